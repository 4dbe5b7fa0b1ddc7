// SPDX-License-Identifier: MIT
// If these fail, materials read the wrong channel, or glass doesn't know which side it is seen from.
// passes: 2
#version 460
#include "bsdf/material.glsl"
#include "world/test_world.glsl"
layout(local_size_x = 8) in;

// 0: factors only, 1: all maps, 2: solid glass, 3: blend, 4: out of range, 5: layers' factors, 6: layers' maps, 7: unlit.
const uint COUNT = 8u;

void write() {
    for (uint v = 0u; v < 3u; ++v) {
        TestPositions(testArray(TEST_POSITIONS)).at[v] = vec4(vec3(v == 1u ? 1.0 : 0.0, v == 2u ? 1.0 : 0.0, 0.0), 0);
        TestVertices(testArray(TEST_VERTICES)).at[v] =
            VertexRecord(packNormal(vec3(0, 0, 1)), packTangent(vec4(1, 0, 0, 1)), vec2(0), vec2(0), packColor(vec4(0, 1, 0.5, 1)));
    }
    TestInstances(testArray(TEST_INSTANCES)).at[0] = testInstance(vec4(1, 0, 0, 0), vec4(0, 1, 0, 0), vec4(0, 0, 1, 0));
    TestTextures(testArray(TEST_TEXTURES)).at[0] = TextureRecord(testArray(TEST_TEXELS), 1u, 1u, 1u, 0u, uvec2(0));
    TestUints(testArray(TEST_TEXELS)).at[0] = 51u | 102u << 8 | 153u << 16 | 204u << 24;  // 0.2, 0.4, 0.6, 0.8
    MaterialRecord r[COUNT];
    for (uint m = 0u; m < COUNT; ++m) r[m] = testMaterial();
    r[0].baseColor = vec4(0.1, 0.2, 0.3, 0.4);
    r[0].metallic = 0.25;
    r[0].roughness = 0.5;
    r[0].flags = MATERIAL_VERTEX_COLOR;
    r[1].baseColorMap = r[1].metallicRoughnessMap = r[1].transmissionMap = testSlot(0u);
    r[1].baseColor = vec4(0.5);
    r[1].metallic = 0.5;
    r[1].transmission = 0.5;
    r[2].flags = MATERIAL_SOLID;
    r[2].transmission = 1.0;
    r[2].roughness = 0.0;
    r[2].attenuation = vec3(0.0, 1.0, 2.0);
    r[3].flags = MATERIAL_BLEND;
    r[3].baseColor.a = 0.5;
    r[3].baseColorMap = testSlot(0u);
    r[4].baseColor = vec4(2.0);
    r[4].metallic = -1.0;
    r[4].ior = 0.0;
    TextureSlotRecord none[8], all[8];
    for (uint map = 0u; map < LAYER_MAPS; ++map) {
        none[map] = testSlot(NONE);
        all[map] = testSlot(0u);
    }
    LayersRecord layers = LayersRecord(vec3(1, 2, 0), 0.5, vec3(0.5, 0.25, 1), 0.5, vec2(0.6, 0.8), 0.5, 0.5, 0.8, 2.0, none, uvec2(0));
    TestLayers(testArray(TEST_LAYERS)).at[0] = layers;
    layers.maps = all;
    TestLayers(testArray(TEST_LAYERS)).at[1] = layers;
    r[7].flags = MATERIAL_UNLIT;
    for (uint m = 5u; m < 7u; ++m) {
        r[m].layers = m - 5u;
        r[m].roughness = 0.5;
    }
    for (uint m = 0u; m < COUNT; ++m) {
        TestMaterials(testArray(TEST_MATERIALS)).at[m] = r[m];
        TestPrimitives(testArray(TEST_PRIMITIVES)).at[m] = PrimitiveRecord(0u, 1u, 2u, m);
    }
}

