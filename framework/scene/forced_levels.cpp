// SPDX-License-Identifier: MIT
#include <framework/scene/forced_levels.h>

#include <framework/core/error.h>
#include <framework/scene/level_policy.h>

#include <algorithm>
#include <charconv>
#include <set>
#include <string_view>

namespace lodestir {
namespace {

constexpr std::string_view freed = "auto";

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
    return text;
}

/// A whole number and nothing else.
std::optional<std::uint32_t> numberIn(std::string_view text) {
    std::uint32_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

ForcedLevel readOne(std::string_view text) {
    const std::size_t equals = text.rfind('=');
    const std::string_view who = trimmed(text.substr(0, equals)), level = equals == text.npos ? "" : trimmed(text.substr(equals + 1));
    const std::optional<std::uint32_t> number = numberIn(level);
    if (who.empty() || (level != freed && (!number || *number >= std::uint32_t(maxLevels))))
        throw Error("\"" + std::string(text) + "\" forces no level", "write it like rock=2, #3=0 or *=auto, with commas between");
    return {std::string(who), number ? std::optional(int(*number)) : std::nullopt};
}

std::vector<std::uint32_t> meantBy(const Scene& scene, const std::string& who) {
    std::vector<std::uint32_t> meant;
    if (who == "*") {
        for (std::uint32_t i = 0; i < scene.instances.size(); ++i) meant.push_back(i);
    } else if (const auto number = who.starts_with('#') ? numberIn(std::string_view(who).substr(1)) : std::nullopt) {
        if (*number < scene.instances.size()) meant.push_back(*number);
    } else {
        meant = instancesNamed(scene, who);
    }
    if (!meant.empty()) return meant;
    std::set<std::string> names;
    for (const Instance& instance : scene.instances) names.insert(instance.name);
    throw Error(Where{scene.file.string()}, "there is no instance \"" + who + "\" to force a level on",
                didYouMean(who, std::vector<std::string>(names.begin(), names.end())));
}

}  // namespace

std::vector<ForcedLevel> readForced(const std::string& text) {
    std::vector<ForcedLevel> forced;
    if (trimmed(text).empty()) return forced;
    for (std::size_t from = 0; from <= text.size();) {
        const std::size_t comma = std::min(text.find(',', from), text.size());
        forced.push_back(readOne(trimmed(std::string_view(text).substr(from, comma - from))));
        from = comma + 1;
    }
    return forced;
}

std::string writeForced(const std::vector<ForcedLevel>& forced) {
    std::string text;
    for (const ForcedLevel& f : forced) {
        if (!text.empty()) text += ", ";
        text += f.who + "=" + (f.level ? std::to_string(*f.level) : std::string(freed));
    }
    return text;
}

std::string whoIs(const Scene& scene, std::uint32_t instance) {
    const auto says = [&](const std::string& name) {
        const bool plain = !name.empty() && name != "*" && name.front() != '#' && name.find(',') == name.npos && trimmed(name) == name;
        return plain && instancesNamed(scene, name) == std::vector{instance};
    };
    if (says(scene.instances[instance].name)) return scene.instances[instance].name;
    for (std::uint32_t node = scene.instances[instance].node; node != none; node = scene.nodes[node].parent)
        if (says(scene.nodes[node].name)) return scene.nodes[node].name;  // a model's parts are told apart by where the scene file puts it
    return "#" + std::to_string(instance);
}

std::vector<std::uint32_t> forcedLevels(const Scene& scene, const std::string& text) {
    std::vector<std::uint32_t> levels(scene.instances.size(), none);
    for (const ForcedLevel& forced : readForced(text))
        for (const std::uint32_t i : meantBy(scene, forced.who)) {
            const auto coarsest = std::uint32_t(scene.meshes[scene.instances[i].mesh].levels.size() - 1);
            levels[i] = forced.level ? std::min(std::uint32_t(*forced.level), coarsest) : none;
        }
    return levels;
}

}  // namespace lodestir
