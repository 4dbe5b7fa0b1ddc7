// SPDX-License-Identifier: MIT
// If these fail, resampling, MIS weights and Jacobians do not fit together: reuse between pixels and frames changes the image's energy.
// The same statistic has to catch planted faults, else it proves nothing.
// groups: 64 12
// passes: 2
#version 460
#include "base/math.glsl"
#include "base/random.glsl"
#include "base/test.glsl"
#include "restir/mis.glsl"
#include "restir/ris.glsl"
layout(local_size_x = 64) in;

// Pixels are unit intervals, paths are points of them, shifts are affine and fail where they leave the interval. Pixel 0 is the image:
// the integral of x^2 over [0, 1], 1/3.
struct Sample { float x, W, M; };
struct Shift { float a, b; };  // x = a z + b, from another's interval
const uint BALANCE = 0u, PAIRWISE = 1u, DEFENSIVE = 2u;
// Faults: no Jacobians; a neighbour whose shift failed leaves the sums of confidences; where no neighbour's shift leads, the canonical
// sample doesn't get that neighbour's share.
const uint SOUND = 0u, NO_JACOBIAN = 1u, FAILED_IS_ABSENT = 2u, UNCOVERED = 3u;
const uint FRAMES = 6u, NEIGHBOURS = 3u;

struct Case { uint mis, fault, neighbours; bool frames, constant; };
const Case CASES[12] = Case[](Case(BALANCE, SOUND, 0u, false, false),              // candidates of one pixel only
                              Case(BALANCE, SOUND, 1u, false, false),              // two pixels
                              Case(PAIRWISE, SOUND, 3u, false, false),             // space
                              Case(DEFENSIVE, SOUND, 3u, false, false),
                              Case(BALANCE, SOUND, 0u, true, false),               // time
                              Case(DEFENSIVE, SOUND, 1u, true, false),             // time and space: two pixels over some frames
                              Case(DEFENSIVE, SOUND, 1u, true, true),              // the same with integrand and target 1: mean W is 1
                              Case(DEFENSIVE, NO_JACOBIAN, 3u, false, false),      // the faults
                              Case(DEFENSIVE, FAILED_IS_ABSENT, 3u, false, false),
                              Case(DEFENSIVE, UNCOVERED, 3u, false, false),
                              Case(DEFENSIVE, NO_JACOBIAN, 1u, true, false),
                              Case(DEFENSIVE, FAILED_IS_ABSENT, 1u, true, false));
const uint FIRST_FAULT = 7u, LANES = 4096u, RUNS = 32u;

// From neighbours 1, 2, 3 to pixel 0. 1 loses samples at both ends, 2 reaches half of the pixel only, 3 is turned round.
const Shift SHIFTS[NEIGHBOURS] = Shift[](Shift(1.5, -0.25), Shift(0.5, 0.5), Shift(-1.25, 1.0));
const Shift ZOOM = Shift(1.1, -0.05);  // from last frame's interval to this frame's, of each pixel

Shift inverse(Shift s) { return Shift(1.0 / s.a, -s.b / s.a); }
bool apply(Shift s, float z, out float x) {
    x = s.a * z + s.b;
    return x >= 0.0 && x <= 1.0;
}

// Targets. That of pixel 0 is not its integrand, that of pixel 2 is zero in part.
float pHat(Case c, uint pixel, float x) {
    if (c.constant) return 1.0;
    return pixel == 0u ? x : pixel == 1u ? 0.1 + x : pixel == 2u ? max(0.0, x - 0.1) : square(1.0 - x) + 0.05;
}

Sample initial(Case c, uint pixel, uint count, uvec2 seed) {
    Ris r = risStart();
    float kept = 0.0;
    for (uint i = 0u; i < count; ++i) {
        vec2 u = random2(seed, i, pixel);
        if (risAdd(r, resamplingWeight(1.0 / float(count), pHat(c, pixel, u.x), 1.0, 1.0), u.y)) kept = u.x;
    }
    return Sample(kept, contributionWeight(r, pHat(c, pixel, kept)), 1.0);
}

