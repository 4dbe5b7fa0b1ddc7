// SPDX-License-Identifier: MIT
// Reads and writes the packed words of a Reservoir.
//
// Rounding rule: pack first, then compute F, G and W from what unpacks. A shift sees only the unpacked values; with others F would not
// belong to the path that is stored.
#include "base/math.glsl"
#include "base/pack.glsl"
#include "restir/reservoir.h"

/// What kind of path it is, but for its geometry. Lobes are those of bsdf/bsdf.glsl.
struct PathShape {
    uint d;           // number of segments <= PATH_LENGTH_MAX; x_d is the light
    uint k;           // reconnection vertex, 2..d, or 0: none
    bool nee;         // the light was found by light sampling
    uint light;       // PATH_LIGHT_*
    uint lobeBefore;  // at x_{k-1}
    uint lobeAt;      // at x_k
};

/// M: confidence in 0..65504, kept to 11 bits (whole numbers up to 2048 are exact).
uint packShape(PathShape s, float M) {
    uint half15 = packHalf2x16(vec2(clamp(M, 0.0, 65504.0), 0.0)) & 0x7fffu;
    return s.d << SHAPE_LENGTH | s.k << SHAPE_RECONNECTION | uint(s.nee) << SHAPE_NEE | s.light << SHAPE_LIGHT |
           s.lobeBefore << SHAPE_LOBE_BEFORE | s.lobeAt << SHAPE_LOBE_AT | half15 << SHAPE_CONFIDENCE;
}

PathShape unpackShape(uint bits) {
    return PathShape(bitfieldExtract(bits, int(SHAPE_LENGTH), 5), bitfieldExtract(bits, int(SHAPE_RECONNECTION), 5),
                     bitfieldExtract(bits, int(SHAPE_NEE), 1) != 0u, bitfieldExtract(bits, int(SHAPE_LIGHT), 2),
                     bitfieldExtract(bits, int(SHAPE_LOBE_BEFORE), 2), bitfieldExtract(bits, int(SHAPE_LOBE_AT), 2));
}

float confidence(Reservoir r) { return unpackHalf2x16(r.shape >> SHAPE_CONFIDENCE).x; }
void setConfidence(inout Reservoir r, float M) { r.shape = packShape(unpackShape(r.shape), M); }

/// No path, but a confidence: a pixel that found no light knows as much as one that did. M = 0: it has not looked, and counts nowhere.
Reservoir emptyReservoir(float M) {
    return Reservoir(uvec2(0), 0.0, packShape(PathShape(0u, 0u, false, 0u, 0u, 0u), M), vec3(0.0), 0.0, 0u, 0u, uvec2(0), vec3(0.0), 1.0);
}

bool holdsPath(Reservoir r) { return r.W > 0.0; }

/// Scalar target p^ of the kept path.
float target(Reservoir r) { return luminance(r.F); }

/// Only a share arrives of the light that was sent along the path's last segment, which lies before x_k or behind it.
void dimLight(inout Reservoir r, PathShape s, vec3 share) {
    r.F *= share;
    if (s.k > 0u && s.k < s.d) r.radiance *= share;
}

/// Estimate of the pixel: F(Y) W.
vec3 shadeReservoir(Reservoir r) { return holdsPath(r) ? r.F * r.W : vec3(0.0); }

/// What a candidate of weight w adds to the estimate by the weights of all candidates, m F W |dT/dx|: in the mean that of the kept one, in colour and
/// brightness calmer (Lin et al. 2026, section 6.3). F is the candidate's where it is resampled.
vec3 candidateRadiance(Reservoir r, float w) {
    float pHat = target(r);
    return pHat > 0.0 ? r.F * (w / pHat) : vec3(0.0);
}

// Kinds of reconnection, by what follows x_k: they differ in their Jacobian and in what has to be evaluated anew.
const uint RC_NONE = 0u;         // the whole path is replayed
const uint RC_SURFACE = 1u;      // x_k scatters, and the direction after it came from its BSDF
const uint RC_TO_LIGHT = 2u;     // x_k scatters, x_{k+1} is a light found by light sampling
const uint RC_EMITTER = 3u;      // x_k is an emitter found by the BSDF
const uint RC_ENVIRONMENT = 4u;  // x_k is the environment found by the BSDF
const uint RC_LIGHT = 5u;        // x_k is a light found by light sampling

uint reconnectionKind(PathShape s) {
    if (s.k == 0u) return RC_NONE;
    if (s.k == s.d) return s.nee ? RC_LIGHT : s.light == PATH_LIGHT_ENVIRONMENT ? RC_ENVIRONMENT : RC_EMITTER;
    return s.nee && s.k + 1u == s.d ? RC_TO_LIGHT : RC_SURFACE;
}
