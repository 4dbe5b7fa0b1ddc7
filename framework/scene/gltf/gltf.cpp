// SPDX-License-Identifier: MIT
// The steps of loading a glTF model, in order.
#include <framework/scene/gltf/gltf.h>
#include <framework/scene/gltf/animation.h>
#include <framework/scene/gltf/material.h>
#include <framework/scene/gltf/node.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace lodestir {
namespace {

void noteIgnoredExtensions(GltfImport& import) {
    std::set<std::string> ignored;
    for (const std::string& name : import.file.model.extensionsUsed) {
        if (!isSupportedGltfExtension(name)) ignored.insert(name);
    }
    if (!ignored.empty()) import.note(fmt::format("ignored: {}", fmt::join(ignored, ", ")));
}

/// Place of the chosen name, -1 where none is chosen; tells the names then, where there is a choice.
int choose(GltfImport& import, const GltfChoice& choice, const std::vector<std::string>& names, const char* what) {
    if (choice.name.empty()) {
        if (names.size() > 1) import.note(fmt::format("{}s to choose from: \"{}\"", what, fmt::join(names, "\", \"")));
        return -1;
    }
    const auto found = std::find(names.begin(), names.end(), choice.name);
    if (found != names.end()) return static_cast<int>(found - names.begin());
    const std::string file = import.file.path.filename().string();
    if (names.empty()) {
        import.problems.add(choice.where, fmt::format("{} has no {}s", file, what));
        return -1;
    }
    std::string hint = didYouMean(choice.name, names);
    if (hint.empty()) hint = fmt::format("known: {}", fmt::join(names, ", "));
    import.problems.add(choice.where, fmt::format("{} has no {} \"{}\"", file, what, choice.name), hint);
    return -1;
}

std::vector<std::string> variantNames(const GltfFile& file) {
    const Json* extensions = file.json.find("extensions");
    const Json* extension = extensions ? extensions->find("KHR_materials_variants") : nullptr;
    const Json* variants = extension ? extension->find("variants") : nullptr;
    std::vector<std::string> names;
    if (!variants || !variants->isArray()) return names;
    for (const Json& variant : variants->items()) {
        const Json* name = variant.find("name");
        names.push_back(name && name->isString() ? name->asString() : fmt::format("variant {}", names.size()));
    }
    return names;
}

std::vector<std::string> animationNames(const GltfFile& file) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < file.model.animations.size(); ++i) names.push_back(gltfAnimationName(file, i));
    return names;
}

}  // namespace

void loadGltf(const Path& path, Scene& scene, std::uint32_t parentNode, const GltfChoices& choices) {
    const GltfFile file = readGltfFile(path);
    Problems problems;
    GltfImport import{file, scene, problems};
    for (const std::string& note : file.notes) import.note(note);
    noteIgnoredExtensions(import);
    import.variant = choose(import, choices.variant, variantNames(file), "material variant");
    import.animation = choose(import, choices.animation, animationNames(file), "animation");
    GltfTextures textures(import);
    loadGltfMaterials(import, textures);
    loadGltfNodes(import, parentNode);
    loadGltfAnimations(import);
    textures.decode();
    problems.raise();
}

}  // namespace lodestir
