// SPDX-License-Identifier: MIT
// Loads glTF 2.0 models (.gltf, .glb) into a scene.
#pragma once
#include <framework/scene/scene.h>

namespace lodestir {

/// Appends a model: its nodes under `parentNode` (`none`: as roots), meshes, materials, textures, lights, animation, and its first
/// perspective camera when the scene has no camera yet (keys empty). Extensions: KHR_lights_punctual, KHR_materials_emissive_strength,
/// _ior, _transmission, _volume, KHR_texture_transform, KHR_mesh_quantization, EXT_mesh_gpu_instancing, MSFT_lod (nodes);
/// approximated with a note: KHR_materials_unlit, KHR_materials_pbrSpecularGlossiness.
/// Error with every problem found, each at its JSON pointer; the scene is not to be used then.
LODESTIR_API void loadGltf(const Path& path, Scene& scene, std::uint32_t parentNode);

}  // namespace lodestir
