// SPDX-License-Identifier: MIT
// Light for scenes that bring none.
#pragma once
#include <framework/scene/scene.h>

namespace lodestir {

/// Adds a sky with the sun where the scene does not light itself, or a lamp at its camera where that stands in a closed shell that no sky
/// could shine into; says so in a note. The scene needs its camera before. `keepExposure`: the scene file has set one.
void addDefaultLight(Scene& scene, bool keepExposure);

}  // namespace lodestir
