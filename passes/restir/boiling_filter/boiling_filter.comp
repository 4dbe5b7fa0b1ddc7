// SPDX-License-Identifier: MIT
// A cleared reservoir has neither path nor confidence, so that what lies around fills it.
#version 460
#include "pass.glsl"
#include "restir/reservoir.glsl"

shared vec2 sums[64];  // sum and number of the weights above 0 that each invocation saw

float weightOf(Reservoir r) { return holdsPath(r) ? target(r) * r.W : 0.0; }

void main() {
    if (warming()) return;
    ivec2 corner = 2 * (ivec2(push.base) + 8 * ivec2(gl_WorkGroupID.xy)) + ivec2(gl_LocalInvocationID.xy);
    ivec2 size = ivec2(frameSize());
    vec2 sum = vec2(0);
    for (int i = 0; i < 4; ++i) {
        ivec2 p = corner + 8 * ivec2(i & 1, i >> 1);
        if (any(greaterThanEqual(p, size))) continue;
        float w = weightOf(pathsReservoirs(pixelIndex(p)));
        if (w > 0) sum += vec2(w, 1);
    }
    sums[gl_LocalInvocationIndex] = sum;
    barrier();
    vec2 all = vec2(0);
    for (int i = 0; i < 64; ++i) all += sums[i];
    float most = (10 / params.strength - 9) * all.x / max(all.y, 1);
    for (int i = 0; i < 4; ++i) {
        ivec2 p = corner + 8 * ivec2(i & 1, i >> 1);
        if (any(greaterThanEqual(p, size))) continue;
        uint at = pixelIndex(p);
        Reservoir r = pathsReservoirs(at);
        if (weightOf(r) > most) r = emptyReservoir(0);
        storePathsReservoirs(at, r);
        storePathsSamples(at, pathsSamples(at));
    }
}
