// SPDX-License-Identifier: MIT
// Animations of a glTF model: channels of the nodes' translations, rotations, scales and morph weights.
#pragma once
#include <framework/scene/gltf/import.h>

namespace lodestir {

/// Appends the channels of the chosen animation, or of all of them, which play together then; where two of them move the same value of a node the first one
/// counts. Channels of nodes outside the scene are left out; an animation with keys that cannot be played is left out whole, with a note.
void loadGltfAnimations(GltfImport& import);

/// The animation's name, or "animation N".
std::string gltfAnimationName(const GltfFile& file, std::size_t animation);

}  // namespace lodestir
