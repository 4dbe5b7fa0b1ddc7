// SPDX-License-Identifier: MIT
// What a GPU unit test (<name>.test.comp) is written with; tests/gpu_runner runs it and prints what failed, with its line.
//
//   // groups: 64        workgroups of the dispatch, up to three numbers (1 when the line is left out)
//   // passes: 2         dispatches one after the other, each sees what the earlier wrote (1 when left out)
//   #version 460
//   #include "base/test.glsl"
//   layout(local_size_x = 64) in;
//   void main() { EXPECT_NEAR(sqrt(4.0), 2.0, 1e-6); }
//
// EXPECT_TRUE(condition), EXPECT_EQ(value, expected) and EXPECT_NEAR(value, expected, tolerance) take scalars and vectors; NaN
// fails, equal infinities are near. Every invocation counts its own checks, so one line can make a million of them.
// For statistics, `testScratch[i]` (uint) and `testFloats[i]` (float) are the same TEST_SCRATCH words, zero at the start and
// kept between passes: fill a histogram with atomicAdd in pass 0 and check it in pass 1 (`testPush.pass`).

const uint TEST_FAILURES = 1024u;       // failures recorded with their values; the rest is only counted
const uint TEST_SCRATCH = 1u << 20;

// Kinds of values, for printing.
const uint TEST_BOOL = 0u, TEST_INT = 1u, TEST_UINT = 2u, TEST_FLOAT = 3u, TEST_NEAR = 4u;
const uint TEST_SCALAR = 0xffu;         // "component" of what isn't a vector

struct TestFailure {
    uint text, line;                    // __FILE__ and __LINE__
    uint kind, component;
    uint64_t value, expected;           // integers as they are, floats as their bits
    float tolerance;
    uvec3 invocation;                   // gl_GlobalInvocationID
};
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer TestResults {
    uint checks, failures, unused[2];
    TestFailure recorded[TEST_FAILURES];
    uint scratch[TEST_SCRATCH];
};
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer TestFloats {
    uint unused[4];
    TestFailure recorded[TEST_FAILURES];
    float scratch[TEST_SCRATCH];
};
layout(push_constant, scalar) uniform TestPush {
    uint64_t results;
    uint pass;                          // 0, 1, ... of "passes"
} testPush;

#define testScratch (TestResults(testPush.results).scratch)
#define testFloats (TestFloats(testPush.results).scratch)

// Adds to testFloats[i] atomically. The sum depends on the order in its last bits.
void testAdd(uint i, float value) {
    uint old = testScratch[i], seen;
    do {
        seen = old;
        old = atomicCompSwap(testScratch[i], seen, floatBitsToUint(uintBitsToFloat(seen) + value));
    } while (old != seen);
}

// Limit that a chi-square statistic exceeds with a probability of only 1e-5 when the hypothesis is true: the cube of a normal
// deviate (Wilson and Hilferty 1931), right to 1 % from 20 degrees of freedom on; below it is too large, by 5 % for 3.
float chiSquareLimit(uint degreesOfFreedom) {
    float k = float(degreesOfFreedom), t = 2.0 / (9.0 * k);
    float root = 1.0 - t + 4.2649 * sqrt(t);
    return k * root * root * root;
}

void testCheck(bool good, uint text, uint line, uint kind, uint component, uint64_t value, uint64_t expected, float tolerance) {
    TestResults results = TestResults(testPush.results);
    atomicAdd(results.checks, 1u);
    if (good) return;
    uint slot = atomicAdd(results.failures, 1u);
    if (slot >= TEST_FAILURES) return;
    results.recorded[slot] = TestFailure(text, line, kind, component, value, expected, tolerance, gl_GlobalInvocationID);
}

// NaN by its bits: compilers may assume that comparisons never see one.
bool testIsNan(float x) { return (floatBitsToUint(x) & 0x7fffffffu) > 0x7f800000u; }
bool testIsNear(float value, float expected, float tolerance) {
    return !testIsNan(value) && !testIsNan(expected) && (value == expected || abs(value - expected) <= tolerance);
}
uint64_t testBits(float x) { return uint64_t(floatBitsToUint(x)); }

void testNear(uint text, uint line, uint component, float value, float expected, float tolerance) {
    testCheck(testIsNear(value, expected, tolerance), text, line, TEST_NEAR, component, testBits(value), testBits(expected), tolerance);
}
void testEq(uint text, uint line, uint component, float value, float expected) {
    testCheck(!testIsNan(value) && value == expected, text, line, TEST_FLOAT, component, testBits(value), testBits(expected), 0.0);
}
void testEq(uint text, uint line, uint component, int64_t value, int64_t expected) {
    testCheck(value == expected, text, line, TEST_INT, component, uint64_t(value), uint64_t(expected), 0.0);
}
void testEq(uint text, uint line, uint component, uint64_t value, uint64_t expected) {
    testCheck(value == expected, text, line, TEST_UINT, component, value, expected, 0.0);
}
void testEq(uint text, uint line, uint component, int value, int expected) { testEq(text, line, component, int64_t(value), int64_t(expected)); }
void testEq(uint text, uint line, uint component, uint value, uint expected) { testEq(text, line, component, uint64_t(value), uint64_t(expected)); }
void testEq(uint text, uint line, uint component, bool value, bool expected) {
    testCheck(value == expected, text, line, TEST_BOOL, component, uint64_t(value), uint64_t(expected), 0.0);
}

// A loop over the components keeps the code small however many checks a test has.
#define TEST_SCALARS(T)                                                                                                    \
    void testEq(uint text, uint line, T value, T expected) { testEq(text, line, TEST_SCALAR, value, expected); }
#define TEST_VECTORS(T, N)                                                                                                 \
    void testEq(uint text, uint line, T value, T expected) {                                                               \
        for (uint i = 0u; i < N; ++i) testEq(text, line, i, value[i], expected[i]);                                        \
    }
#define TEST_NEARS(T, N)                                                                                                   \
    void testNear(uint text, uint line, T value, T expected, float tolerance) {                                            \
        for (uint i = 0u; i < N; ++i) testNear(text, line, i, value[i], expected[i], tolerance);                           \
    }
TEST_SCALARS(bool)
TEST_SCALARS(int)
TEST_SCALARS(uint)
TEST_SCALARS(int64_t)
TEST_SCALARS(uint64_t)
TEST_SCALARS(float)
TEST_VECTORS(vec2, 2u)
TEST_VECTORS(vec3, 3u)
TEST_VECTORS(vec4, 4u)
TEST_VECTORS(ivec2, 2u)
TEST_VECTORS(ivec3, 3u)
TEST_VECTORS(ivec4, 4u)
TEST_VECTORS(uvec2, 2u)
TEST_VECTORS(uvec3, 3u)
TEST_VECTORS(uvec4, 4u)
TEST_NEARS(vec2, 2u)
TEST_NEARS(vec3, 3u)
TEST_NEARS(vec4, 4u)
void testNear(uint text, uint line, float value, float expected, float tolerance) { testNear(text, line, TEST_SCALAR, value, expected, tolerance); }

#define EXPECT_TRUE(condition) testEq(__FILE__, __LINE__, bool(condition), true)
#define EXPECT_EQ(value, expected) testEq(__FILE__, __LINE__, value, expected)
#define EXPECT_NEAR(value, expected, tolerance) testNear(__FILE__, __LINE__, value, expected, tolerance)
