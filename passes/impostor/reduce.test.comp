// SPDX-License-Identifier: MIT
// If these fail, levels of an impostor blur what they must keep apart, or lose what they must keep.
#version 460
#include "base/test.glsl"
#include "base/math.glsl"
#include "impostor/reduce.glsl"
layout(local_size_x = 1) in;

const uint N = 64u;  // of the children's level

ImpostorTexel seen(float depth, vec2 uv, uint place) {
    return ImpostorTexel(vec3(0, 0, 1), depth, 1.0, -4.0, 0u, uv, place + 100u, 15u << (4u * place));
}

uint rounded(float a, float b, float c) { return roundShares(float[](a, b, c, 0.0, 0.0, 0.0, 0.0, 0.0)); }
uint counts(uint a, uint b, uint c) { return a | b << 4 | c << 8; }

void main() {
    // Shares: whole 15ths stay, the largest remainder is rounded up, and what is small doesn't vanish.
    EXPECT_EQ(rounded(1.0, 0.0, 0.0), counts(15u, 0u, 0u));
    EXPECT_EQ(rounded(0.2, 0.8, 0.0), counts(3u, 12u, 0u));
    EXPECT_EQ(rounded(0.5, 0.5, 0.0), counts(8u, 7u, 0u));
    EXPECT_EQ(rounded(1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0), counts(5u, 5u, 5u));
    EXPECT_EQ(rounded(0.96, 0.04, 0.0), counts(14u, 1u, 0u));
    EXPECT_EQ(rounded(0.98, 0.02, 0.0), counts(15u, 0u, 0u));
    // Five that must not vanish: 3.375 + 9 + 5 * 0.525 of 15 would be 17, so that either of the large ones gives one.
    EXPECT_EQ(roundShares(float[](0.225, 0.6, 0.035, 0.035, 0.035, 0.035, 0.035, 0.0)), 0x01111182u);
    uint eighths = roundShares(float[](0.125, 0.125, 0.125, 0.125, 0.125, 0.125, 0.125, 0.125));
    uint sum = 0u;
    for (uint p = 0u; p < PALETTE; ++p) {
        sum += countOf(eighths, p);
        EXPECT_TRUE(countOf(eighths, p) == 1u || countOf(eighths, p) == 2u);
    }
    EXPECT_EQ(sum, 15u);

    // Four alike give the same, of a texel twice as wide.
    ImpostorTexel one = seen(0.3, vec2(0.4, 0.6), 2u);
    ImpostorTexel r = reduceTexels(ImpostorTexel[](one, one, one, one), N);
    EXPECT_EQ(r.depth, 0.3);
    EXPECT_EQ(r.alpha, 1.0);
    EXPECT_NEAR(r.normal, one.normal, 1e-6);
    EXPECT_NEAR(r.uv, one.uv, 1e-6);
    EXPECT_EQ(r.density, -3.0);
    EXPECT_EQ(r.material, 102u);
    EXPECT_EQ(r.counts, one.counts);

    // Nothing of nothing; alpha is averaged over all four, attributes over those that are seen.
    ImpostorTexel none = emptyTexel();
    EXPECT_TRUE(!isSeen(reduceTexels(ImpostorTexel[](none, none, none, none), N)));
    r = reduceTexels(ImpostorTexel[](none, one, none, none), N);
    EXPECT_EQ(r.alpha, 0.25);
    EXPECT_NEAR(r.normal, one.normal, 1e-6);
    EXPECT_EQ(r.depth, 0.3);
    EXPECT_EQ(r.density, one.density);  // no more of the texture is shown
    // What is too faint to be seen still covers.
    ImpostorTexel faint = one;
    faint.alpha = 0.002;
    r = reduceTexels(ImpostorTexel[](one, faint, faint, faint), N);
    EXPECT_NEAR(r.alpha, 0.2515, 1e-6);

    // Another layer, 5 texels behind, gives nothing but its alpha; 3 texels behind is the same surface.
    ImpostorTexel behind = seen(0.3 + 5.0 / float(N), vec2(0.9, 0.1), 0u);
    behind.normal = vec3(1, 0, 0);
    r = reduceTexels(ImpostorTexel[](behind, one, behind, behind), N);
    EXPECT_EQ(r.depth, 0.3);
    EXPECT_EQ(r.alpha, 1.0);
    EXPECT_NEAR(r.normal, one.normal, 1e-6);
    EXPECT_EQ(r.counts, one.counts);
    EXPECT_NEAR(r.uv, one.uv, 1e-6);
    behind.depth = 0.3 + 3.0 / float(N);
    r = reduceTexels(ImpostorTexel[](behind, one, behind, behind), N);
    EXPECT_NEAR(r.normal, vec3(0.75, 0, 0.25), 1e-6);

    // Normals at right angles: their mean is shorter, and two levels give what one average of all gives.
    ImpostorTexel x = one, y = one;
    x.normal = vec3(1, 0, 0);
    y.normal = vec3(0, 1, 0);
    ImpostorTexel xy = reduceTexels(ImpostorTexel[](x, y, x, y), N), zz = reduceTexels(ImpostorTexel[](one, one, one, one), N);
    EXPECT_NEAR(length(xy.normal), sqrt(0.5), 1e-6);
    EXPECT_NEAR(reduceTexels(ImpostorTexel[](xy, zz, zz, zz), N / 2u).normal, vec3(0.125, 0.125, 0.75), 1e-6);
    // Weighted by what they cover.
    x.alpha = 0.25;
    EXPECT_NEAR(reduceTexels(ImpostorTexel[](x, one, none, none), N).normal, vec3(0.2, 0, 0.8), 1e-6);

    // Materials are counted; the coordinates are of those that most have, the nearest first.
    ImpostorTexel other = seen(0.29, vec2(0.9, 0.9), 1u), near = seen(0.295, vec2(0.42, 0.6), 2u);
    r = reduceTexels(ImpostorTexel[](one, other, near, one), N);
    EXPECT_EQ(r.counts, counts(0u, 4u, 11u));
    EXPECT_NEAR(r.uv, vec2((0.4 + 0.42 + 0.4) / 3.0, 0.6), 1e-6);
    EXPECT_EQ(r.material, 102u);

    // Coordinates across the edge of a repeat lie side by side; those of another chart are left out.
    ImpostorTexel left = seen(0.3, vec2(0.98, 0.5), 0u), right = seen(0.31, vec2(0.02, 0.5), 0u), far = seen(0.31, vec2(0.5, 0.5), 0u);
    r = reduceTexels(ImpostorTexel[](left, right, left, right), N);
    EXPECT_NEAR(min(r.uv.x, 1.0 - r.uv.x), 0.0, 1e-6);
    r = reduceTexels(ImpostorTexel[](left, far, far, far), N);
    EXPECT_NEAR(r.uv, left.uv, 1e-6);

    // Flags of any, but not of what lies behind.
    x.flags = TEXEL_BACK;
    behind = seen(0.6, vec2(0.1), 0u);
    behind.flags = TEXEL_TWO_SIDED;
    EXPECT_EQ(reduceTexels(ImpostorTexel[](x, one, behind, none), N).flags, TEXEL_BACK);
}
