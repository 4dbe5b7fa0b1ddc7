// SPDX-License-Identifier: MIT
// Skins of a glTF model: the joints that its meshes follow.
#pragma once
#include <framework/scene/gltf_import.h>

namespace lodestir {

/// Gives each mesh that waits in `import.skinned` its skin (glTF 2.0, section 3.7.3.3), once all nodes are loaded. Joints that are not in
/// the scene, matrices that are missing and vertices that follow a joint past the last are gathered as problems.
void loadGltfSkins(GltfImport& import);

}  // namespace lodestir