void main() {
    uint m = gl_LocalInvocationID.x;
    if (testPush.pass == 0u) {
        if (m == 0u) write();
        return;
    }
    if (m >= COUNT) return;
    World w = testWorld();
    for (uint side = 0u; side < 2u; ++side) {
        Surface s = surfaceAt(w, Hit(1.0, vec2(0.2), m, 0u), vec3(0, 0, side == 0u ? -1 : 1));
        Bsdf b = bsdfAt(w, s);
        vec3 passed = segmentTransmittance(w, s, 0.5);
        EXPECT_NEAR(b.normal, vec3(0, 0, side == 0u ? 1 : -1), 1e-6);
        if (m == 0u) {
            EXPECT_NEAR(b.base, vec3(0.0, 0.2, 0.15), 1e-6);
            EXPECT_NEAR(vec3(b.metallic, b.alpha, b.transmission), vec3(0.25, 0.25, 0.0), 1e-6);
            EXPECT_EQ(vec2(b.eta, b.coverage), vec2(1.5, 1.0));
        }
        if (m == 1u) {
            EXPECT_NEAR(b.base, vec3(0.1, 0.2, 0.3), 1e-6);
            EXPECT_NEAR(vec3(b.metallic, b.alpha, b.transmission), vec3(0.3, 0.16, 0.1), 1e-6);
        }
        if (m == 2u) {
            EXPECT_EQ(b.eta, side == 0u ? 1.5 : 1.0 / 1.5);
            EXPECT_TRUE(b.solid && lobeDelta(b, LOBE_TRANSMISSION) && bsdfAllDelta(b, lobeProbabilities(b, s.normal)));
            EXPECT_NEAR(passed, side == 0u ? vec3(1.0) : exp(vec3(0.0, -0.5, -1.0)), 1e-6);
        } else {
            EXPECT_EQ(passed, vec3(1.0));
        }
        if (m == 5u || m == 6u) {
            // The map's 0.2, 0.4, 0.6, 0.8: direction (-0.6, -0.2), turned by (0.6, 0.8); coat normal (-1.2, -0.4, 0.2) before its length.
            bool mapped = m == 6u;
            float specular = mapped ? 0.4 : 0.5, strength = mapped ? 0.3 : 0.5, up = side == 0u ? 1.0 : -1.0;
            EXPECT_NEAR(b.specular, specular, 1e-6);
            EXPECT_NEAR(b.specularShift, specular * (0.04 * (mapped ? vec3(0.2, 0.8, 0.0) : vec3(1, 2, 0)) - 0.04) / 0.96, 1e-6);
            EXPECT_NEAR(b.sheen, mapped ? vec3(0.1, 0.1, 0.6) : vec3(0.5, 0.25, 1), 1e-6);
            EXPECT_NEAR(vec3(b.sheenRoughness, b.coat, b.coatAlpha), mapped ? vec3(0.4, 0.1, square(0.32)) : vec3(0.5, 0.5, 0.64), 1e-6);
            EXPECT_NEAR(vec2(b.alpha, b.along), vec2(0.25, mix(0.25, 1.0, strength * strength)), 1e-6);
            EXPECT_NEAR(b.tangent, mapped ? normalize(vec3(-0.6 * 0.6 + 0.8 * 0.2, -0.6 * 0.2 - 0.8 * 0.6, 0)) : vec3(0.6, 0.8, 0), 1e-3);
            if (!mapped) EXPECT_NEAR(b.coatNormal, vec3(0, 0, up), 1e-4);
            // It is bent until its mirror direction is above the triangle, and leans the same way.
            if (mapped) EXPECT_TRUE(b.coatNormal.x * up < -0.5 && b.coatNormal.z * up > 0.5 && abs(length(b.coatNormal) - 1.0) < 1e-5);
            EXPECT_TRUE(hasCoat(b) && hasSheen(b));
        } else {
            EXPECT_TRUE(!hasCoat(b) && !hasSheen(b) && b.alpha == b.along);
        }
        EXPECT_NEAR(b.coverage, m == 3u ? 0.4 : m == 7u && side == 1u ? 0.0 : 1.0, 1e-6);
        if (m == 4u) {
            EXPECT_EQ(vec4(b.base, b.metallic), vec4(1, 1, 1, 0));
            EXPECT_TRUE(fresnelDielectric(1.0, b.eta) > 0.99);
        }
    }
}
