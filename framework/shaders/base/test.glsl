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
// Results must not depend on the run: where something fails, it runs again for more details.
// For statistics, `testScratch[i]` (uint) and `testFloats[i]` (float) are the same TEST_SCRATCH words, zero at the start and
// kept between passes: fill a histogram with atomicAdd in pass 0 and check it in pass 1 (`testPush.pass`).

const uint TEST_RECORDS = 1024u;         // failures recorded with their values in one run; the rest is only counted
const uint TEST_SCRATCH = 1u << 20;      // words

// Kinds of values, for printing.
const uint TEST_BOOL = 0u, TEST_INT = 1u, TEST_UINT = 2u, TEST_FLOAT = 3u, TEST_NEAR = 4u;
const uint TEST_SCALAR = 0xffu;          // "component" of what isn't a vector

struct TestFailure {
    uint text, line;                     // __FILE__ and __LINE__
    uint kind, component;
    uint64_t value, expected;            // integers as they are, floats as their bits
    float tolerance;
    uvec3 invocation;                    // gl_GlobalInvocationID
};
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer TestResults {
    uint checks, failures, most, count;  // sums over invocations; most failures of one; how many are recorded
    TestFailure recorded[TEST_RECORDS];
    uint scratch[TEST_SCRATCH];
};
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer TestFloats {
    uint unused[4];
    TestFailure recorded[TEST_RECORDS];
    float scratch[TEST_SCRATCH];
};
layout(push_constant, scalar) uniform TestPush {
    uint64_t results;
    uint pass;                           // 0, 1, ... of "passes"
    uint skip;                           // each invocation records its failure of this number; the runner repeats the run for the next
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

// A check costs a few selects and no branch; memory is written once, after main. (Written at each check, two hundred checks of
// vectors took lavapipe's compiler two minutes.)
uint testChecks = 0u, testFailures = 0u;
uint testPlace, testKind;  // of the kept failure: text and line, kind and component, 16 bits each
uint64_t testValue, testExpected;
float testTolerance;

void testCheck(bool good, uint text, uint line, uint kind, uint component, uint64_t value, uint64_t expected, float tolerance) {
    ++testChecks;
    bool keep = !good && testFailures == testPush.skip;
    testPlace = keep ? text << 16 | line : testPlace;
    testKind = keep ? kind << 16 | component : testKind;
    testValue = keep ? value : testValue;
    testExpected = keep ? expected : testExpected;
    testTolerance = keep ? tolerance : testTolerance;
    testFailures += good ? 0u : 1u;
}

void testMain();  // what the test calls main()
void main() {
    testMain();
    TestResults results = TestResults(testPush.results);
    atomicAdd(results.checks, testChecks);
    if (testFailures == 0u) return;
    atomicAdd(results.failures, testFailures);
    atomicMax(results.most, testFailures);
    if (testFailures <= testPush.skip) return;
    uint slot = atomicAdd(results.count, 1u);
    if (slot >= TEST_RECORDS) return;
    results.recorded[slot] = TestFailure(testPlace >> 16, testPlace & 0xffffu, testKind >> 16, testKind & 0xffffu,
                                         testValue, testExpected, testTolerance, gl_GlobalInvocationID);
}
#define main testMain

// NaN by its bits: compilers may assume that comparisons never see one.
bool testIsNan(float x) { return (floatBitsToUint(x) & 0x7fffffffu) > 0x7f800000u; }
bool testIsNear(float value, float expected, float tolerance) {
    return !testIsNan(value) && !testIsNan(expected) && (value == expected || abs(value - expected) <= tolerance);
}
uint64_t testBits(float x) { return uint64_t(floatBitsToUint(x)); }

bool testIsEqual(float value, float expected) { return !testIsNan(value) && value == expected; }
bool testIsEqual(int value, int expected) { return value == expected; }
bool testIsEqual(uint value, uint expected) { return value == expected; }
uint64_t testBits(int x) { return uint64_t(int64_t(x)); }
uint64_t testBits(uint x) { return uint64_t(x); }

void testNear(uint text, uint line, float value, float expected, float tolerance) {
    testCheck(testIsNear(value, expected, tolerance), text, line, TEST_NEAR, TEST_SCALAR, testBits(value), testBits(expected), tolerance);
}
void testEq(uint text, uint line, float value, float expected) {
    testCheck(testIsEqual(value, expected), text, line, TEST_FLOAT, TEST_SCALAR, testBits(value), testBits(expected), 0.0);
}
void testEq(uint text, uint line, int64_t value, int64_t expected) {
    testCheck(value == expected, text, line, TEST_INT, TEST_SCALAR, uint64_t(value), uint64_t(expected), 0.0);
}
void testEq(uint text, uint line, uint64_t value, uint64_t expected) {
    testCheck(value == expected, text, line, TEST_UINT, TEST_SCALAR, value, expected, 0.0);
}
void testEq(uint text, uint line, int value, int expected) { testEq(text, line, int64_t(value), int64_t(expected)); }
void testEq(uint text, uint line, uint value, uint expected) { testEq(text, line, uint64_t(value), uint64_t(expected)); }
void testEq(uint text, uint line, bool value, bool expected) {
    testCheck(value == expected, text, line, TEST_BOOL, TEST_SCALAR, uint64_t(value), uint64_t(expected), 0.0);
}

// A vector is one check, which tells its first wrong component.
#define TEST_VECTOR(T, COMPONENT, N, KIND)                                                                                          \
    void testEq(uint text, uint line, T value, T expected) {                                                                        \
        uint wrong = N;                                                                                                             \
        COMPONENT v = value[0], e = expected[0];                                                                                    \
        for (uint i = N; i-- > 0u;)                                                                                                 \
            if (!testIsEqual(value[i], expected[i])) { wrong = i; v = value[i]; e = expected[i]; }                                  \
        testCheck(wrong == N, text, line, KIND, wrong, testBits(v), testBits(e), 0.0);                                              \
    }
#define TEST_VECTOR_NEAR(T, N)                                                                                                      \
    void testNear(uint text, uint line, T value, T expected, float tolerance) {                                                     \
        uint wrong = N;                                                                                                             \
        float v = value[0], e = expected[0];                                                                                        \
        for (uint i = N; i-- > 0u;)                                                                                                 \
            if (!testIsNear(value[i], expected[i], tolerance)) { wrong = i; v = value[i]; e = expected[i]; }                        \
        testCheck(wrong == N, text, line, TEST_NEAR, wrong, testBits(v), testBits(e), tolerance);                                   \
    }
TEST_VECTOR(vec2, float, 2u, TEST_FLOAT)
TEST_VECTOR(vec3, float, 3u, TEST_FLOAT)
TEST_VECTOR(vec4, float, 4u, TEST_FLOAT)
TEST_VECTOR(ivec2, int, 2u, TEST_INT)
TEST_VECTOR(ivec3, int, 3u, TEST_INT)
TEST_VECTOR(ivec4, int, 4u, TEST_INT)
TEST_VECTOR(uvec2, uint, 2u, TEST_UINT)
TEST_VECTOR(uvec3, uint, 3u, TEST_UINT)
TEST_VECTOR(uvec4, uint, 4u, TEST_UINT)
TEST_VECTOR_NEAR(vec2, 2u)
TEST_VECTOR_NEAR(vec3, 3u)
TEST_VECTOR_NEAR(vec4, 4u)

#define EXPECT_TRUE(condition) testEq(__FILE__, __LINE__, bool(condition), true)
#define EXPECT_EQ(value, expected) testEq(__FILE__, __LINE__, value, expected)
#define EXPECT_NEAR(value, expected, tolerance) testNear(__FILE__, __LINE__, value, expected, tolerance)
