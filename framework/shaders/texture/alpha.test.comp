// SPDX-License-Identifier: MIT
// If these fail, cut-outs have the wrong outline, or what covers in part hides everything behind it by chance.
// passes: 2
#version 460
#include "texture/alpha.glsl"
#include "world/test_world.glsl"
layout(local_size_x = 8) in;

// One triangle with uv0 = (x, y), uv1 = (y, x); materials 0: opaque, 1: mask, 2: blend, 3: mask by uv1 and transform, 4: by vertex colour.
void write() {
    for (uint v = 0u; v < 3u; ++v) {
        vec2 uv = vec2(v == 1u ? 1.0 : 0.0, v == 2u ? 1.0 : 0.0);
        TestPositions(testArray(TEST_POSITIONS)).at[v] = vec4(vec3(uv, 0.0), 0);
        TestVertices(testArray(TEST_VERTICES)).at[v] = VertexRecord(0u, 0u, uv, uv.yx, packColor(v == 1u ? vec4(1, 1, 1, 0) : vec4(0, 1, 0, 1)));
    }
    // Alpha 0 on the left half, 1 on the right.
    TestTextures(testArray(TEST_TEXTURES)).at[0] = TextureRecord(testArray(TEST_TEXELS), 2u, 1u, 1u, TEXTURE_NEAREST, uvec2(0));
    TestUints(testArray(TEST_TEXELS)).at[0] = 0x00ffffffu;
    TestUints(testArray(TEST_TEXELS)).at[1] = 0xffffffffu;
    for (uint m = 0u; m < 5u; ++m) {
        MaterialRecord r = testMaterial();
        r.baseColorMap = testSlot(m == 4u ? NONE : 0u);
        r.flags = m == 0u ? 0u : m == 2u ? MATERIAL_BLEND : MATERIAL_MASK;
        if (m == 3u) r.baseColorMap = TextureSlotRecord(0u, 1u, vec3(1, 0, 0.5), vec3(0, 1, 0));
        if (m == 4u) r.flags |= MATERIAL_VERTEX_COLOR;
        TestMaterials(testArray(TEST_MATERIALS)).at[m] = r;
        TestPrimitives(testArray(TEST_PRIMITIVES)).at[m] = PrimitiveRecord(0u, 1u, 2u, m);
    }
}

void main() {
    if (testPush.pass == 0u) {
        if (gl_LocalInvocationID.x == 0u) write();
        return;
    }
    World w = testWorld();
    // A column is a material, a row a point: left, right, and above with uv1.x on the right half.
    const vec2 points[3] = vec2[](vec2(0.2, 0.2), vec2(0.7, 0.2), vec2(0.2, 0.7));
    const bool accepted[15] = bool[](true, false, true, true, true,
                                     true, true, true, true, false,
                                     true, false, true, false, true);
    uint material = gl_LocalInvocationID.x;
    if (material >= 5u) return;
    for (uint i = 0u; i < 3u; ++i) EXPECT_EQ(alphaAccepts(w, material, points[i]), accepted[5u * i + material]);
    if (material == 4u) EXPECT_NEAR(vertexColorOn(w, 4u, uvec3(0, 1, 2), vec2(0.7, 0.2)), vec4(0.7, 1.0, 0.7, 0.3), 1e-5);
    EXPECT_NEAR(alphaOn(w, 2u, uvec3(0, 1, 2), vec2(0.2, 0.2)), 0.0, 1e-6);
}
