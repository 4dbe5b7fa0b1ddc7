// SPDX-License-Identifier: MIT
// If these fail, what a texel shows beside its middle is smeared over outlines, seams and materials, or highlights are made wider by it.
#version 460
#include "base/test.glsl"
#include "base/math.glsl"
#include "impostor/texel_between.glsl"
layout(local_size_x = 1) in;

const float SIDE = 1.0 / 64.0;  // diameters

ImpostorTexel seen(float turn, vec2 uv) {
    return ImpostorTexel(0.9 * vec3(sin(turn), 0, cos(turn)), 0.3, 1.0, -4.0, 0u, uv, 100u, 15u);
}

ImpostorTexel between(ImpostorTexel own, ImpostorTexel other, float share) {
    TexelMix m = mixOf(own, 1.0 - share);
    mixIn(m, own, other, share, SIDE);
    return mixed(own, m);
}

void main() {
    // Half way between two normals that lie 0.6 apart: 0.3 off each, and as long as both are.
    ImpostorTexel own = seen(0.0, vec2(0.5)), other = seen(0.6, vec2(0.54, 0.5));
    ImpostorTexel middle = between(own, other, 0.5);
    EXPECT_NEAR(middle.normal, 0.9 * vec3(sin(0.3), 0, cos(0.3)), 1e-6);
    EXPECT_NEAR(middle.uv, vec2(0.52, 0.5), 1e-6);
    EXPECT_NEAR(between(own, other, 0.0).normal, own.normal, 1e-6);
    EXPECT_NEAR(between(own, other, 0.25).uv, vec2(0.51, 0.5), 1e-6);
    // Both say the same of their border.
    ImpostorTexel back = between(other, own, 0.5);
    EXPECT_NEAR(back.normal, middle.normal, 1e-6);
    EXPECT_NEAR(back.uv, middle.uv, 1e-6);
    // What isn't mixed stays the own texel's.
    EXPECT_EQ(middle.depth, own.depth);
    EXPECT_EQ(middle.density, own.density);
    EXPECT_EQ(middle.material, own.material);

    // Texture coordinates go on over 1.
    EXPECT_NEAR(between(seen(0.0, vec2(0.99, 0.5)), seen(0.0, vec2(0.03, 0.5)), 0.5).uv, vec2(0.01, 0.5), 1e-6);
    EXPECT_NEAR(between(seen(0.0, vec2(0.01, 0.5)), seen(0.0, vec2(0.95, 0.5)), 0.5).uv, vec2(0.98, 0.5), 1e-6);

    // Another chart and another material share the normal alone.
    ImpostorTexel chart = other, material = other;
    chart.uv = vec2(0.8, 0.5);
    material.counts = 15u << 4;
    EXPECT_NEAR(between(own, chart, 0.5).normal, middle.normal, 1e-6);
    EXPECT_NEAR(between(own, chart, 0.5).uv, own.uv, 1e-6);
    EXPECT_NEAR(between(own, material, 0.5).normal, middle.normal, 1e-6);
    EXPECT_NEAR(between(own, material, 0.5).uv, own.uv, 1e-6);

    // Another surface shares nothing: farther behind or before than surfaces slope, the other side of what has two, nothing at all.
    ImpostorTexel behind = other, before = other, turned = other, none = emptyTexel();
    behind.depth = own.depth + 4.1 * SIDE;
    before.depth = own.depth - 4.1 * SIDE;
    turned.flags = TEXEL_BACK;
    EXPECT_NEAR(between(own, behind, 0.5).normal, own.normal, 1e-6);
    EXPECT_NEAR(between(own, before, 0.5).normal, own.normal, 1e-6);
    EXPECT_NEAR(between(own, turned, 0.5).normal, own.normal, 1e-6);
    EXPECT_NEAR(between(own, none, 0.5).normal, own.normal, 1e-6);
    EXPECT_NEAR(between(own, none, 0.5).uv, own.uv, 1e-6);
}
