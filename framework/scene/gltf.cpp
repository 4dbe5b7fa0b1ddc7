// SPDX-License-Identifier: MIT
// The steps of loading a glTF model, in order.
#include <framework/scene/gltf.h>
#include <framework/scene/gltf_animation.h>
#include <framework/scene/gltf_material.h>
#include <framework/scene/gltf_node.h>

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

/// Finds the chosen one of KHR_materials_variants; tells their names where none is chosen.
void chooseVariant(GltfImport& import, const VariantChoice& choice) {
    const Json* extensions = import.file.json.find("extensions");
    const Json* extension = extensions ? extensions->find("KHR_materials_variants") : nullptr;
    const Json* variants = extension ? extension->find("variants") : nullptr;
    std::vector<std::string> names;
    if (variants && variants->isArray()) {
        for (const Json& variant : variants->items()) {
            const Json* name = variant.find("name");
            names.push_back(name && name->isString() ? name->asString() : fmt::format("variant {}", names.size()));
        }
    }
    if (choice.name.empty()) {
        if (!names.empty()) import.note(fmt::format("material variants to choose from: \"{}\"", fmt::join(names, "\", \"")));
        return;
    }
    const auto found = std::find(names.begin(), names.end(), choice.name);
    if (found != names.end()) {
        import.variant = static_cast<int>(found - names.begin());
        return;
    }
    const std::string file = import.file.path.filename().string();
    if (names.empty()) return import.problems.add(choice.where, fmt::format("{} has no material variants", file));
    std::string hint = didYouMean(choice.name, names);
    if (hint.empty()) hint = fmt::format("known: {}", fmt::join(names, ", "));
    import.problems.add(choice.where, fmt::format("{} has no material variant \"{}\"", file, choice.name), hint);
}

}  // namespace

void loadGltf(const Path& path, Scene& scene, std::uint32_t parentNode, const VariantChoice& variant) {
    const GltfFile file = readGltfFile(path);
    Problems problems;
    GltfImport import{file, scene, problems};
    noteIgnoredExtensions(import);
    chooseVariant(import, variant);
    GltfTextures textures(import);
    loadGltfMaterials(import, textures);
    loadGltfNodes(import, parentNode);
    loadGltfAnimations(import);
    textures.decode();
    problems.raise();
}

}  // namespace lodestir
