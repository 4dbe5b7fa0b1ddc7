// SPDX-License-Identifier: MIT
// A furnace: a closed room and things in it that all reflect one half and glow with radiance 1. Every path of n scatterings or fewer then
// brings the sum of 2^-i over i = 0..n, whatever it meets. Facets are flat: shading normals would lose light at their edges.
#include <utility>

#include "kit/scene.h"
#include "kit/shapes.h"
#include "kit/still_life.h"

namespace lodestir::generate {

namespace {

Glb makeFurnace() {
    Composition c;
    Material clay = matt("clay", glm::vec3(0.5f));
    clay.emission = glm::vec3(1);
    const int all = c.glb.addMaterial(clay);
    c.glb.addNode(chamber({}, {all, all, all, all, all, all}));

    // They float: faces that lie in the floor would be seen from both sides at once.
    c.put("gem", all, gem(8), {.translation = {-0.55f, 0.75f, 0.1f}, .scale = glm::vec3(0.5f)});
    c.put("block", all, plainBox({0.6f, 0.9f, 0.5f}), {.translation = {0.6f, 0.6f, -0.2f}, .rotation = turnY(25)});
    c.put("ball", all, faceted(sphere(12, 8)), {.translation = {0.62f, 1.4f, -0.1f}, .scale = {0.22f, 0.3f, 0.22f}});
    return std::move(c.glb);
}

}  // namespace

LODESTIR_SCENE(makeFurnace)

}  // namespace lodestir::generate
