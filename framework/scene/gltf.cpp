// SPDX-License-Identifier: MIT
// The steps of loading a glTF model, in order.
#include <framework/scene/gltf.h>
#include <framework/scene/gltf_animation.h>
#include <framework/scene/gltf_material.h>
#include <framework/scene/gltf_node.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace lodestir {
namespace {

void noteIgnoredExtensions(GltfImport& import) {
    std::set<std::string> ignored;
    for (const std::string& name : import.file.model.extensionsUsed) {
        if (!isSupportedGltfExtension(name)) ignored.insert(name);
    }
    if (!ignored.empty()) import.note(fmt::format("ignored: {}", fmt::join(ignored, ", ")));
}

}  // namespace

void loadGltf(const Path& path, Scene& scene, std::uint32_t parentNode) {
    const GltfFile file = readGltfFile(path);
    Problems problems;
    GltfImport import{file, scene, problems};
    noteIgnoredExtensions(import);
    GltfTextures textures(import);
    loadGltfMaterials(import, textures);
    loadGltfNodes(import, parentNode);
    loadGltfAnimations(import);
    textures.decode();
    problems.raise();
}

}  // namespace lodestir
