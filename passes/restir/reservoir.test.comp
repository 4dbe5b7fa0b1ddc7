// SPDX-License-Identifier: MIT
// If these fail, a reservoir does not come back from memory as it was written: lengths, lobes, confidences or points are others.
// groups: 64
// passes: 2
#version 460
#include "base/random.glsl"
#include "base/sampling.glsl"
#include "base/test.glsl"
#include "restir/reservoir.glsl"
#include "restir/sample_hit.h"
layout(local_size_x = 64) in;

// The scratch memory of the test, seen as records.
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer TestReservoirs {
    uint unused[4];
    TestFailure recorded[TEST_RECORDS];
    Reservoir scratch[4096];
    SampleHit hits[4096];
};
const uint HITS = 4096u * 16u;  // word where the hits begin

PathShape someShape(uint id) {
    uvec3 a = randomBits3(uvec2(id, 5), 0u, 0u), b = randomBits3(uvec2(id, 5), 1u, 0u);
    uint d = 1u + scaledIndex(a.x, PATH_LENGTH_MAX);
    uint k = d == 1u || (a.z & 3u) == 0u ? 0u : 2u + scaledIndex(a.y, d - 1u);
    return PathShape(d, k, (a.z & 4u) != 0u, scaledIndex(b.x, 3u), scaledIndex(b.y, 4u), scaledIndex(b.z, 4u));
}

void expectShape(PathShape s, PathShape expected) {
    EXPECT_EQ(uvec4(s.d, s.k, s.light, uint(s.nee)), uvec4(expected.d, expected.k, expected.light, uint(expected.nee)));
    EXPECT_EQ(uvec2(s.lobeBefore, s.lobeAt).xyy, uvec2(expected.lobeBefore, expected.lobeAt).xyy);
}

Reservoir someReservoir(uint id) {
    uvec2 seed = pathSeed(uvec2(id & 63u, id >> 6), 7u, 1u);
    vec3 a = random3(seed, 1u, 0u), b = random3(seed, 1u, 1u), c = random3(seed, 1u, 2u), direction = random3(seed, 1u, 3u) * 2.0 - 1.0;
    return Reservoir(seed, 10.0 * a.x, packShape(someShape(id), float(id) * 0.25), b, a.y, id, id * 3u + 1u,
                     packDirection(safeNormalize(direction, vec3(0, 0, 1))), c, a.z);
}

