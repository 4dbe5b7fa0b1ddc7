// SPDX-License-Identifier: MIT
// Loads glTF 2.0 models (.gltf, .glb) into a scene.
#pragma once
#include <framework/core/error.h>
#include <framework/scene/scene.h>

namespace lodestir {

/// A name out of several of a model, and where somebody chose it.
struct GltfChoice {
    std::string name;  ///< empty: none is chosen
    Where where;
};

struct GltfChoices {
    GltfChoice variant;    ///< of KHR_materials_variants; none: the materials as they are
    GltfChoice animation;  ///< none: all play together
};

/// Nodes of a scene, each instance being one; a small file can ask for any number by instancing what instances.
inline constexpr std::size_t maxNodes = std::size_t(1) << 22;

/// Appends a model: its nodes under `parentNode` (`none`: as roots), meshes, materials, textures, lights, animation, and its first
/// camera when the scene has no camera yet (keys empty). Skins and morph targets deform their meshes. Extensions:
/// KHR_lights_punctual, KHR_materials_emissive_strength, _ior, _transmission, _volume, _specular, _sheen, _anisotropy, _clearcoat, _unlit,
/// KHR_materials_variants, KHR_texture_transform, KHR_mesh_quantization, EXT_meshopt_compression, KHR_meshopt_compression,
/// EXT_mesh_gpu_instancing, MSFT_lod (nodes);
/// approximated with a note: KHR_materials_pbrSpecularGlossiness.
/// What a model can be shown without (a skin, an animation, a texture, a light or a camera that is broken or isn't there) is left out with a
/// note; what is wrong with its hierarchy, its geometry or its bytes is an Error with every problem found, each at its JSON pointer, and the
/// scene is not to be used then.
LODESTIR_API void loadGltf(const Path& path, Scene& scene, std::uint32_t parentNode, const GltfChoices& choices = {});

}  // namespace lodestir
