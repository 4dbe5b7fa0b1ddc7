// SPDX-License-Identifier: MIT
// Materials of a glTF model: metallic-roughness with emissive_strength, transmission, ior, volume, layers, unlit and texture transforms.
#pragma once
#include <framework/scene/gltf/texture.h>

namespace lodestir {

/// Appends all materials of the file to Scene::materials, asking `textures` for what they use. Values out of their range are
/// clamped; what cannot be meant is replaced by its default with a note.
void loadGltfMaterials(GltfImport& import, GltfTextures& textures);

/// The texture whose coordinates the tangents of a material's meshes follow; nothing where no tangents are needed.
std::optional<TextureSlot> tangentSlot(const Material& material);

/// The scene's material of a primitive: that of the chosen variant, else its own, else, or where that isn't there, the
/// default one of glTF (white, metallic and rough).
std::uint32_t gltfMaterial(GltfImport& import, const tinygltf::Primitive& primitive);

}  // namespace lodestir
