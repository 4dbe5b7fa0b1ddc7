// SPDX-License-Identifier: MIT
// Materials of a glTF model: metallic-roughness with emissive_strength, transmission, ior, volume and texture transforms.
#pragma once
#include <framework/scene/gltf_texture.h>

namespace lodestir {

/// Appends all materials of the file to Scene::materials, asking `textures` for what they use. Values out of their range are
/// clamped, wrong indices gathered as problems.
void loadGltfMaterials(GltfImport& import, GltfTextures& textures);

/// The scene's material of a primitive: the file's material `index`, or for -1 the default one of glTF (white, metallic and rough).
std::uint32_t gltfMaterial(GltfImport& import, int index, const std::string& user);

}  // namespace lodestir
