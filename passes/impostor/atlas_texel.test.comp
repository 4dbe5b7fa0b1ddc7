// SPDX-License-Identifier: MIT
// If these fail, an atlas shows other colours than were baked, or those of a neighbouring view.
// groups: 64
// passes: 2
#version 460
#include "base/test.glsl"
#include "impostor/atlas_texel.glsl"
layout(local_size_x = 64) in;

const uint RESOLUTION = 16u, LEVELS_MADE = 2u, FIRST_MATTER = 1u << 18;

/// In the scratch memory: whose words begin behind counters and recorded failures.
uint64_t scratchAddress() { return testPush.results + 16ul + uint64_t(TEST_RECORDS) * 48ul; }

Atlases gridAtlas() {
    Atlases made;
    made.meshes = 1u;
    made.arrangement = ATLAS_FULL;
    made.across = 4u;
    made.resolution = RESOLUTION;
    made.levels = LEVELS_MADE;
    made.isMatched = 1u;
    return made;
}
AtlasRecord record() { return AtlasRecord(scratchAddress(), scratchAddress() + 4ul * uint64_t(FIRST_MATTER), vec3(0), 1.0); }

/// A colour, a depth, and more that no other view has.
AtlasTexel marker(uint view) {
    vec3 color = vec3(view & 3u, view >> 2, 1.0) / 4.0;
    AtlasTexel t = emptyAtlasTexel();
    addTexel(t, AtlasTexel(1.0, color * color, normalize(color), float(view) / 16.0, float(view) / 15.0, 1.0 - float(view) / 15.0, 100.0 * color), 1.0);
    return t;
}

void expectSurface(AtlasTexel value, AtlasTexel expected) {
    EXPECT_NEAR(value.color, expected.color, 4.5e-3);  // half a 255th of a square root: up to 2 * 1 / 510
    EXPECT_NEAR(value.normal, expected.normal, 1e-4);
    EXPECT_NEAR(value.depth, expected.depth, 1e-5);
    EXPECT_NEAR(value.roughness, expected.roughness, 2.1e-3);
    EXPECT_NEAR(value.metallic, expected.metallic, 2.1e-3);
    EXPECT_NEAR(value.emission, expected.emission, maxComponent(expected.emission) / 255.0);
}

void main() {
    uint id = gl_GlobalInvocationID.x;
    Atlases made = gridAtlas();
    uint texels = atlasViews(made) * (RESOLUTION * RESOLUTION + RESOLUTION * RESOLUTION / 4u);
    if (testPush.pass == 0u) {
        for (uint i = id; i < texels; i += 64u * 64u) {
            uint level = i >= atlasIndex(made, 1u, 0u, uvec2(0u)) ? 1u : 0u, n = RESOLUTION >> level;
            AtlasTexel t = marker((i - atlasIndex(made, level, 0u, uvec2(0u))) / (n * n));
            testScratch[2u * i] = packShades(t).x;
            testScratch[2u * i + 1u] = packShades(t).y;
            testScratch[FIRST_MATTER + 2u * i] = packMatters(t).x;
            testScratch[FIRST_MATTER + 2u * i + 1u] = packMatters(t).y;
        }
        return;
    }

    // Bits, there and back, of what covers its texel in part.
    vec3 r = fract(vec3(0.8191725, 0.6710436, 0.5497005) * float(id)), s = fract(r * 7.31);
    AtlasTexel surface = AtlasTexel(1.0, r, normalize(s - 0.5), s.x, s.y, s.z, exp2(20.0 * (r.x - 0.5)) * s), covered = emptyAtlasTexel();
    addTexel(covered, surface, 0.25 + 0.75 * r.y);
    AtlasTexel back = unpackAtlasTexel(packShades(covered), packMatters(covered));
    EXPECT_NEAR(back.alpha, covered.alpha, 2e-3);
    expectSurface(surfaceOfTexel(back), surface);
    EXPECT_EQ(unpackAtlasTexel(packShades(emptyAtlasTexel()), packMatters(emptyAtlasTexel())).alpha, 0.0);
    EXPECT_EQ(unpackShared(packShared(vec3(0))), vec3(0));
    EXPECT_NEAR(unpackShared(packShared(vec3(1e4, 1, 0))), vec3(1e4, 0, 0), 64.0);

    // Wherever a view is read, inside, at its border and beyond, all that is seen is its own.
    vec2 window = 1.4 * fract(vec2(0.6180340, 0.7548777) * float(id)) - 0.2;
    for (uint view = 0u; view < 16u; ++view) {
        for (uint level = 0u; level < LEVELS_MADE; ++level) {
            AtlasTexel t = atlasAt(made, record(), level, view, window);
            float texel = float(RESOLUTION >> level);
            vec2 inside = clamp(min(window, 1.0 - window) * texel + 0.5, 0.0, 1.0);  // texels fade out over the border's last half and half a texel beyond
            EXPECT_NEAR(t.alpha, inside.x * inside.y, 1e-4);
            if (t.alpha > 0.01) expectSurface(surfaceOfTexel(t), surfaceOfTexel(marker(view)));
        }
    }
    // Without matters all are alike.
    made.isMatched = 0u;
    AtlasTexel plain = surfaceOfTexel(atlasAt(made, record(), 0u, 5u, vec2(0.5)));
    EXPECT_NEAR(vec4(plain.depth, plain.roughness, plain.metallic, plain.emission.x), vec4(PLANE_DEPTH, UNKNOWN_ROUGHNESS, UNKNOWN_METALLIC, 0.0), 1e-6);
    EXPECT_NEAR(atlasHeight(made, record(), 0u, 5u, vec2(0.5)), 0.0, 1e-6);
    // Beyond the border heights are those of what is near: coarse texels reach farther.
    made.isMatched = 1u;
    EXPECT_NEAR(atlasHeight(made, record(), 0u, 4u, vec2(0.5, 1.05)), 1.0 - 2.0 * 4.0 / 16.0, 1e-4);

    // Cards: two sides each, at right angles, and 60 degrees apart.
    for (uint card = 0u; card < 4u; ++card) {
        EXPECT_NEAR(cardDirection(ATLAS_STAR, 2u * card), -cardDirection(ATLAS_STAR, 2u * card + 1u), 1e-6);
        if (card < 3u) EXPECT_NEAR(cardDirection(ATLAS_CROSS, 2u * card), -cardDirection(ATLAS_CROSS, 2u * card + 1u), 1e-6);
        if (card < 2u) EXPECT_NEAR(dot(cardDirection(ATLAS_STAR, 2u * card), cardDirection(ATLAS_STAR, 2u * card + 2u)), 0.5, 1e-6);
    }
}