// Resamples pixel's own sample and `count` others, shifted to it.
Sample reuse(Case c, uint mis, uint pixel, Sample own, Sample others[NEIGHBOURS], uint pixels[NEIGHBOURS], Shift shifts[NEIGHBOURS],
             uint count, uvec2 seed) {
    float y[NEIGHBOURS], jacobian[NEIGHBOURS], S = 0.0, pHatX = pHat(c, pixel, own.x);
    for (uint i = 0u; i < count; ++i) {
        bool good = apply(shifts[i], others[i].x, y[i]);
        jacobian[i] = good ? c.fault == NO_JACOBIAN ? 1.0 : abs(shifts[i].a) : 0.0;
        if (c.fault == FAILED_IS_ABSENT && !good) others[i].M = 0.0;
        S += others[i].M;
    }
    PairwiseMis pairs = pairwiseMis(own.M, S);
    if (mis == DEFENSIVE) pairs = defensivePairwiseMis(own.M, S);
    float m = mis == BALANCE ? count == 0u ? 1.0 : 0.0 : pairs.start, kept = own.x;
    Ris r = risStart();
    r.M = own.M + S;
    for (uint i = 0u; i < count; ++i) {
        float z, pHatY = pHat(c, pixel, y[i]), from = pHatFromForward(pHat(c, pixels[i], others[i].x), jacobian[i]);
        Shift back = inverse(shifts[i]);
        bool good = apply(back, own.x, z);
        float fromX = pHatFromReverse(pHat(c, pixels[i], z), good ? c.fault == NO_JACOBIAN ? 1.0 : abs(back.a) : 0.0);
        float mine, M = others[i].M;
        if (mis == BALANCE) {
            mine = balanceMis(M * from, own.M * pHatY);
            m += balanceMis(own.M * pHatX, M * fromX);
        } else {
            mine = neighbourMis(pairs, M, pHatY, from);
            if (good || c.fault != UNCOVERED) m += canonicalMis(pairs, M, pHatX, fromX);
        }
        if (risAdd(r, resamplingWeight(mine, pHatY, others[i].W, jacobian[i]), random1(seed, i, 100u))) kept = y[i];
    }
    if (risAdd(r, resamplingWeight(m, pHatX, own.W, 1.0), random1(seed, count, 100u))) kept = own.x;
    return Sample(kept, contributionWeight(r, pHat(c, pixel, kept)), r.M);
}

// One frame's reuse in space: pixel 0 takes from neighbours 1..3.
Sample space(Case c, uvec2 seed) {
    Sample own = initial(c, 0u, 2u, seed), others[NEIGHBOURS];
    uint pixels[NEIGHBOURS] = uint[](1u, 2u, 3u);
    for (uint i = 0u; i < c.neighbours; ++i) {
        others[i] = initial(c, i + 1u, i + 2u, seed);
        others[i].M = float(i + 1u);
    }
    return reuse(c, c.mis, 0u, own, others, pixels, SHIFTS, c.neighbours, seed);
}

// Pixels 0 and 1 over some frames: each takes from its own past, then from the other.
Sample time(Case c, uvec2 seed) {
    Sample history[2], now[2], others[NEIGHBOURS];
    for (uint frame = 0u; frame < FRAMES; ++frame) {
        uvec2 turn = uvec2(seed.x, seed.y * 64u + frame * 4u);
        for (uint p = 0u; p < 2u; ++p) {
            Sample own = initial(c, p, 1u, turn);
            others[0] = history[p];
            others[0].M = cappedConfidence(others[0].M, 3.0);
            uint pixels[NEIGHBOURS] = uint[](p, p, p);
            Shift shifts[NEIGHBOURS] = Shift[](ZOOM, ZOOM, ZOOM);
            now[p] = reuse(c, BALANCE, p, own, others, pixels, shifts, frame == 0u ? 0u : 1u, turn + uvec2(0, p));
        }
        for (uint p = 0u; p < 2u; ++p) {
            others[0] = now[1u - p];
            uint pixels[NEIGHBOURS] = uint[](1u - p, 0u, 0u);
            Shift shifts[NEIGHBOURS] = SHIFTS;
            if (p == 1u) shifts[0] = inverse(SHIFTS[0]);
            history[p] = c.neighbours == 0u ? now[p] : reuse(c, c.mis, p, now[p], others, pixels, shifts, 1u, turn + uvec2(0, 2u + p));
        }
    }
    return history[0];
}

void main() {
    uint lane = gl_GlobalInvocationID.x, n = gl_WorkGroupID.y, base = n * LANES * 2u;
    Case c = CASES[n];
    if (testPush.pass == 0u) {
        vec2 sums = vec2(0.0);
        for (uint run = 0u; run < RUNS; ++run) {
            uvec2 seed = uvec2(lane, n * RUNS + run);
            Sample s;
            if (c.frames) s = time(c, seed);
            else s = space(c, seed);
            float error = c.constant ? s.W - 1.0 : s.x * s.x * s.W - 1.0 / 3.0;
            sums += vec2(error, error * error);
        }
        testFloats[base + lane * 2u] = sums.x;
        testFloats[base + lane * 2u + 1u] = sums.y;
        return;
    }
    if (lane > 0u) return;
    float count = float(LANES * RUNS);
    vec2 sums = vec2(0.0);
    float alone = 0.0;
    for (uint i = 0u; i < LANES; ++i) {
        sums += vec2(testFloats[base + i * 2u], testFloats[base + i * 2u + 1u]);
        alone += testFloats[i * 2u + 1u] / count;
    }
    float variance = sums.y / count - square(sums.x / count), z = sums.x / count / sqrt(variance / count);
    if (n >= FIRST_FAULT) EXPECT_TRUE(abs(z) > 8.0);
    else EXPECT_NEAR(z, 0.0, 4.0);
    // Reuse is worth its while: less variance than the pixel's own candidates, two in space, one a frame in time (variance of x^2: 4 / 45).
    if (n > 0u && n < FIRST_FAULT && !c.constant) EXPECT_TRUE(variance < (c.frames ? 4.0 / 45.0 : alone));
}
