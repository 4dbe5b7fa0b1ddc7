// SPDX-License-Identifier: MIT
// If these fail, a number chooses a triangle that nobody sees, or none of those that are seen; or the density of a light is that of another level.
// groups: 1
// passes: 2
#version 460
#include "light/light.glsl"
#include "world/test_world.glsl"
layout(local_size_x = 64) in;

const uint TEST_LEVELS = 11u, TEST_MESHES = 12u, TEST_SHOWN = 13u, TEST_LIGHT_LEVELS = 14u;
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer TestLevels { LevelRecord at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer TestMeshes { MeshRecord at[]; };

// A mesh of three levels: two triangles; two others, twice as large; one that does not glow.
// Lights: those of the finest level, a point light, and behind them those of the next. Of all numbers three quarters are the mesh's.
const uint QUARTER = 0x40000000u, LIGHTS = 3u;
const uint last[5] = uint[](QUARTER - 1u, 3u * QUARTER - 1u, 0xffffffffu, 2u * QUARTER - 1u, 3u * QUARTER - 1u);
const float pmf[5] = float[](0.25, 0.5, 0.25, 0.5, 0.25);

void write() {
    const vec3 corners[3] = vec3[](vec3(0), vec3(1, 0, 0), vec3(0, 1, 0));
    for (uint i = 0u; i < 15u; ++i)
        TestPositions(testArray(TEST_POSITIONS)).at[i] = vec4(corners[i % 3u] * (i >= 6u ? vec3(2, 1, 1) : vec3(1)) + vec3(0, 0, i / 3u), 0);
    const uint emitters[5] = uint[](0u, 1u, 0u, 1u, NONE), first[3] = uint[](0u, 2u, 4u), count[3] = uint[](2u, 2u, 1u);
    for (uint i = 0u; i < 5u; ++i) {
        TestPrimitives(testArray(TEST_PRIMITIVES)).at[i] = PrimitiveRecord(3u * i, 3u * i + 1u, 3u * i + 2u, 0u);
        TestUints(testArray(TEST_EMITTERS)).at[i] = emitters[i];
        LightRecord light = testLight(i == 2u ? LIGHT_POINT : LIGHT_TRIANGLE, pmf[i]);
        light.instance = 0u;
        light.primitive = i < 2u ? i : i - 1u;
        light.last = last[i];
        light.start = min(i, 1u);  // read of the first three alone
        TestLights(testArray(TEST_LIGHTS)).at[i] = light;
    }
    for (uint level = 0u; level < LEVELS; ++level)
        TestLevels(testArray(TEST_LEVELS)).at[level] = LevelRecord(first[min(level, 2u)], count[min(level, 2u)], 0.0, 0u);
    TestMeshes(testArray(TEST_MESHES)).at[0] = MeshRecord(vec3(0), 1.0, 3u, uvec3(0));
    const uint begin[3] = uint[](3u, 5u, 5u);
    for (uint i = 0u; i < 3u; ++i) TestUints(testArray(TEST_LIGHT_LEVELS)).at[i] = begin[i];
    InstanceRecord instance = testInstance(vec4(1, 0, 0, 0), vec4(0, 1, 0, 0), vec4(0, 0, 1, 0));
    instance.firstLight = instance.coarserLights = 0u;
    TestInstances(testArray(TEST_INSTANCES)).at[0] = instance;
    MaterialRecord glowing = testMaterial();
    glowing.emission = vec3(1);
    glowing.flags = MATERIAL_EMISSIVE | MATERIAL_DOUBLE_SIDED;
    TestMaterials(testArray(TEST_MATERIALS)).at[0] = glowing;
}

World showing(uint level) {
    World w = testWorld();
    w.levels = UintArray(testArray(TEST_SHOWN) + 4ul * uint64_t(level));
    w.meshLevels = LevelArray(testArray(TEST_LEVELS));
    w.meshes = MeshArray(testArray(TEST_MESHES));
    w.lightLevels = UintArray(testArray(TEST_LIGHT_LEVELS));
    w.lightCount = LIGHTS;
    return w;
}

void main() {
    if (gl_GlobalInvocationID.x != 0u) return;
    if (testPush.pass == 0u) {
        write();
        for (uint level = 0u; level <= LEVELS; ++level) TestUints(testArray(TEST_SHOWN)).at[level] = level;
        return;
    }
    const uint numbers[5] = uint[](QUARTER - 1u, QUARTER, 2u * QUARTER, 3u * QUARTER - 1u, 3u * QUARTER);
    const uint chosen[15] = uint[](0u, 1u, 1u, 1u, 2u, 3u, 3u, 4u, 4u, 2u, NONE, NONE, NONE, NONE, 2u);
    const uint lights[15] = uint[](0u, 1u, NONE, NONE, NONE, NONE, NONE, 3u, 4u, NONE, NONE, NONE, NONE, NONE, NONE);
    for (uint level = 0u; level <= LEVELS; ++level) {  // LEVELS: hidden, as its coarsest
        World w = showing(level);
        uint row = 5u * min(level, 2u);
        for (uint i = 0u; i < 5u; ++i) {
            EXPECT_EQ(numberedLight(w, numbers[i]), chosen[row + i]);
            EXPECT_EQ(chooseLight(w, uvec3(numbers[i]), vec3(0.5)).light, chosen[row + i]);
            uint light = triangleLight(w, 0u, i);
            EXPECT_EQ(light, lights[row + i]);
            // Seen from straight above, one away: the density is the chance over the area.
            vec3 at = vec3(0.2, 0.2, float(i));
            float expected = light == NONE ? 0.0 : pmf[light] / (level == 0u ? 0.5 : 1.0);
            EXPECT_NEAR(lightPdf(w, 0u, i, vec3(0, 0, -1), 1.0), expected, 1e-6);
            for (uint l = 0u; l < 5u; ++l) {
                if (l == 2u || w.lights.at[l].primitive != i) continue;
                vec2 uv = vec2(level == 0u ? 0.2 : 0.1, 0.2);
                LightSample s = lightSampleAt(w, LightPoint(l, 0u, uv), at + vec3(0, 0, 1));
                EXPECT_EQ(s.radianceOverPdf == vec3(0.0), light == NONE);
                EXPECT_NEAR(s.pdf, expected, 1e-6);
            }
        }
    }
}
