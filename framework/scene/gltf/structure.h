// SPDX-License-Identifier: MIT
// The structure of a glTF file: its JSON as tinygltf's model.
#pragma once
#include <framework/scene/gltf/file.h>

namespace lodestir {

/// Makes `file.model` of `file.json`. Animations, cameras, skins and lights that are not as the format demands are left out with a note;
/// Error for anything else that isn't.
void parseGltfStructure(GltfFile& file);

}  // namespace lodestir
