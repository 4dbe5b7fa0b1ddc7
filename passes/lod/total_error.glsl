// SPDX-License-Identifier: MIT
// Levels of detail that leave the least error in all: that of geometry, which samples don't lower, and noise, which a finer level raises, because its rays
// cost more and a budget buys fewer of them.
#include "lod/screen_error.glsl"

/// Squared error of geometry that is off by so many pixels, where one of 1 pixel makes 1. An edge that moves by e < 1 changes one pixel, by e of its
/// contrast; one that moves by e > 1 changes e pixels by all of it.
float geometryError(float pixels) { return pixels < 1.0 ? pixels * pixels : pixels; }

/// What a choice weighs, in units of the variance of one path.
struct TotalError {
    float edges;     // squared error of geometry that is off by a pixel
    float samples;   // paths a pixel
    float doubling;  // share by which a path costs more when what it meets has twice the triangles
};

/// Noise at a given cost: with cost C of a path the cost B buys B / C of them, and they leave the variance C / B. Only differences between levels count.
float noiseAtCost(World w, uint meshLevel, TotalError e) { return e.doubling * log2(float(max(w.meshLevels.at[meshLevel].primitiveCount, 1u))) / e.samples; }

/// The level with the least sum of both. The sum over all instances is least where each one's is, weighted by its pixels, which weight both parts alike:
/// pixels see an object's edges, and their rays meet its triangles. Another level than last frame's has to win the share `hysteresis` of the noise
/// between the two.
uint levelByTotalError(World w, uint instance, TotalError e, bool known, uint last, float hysteresis) {
    InstanceView view = instanceView(w, instance);
    uint mesh = w.instances.at[instance].mesh, chosen = 0u;
    float least = 0.0, leastNoise = 0.0, lastSum = 0.0, lastNoise = 0.0;
    for (uint level = 0u; level < w.meshes.at[mesh].levels; ++level) {
        float noise = noiseAtCost(w, mesh * LEVELS + level, e), sum = noise + e.edges * geometryError(screenError(w, instance, view, level));
        if (level == 0u || sum < least) chosen = level, least = sum, leastNoise = noise;
        if (level == last) lastSum = sum, lastNoise = noise;
    }
    bool stays = known && last < w.meshes.at[mesh].levels && lastSum - least <= hysteresis * abs(lastNoise - leastNoise);
    return stays ? last : chosen;
}
