// SPDX-License-Identifier: MIT
// Skins of a glTF model: the joints that its meshes follow.
#pragma once
#include <framework/scene/gltf/import.h>

namespace lodestir {

/// Gives each mesh that waits in `import.skinned` its skin (glTF 2.0, section 3.7.3.3), once all nodes are loaded. A skin with a joint that
/// is not in the scene or without its matrices is left out with a note, and its meshes stand as they were modelled; vertices follow no joint
/// past the last.
void loadGltfSkins(GltfImport& import);

}  // namespace lodestir
