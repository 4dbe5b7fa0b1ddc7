// SPDX-License-Identifier: MIT
// If these fail, samples crowd where their densities say they don't: every estimate that uses them is biased.
// groups: 64
// passes: 2
#version 460
#include "base/random.glsl"
#include "base/sampling.glsl"
#include "base/test.glsl"
layout(local_size_x = 64) in;

const uint BINS = 8u, SAMPLES = 64u, KINDS = 4u;
const float CONE = 0.3;

// Each sample is taken back to the square by the inverse distribution functions: it must be uniform there.
vec2 inverse(uint kind, vec2 u) {
    if (kind == 0u) {
        vec2 p = uniformDisk(u);
        return vec2(dot(p, p), atan(p.y, p.x) / TWO_PI);
    }
    if (kind == 1u) {
        vec3 d = cosineHemisphere(u);
        return vec2(d.z * d.z, atan(d.y, d.x) / TWO_PI);
    }
    if (kind == 2u) {  // triangle (x, y): the marginal of the first weight is 1 - (1 - x)^2
        vec2 b = uniformTriangle(u);
        return vec2(1.0 - square(1.0 - b.x), b.y / (1.0 - b.x));
    }
    vec3 d = uniformCone(u, CONE);
    return vec2((1.0 - d.z) / (1.0 - CONE), atan(d.y, d.x) / TWO_PI);
}

void main() {
    uint id = gl_GlobalInvocationID.x;
    if (testPush.pass == 0u) {
        for (uint i = 0u; i < SAMPLES; ++i) {
            vec2 u = random2(uvec2(id, i), 0u, 0u);
            for (uint kind = 0u; kind < KINDS; ++kind) {
                vec2 v = inverse(kind, u);
                uvec2 bin = min(uvec2((v - floor(v)) * float(BINS)), BINS - 1u);
                atomicAdd(testScratch[(kind * BINS + bin.y) * BINS + bin.x], 1u);
            }
            vec2 b = uniformTriangle(u);
            EXPECT_TRUE(b.x >= 0.0 && b.y >= 0.0 && b.x + b.y <= 1.000001);
            EXPECT_NEAR(length(cosineHemisphere(u)), 1.0, 1e-6);
            EXPECT_NEAR(length(uniformCone(u, CONE)), 1.0, 1e-6);
        }
        if (id == 0u) EXPECT_NEAR(uniformConePdf(-1.0), 1.0 / (4.0 * PI), 1e-7);
        return;
    }
    if (id >= KINDS) return;
    float expected = float(64u * 64u * SAMPLES) / float(BINS * BINS), chiSquare = 0.0;
    for (uint bin = 0u; bin < BINS * BINS; ++bin) {
        float d = float(testScratch[id * BINS * BINS + bin]) - expected;
        chiSquare += d * d / expected;
    }
    EXPECT_TRUE(chiSquare < chiSquareLimit(BINS * BINS - 1u));
}
