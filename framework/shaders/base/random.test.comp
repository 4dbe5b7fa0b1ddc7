// SPDX-License-Identifier: MIT
// If these fail, images have patterns: draws would repeat, or depend on each other across pixels, frames, vertices or dimensions.
// groups: 64
// passes: 2
#version 460
#include "base/random.glsl"
#include "base/test.glsl"
layout(local_size_x = 64) in;

const uint BINS = 16u;       // a side of the histograms of pairs
const uint HISTOGRAMS = 12u;
const uint SAMPLES = 64u;    // of an invocation; 2^18 in all: the pixels of a 512 x 512 image

// Two numbers that must be independent of each other.
vec2 numberPair(uint kind, uvec2 pixel, uint run) {
    uvec2 seed = pathSeed(pixel, 3u, run);
    vec3 u = random3(seed, 1u, RANDOM_BSDF);
    if (kind == 0u) return u.xy;
    if (kind == 1u) return u.yz;
    if (kind == 2u) return u.xz;
    if (kind == 3u) return vec2(u.x, random1(pathSeed(pixel + uvec2(1, 0), 3u, run), 1u, RANDOM_BSDF));
    if (kind == 4u) return vec2(u.x, random1(pathSeed(pixel + uvec2(0, 1), 3u, run), 1u, RANDOM_BSDF));
    if (kind == 5u) return vec2(u.x, random1(pathSeed(pixel, 4u, run), 1u, RANDOM_BSDF));
    if (kind == 6u) return vec2(u.x, random1(seed, 2u, RANDOM_BSDF));
    if (kind == 7u) return vec2(u.x, random1(seed, 1u, RANDOM_LIGHT_CHOICE));
    if (kind == 8u) return vec2(u.x, random1(resamplingSeed(pixel, 3u, run, 0u), 1u, RANDOM_BSDF));
    if (kind == 9u) return vec2(u.x, random1(pathSeed(pixel, 3u, run + 1u), 1u, RANDOM_BSDF));
    if (kind == 10u) return vec2(u.z, random3(pathSeed(pixel ^ 1u, 3u, run), 1u, RANDOM_BSDF).y);
    return fract(u.xy * 4096.0);  // the middle bits
}

void main() {
    uint id = gl_GlobalInvocationID.x;
    if (testPush.pass == 0u) {
        for (uint i = 0u; i < SAMPLES; ++i) {
            uint n = id * SAMPLES + i;
            uvec2 pixel = uvec2(n & 511u, n >> 9);
            for (uint kind = 0u; kind < HISTOGRAMS; ++kind) {
                uvec2 bin = uvec2(numberPair(kind, pixel, 1u) * float(BINS));
                atomicAdd(testScratch[(kind * BINS + bin.y) * BINS + bin.x], 1u);
            }
            // One key: the seed is an exclusive-or away from pixel and index, hence unique.
            if (i == 0u) EXPECT_EQ(pathSeed(pixel, n, 5u) ^ pathSeed(uvec2(0), 0u, 5u), uvec2(pixel.x | pixel.y << 16, n));
            if (i == 0u) EXPECT_EQ(seedPixel(pathSeed(pixel, n, 5u), 5u), pixel);
        }
        if (id > 0u) return;
        // Known answers, computed apart from this code.
        EXPECT_EQ(pcg4d(uvec4(0)), uvec4(0x0f02f829u, 0x2d568769u, 0x32b0c43bu, 0xd32548eau));
        EXPECT_EQ(pcg4d(uvec4(1, 2, 3, 4)), uvec4(0x3622cd16u, 0xf11471d8u, 0xe1109b3fu, 0x02b94c2fu));
        EXPECT_EQ(pcg4d(uvec4(0xffffffffu, 0x80000000u, 7, 12)), uvec4(0xae3e19d2u, 0x2a3021f6u, 0xadd5df95u, 0x50b36a7eu));
        EXPECT_EQ(random3(uvec2(1, 2), 3u, 4u), vec3(pcg4d(uvec4(1, 2, 3, 4)).xyz >> 8) / 16777216.0);
        EXPECT_TRUE(unitFloat(0xffffffffu) < 1.0);
        EXPECT_EQ(unitFloat(0x80000000u), 0.5);
        EXPECT_EQ(scaledIndex(0xffffffffu, 7u), 6u);
        EXPECT_EQ(scaledIndex(0u, 7u), 0u);
        EXPECT_EQ(scaledIndex(0x80000000u, 500000u), 250000u);
        EXPECT_TRUE(pathSeed(uvec2(3, 4), 5u, 6u) != resamplingSeed(uvec2(3, 4), 5u, 6u, 0u));
        EXPECT_TRUE(resamplingSeed(uvec2(3, 4), 5u, 6u, 1u) != resamplingSeed(uvec2(3, 4), 5u, 6u, 0u));
        return;
    }
    if (id >= HISTOGRAMS) return;
    float expected = float(64u * 64u * SAMPLES) / float(BINS * BINS), chiSquare = 0.0;
    for (uint bin = 0u; bin < BINS * BINS; ++bin) {
        float d = float(testScratch[id * BINS * BINS + bin]) - expected;
        chiSquare += d * d / expected;
    }
    EXPECT_TRUE(chiSquare < chiSquareLimit(BINS * BINS - 1u));
    EXPECT_TRUE(chiSquare > 160.0);  // too even would be as wrong: 255 degrees of freedom, deviation 22.6
}
