// SPDX-License-Identifier: MIT
// If these fail, textures are shifted by half a texel, filtered in the wrong space, or bleed over their edges.
// groups: 4
// passes: 2
#version 460
#include "texture/texture.glsl"
#include "world/test_world.glsl"
layout(local_size_x = 64) in;

// Texture 0: 4 x 2, red 51 * x, green 51 * y, alpha 255, with a second level 2 x 1 of blue 51, 102 and a third 1 x 1 of blue 255.
uint texel(uint r, uint g, uint b, uint a) { return r | g << 8 | b << 16 | a << 24; }

void write() {
    TestUints texels = TestUints(testArray(TEST_TEXELS));
    for (uint i = 0u; i < 8u; ++i) texels.at[i] = texel(51u * (i & 3u), 51u * (i >> 2), 0u, 255u);
    texels.at[8] = texel(0u, 0u, 51u, 255u);
    texels.at[9] = texel(0u, 0u, 102u, 255u);
    texels.at[10] = texel(0u, 0u, 255u, 255u);
    for (uint i = 0u; i < 256u; ++i) texels.at[16u + i] = texel(i, i, i, i);
    TestTextures textures = TestTextures(testArray(TEST_TEXTURES));
    const uint flags[6] = uint[](0u, TEXTURE_NEAREST, TEXTURE_CLAMP_U | TEXTURE_CLAMP_V, TEXTURE_MIRROR_U | TEXTURE_MIRROR_V,
                                 TEXTURE_CLAMP_U | TEXTURE_MIRROR_V, TEXTURE_NEAREST | TEXTURE_MIRROR_U);
    for (uint i = 0u; i < 6u; ++i) textures.at[i] = TextureRecord(testArray(TEST_TEXELS), 4u, 2u, 3u, flags[i], uvec2(0));
    textures.at[6] = TextureRecord(testArray(TEST_TEXELS) + 64ul, 256u, 1u, 1u, TEXTURE_SRGB | TEXTURE_NEAREST, uvec2(0));
    textures.at[7] = TextureRecord(testArray(TEST_TEXELS) + 64ul, 256u, 1u, 1u, TEXTURE_SRGB, uvec2(0));
}

// A read and what it must give; `at` in texels of the finest level.
struct Case {
    uint id;
    vec2 at;
    float lod;
    vec3 expected;  // in units of 51 / 255
};
const Case cases[] = Case[](
    Case(0u, vec2(0.5, 0.5), 0.0, vec3(0, 0, 0)), Case(1u, vec2(0.5, 0.5), 0.0, vec3(0, 0, 0)),       // texel centres
    Case(2u, vec2(2.5, 0.5), 0.0, vec3(2, 0, 0)), Case(3u, vec2(3.5, 1.5), 0.0, vec3(3, 1, 0)),
    Case(4u, vec2(1.5, 1.5), 0.0, vec3(1, 1, 0)), Case(5u, vec2(1.5, 1.5), 0.0, vec3(1, 1, 0)),
    Case(0u, vec2(1.0, 0.5), 0.0, vec3(0.5, 0, 0)), Case(0u, vec2(1.25, 0.5), 0.0, vec3(0.75, 0, 0)), // between them
    Case(0u, vec2(0.5, 1.25), 0.0, vec3(0, 0.75, 0)), Case(0u, vec2(2.0, 1.0), 0.0, vec3(1.5, 0.5, 0)),
    Case(0u, vec2(4.25, 0.5), 0.0, vec3(0.75, 0, 0)), Case(0u, vec2(-0.25, 0.5), 0.0, vec3(2.25, 0, 0)),  // repeated
    Case(0u, vec2(0.0, 0.5), 0.0, vec3(1.5, 0, 0)), Case(0u, vec2(402.5, 2.0), 0.0, vec3(2, 0.5, 0)),
    Case(1u, vec2(1.999, 0.5), 0.0, vec3(1, 0, 0)), Case(1u, vec2(2.001, 0.5), 0.0, vec3(2, 0, 0)),   // nearest
    Case(1u, vec2(-0.5, 2.5), 0.0, vec3(3, 0, 0)),
    Case(2u, vec2(9.0, 0.5), 0.0, vec3(3, 0, 0)), Case(2u, vec2(-9.0, -9.0), 0.0, vec3(0, 0, 0)),     // clamped
    Case(2u, vec2(4.0, 2.0), 0.0, vec3(3, 1, 0)),
    Case(3u, vec2(4.5, 0.5), 0.0, vec3(3, 0, 0)), Case(3u, vec2(5.25, 0.5), 0.0, vec3(2.25, 0, 0)),   // mirrored
    Case(3u, vec2(-1.5, 0.5), 0.0, vec3(1, 0, 0)), Case(3u, vec2(8.5, 2.5), 0.0, vec3(0, 1, 0)),
    Case(4u, vec2(36.0, -1.5), 0.0, vec3(3, 1, 0)), Case(5u, vec2(5.5, 0.5), 0.0, vec3(2, 0, 0)),
    Case(0u, vec2(1.0, 1.0), 1.0, vec3(0, 0, 1)), Case(0u, vec2(2.0, 1.0), 1.0, vec3(0, 0, 1.5)),     // levels
    Case(0u, vec2(1.0, 1.0), 1.25, vec3(0, 0, 2)), Case(0u, vec2(1.0, 1.0), 0.5, vec3(0.25, 0.25, 0.5)),
    Case(0u, vec2(1.0, 1.0), 9.0, vec3(0, 0, 5)), Case(0u, vec2(1.5, 0.5), -3.0, vec3(1, 0, 0)));

void main() {
    uint id = gl_GlobalInvocationID.x;
    if (testPush.pass == 0u) {
        if (id == 0u) write();
        return;
    }
    World w = testWorld();
    // Every byte, decoded as IEC 61966-2-1 says; alpha stays.
    float c = float(id) / 255.0, decoded = c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
    float next = float(id + 1u) / 255.0, decodedNext = next <= 0.04045 ? next / 12.92 : pow((next + 0.055) / 1.055, 2.4);
    for (uint i = 0u; i < 3u; ++i) {
        bool isCase = i == 2u && id < cases.length();
        uint k = min(id, cases.length() - 1u);
        vec2 uv = isCase ? cases[k].at / vec2(4.0, 2.0) : vec2((float(id) + (i == 0u ? 0.5 : 1.0)) / 256.0, 0.5);
        vec4 color = sampleTexture(w, isCase ? cases[k].id : 6u + (i & 1u), uv, isCase ? cases[k].lod : 0.0);
        if (i == 0u) EXPECT_NEAR(color, vec4(vec3(decoded), c), 2e-4 * decoded + 1e-7);
        // Filtered after decoding: halfway between two texels is their linear mean.
        if (i == 1u && id < 255u) EXPECT_NEAR(color.r, 0.5 * (decoded + decodedNext), 1e-4);
        if (isCase) EXPECT_NEAR(color, vec4(cases[k].expected / 5.0, 1.0), 2e-5);
    }
    // Coordinates that are no numbers must not lead out of the texture.
    float zero = float(testPush.pass) - 1.0, weight;
    ivec2 pair = texelPair(id == 0u ? zero / zero : id == 1u ? 1.0 / zero : -1.0 / zero, 4, (id & 8u) == 0u, (id & 4u) == 0u, weight);
    EXPECT_TRUE(all(greaterThanEqual(pair, ivec2(0))) && all(lessThan(pair, ivec2(4))));
}
