// SPDX-License-Identifier: MIT
// A pixel's path with its weight: 64 bytes, shared by C++ and GLSL; restir/reservoir.glsl reads and writes the packed words.
//
// The path x0 (lens), x1 (primary hit), ..., x_d (light) keeps what a hybrid shift needs: the seed that replays its beginning, the
// reconnection vertex x_k, and what comes after it (Lin et al. 2026, ReSTIR PT Enhanced, section 2.3). x0, x1 and where x_k lies on its
// triangle are in SampleHit.
#ifndef LODESTIR_RESERVOIR_H
#define LODESTIR_RESERVOIR_H
#include "base/shared.h"

LODESTIR_SHARED_BEGIN

struct Reservoir {
    uvec2 seed;           // of the path (base/random.glsl): replays it, and tells copies of it
    float W;              // unbiased contribution weight; 0: no path, the rest but M means nothing
    uint shape;           // SHAPE_*: lengths, technique, lobes, and the confidence M
    vec3 F;               // integrand in the mixed measure (restir/jacobian.glsl); the target p^ is its luminance
    float lightPdf;       // of light sampling, for the technique's MIS weight: per solid angle; per area where x_k is a light of some area
    uint rcInstance;      // x_k: instance and primitive (World.primitives); for a punctual light rcPrimitive is its index in World.lights,
    uint rcPrimitive;     // for the environment found by light sampling its texel
    uvec2 rcDirection;    // omega_k (base/pack.glsl); where x_k is the environment, the direction to it
    vec3 radiance;        // what comes to x_k from omega_k, over the densities after x_k; where x_k is the light, what it sends
    float G;              // geometry term x_{k-1} -> x_k per barycentric area of x_k; 1 for environment and punctual lights, and if k = 0
};

// Bits of Reservoir.shape.
const uint SHAPE_LENGTH = 0u;        // 5 bits: d, number of segments; 1: light seen directly
const uint SHAPE_RECONNECTION = 5u;  // 5 bits: k, 0: none, the whole path is replayed
const uint SHAPE_NEE = 10u;          // 1 bit: x_d was made by light sampling, else by the BSDF
const uint SHAPE_LIGHT = 11u;        // 2 bits: PATH_LIGHT_*
const uint SHAPE_LOBE_BEFORE = 13u;  // 2 bits: lobe (bsdf/bsdf.glsl) sampled at x_{k-1}; of no meaning where light sampling took all lobes
const uint SHAPE_LOBE_AT = 15u;      // 2 bits: at x_k, likewise
const uint SHAPE_CONFIDENCE = 17u;   // 15 bits: M as a half float without its sign

const uint PATH_LENGTH_MAX = 31u;
const uint PATH_LIGHT_TRIANGLE = 0u;
const uint PATH_LIGHT_ENVIRONMENT = 1u;
const uint PATH_LIGHT_PUNCTUAL = 2u;  // point, spot, directional: found by light sampling alone

LODESTIR_SHARED_END
LODESTIR_SHARED(Reservoir, "restir/reservoir.h")
#ifdef __cplusplus
static_assert(sizeof(lodestir::Reservoir) == 64);
#endif
#endif
