// SPDX-License-Identifier: MIT
// A ray and what it hits, shared by C++ and GLSL.
#ifndef LODESTIR_RAY_H
#define LODESTIR_RAY_H
#include "base/shared.h"

LODESTIR_SHARED_BEGIN

struct Ray {
    vec3 origin;
    float tMin;
    vec3 direction;  // need not be unit: t counts in its length
    float tMax;      // < 0: no ray (a lane that only keeps its subgroup company)
    uint flags;      // RAY_*; bits 8 to 31: number by which it chooses levels (world/ray_levels.glsl)
};
const uint RAY_THROUGH_PANES = 1u;  // an any-hit ray goes on through what lets light straight through (trace/pane.glsl); without, that ends it

struct Hit {
    float t;            // of an any-hit ray that nothing ended, t and barycentrics are the share of light that is left (light/light.glsl)
    vec2 barycentrics;  // weights of the second and third vertex
    uint primitive;     // World.primitives index, NONE: nothing hit
    uint instance;
};

LODESTIR_SHARED_END
LODESTIR_SHARED(Ray, "world/ray.h")
LODESTIR_SHARED(Hit, "world/ray.h")
#endif
