// SPDX-License-Identifier: MIT
#include <framework/image/exr_layers.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <string_view>
#include <utility>

namespace lodestir {
namespace {

std::string lowerCase(std::string_view text) {
    std::string result(text);
    std::ranges::transform(result, result.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

/// A layer as it is found: its channels' names, and what they are called in it.
struct Found {
    std::size_t part = 0;
    std::string prefix;
    std::vector<std::string> names, roles;

    /// Adds the first channel that has one of these roles; true where there is one.
    bool take(std::vector<std::string>& channels, std::initializer_list<std::string_view> wanted) const {
        const auto role = std::ranges::find_first_of(roles, wanted);
        if (role == roles.end()) return false;
        channels.push_back(names[static_cast<std::size_t>(role - roles.begin())]);
        return true;
    }
    bool has(std::string_view role) const { return std::ranges::find(roles, role) != roles.end(); }
    /// OpenEXR's own conversion knows these names in capitals and reads the first part.
    bool hasLuminanceChroma() const {
        const auto named = [&](const char* role) {
            return std::ranges::find(names, prefix.empty() ? role : prefix + "." + role) != names.end();
        };
        return part == 0 && named("Y") && named("RY") && named("BY");
    }
};

std::vector<Found> layersOf(const std::vector<ExrPart>& parts) {
    std::vector<Found> layers;
    std::map<std::pair<std::size_t, std::string>, std::size_t> places;  // damaged files may have any number of them
    for (std::size_t p = 0; p < parts.size(); ++p) {
        for (const std::string& channel : parts[p].channels) {
            const std::size_t dot = channel.rfind('.');
            const std::string prefix = dot == channel.npos ? "" : channel.substr(0, dot);
            const auto [place, isNew] = places.try_emplace({p, prefix}, layers.size());
            if (isNew) layers.push_back({.part = p, .prefix = prefix, .names = {}, .roles = {}});
            layers[place->second].names.push_back(channel);
            layers[place->second].roles.push_back(lowerCase(dot == channel.npos ? channel : channel.substr(dot + 1)));
        }
    }
    return layers;
}

ExrLayer understood(const Found& found, const std::vector<ExrPart>& parts) {
    ExrLayer layer{.part = found.part, .name = found.prefix, .prefix = found.prefix, .channels = {}, .others = {}};
    if (parts.size() > 1) layer.name = parts[found.part].name + (found.prefix.empty() ? "" : "." + found.prefix);
    auto& channels = layer.channels;
    const auto takeOpacity = [&] { layer.hasOpacity = found.take(channels, {"a", "alpha"}); };
    if (found.hasLuminanceChroma()) {
        layer.content = ExrContent::luminanceChroma;
        channels = {"R", "G", "B"};
        if (std::ranges::find(found.names, found.prefix.empty() ? "A" : found.prefix + ".A") != found.names.end()) {
            layer.hasOpacity = true;
            channels.emplace_back("A");
        }
        return layer;
    }
    found.take(channels, {"r", "red"});
    found.take(channels, {"g", "green"});
    found.take(channels, {"b", "blue"});
    if (!channels.empty()) {
        layer.content = channels.size() == 3 ? ExrContent::color : ExrContent::someColors;
        takeOpacity();
    } else if (!found.has("x") && found.take(channels, {"y"})) {
        layer.content = ExrContent::grey;
        takeOpacity();
    } else if (found.has("x") && found.has("y")) {
        layer.content = ExrContent::vector;
        for (const char* axis : {"x", "y", "z"}) found.take(channels, {axis});
    }
    return layer;
}

bool isCalledImage(const std::string& name) {
    constexpr std::array<std::string_view, 6> known{"combined", "beauty", "rgba", "rgb", "color", "colour"};
    const std::string lower = lowerCase(name);
    for (std::size_t start = 0; start <= lower.size();) {
        const std::size_t end = std::min(lower.find('.', start), lower.size());
        if (std::ranges::find(known, std::string_view(lower).substr(start, end - start)) != known.end()) return true;
        start = end + 1;
    }
    return false;
}

/// Colour stored as luminance and chroma is colour.
ExrContent rankOf(const ExrLayer& layer) { return layer.content == ExrContent::luminanceChroma ? ExrContent::color : layer.content; }

ExrLayer everything(const std::vector<ExrPart>& parts) {
    ExrLayer all;
    while (all.part + 1 < parts.size() && parts[all.part].channels.empty()) ++all.part;
    if (all.part >= parts.size() || parts[all.part].channels.empty()) return {};
    all.channels = parts[all.part].channels;
    const auto opacity = std::ranges::find(all.channels, "A");
    all.hasOpacity = opacity != all.channels.end();
    if (all.hasOpacity) std::rotate(opacity, opacity + 1, all.channels.end());
    return all;
}

}  // namespace

ExrLayer chooseLayer(const std::vector<ExrPart>& parts) {
    std::vector<ExrLayer> layers;
    for (const Found& found : layersOf(parts)) {
        ExrLayer layer = understood(found, parts);
        if (layer.content != ExrContent::unknown) layers.push_back(std::move(layer));
    }
    if (layers.empty()) return everything(parts);
    const auto best = std::ranges::min_element(layers, {}, [](const ExrLayer& layer) {
        return std::pair(rankOf(layer), layer.name.empty() ? 0 : isCalledImage(layer.name) ? 1 : 2);
    });
    ExrLayer chosen = *best;
    for (const ExrLayer& layer : layers)
        if (&layer != &*best && rankOf(layer) == rankOf(chosen)) chosen.others.push_back(layer.name);
    return chosen;
}

}  // namespace lodestir
