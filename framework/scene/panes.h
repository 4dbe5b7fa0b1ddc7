// SPDX-License-Identifier: MIT
// Surfaces that let light go straight on: shaders/trace/pane.glsl.
#pragma once
#include <framework/scene/scene.h>

namespace lodestir {

/// May transmission through the material be clear, a delta lobe of its BSDF? It is where the perceptual roughness is below 0.0316
/// (shaders/bsdf/bsdf.glsl, ALPHA_DELTA); a map may make it so in places.
bool isClear(const Material& m);

/// May light go straight on through a surface of the material? It does where the surface blends, where a thin wall is clear, and where an unlit
/// one is seen from behind.
bool isPane(const Material& m);

/// Has the scene panes, and lights without extent (point, spot, directional) to shine through them?
bool lightsShineThroughPanes(const Scene& scene);

}  // namespace lodestir