void main() {
    uint id = gl_GlobalInvocationID.x;
    TestReservoirs memory = TestReservoirs(testPush.results);
    Reservoir r = someReservoir(id);
    PrimaryHit primary = PrimaryHit(id, id + 1u, vec2(0.25, 0.5), vec2(0.125, 0.75), vec2(0.5, 0.0));
    SampleHit h = SampleHit(primary, 0.625, vec2(-3.5, float(id)), TrianglePlace(vec2(0.3, 0.1), vec2(7.0, 8.0)), 0u);
    if (testPush.pass == 0u) {
        memory.scratch[id] = r;
        memory.hits[id] = h;
    } else {
        // Each lane reads what its neighbour wrote, by words: the layout of C++ and of a dump.
        uint other = id ^ 1u, base = other * 16u, hits = HITS + other * 16u;
        r = someReservoir(other);
        EXPECT_EQ(uvec4(testScratch[base], testScratch[base + 1u], testScratch[base + 2u], testScratch[base + 3u]),
                  uvec4(r.seed, floatBitsToUint(r.W), r.shape));
        EXPECT_EQ(vec4(testFloats[base + 4u], testFloats[base + 5u], testFloats[base + 6u], testFloats[base + 7u]), vec4(r.F, r.lightPdf));
        EXPECT_EQ(uvec4(testScratch[base + 8u], testScratch[base + 9u], testScratch[base + 10u], testScratch[base + 11u]),
                  uvec4(r.rcInstance, r.rcPrimitive, r.rcDirection));
        EXPECT_EQ(vec4(testFloats[base + 12u], testFloats[base + 13u], testFloats[base + 14u], testFloats[base + 15u]),
                  vec4(r.radiance, r.G));
        EXPECT_EQ(uvec2(testScratch[hits], testScratch[hits + 1u]).xyy, uvec2(other, other + 1u).xyy);
        EXPECT_EQ(vec3(testFloats[hits + 8u], testFloats[hits + 10u], testFloats[hits + 14u]), vec3(0.625, float(other), 8.0));
        EXPECT_EQ(memory.hits[other].rc.barycentrics, vec2(0.3, 0.1));
        expectShape(unpackShape(memory.scratch[other].shape), someShape(other));
        EXPECT_EQ(memory.hits[other].uv, vec2(-3.5, float(other)));
        return;
    }
    // Round trips: shape and confidence share a word and leave each other alone.
    expectShape(unpackShape(r.shape), someShape(id));
    EXPECT_NEAR(confidence(r), float(id) * 0.25, float(id) * 0.25 / 1024.0);  // 11 bits, rounded either way
    float quarter = float(id & 255u) * 0.25;
    setConfidence(r, quarter);
    EXPECT_EQ(confidence(r), quarter);
    expectShape(unpackShape(r.shape), someShape(id));
    EXPECT_EQ(packShape(unpackShape(r.shape), confidence(r)), r.shape);
    setConfidence(r, float(id & 2047u));
    EXPECT_EQ(confidence(r), float(id & 2047u));
    if (id > 0u) return;
    // d = 3, k = 2, light sampling, environment, lobes 1 and 2, M = 1 (half: 0x3c00).
    uint bits = packShape(PathShape(3u, 2u, true, PATH_LIGHT_ENVIRONMENT, 1u, 2u), 1.0);
    EXPECT_EQ(bits, 3u | 2u << 5 | 1u << 10 | 1u << 11 | 1u << 13 | 2u << 15 | 0x3c00u << 17);
    EXPECT_EQ(packShape(PathShape(31u, 31u, true, 3u, 3u, 3u), 0.0), 0x1ffffu);
    setConfidence(r, 1e9);
    EXPECT_EQ(confidence(r), 65504.0);
    setConfidence(r, -1.0);
    EXPECT_EQ(confidence(r), 0.0);
    Reservoir none = emptyReservoir(5.0);
    EXPECT_EQ(holdsPath(none), false);
    EXPECT_EQ(confidence(none), 5.0);
    EXPECT_EQ(shadeReservoir(none), vec3(0.0));
    none.W = 2.0;
    none.F = vec3(1.0, 2.0, 3.0);
    EXPECT_EQ(shadeReservoir(none), vec3(2.0, 4.0, 6.0));
    EXPECT_NEAR(target(none), 0.2126 + 1.4304 + 0.2166, 1e-6);
    // Every kind of reconnection.
    EXPECT_EQ(reconnectionKind(PathShape(4u, 0u, true, 0u, 0u, 0u)), RC_NONE);
    EXPECT_EQ(reconnectionKind(PathShape(4u, 2u, true, 0u, 0u, 0u)), RC_SURFACE);
    EXPECT_EQ(reconnectionKind(PathShape(4u, 3u, true, 0u, 0u, 0u)), RC_TO_LIGHT);
    EXPECT_EQ(reconnectionKind(PathShape(4u, 3u, false, 0u, 0u, 0u)), RC_SURFACE);
    EXPECT_EQ(reconnectionKind(PathShape(4u, 4u, true, PATH_LIGHT_ENVIRONMENT, 0u, 0u)), RC_LIGHT);
    EXPECT_EQ(reconnectionKind(PathShape(4u, 4u, false, PATH_LIGHT_ENVIRONMENT, 0u, 0u)), RC_ENVIRONMENT);
    EXPECT_EQ(reconnectionKind(PathShape(4u, 4u, false, PATH_LIGHT_TRIANGLE, 0u, 0u)), RC_EMITTER);
}
