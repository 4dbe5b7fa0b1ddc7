// SPDX-License-Identifier: MIT
// If these fail, direct light is too bright or too dark, or its densities disagree with those of BSDF samples that find the same light.
// groups: 32
// passes: 3
#version 460
#include "light/light.glsl"
#include "world/test_world.glsl"
layout(local_size_x = 64) in;

// Lights: 0, 1 the triangles of a textured quad (a 2 x 2 square at z = 2 that faces -Z, instance 0); 2 a mirrored and stretched triangle,
// instance 1; 3 point with range; 4 spot; 5 directional. The table of numbers is by hand.
const uint LIGHTS = 6u;
const uint last[LIGHTS] = uint[](1002159035u, 2147483647u, 2576980377u, 3221225471u, 3865470565u, 4294967295u);
const uint start[LIGHTS] = uint[](0u, 0u, 1u, 2u, 3u, 4u);
const float pmf[LIGHTS] = float[](1.4 / 6.0, 1.6 / 6.0, 0.1, 0.15, 0.15, 0.1);  // what the table gives

void write() {
    const vec3 positions[7] = vec3[](vec3(-1, -1, 2), vec3(-1, 1, 2), vec3(1, 1, 2), vec3(1, -1, 2),  //
                                     vec3(0, 0, 0), vec3(0, 1, 0), vec3(1, 0, 0));
    uint down = packNormal(vec3(0, 0, -1));
    for (uint i = 0u; i < 7u; ++i) {
        TestPositions(testArray(TEST_POSITIONS)).at[i] = vec4(positions[i], 0);
        TestVertices(testArray(TEST_VERTICES)).at[i] = VertexRecord(down, 0u, 0.5 * positions[i].xy + 0.5, vec2(0), packColor(vec4(1)));
    }
    TestPrimitives(testArray(TEST_PRIMITIVES)).at[0] = PrimitiveRecord(0u, 1u, 2u, 0u);
    TestPrimitives(testArray(TEST_PRIMITIVES)).at[1] = PrimitiveRecord(0u, 2u, 3u, 0u);
    TestPrimitives(testArray(TEST_PRIMITIVES)).at[2] = PrimitiveRecord(4u, 5u, 6u, 1u);  // faces -Z
    TestPrimitives(testArray(TEST_PRIMITIVES)).at[3] = PrimitiveRecord(0u, 1u, 2u, 2u);  // no light
    const uint emitters[4] = uint[](0u, 1u, 0u, NONE);
    for (uint i = 0u; i < 4u; ++i) TestUints(testArray(TEST_EMITTERS)).at[i] = emitters[i];
    InstanceRecord plain = testInstance(vec4(1, 0, 0, 0), vec4(0, 1, 0, 0), vec4(0, 0, 1, 0));
    plain.firstLight = 0u;
    InstanceRecord mirrored = testInstance(vec4(-2, 0, 0, 1), vec4(0, 1, 0, -1), vec4(0, 0, 1, 1.5));
    mirrored.firstLight = 2u;
    TestInstances(testArray(TEST_INSTANCES)).at[0] = plain;
    TestInstances(testArray(TEST_INSTANCES)).at[1] = mirrored;
    MaterialRecord glowing = testMaterial();
    glowing.emission = vec3(4, 2, 1);
    glowing.flags = MATERIAL_EMISSIVE;
    glowing.emissiveMap = testSlot(0u);
    MaterialRecord both = testMaterial();
    both.emission = vec3(3);
    both.flags = MATERIAL_EMISSIVE | MATERIAL_DOUBLE_SIDED;
    TestMaterials(testArray(TEST_MATERIALS)).at[0] = glowing;
    TestMaterials(testArray(TEST_MATERIALS)).at[1] = both;
    TestMaterials(testArray(TEST_MATERIALS)).at[2] = testMaterial();
    // Red 0.2 and 1.0 in the two halves along x, unfiltered: mean 0.6.
    TestTextures(testArray(TEST_TEXTURES)).at[0] = TextureRecord(testArray(TEST_TEXELS), 2u, 1u, 1u, TEXTURE_NEAREST | TEXTURE_CLAMP_U, uvec2(0));
    TestUints(testArray(TEST_TEXELS)).at[0] = 0xffffff33u;
    TestUints(testArray(TEST_TEXELS)).at[1] = 0xffffffffu;
    const uint types[LIGHTS] = uint[](LIGHT_TRIANGLE, LIGHT_TRIANGLE, LIGHT_TRIANGLE, LIGHT_POINT, LIGHT_SPOT, LIGHT_DIRECTIONAL);
    for (uint i = 0u; i < LIGHTS; ++i) {
        LightRecord light = testLight(types[i], pmf[i]);
        light.instance = i / 2u;
        light.primitive = i;
        light.last = last[i];
        light.start = start[i];
        light.position = vec3(0, 3, 0);
        light.intensity = vec3(9, 18, 36);
        light.range = i == 3u ? 6.0 : 0.0;
        light.cosInner = 0.9;
        light.cosOuter = 0.8;
        TestLights(testArray(TEST_LIGHTS)).at[i] = light;
    }
}

