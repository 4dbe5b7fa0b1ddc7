// SPDX-License-Identifier: MIT
// If these fail, the distribution that is sampled is not the one that is evaluated, or it isn't a distribution.
// groups: 24
// passes: 2
#version 460
#include "base/random.glsl"
#include "base/test.glsl"
#include "bsdf/ggx.glsl"
layout(local_size_x = 64) in;

// A group is one pair of width and view. Bins of the half vector: 16 of tan^2 in equal shares of D's own measure, 16 of the angle.
const uint BINS = 16u, SAMPLES = 2048u, FINE = 24u;

void main() {
    uint group = gl_WorkGroupID.x, lane = gl_LocalInvocationID.x;
    // Groups from 12 on are drawn out along an axis askew to the view, whose own lobe is `alpha` across.
    float alpha = group % 4u == 0u ? 1.0 : group % 4u == 1u ? 0.3 : group % 4u == 2u ? 0.05 : 0.002;
    float cosO = group / 4u % 3u == 0u ? 0.9999 : group / 4u % 3u == 1u ? 0.6 : 0.08;
    vec3 o = vec3(0.0, -sqrt(1.0 - cosO * cosO), cosO), n = vec3(0, 0, 1);
    Facets f = Facets(n, vec3(1, 0, 0), alpha, group < 12u ? alpha : mix(alpha, 1.0, 0.4));
    if (group >= 12u) o = vec3(0.6 * o.y, 0.8 * o.y, cosO);
    vec2 widths = vec2(f.along, f.alpha);
    uint base = group * 2u * BINS * BINS;
    if (testPush.pass == 0u) {
        // Expected share of each bin: the density over half vectors, G1 D max(0, o.h) / cosO, integrated.
        for (uint bin = lane; bin < BINS * BINS; bin += 64u) {
            float share = 0.0;
            for (uint i = 0u; i < FINE * FINE; ++i) {
                vec2 u = (vec2(bin % BINS, bin / BINS) + (vec2(i % FINE, i / FINE) + 0.5) / float(FINE)) / float(BINS);
                float s = 1.0 - u.x, t = sqrt(1.0 - s * s) / s;
                vec3 h = normalize(vec3(widths * t * vec2(cos(TWO_PI * u.y), sin(TWO_PI * u.y)), 1.0));
                float z = h.z;
                // d omega of u: D z d omega = 2 s du / 2 PI dphi.
                float perOmega = ggxDistribution(f, h) * z / max(2.0 * s, 1e-20);
                share += ggxVisibleDensity(cosO, ggxSlope(f, o, cosO), ggxDistribution(f, h)) * max(0.0, dot(o, h)) / max(perOmega, 1e-20);
            }
            testFloats[base + bin] = share / float(FINE * FINE * BINS * BINS);
        }
        for (uint i = 0u; i < SAMPLES; ++i) {
            vec3 h = ggxSampleHalf(o, widths, random2(uvec2(gl_GlobalInvocationID.x, i), 0u, 0u));
            EXPECT_TRUE(h.z >= 0.0 && dot(o, h) > -1e-4 && abs(length(h) - 1.0) < 1e-5);
            vec2 stretched = h.xy / (widths * max(h.z, 1e-10));
            float u = 1.0 - 1.0 / sqrt(1.0 + dot(stretched, stretched));
            float phi = atan(stretched.y, stretched.x) / TWO_PI;
            uvec2 bin = min(uvec2(vec2(u, phi - floor(phi)) * float(BINS)), BINS - 1u);
            atomicAdd(testScratch[base + BINS * BINS + bin.y * BINS + bin.x], 1u);
        }
        return;
    }
    if (lane > 0u) return;
    float total = 0.0, chiSquare = 0.0, rest = 0.0, restCount = 0.0;
    uint used = 0u;
    for (uint bin = 0u; bin < BINS * BINS; ++bin) {
        float expected = testFloats[base + bin] * float(SAMPLES * 64u), count = float(testScratch[base + BINS * BINS + bin]);
        total += testFloats[base + bin];
        if (expected < 10.0) {
            rest += expected;
            restCount += count;
            continue;
        }
        chiSquare += square(count - expected) / expected;
        ++used;
    }
    EXPECT_NEAR(total, 1.0, 2e-3);
    EXPECT_TRUE(abs(restCount - rest) < 5.0 * sqrt(rest) + 5.0);
    EXPECT_NEAR(chiSquare, 0.0, chiSquareLimit(used - 1u));
    // Where both slopes are 1, as for alpha 1, Smith's G2 is 2 o i / (o + i).
    EXPECT_NEAR(4.0 * cosO * 0.5 * ggxVisibility(cosO, 1.0, 0.5, 1.0), cosO / (cosO + 0.5), 1e-6);
}
