// SPDX-License-Identifier: MIT
// If these fail, the sky is turned or mirrored, or light sampling disagrees with the densities of BSDF samples that escape.
// groups: 32
// passes: 3
#version 460
#include "light/light.glsl"
#include "world/test_world.glsl"
layout(local_size_x = 64) in;

// 8 x 4 texels, one of them bright. Every other slot of the alias table gives what it doesn't keep to that one.
const uvec2 SIZE = uvec2(8, 4);
const uint TEXELS = 32u, SUN = 11u, SAMPLES = 64u;
const float PMF = 0.8, ROTATION = 0.7;
const uint SUMS = TEST_SUMS * 32768u;  // then counts of texels

float keepOf(uint texel) { return texel == SUN ? 1.0 : 0.2 + 0.02 * float(texel); }
vec3 radianceOf(uint texel) { return texel == SUN ? vec3(40, 30, 20) : vec3(1.0 + float(texel % 5u), 2.0, 0.5 + 0.1 * float(texel)); }

void write() {
    float given = 0.0;
    for (uint i = 0u; i < TEXELS; ++i) given += 1.0 - keepOf(i);
    for (uint i = 0u; i < TEXELS; ++i) {
        float density = i == SUN ? 1.0 + given : keepOf(i);  // per unit of uv: probability times the number of texels
        TestEnvironment(testArray(TEST_ENVIRONMENT)).at[i] = EnvironmentTexel(radianceOf(i), density, keepOf(i), SUN, uvec2(0));
    }
    TestLights(testArray(TEST_LIGHTS)).at[0] = testLight(LIGHT_POINT, 1.0 - PMF);
    TestLights(testArray(TEST_LIGHTS)).at[1] = testLight(LIGHT_ENVIRONMENT, PMF);
    TestLights(testArray(TEST_LIGHTS)).at[0].last = 858993458u;  // a fifth of all numbers
    TestLights(testArray(TEST_LIGHTS)).at[0].start = 0u;
    TestLights(testArray(TEST_LIGHTS)).at[1].last = 0xffffffffu;
    TestLights(testArray(TEST_LIGHTS)).at[1].start = 1u;
}

void known(World w) {
    w.environmentRotation = 0.0;
    EXPECT_NEAR(environmentUv(w, vec3(0, 0, -1)), vec2(0.5, 0.5), 1e-6);
    EXPECT_NEAR(environmentUv(w, vec3(1, 0, 0)), vec2(0.75, 0.5), 1e-6);
    EXPECT_NEAR(environmentUv(w, vec3(-1, 0, 0)), vec2(0.25, 0.5), 1e-6);
    EXPECT_NEAR(environmentUv(w, vec3(0, 1, 0)).y, 0.0, 1e-6);
    EXPECT_NEAR(environmentUv(w, vec3(0, -1, 0)).y, 1.0, 1e-6);
    w.environmentRotation = 0.5 * PI;  // the map's middle, -Z, turns to -X
    EXPECT_NEAR(environmentUv(w, vec3(-1, 0, 0)), vec2(0.5, 0.5), 1e-6);
    // Texel centres, between columns over the seam, and rows that end at the poles.
    const vec2 at[4] = vec2[](vec2(3.5, 1.5), vec2(8.0, 2.5), vec2(2.0, 2.0), vec2(5.5, 0.1));
    const vec3 expected[4] = vec3[](radianceOf(11u), 0.5 * (radianceOf(23u) + radianceOf(16u)),
                                    0.25 * (radianceOf(9u) + radianceOf(10u) + radianceOf(17u) + radianceOf(18u)), radianceOf(5u));
    for (uint i = 0u; i < 4u; ++i) {
        vec2 uv = at[i] / vec2(SIZE);
        EXPECT_NEAR(environmentRadiance(w, environmentDirection(w, uv)), expected[i], 1e-4);
    }
    w.environmentLight = NONE;
    EXPECT_EQ(environmentRadiance(w, vec3(0, 1, 0)), vec3(0.0));
    EXPECT_EQ(environmentPdf(w, vec3(0, 1, 0)), 0.0);
}

