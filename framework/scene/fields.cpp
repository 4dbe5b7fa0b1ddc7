// SPDX-License-Identifier: MIT
// Typed reading of JSON members.
#include <framework/scene/fields.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lodestir {

Fields::Fields(const Json& value, std::string what, Problems& problems) : value_(value), what_(std::move(what)), problems_(problems) {
    if (!value.isObject()) problems_.add(value.where(), fmt::format("{} must be an object, not {}", what_, value.kindName()));
}

void Fields::finish() {
    if (value_.isObject()) value_.expectOnly(known_, what_, problems_);
}

void Fields::allow(std::initializer_list<const char*> keys) { known_.insert(known_.end(), keys.begin(), keys.end()); }

const Json* Fields::find(const char* key) {
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
    return value_.find(key);
}

const Json* Fields::require(const char* key) {
    const Json* member = find(key);
    if (!member && value_.isObject()) problems_.add(value_.where(), fmt::format("{} needs \"{}\"", what_, key));
    return member;
}

void Fields::number(const char* key, float& value, double least, double most) {
    const Json* member = find(key);
    if (!member) return;
    try {
        const double read = member->asNumber(fmt::format("\"{}\"", key));
        if (read < least || read > most || !std::isfinite(float(read))) {
            const std::string range = std::isinf(most) ? fmt::format("at least {}", least) : fmt::format("{} to {}", least, most);
            problems_.add(member->where(), fmt::format("\"{}\" of {} is {}, outside its range", key, what_, read), "allowed: " + range);
            return;
        }
        value = static_cast<float>(read);
    } catch (const Error& error) {
        problems_.add(error);
    }
}

void Fields::integer(const char* key, int& value, int least, int most) {
    const Json* member = find(key);
    if (!member) return;
    try {
        const std::int64_t read = member->asInt(fmt::format("\"{}\"", key));
        if (read < least || read > most) {
            problems_.add(member->where(), fmt::format("\"{}\" of {} is {}, outside its range", key, what_, read),
                          least == most ? fmt::format("allowed: {}", least) : fmt::format("allowed: {} to {}", least, most));
            return;
        }
        value = static_cast<int>(read);
    } catch (const Error& error) {
        problems_.add(error);
    }
}

void Fields::text(const char* key, std::string& value) {
    const Json* member = find(key);
    if (!member) return;
    try {
        value = member->asString(fmt::format("\"{}\"", key));
    } catch (const Error& error) {
        problems_.add(error);
    }
}

void Fields::vector(const char* key, glm::vec3& value) {
    const Json* member = find(key);
    if (!member) return;
    try {
        const std::vector<double> read = numbersOf(*member, fmt::format("\"{}\"", key), 3);
        value = {read[0], read[1], read[2]};
    } catch (const Error& error) {
        problems_.add(error);
    }
}

void Fields::color(const char* key, glm::vec3& value) {
    glm::vec3 read = value;
    vector(key, read);
    if (std::min({read.r, read.g, read.b}) >= 0)
        value = read;
    else
        problems_.add(find(key)->where(), fmt::format("\"{}\" of {} has a negative component", key, what_));
}

void Fields::choice(const char* key, std::size_t& value, const std::vector<std::string>& names) {
    const Json* member = find(key);
    if (!member) return;
    try {
        const std::string& name = member->asString(fmt::format("\"{}\"", key));
        const auto found = std::find(names.begin(), names.end(), name);
        if (found == names.end())
            problems_.add(member->where(), fmt::format("\"{}\" is no {} of {}", name, key, what_), didYouMean(name, names));
        else
            value = static_cast<std::size_t>(found - names.begin());
    } catch (const Error& error) {
        problems_.add(error);
    }
}

std::vector<double> numbersOf(const Json& value, const std::string& what, std::size_t count) {
    if (!value.isArray() || value.items().size() != count) {
        throw Error(value.where(), fmt::format("{} must be an array of {} numbers", what, count));
    }
    std::vector<double> result;
    for (const Json& item : value.items()) {
        result.push_back(item.asNumber(fmt::format("each element of {}", what)));
        if (!std::isfinite(static_cast<float>(result.back())))
            throw Error(item.where(), fmt::format("an element of {} is too large", what));
    }
    return result;
}

}  // namespace lodestir
