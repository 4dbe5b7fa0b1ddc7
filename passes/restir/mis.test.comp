// SPDX-License-Identifier: MIT
// If these fail, MIS weights do not sum to 1: reuse makes or loses energy, most where shifts fail.
// groups: 256
#version 460
#include "base/random.glsl"
#include "base/test.glsl"
#include "restir/mis.glsl"
layout(local_size_x = 64) in;

const uint NEIGHBOURS = 5u;

// A target over twelve orders of magnitude, zero once in four.
float someTarget(vec2 u) { return u.x < 0.25 ? 0.0 : exp((u.y - 0.5) * 27.6); }

void main() {
    uint id = gl_GlobalInvocationID.x;
    // A sample y of the canonical domain, seen from every neighbour; weights of all techniques that could have made it.
    uvec2 seed = uvec2(id, 77);
    float canonical = 1.0 + floor(random1(seed, 0u, 0u) * 21.0), pHat = someTarget(random2(seed, 0u, 1u));
    uint count = uint(random1(seed, 0u, 2u) * float(NEIGHBOURS + 1u));  // 0..5
    float c[NEIGHBOURS], pHatFrom[NEIGHBOURS], S = 0.0, all = canonical * pHat;
    for (uint i = 0u; i < count; ++i) {
        vec3 u = random3(seed, i + 1u, 0u);
        c[i] = u.x < 0.2 ? 0.0 : floor(u.x * 80.0) * 0.25;
        pHatFrom[i] = someTarget(u.yz);
        S += c[i];
        all += c[i] * pHatFrom[i];
    }
    float balance = balanceMis(canonical * pHat, all - canonical * pHat);
    PairwiseMis plain = pairwiseMis(canonical, S), defensive = defensivePairwiseMis(canonical, S);
    float plainSum = plain.start, defensiveSum = defensive.start, plainCanonical = plain.start, defensiveCanonical = defensive.start;
    for (uint i = 0u; i < count; ++i) {
        float others = canonical * pHat;
        for (uint j = 0u; j < count; ++j)
            if (j != i) others += c[j] * pHatFrom[j];
        float mine = balanceMis(c[i] * pHatFrom[i], others);
        balance += mine;
        float term = canonicalMis(plain, c[i], pHat, pHatFrom[i]), m = neighbourMis(plain, c[i], pHat, pHatFrom[i]);
        plainCanonical += term;
        plainSum += term + m;
        EXPECT_TRUE(m >= 0.0 && m <= 1.0 && term >= 0.0);
        if (count == 1u && all > 0.0) EXPECT_NEAR(m, mine, 1e-6);  // of one neighbour, pairwise is the balance heuristic
        term = canonicalMis(defensive, c[i], pHat, pHatFrom[i]);
        m = neighbourMis(defensive, c[i], pHat, pHatFrom[i]);
        defensiveCanonical += term;
        defensiveSum += term + m;
        EXPECT_TRUE(m >= 0.0 && m <= 1.0 && term >= 0.0);
        if (pHatFrom[i] == 0.0) EXPECT_EQ(m, 0.0);  // no preimage, no weight
    }
    if (all > 0.0) EXPECT_NEAR(balance, 1.0, 1e-5);
    EXPECT_NEAR(plainSum, 1.0, 1e-5);
    EXPECT_NEAR(defensiveSum, 1.0, 1e-5);
    EXPECT_TRUE(defensiveCanonical >= canonical / (canonical + S) - 1e-6);
    if (S == 0.0) EXPECT_EQ(vec2(plainCanonical, defensiveCanonical), vec2(1.0));
    // Nobody has tried to make a canonical sample: neighbours share what they can make, and nothing divides by zero.
    plain = pairwiseMis(0.0, S);
    defensive = defensivePairwiseMis(0.0, S);
    for (uint i = 0u; i < count; ++i) {
        float share = c[i] > 0.0 && pHatFrom[i] > 0.0 ? c[i] / S : 0.0;
        EXPECT_NEAR(neighbourMis(plain, c[i], pHat, pHatFrom[i]), share, 1e-6);
        EXPECT_NEAR(neighbourMis(defensive, c[i], pHat, pHatFrom[i]), share, 1e-6);
        EXPECT_NEAR(canonicalMis(plain, c[i], pHat, pHatFrom[i]), c[i] > 0.0 && pHatFrom[i] == 0.0 ? c[i] / S : 0.0, 1e-6);
    }
    EXPECT_EQ(vec2(plain.start, defensive.start), vec2(S > 0.0 ? 0.0 : 1.0));
    if (id > 0u) return;
    // Known answers: confidences 2 (canonical) and 3, 1; targets 6 and 1, 4. Plain: 3/4 * 4 / (4 + 12), 1/4 * 16 / (16 + 12).
    plain = pairwiseMis(2.0, 4.0);
    EXPECT_NEAR(neighbourMis(plain, 3.0, 6.0, 1.0), 0.1875, 1e-7);
    EXPECT_NEAR(neighbourMis(plain, 1.0, 6.0, 4.0), 1.0 / 7.0, 1e-7);
    EXPECT_NEAR(plain.start + canonicalMis(plain, 3.0, 6.0, 1.0) + canonicalMis(plain, 1.0, 6.0, 4.0), 0.5625 + 3.0 / 28.0, 1e-7);
    defensive = defensivePairwiseMis(2.0, 4.0);
    EXPECT_NEAR(neighbourMis(defensive, 3.0, 6.0, 1.0), 0.125, 1e-7);
    EXPECT_NEAR(defensive.start + canonicalMis(defensive, 3.0, 6.0, 1.0), 1.0 / 3.0 + 0.375, 1e-7);
    EXPECT_NEAR(balanceMis(2.0 * 6.0, 3.0 * 1.0 + 1.0 * 4.0), 12.0 / 19.0, 1e-7);
    // Degenerate: nothing at all, no canonical target, no preimages, numbers whose products leave the range of floats.
    EXPECT_EQ(balanceMis(0.0, 0.0), 0.0);
    EXPECT_EQ(balanceMis(0.0, 5.0), 0.0);
    EXPECT_EQ(balanceMis(5.0, 0.0), 1.0);
    EXPECT_EQ(balanceMis(3e38, 3e38), 0.5);
    EXPECT_EQ(balanceMis(1e-30, 1e30), 0.0);
    EXPECT_EQ(pairwiseMis(0.0, 0.0).start, 1.0);
    EXPECT_EQ(defensivePairwiseMis(0.0, 0.0).start, 1.0);
    EXPECT_EQ(neighbourMis(defensive, 3.0, 0.0, 1.0), 0.5);
    EXPECT_EQ(canonicalMis(defensive, 3.0, 0.0, 0.0), 0.5);
    EXPECT_EQ(canonicalMis(defensive, 3.0, 0.0, 1.0), 0.0);
    EXPECT_EQ(neighbourMis(defensive, 0.0, 1.0, 1.0), 0.0);
    EXPECT_EQ(pHatFromForward(6.0, 1.5), 4.0);
    EXPECT_EQ(pHatFromForward(6.0, 0.0), 0.0);
    EXPECT_EQ(pHatFromReverse(6.0, 1.5), 9.0);
    EXPECT_EQ(pHatFromReverse(6.0, 0.0), 0.0);
}