const uint COUNT = TEST_SUMS * 32768u, IRRADIANCE = COUNT + 8u, SQUARE = COUNT + 16u, RED = COUNT + 24u;
const vec3 RECEIVER = vec3(0.3, -0.2, 0.4);
const uint SAMPLES = 64u;

/// Irradiance from a polygon of radiance 1 at a point (Lambert 1760): the sum over its edges of the angle they subtend times the cosine of
/// their plane with the normal, halved. All corners lie above the horizon.
float polygonIrradiance(vec3 a, vec3 b, vec3 c, vec3 position, vec3 normal) {
    vec3 corner[3] = vec3[](normalize(a - position), normalize(b - position), normalize(c - position));
    float sum = 0.0;
    for (uint i = 0u; i < 3u; ++i) {
        vec3 p = corner[i], q = corner[(i + 1u) % 3u], across = cross(p, q);
        sum += atan(length(across), dot(p, q)) * dot(normalize(across), normal);
    }
    return 0.5 * abs(sum);
}

void accumulate(World w, uint id) {
    float irradiance[3] = float[](0.0, 0.0, 0.0), squares[3] = float[](0.0, 0.0, 0.0), red = 0.0;
    for (uint i = 0u; i < SAMPLES; ++i) {
        uvec2 seed = uvec2(id, i);
        LightSample s = sampleLight(w, RECEIVER, randomBits3(seed, 1u, RANDOM_LIGHT_CHOICE), random3(seed, 1u, RANDOM_LIGHT_POINT));
        uint light = s.point.light;
        atomicAdd(testScratch[COUNT + light], 1u);
        EXPECT_NEAR(length(s.direction), 1.0, 1e-5);
        EXPECT_EQ(s.delta, light >= 3u);
        EXPECT_EQ(s.pdf == 0.0, s.delta);
        if (light >= 3u) continue;
        // Green is free of the texture: radiance 2 on the quad, 3 on the other triangle.
        float value = s.radianceOverPdf.g * max(0.0, s.direction.z) / (light == 2u ? 3.0 : 2.0);
        irradiance[light] += value;
        squares[light] += value * value;
        if (light == 0u) {  // by area, the texture's mean over the triangle
            float areaPdf = s.pdf * s.cosine / square(s.distance) / pmf[0];
            EXPECT_NEAR(areaPdf, 0.5, 1e-4);
            red += s.radianceOverPdf.r * s.pdf / 4.0;
        }
        // A ray along the sample finds the point with the same density.
        EXPECT_NEAR(lightPdf(w, light / 2u, light, s.direction, s.distance) / s.pdf, 1.0, 1e-4);
        LightSample again = lightSampleAt(w, s.point, RECEIVER);
        EXPECT_EQ(again.direction, s.direction);
        EXPECT_EQ(again.pdf, s.pdf);
    }
    for (uint i = 0u; i < 3u; ++i) {
        testAdd(IRRADIANCE + i, irradiance[i]);
        testAdd(SQUARE + i, squares[i]);
    }
    testAdd(RED, red);
}

