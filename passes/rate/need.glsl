// SPDX-License-Identifier: MIT
// How much a pixel needs a path of its own, as one guide after another sees it: 0: not at all, 1: as much as any. The largest counts, so that no guide
// talks another out of it.
#include "base/math.glsl"

/// How noisy the pixel has been: standard deviation of its luminance, relative to the luminance, but not to less than a twentieth of the frame's mean, so that
/// the dark doesn't take all paths.
float noiseNeed(float variance, float mean, float frameMean) {
    float scale = mean + 0.05 * frameMean;
    return scale > 0.0 ? min(sqrt(max(variance, 0.0)) / scale, 1.0) : 0.0;
}

/// How little is known: confidence of what reuse brings, of `cap` at most.
float confidenceNeed(float confidence, float cap) { return cap > 0.0 ? clamp(1.0 - confidence / cap, 0.0, 1.0) : 1.0; }

/// How much of the neighbourhood lives on copies of one path; `share` of a duplication_map.
float copiesNeed(float share) { return sqrt(clamp(share, 0.0, 1.0)); }

/// Perceptual roughness of the smoothest lobe that counts: neighbours see other things in a mirror.
float specularNeed(float roughness) { return 1.0 - smoothstep(0.05, 0.35, roughness); }

/// Distance to where the path went on from the first hit, against the hit's own from the camera: what is near changes from pixel to pixel.
float nearnessNeed(float distance, float depth) { return depth > 0.0 ? clamp(1.0 - distance / depth, 0.0, 1.0) : 0.0; }
