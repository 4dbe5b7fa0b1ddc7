// SPDX-License-Identifier: MIT
// Panes: what lets light go straight on. A path goes through them by a delta lobe of their BSDF; light that no path can find, because it has
// no extent, goes through them by the same share, along its shadow ray.
#include "bsdf/material.glsl"
#include "world/ray.h"

/// What becomes of the light along a ray.
struct Passage {
    vec3 left;   // share of it
    float last;  // t of the last pane
};

Passage passageStart() { return Passage(vec3(1.0), -FAR); }

/// Whether light comes to an end on a triangle that an any-hit ray meets at `hit`. Two that meet the ray within the error of positions are one
/// pane, to paths as well: triangles that share the edge it goes through, or a sheet made of two.
bool endsLight(World w, Ray ray, Hit hit, inout Passage passage) {
    if (SCENE_PANES == 0 || (ray.flags & RAY_THROUGH_PANES) == 0u) return true;
    if ((w.materials.at[w.primitives.at[hit.primitive].material].flags & MATERIAL_PANE) == 0u) return true;
    Surface s = surfaceAt(w, hit, ray.direction);
    float apart = 4.0 * s.rounding / max(abs(dot(s.normal, s.view)), 0.01);
    bool again = abs(hit.t - passage.last) * length(ray.direction) <= apart;
    if (!again) passage.left *= straightOn(bsdfAt(w, s), s.view);
    passage.last = hit.t;
    return passage.left == vec3(0.0);
}

/// What an any-hit ray says that has `hit`, which may be none.
Hit arrivedHit(Hit hit, Passage passage) {
    return SCENE_PANES == 0 || hit.primitive != NONE ? hit : Hit(passage.left.x, passage.left.yz, NONE, NONE);
}