void drawSamples(World w, uint id) {
    float sums[5] = float[](0.0, 0.0, 0.0, 0.0, 0.0);
    for (uint i = 0u; i < SAMPLES; ++i) {
        uvec2 seed = uvec2(id, i);
        LightSample s = sampleLight(w, vec3(1, 2, 3), randomBits3(seed, 1u, RANDOM_LIGHT_CHOICE), random3(seed, 1u, RANDOM_LIGHT_POINT));
        if (s.delta) continue;
        EXPECT_NEAR(length(s.direction), 1.0, 1e-5);
        EXPECT_EQ(s.distance, FAR);
        EnvironmentPoint point = EnvironmentPoint(s.point.texel, s.point.uv);
        EXPECT_TRUE(s.pdf == PMF * environmentDensity(w, point) && all(lessThan(s.point.uv, vec2(1.0))));
        vec2 uv = environmentUv(w, s.direction), turn = abs(uv - environmentUv(w, point));
        EXPECT_NEAR(vec2(min(turn.x, 1.0 - turn.x) * sin(PI * uv.y), turn.y), vec2(0.0), 2e-6);
        // At the very border of a texel rounding may put the direction into the next one.
        vec2 inside = abs(s.point.uv - 0.5);
        if (max(inside.x, inside.y) < 0.4999 && uv.y > 0.01 && uv.y < 0.99) EXPECT_NEAR(environmentPdf(w, s.direction) / s.pdf, 1.0, 2e-3);
        vec3 radiance = environmentRadiance(w, s.direction);
        EXPECT_NEAR(s.radianceOverPdf * s.pdf / radiance, vec3(1.0), 2e-3);
        atomicAdd(testScratch[SUMS + 16u + s.point.texel], 1u);
        float up = max(0.0, dot(s.direction, normalize(vec3(1, 2, 2)))), lit = s.radianceOverPdf.r * up;
        sums[0] += 1.0;
        sums[1] += 1.0 / s.pdf;   // the whole sphere
        sums[2] += up / s.pdf;    // radiance 1: PI
        sums[3] += lit;
        sums[4] += lit * lit;
    }
    for (uint i = 0u; i < 5u; ++i) testAdd(SUMS + i, sums[i]);
}

void check(World w) {
    float total = 32.0 * 64.0 * float(SAMPLES), chiSquare = 0.0;
    EXPECT_NEAR(testFloats[SUMS] / total, PMF, 0.006);
    EXPECT_NEAR(testFloats[SUMS + 1u] / total, 4.0 * PI, 0.1);
    EXPECT_NEAR(testFloats[SUMS + 2u] / total, PI, 0.04);
    // The bright texel and all others, against a midpoint sum over the sphere.
    float irradiance = 0.0;
    const uint N = 128u;
    for (uint i = 0u; i < N * N; ++i) {
        vec2 uv = (vec2(i % N, i / N) + 0.5) / float(N);
        vec3 d = environmentDirection(w, uv);
        float solidAngle = sin(PI * uv.y) * 2.0 * PI * PI / float(N * N);
        irradiance += environmentRadiance(w, d).r * max(0.0, dot(d, normalize(vec3(1, 2, 2)))) * solidAngle;
    }
    float mean = testFloats[SUMS + 3u] / total, deviation = sqrt((testFloats[SUMS + 4u] / total - mean * mean) / total);
    EXPECT_NEAR(mean, irradiance, 4.5 * deviation + 1e-3 * irradiance);
    EXPECT_TRUE(deviation < 0.01 * irradiance);
    for (uint i = 0u; i < TEXELS; ++i) {
        float expected = testFloats[SUMS] * TestEnvironment(testArray(TEST_ENVIRONMENT)).at[i].density / float(TEXELS);
        chiSquare += square(float(testScratch[SUMS + 16u + i]) - expected) / expected;
    }
    EXPECT_TRUE(chiSquare < chiSquareLimit(TEXELS - 1u));
}

void main() {
    uint id = gl_GlobalInvocationID.x;
    World w = testWorld();
    w.lightCount = 2u;
    w.environmentLight = 1u;
    w.environmentSize = SIZE;
    w.environmentRotation = ROTATION;
    if (testPush.pass == 0u && id == 0u) write();
    if (testPush.pass == 1u) drawSamples(w, id);
    if (testPush.pass == 2u && id == 0u) {
        check(w);
        known(w);
    }
}