void checkSums() {
    float total = 32.0 * 64.0 * float(SAMPLES), chiSquare = 0.0;
    for (uint i = 0u; i < LIGHTS; ++i) chiSquare += square(float(testScratch[COUNT + i]) - pmf[i] * total) / (pmf[i] * total);
    EXPECT_TRUE(chiSquare < chiSquareLimit(LIGHTS - 1u));
    const vec3 corners[9] = vec3[](vec3(-1, -1, 2), vec3(-1, 1, 2), vec3(1, 1, 2), vec3(-1, -1, 2), vec3(1, 1, 2), vec3(1, -1, 2),
                                   vec3(1, -1, 1.5), vec3(1, 0, 1.5), vec3(-1, -1, 1.5));
    for (uint i = 0u; i < 3u; ++i) {
        float mean = testFloats[IRRADIANCE + i] / total, deviation = sqrt((testFloats[SQUARE + i] / total - mean * mean) / total);
        float known = polygonIrradiance(corners[3u * i], corners[3u * i + 1u], corners[3u * i + 2u], RECEIVER, vec3(0, 0, 1));
        EXPECT_NEAR(mean, known, 4.5 * deviation);
        EXPECT_TRUE(deviation < 0.01 * known);
    }
    // Triangle 0 is the half towards -x: of its area 3/4 has red 0.2, 1/4 has red 1.
    EXPECT_NEAR(testFloats[RED] / float(testScratch[COUNT]), 0.4, 0.01);
}

// A light seen from a place: what it must give, times its pmf.
struct Case {
    uint light;
    vec3 from, expected;
};
const Case cases[] = Case[](
    Case(0u, vec3(0, 0, 5), vec3(0)),                                       // the quad is dark from behind
    Case(3u, vec3(0, 0, 0), vec3(1, 2, 4) * (1.0 - 1.0 / 16.0)),            // point: inverse square, window 1 - (d / range)^4
    Case(3u, vec3(0, -3.1, 0), vec3(0)),
    Case(4u, vec3(0, 0, 0), vec3(1, 2, 4)),                                 // spot, shining down: full on the axis,
    Case(4u, vec3(0, 2, 0.6197443), 0.25 * 0.7225 * vec3(9, 18, 36)),       // a quarter at the cosine 0.85, halfway,
    Case(4u, vec3(0, 2, 1), vec3(0)),                                       // nothing outside
    Case(5u, vec3(7, 8, 9), vec3(9, 18, 36)));                              // directional

void knownAnswers(World w) {
    for (uint i = 0u; i < cases.length(); ++i) {
        LightSample s = lightSampleAt(w, LightPoint(cases[i].light, 0u, vec2(0.3)), cases[i].from);
        EXPECT_NEAR(s.radianceOverPdf * pmf[cases[i].light], cases[i].expected, 1e-4);
        EXPECT_TRUE(cases[i].light != 3u || abs(s.distance - (3.0 - cases[i].from.y)) < 1e-5);
        EXPECT_EQ(s.distance == FAR, cases[i].light == 5u);
        if (cases[i].light >= 3u && cases[i].from.z == 0.0) EXPECT_NEAR(s.direction, vec3(0, 1, 0), 1e-6);
    }
    EXPECT_EQ(chooseLight(testWorld(), uvec3(1), vec3(0.5)).light, NONE);
    for (uint i = 0u; i < LIGHTS; ++i) {
        EXPECT_EQ(numberedLight(w, last[i]), i);
        EXPECT_EQ(numberedLight(w, last[i] + 1u), (i + 1u) % LIGHTS);
    }
    EXPECT_EQ(lightPdf(w, 0u, 3u, vec3(0, 0, 1), 1.0), 0.0);
    // What rays see that hit the quad's front and back, and a double-sided triangle's back.
    const uint primitives[3] = uint[](1u, 1u, 2u);
    const vec3 seen[3] = vec3[](vec3(4, 2, 1), vec3(0), vec3(3));
    for (uint i = 0u; i < 3u; ++i) {
        Surface s = surfaceAt(w, Hit(1.0, i < 2u ? vec2(0.9, 0.05) : vec2(0.3), primitives[i], i / 2u), vec3(0, 0, i == 0u ? 1 : -1));
        EXPECT_EQ(s.frontFace, i == 0u);
        EXPECT_NEAR(emittedRadiance(w, s), seen[i], 1e-6);
    }
    float zero = float(testPush.pass) - 2.0;
    EXPECT_NEAR(misWeight(1.0, 3.0) + misWeight(3.0, 1.0), 1.0, 1e-6);
    EXPECT_EQ(misWeight(zero, zero), 0.0);
    EXPECT_EQ(misWeight(2.0, zero), 1.0);
    EXPECT_EQ(misWeight(1.0 / zero, 5.0), 1.0);
}

void main() {
    uint id = gl_GlobalInvocationID.x;
    World w = testWorld();
    w.lightCount = LIGHTS;
    if (testPush.pass == 0u && id == 0u) write();
    if (testPush.pass == 1u) accumulate(w, id);
    if (testPush.pass == 2u && id == 0u) {
        checkSums();
        knownAnswers(w);
    }
}
