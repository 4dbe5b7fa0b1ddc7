// SPDX-License-Identifier: MIT
// What makes a source a scene. Each is a program of its own, generate_NAME, that writes build/scenes/NAME.glb.
#pragma once

#include "glb.h"

namespace lodestir::generate {

/// The scene of this program; LODESTIR_SCENE defines it.
Glb scene();

}  // namespace lodestir::generate

/// LODESTIR_SCENE(make) or LODESTIR_SCENE(make, "--levels 4 --mesh rock") ends the source of a scene, NAME.cpp. The build reads what follows the
/// function: `lodestir lod` adds levels of detail to the model with these options.
#define LODESTIR_SCENE(make, ...) \
    Glb scene() { return make(); }

/// The same for a scene of so many triangles that no build makes it unless asked: cmake --build --preset release --target scene_NAME.
#define LODESTIR_LARGE_SCENE(make) LODESTIR_SCENE(make)
