// SPDX-License-Identifier: MIT
#include <framework/core/merge_patch.h>

#include <algorithm>

namespace lodestir {
namespace {

/// An object's text, taken apart so that all parts together are the text again.
struct ObjectText {
    struct Member {
        std::string_view before;  ///< space in front of the key
        std::string key;          ///< as it is written, quotes and all
        std::string_view between; ///< the colon, with the space around it
        std::string value;
        std::string_view after;   ///< space in front of the comma
    };
    std::vector<Member> members;
    std::string_view end;  ///< space in front of the closing brace
};

/// Walks along text that is known to be JSON.
class Scanner {
public:
    explicit Scanner(std::string_view text) : text_(text) {}

    std::string_view space() {
        return take(std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size()));
    }
    std::string_view value() {
        if (text_[at_] == '"') return string();
        if (text_[at_] != '{' && text_[at_] != '[') return take(std::min(text_.find_first_of(",]} \t\r\n", at_), text_.size()));
        const std::size_t start = at_;
        int depth = 0;
        do {
            if (text_[at_] == '"') {
                string();
                continue;
            }
            if (text_[at_] == '{' || text_[at_] == '[') ++depth;
            if (text_[at_] == '}' || text_[at_] == ']') --depth;
            ++at_;
        } while (depth > 0);
        return text_.substr(start, at_ - start);
    }
    std::string_view colon() {
        const std::size_t start = at_;
        space();
        ++at_;
        space();
        return text_.substr(start, at_ - start);
    }
    /// Goes over one of these and says whether it was it.
    bool skip(char c) {
        if (text_[at_] != c) return false;
        ++at_;
        return true;
    }

private:
    std::string_view take(std::size_t end) {
        const std::string_view taken = text_.substr(at_, end - at_);
        at_ = end;
        return taken;
    }
    std::string_view string() {
        std::size_t end = at_ + 1;
        while (text_[end] != '"') end += text_[end] == '\\' ? 2 : 1;
        return take(end + 1);
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

ObjectText takenApart(std::string_view text) {
    Scanner scanner(text);
    ObjectText object;
    scanner.skip('{');
    std::string_view space = scanner.space();
    while (!scanner.skip('}')) {
        ObjectText::Member member{.before = space};
        member.key = scanner.value();
        member.between = scanner.colon();
        member.value = scanner.value();
        space = scanner.space();
        if (scanner.skip(',')) {
            member.after = space;
            space = scanner.space();
        }
        object.members.push_back(std::move(member));
    }
    object.end = space;
    return object;
}

std::string put(const ObjectText& object) {
    std::string text = "{";
    for (std::size_t i = 0; i < object.members.size(); ++i) {
        const ObjectText::Member& member = object.members[i];
        if (i > 0) text += ',';
        text.append(member.before).append(member.key).append(member.between).append(member.value).append(member.after);
    }
    return text.append(object.end) + '}';
}

/// On one line, with the spaces that people write.
std::string written(const Json& value, Nulls nulls) {
    if (!value.isObject()) return value.dump(-1);
    std::string text;
    for (const auto& [key, member] : value.members()) {
        if (member.isNull() && nulls == Nulls::remove) continue;
        text += (text.empty() ? "{ " : ", ") + Json(key).dump(-1) + ": " + written(member, nulls);
    }
    return text.empty() ? "{}" : text + " }";
}

void merge(ObjectText& object, const Json& patch, Nulls nulls) {
    for (const auto& [key, value] : patch.members()) {
        const auto member = std::ranges::find_if(object.members, [&](const auto& m) { return Json::parse(m.key, "").asString() == key; });
        const bool removes = value.isNull() && nulls == Nulls::remove;
        if (member == object.members.end()) {
            if (removes) continue;
            if (object.members.empty()) object.end = " ";
            const std::string_view before = object.members.empty() ? " " : object.members.back().before;
            object.members.push_back({before, Json(key).dump(-1), ": ", written(value, nulls), ""});
        } else if (removes) {
            const bool first = member == object.members.begin();
            const std::string_view before = member->before;
            const auto next = object.members.erase(member);
            if (first && next != object.members.end()) next->before = before;  // behind the brace, as the first one was
        } else if (value.isObject() && member->value.starts_with('{')) {
            member->value = mergedText(member->value, value, nulls);
        } else {
            member->value = written(value, nulls);
        }
    }
}

}  // namespace

Json mergePatch(const Json& from, const Json& to) {
    Json patch = Json::object();
    for (const auto& [key, value] : from.members())
        if (!to.find(key)) patch[key] = Json();
    for (const auto& [key, value] : to.members()) {
        const Json* old = from.find(key);
        if (!old) {
            patch[key] = value;
        } else if (old->isObject() && value.isObject()) {
            Json inner = mergePatch(*old, value);
            if (!inner.members().empty()) patch[key] = std::move(inner);
        } else if (old->dump(-1) != value.dump(-1)) {
            patch[key] = value;
        }
    }
    return patch;
}

std::string mergedText(std::string_view text, const Json& patch, Nulls nulls) {
    const std::size_t begin = text.find('{'), end = text.rfind('}') + 1;
    ObjectText object = takenApart(text.substr(begin, end - begin));
    merge(object, patch, nulls);
    return std::string(text.substr(0, begin)).append(put(object)).append(text.substr(end));
}

}  // namespace lodestir
