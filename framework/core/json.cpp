// SPDX-License-Identifier: MIT
// JSON values: checked access, editing, merge patches, and text.
#include <framework/core/json.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace lodestir {
namespace {

const char* nameOf(Json::Kind kind) {
    switch (kind) {
    case Json::Kind::null: return "null";
    case Json::Kind::boolean: return "a boolean";
    case Json::Kind::integer: return "an integer";
    case Json::Kind::number: return "a number";
    case Json::Kind::string: return "a string";
    case Json::Kind::array: return "an array";
    case Json::Kind::object: return "an object";
    }
    return "";
}

/// "2 is an integer" in a message: short values are shown themselves.
std::string show(const Json& value) {
    constexpr std::size_t limit = 40;
    std::string text = value.isObject() || value.isArray() ? std::string() : value.dump(-1);
    if (text.empty() || text.size() > limit || value.isNull()) return value.kindName();
    return std::string(value.kindName()) + " (" + text + ")";
}

[[noreturn]] void refuse(const Json& value, std::string_view what, std::string_view expected) {
    throw Error(value.where(), std::string(what) + " must be " + std::string(expected) + ", not " + show(value));
}

/// A value without elements as text; bytes that are not UTF-8 become U+FFFD, numbers that are not finite become null.
std::string plainText(const nlohmann::ordered_json& value) {
    return value.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

/// Objects over several lines; arrays of plain values stay on one, as people write sizes and colours.
void write(std::string& out, const Json& value, int indent, int depth) {
    const std::size_t count = value.isArray() ? value.items().size() : value.isObject() ? value.members().size() : 0;
    if (count == 0) {
        out += plainText(value.plain());
        return;
    }
    const auto isNested = [](const Json& item) { return item.isArray() || item.isObject(); };
    const bool oneLine = indent < 0 || (value.isArray() && std::ranges::none_of(value.items(), isNested));
    const auto separate = [&](std::size_t i, int level) {
        if (i > 0) out += oneLine ? ", " : ",";
        if (!oneLine) out += '\n' + std::string(static_cast<std::size_t>(indent * level), ' ');
    };
    out += value.isArray() ? '[' : '{';
    for (std::size_t i = 0; i < count; ++i) {
        separate(i, depth + 1);
        if (value.isObject()) out += plainText(value.members()[i].first) + ": ";
        write(out, value.isArray() ? value.items()[i] : value.members()[i].second, indent, depth + 1);
    }
    separate(0, depth);
    out += value.isArray() ? ']' : '}';
}

}  // namespace

Json::Json(bool value) : kind_(Kind::boolean), boolean_(value) {}
Json::Json(int value) : kind_(Kind::integer), integer_(value) {}
Json::Json(std::int64_t value) : kind_(Kind::integer), integer_(value) {}
Json::Json(double value) : kind_(Kind::number), number_(value) {}
Json::Json(std::string value) : kind_(Kind::string), string_(std::move(value)) {}
Json::Json(const char* value) : Json(std::string(value)) {}

Json Json::array() {
    Json value;
    value.kind_ = Kind::array;
    return value;
}

Json Json::object() {
    Json value;
    value.kind_ = Kind::object;
    return value;
}

const char* Json::kindName() const { return nameOf(kind_); }

void Json::moveTo(const Where& where) {
    where_ = keyWhere_ = where;
    for (Json& item : items_) item.moveTo(where);
    for (Member& member : members_) member.second.moveTo(where);
}

Json Json::from(const nlohmann::ordered_json& value) {
    using Type = nlohmann::ordered_json::value_t;
    switch (value.type()) {
    case Type::boolean: return Json(value.get<bool>());
    case Type::number_integer: return Json(value.get<std::int64_t>());
    case Type::number_unsigned: {
        const auto number = value.get<std::uint64_t>();
        if (number > std::uint64_t(std::numeric_limits<std::int64_t>::max())) {
            throw Error("the integer " + std::to_string(number) + " does not fit into 64 bits with a sign");
        }
        return Json(std::int64_t(number));
    }
    case Type::number_float: return Json(value.get<double>());
    case Type::string: return Json(value.get<std::string>());
    case Type::array: {
        Json result = array();
        for (const auto& item : value) result.items_.push_back(from(item));
        return result;
    }
    case Type::object: {
        Json result = object();
        for (const auto& member : value.items()) result.members_.emplace_back(member.key(), from(member.value()));
        return result;
    }
    case Type::null:
    case Type::binary:
    case Type::discarded: break;
    }
    return {};
}

nlohmann::ordered_json Json::plain() const {
    switch (kind_) {
    case Kind::null: break;
    case Kind::boolean: return boolean_;
    case Kind::integer: return integer_;
    case Kind::number: return number_;
    case Kind::string: return string_;
    case Kind::array: {
        auto result = nlohmann::ordered_json::array();
        for (const Json& item : items_) result.push_back(item.plain());
        return result;
    }
    case Kind::object: {
        auto result = nlohmann::ordered_json::object();
        for (const auto& [key, value] : members_) result[key] = value.plain();
        return result;
    }
    }
    return nullptr;
}

std::string Json::dump(int indent) const {
    std::string text;
    write(text, *this, indent, 0);
    return text;
}

bool Json::asBool(std::string_view what) const {
    if (kind_ != Kind::boolean) refuse(*this, what, "true or false");
    return boolean_;
}

std::int64_t Json::asInt(std::string_view what) const {
    if (kind_ == Kind::integer) return integer_;
    constexpr double limit = 9223372036854775808.0;  // 2^63, the first double beyond
    const bool whole = kind_ == Kind::number && number_ == std::floor(number_) && number_ >= -limit && number_ < limit;
    if (!whole) refuse(*this, what, "an integer");
    return static_cast<std::int64_t>(number_);
}

double Json::asNumber(std::string_view what) const {
    if (!isNumber()) refuse(*this, what, "a number");
    return kind_ == Kind::integer ? static_cast<double>(integer_) : number_;
}

const std::string& Json::asString(std::string_view what) const {
    if (kind_ != Kind::string) refuse(*this, what, "a string");
    return string_;
}

const std::vector<Json>& Json::items(std::string_view what) const {
    if (kind_ != Kind::array) refuse(*this, what, "an array");
    return items_;
}

const std::vector<Json::Member>& Json::members(std::string_view what) const {
    if (kind_ != Kind::object) refuse(*this, what, "an object");
    return members_;
}

const Json* Json::find(std::string_view key) const {
    const auto found = std::ranges::find(members_, key, &Member::first);
    return found == members_.end() ? nullptr : &found->second;
}

Json& Json::operator[](std::string_view key) {
    if (isNull()) kind_ = Kind::object;
    if (!isObject()) refuse(*this, "the value that should get \"" + std::string(key) + "\"", "an object");
    const auto found = std::ranges::find(members_, key, &Member::first);
    if (found != members_.end()) return found->second;
    return members_.emplace_back(std::string(key), Json()).second;
}

void Json::push(Json value) {
    if (isNull()) kind_ = Kind::array;
    if (!isArray()) refuse(*this, "the value that should get an element", "an array");
    items_.push_back(std::move(value));
}

bool Json::remove(std::string_view key) {
    return std::erase_if(members_, [&](const Member& member) { return member.first == key; }) > 0;
}

void Json::merge(const Json& patch) {
    if (!patch.isObject()) {
        *this = patch;
        return;
    }
    if (!isObject()) {
        *this = object();
        where_ = patch.where_;
        keyWhere_ = patch.keyWhere_;
    }
    for (const auto& [key, value] : patch.members_) {
        if (value.isNull()) {
            remove(key);
        } else {
            (*this)[key].merge(value);
        }
    }
}

void Json::expectOnly(std::span<const std::string> known, std::string_view what, Problems& problems) const {
    for (const auto& [key, value] : members(what)) {
        if (std::ranges::find(known, key) != known.end()) continue;
        problems.add(value.keyWhere_, "unknown key \"" + key + "\" in " + std::string(what), didYouMean(key, known));
    }
}

}  // namespace lodestir
