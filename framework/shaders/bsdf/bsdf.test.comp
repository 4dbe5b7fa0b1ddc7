// SPDX-License-Identifier: MIT
// If these fail, surfaces make or lose light, or samples are not distributed as their densities say: every image is biased.
// groups: 75
// passes: 2
#version 460
#include "base/random.glsl"
#include "base/test.glsl"
#include "bsdf/bsdf.glsl"
layout(local_size_x = 64) in;

// A group is one material seen from one of three angles.
const uint MATERIALS = 25u, BINS = 16u, FINE = 24u, SAMPLES = 2048u;

// Scratch of a group: bins of expected density, counted samples, then sums over the group's lanes.
const uint EXPECTED = 0u, COUNTED = 256u, SUMS = 512u, STRIDE = 512u + 64u * 8u;
const uint ALBEDO = 0u, SAMPLED = 1u, SQUARED = 2u, LOBE_SAMPLED = 3u, DELTA = 4u, DELTA_COUNT = 5u, MISSED = 6u, BINNED = 7u;

const vec3 NORMAL = vec3(0.36, 0.48, 0.8);

mat3 testFrame() { return basisAround(NORMAL); }

// Materials from 15 on, from a white dielectric of alpha 0.25 and index 1.5.
void addLayers(inout Bsdf b, uint i) {
    vec3 askew = normalize(NORMAL + 0.3 * testFrame()[0]);
    bool everything = i == 21u || i == 22u || i == 23u;
    if (i == 15u || i == 20u) b.base = vec3(0.0);                                    // white sheen alone, of two roughnesses
    if (i == 15u || i == 20u) b.eta = 1.0;
    if (i == 15u || i == 20u || everything) b.sheen = i < 21u ? vec3(1.0) : vec3(0.9, 0.4, 0.2);
    b.sheenRoughness = i == 20u ? 0.2 : 0.5;
    if (i == 16u || i == 24u || everything) {                                        // lacquer; 24: a delta lobe over a mirror
        b.coat = everything ? 0.8 : 1.0;
        b.coatAlpha = i == 24u ? 0.0 : 0.1;
    }
    if (everything) b.coatNormal = askew;
    if (i == 16u) b.metallic = 1.0;
    if (i == 24u) b.metallic = 1.0;
    if (i == 24u) b.alpha = b.along = 0.0;
    if (i == 17u || everything) {                                                    // brushed metal, F = 1
        if (i == 17u) b.metallic = 1.0;
        b.tangent = testFrame()[0];
        b.alpha = 0.1;
        b.along = 0.6;
    }
    if (i == 18u || everything) {                                                    // a dielectric's reflection alone, tinted
        if (i == 18u) b.base = vec3(0.0);
        b.specular = 0.5;
        b.specularShift = specularShiftOf(b.eta, b.specular, vec3(8.0, 8.0, 8.0));
    }
    if (i == 19u) b.specularShift = specularShiftOf(b.eta, 1.0, vec3(1.0, 20.0, 0.0)); // white diffuse under a tinted layer
    if (everything) b.transmission = 0.4;
    if (i == 21u) b.coverage = 0.8;
    if (everything) b.metallic = 0.2;
    if (i >= 22u) b.solid = true;
    if (i == 23u) b.eta = 1.0 / 1.5;
    if (i == 24u) b.solid = false;
}

Bsdf material(uint i) {
    Bsdf b = plainBsdf(NORMAL, NORMAL, vec3(1.0), 0.0, 0.0, 0.25, 1.5, 1.0, false);
    if (i == 0u) b = plainBsdf(NORMAL, NORMAL, vec3(0.8), 0.0, 0.0, 1.0, 1.0, 1.0, false);                                // Lambert
    if (i == 1u) b.base = vec3(0.6, 0.3, 0.1);                                                                       // plastic
    if (i == 2u) b = plainBsdf(NORMAL, NORMAL, vec3(1.0, 0.8, 0.3), 1.0, 0.0, 0.3, 1.5, 1.0, false);                      // gold
    if (i == 3u) b = plainBsdf(NORMAL, NORMAL, vec3(1.0), 1.0, 0.0, 1.0, 1.5, 1.0, false);                                // F = 1, alpha 1
    if (i == 4u) b = plainBsdf(NORMAL, NORMAL, vec3(1.0), 0.0, 1.0, 0.2, 1.5, 1.0, false);                                // rough pane
    if (i == 5u) b = plainBsdf(NORMAL, NORMAL, vec3(1.0), 0.0, 1.0, 0.2, 1.5, 1.0, true);                                 // into rough glass
    if (i == 6u) b = plainBsdf(NORMAL, NORMAL, vec3(1.0), 0.0, 1.0, 0.3, 1.0 / 1.5, 1.0, true);                           // out of rough glass
    if (i == 7u) b = plainBsdf(NORMAL, NORMAL, vec3(0.9, 0.5, 0.7), 0.3, 0.4, 0.15, 1.4, 0.7, false);                     // all lobes
    if (i == 8u) b = plainBsdf(NORMAL, NORMAL, vec3(0.9, 0.5, 0.7), 0.2, 0.6, 0.4, 1.33, 1.0, true);
    if (i == 9u) b = plainBsdf(NORMAL, normalize(vec3(0.36, 0.68, 0.6)), vec3(0.6), 0.2, 0.5, 0.3, 1.5, 1.0, false);      // normals differ
    if (i == 10u) b = plainBsdf(NORMAL, NORMAL, vec3(1.0), 0.0, 1.0, 0.0, 1.5, 1.0, true);                                // clear glass
    if (i == 11u) b = plainBsdf(NORMAL, NORMAL, vec3(1.0), 0.0, 0.0, 0.0, 1.5, 1.0, false);                               // clear coat on white
    if (i == 12u) b = plainBsdf(NORMAL, NORMAL, vec3(1.0), 0.0, 1.0, 0.0, 1.5, 0.4, false);                               // clear pane, 40 %
    if (i == 13u) b = plainBsdf(NORMAL, NORMAL, vec3(1.0), 1.0, 0.0, 0.1, 1.5, 1.0, false);                               // F = 1, glossy
    if (i == 14u) b = plainBsdf(NORMAL, NORMAL, vec3(0.0), 0.0, 0.0, 0.3, 1.0, 1.0, false);                               // black
    if (i >= 15u) addLayers(b, i);
    return b;
}

// Albedo at the cosines 0.95, 0.5, 0.12 where it is known apart from this code (quadrature in double precision over half vectors, with
// Fresnel's formulas by polarisation and Smith's terms by Lambda); -1: only compared with the numerical integral. Refracted radiance
// is counted times eta^2: as energy.
vec3 knownAlbedo(uint i) {
    if (i == 0u) return vec3(0.8);
    if (i == 3u) return vec3(0.31683, 0.45069, 0.73197);
    if (i == 4u) return vec3(0.94477, 0.89523, 0.88020);  // what is not reflected passes: as for F = 1
    if (i == 5u) return vec3(0.03871 + 0.95559, 0.07345 + 0.89895, 0.19216 + 0.72834);
    if (i == 6u) return vec3(0.08497 + 0.80642, 0.65374 + 0.13108, 0.75347 + 0.02802);
    if (i == 10u || i == 11u || i == 12u) return vec3(1.0);
    if (i == 13u) return vec3(0.98759, 0.96921, 0.88299);
    if (i == 14u) return vec3(0.0);
    // Quadrature over directions and half vectors in double precision.
    if (i == 15u) return vec3(0.03740, 0.18785, 0.53111);
    if (i == 17u) return vec3(0.75407, 0.75511, 0.85486);
    if (i == 18u) return vec3(0.14627, 0.14871, 0.18600);
    if (i == 20u) return vec3(0.000055, 0.03329, 0.48717);
    if (i == 24u) return vec3(1.0);
    return vec3(-1.0);
}

vec3 direction(vec2 cell) {  // of [0, 1)^2, equal areas on the sphere, around an axis unlike the normal
    float z = 2.0 * cell.x - 1.0, phi = TWO_PI * cell.y;
    return vec3(sqrt(1.0 - z * z) * vec2(cos(phi), sin(phi)), z);
}

uvec2 binOf(vec3 d) {
    float phi = atan(d.y, d.x) / TWO_PI;
    return min(uvec2(vec2(0.5 * d.z + 0.5, phi - floor(phi)) * float(BINS)), BINS - 1u);
}

// As energy: refraction into a denser medium squeezes light into a smaller cone, and radiance rises.
vec3 energy(Bsdf b, vec3 wi, vec3 weight) { return b.solid && dot(wi, b.normal) < 0.0 ? weight * (b.eta * b.eta) : weight; }

void integrate(Bsdf b, vec3 wo, uint base, uint lane, inout float sums[8]) {
    for (uint bin = lane; bin < BINS * BINS; bin += 64u) {
        float density = 0.0;
        for (uint i = 0u; i < FINE * FINE; ++i) {
            vec3 wi = direction((vec2(bin % BINS, bin / BINS) + (vec2(i % FINE, i / FINE) + 0.5) / float(FINE)) / float(BINS));
            float pdf;
            vec3 f = bsdfEval(b, wo, wi, pdf);
            density += pdf;
            sums[ALBEDO] += luminance(energy(b, wi, f)) * 4.0 * PI / float(BINS * BINS * FINE * FINE);
        }
        testFloats[base + EXPECTED + bin] = density * 4.0 * PI / float(BINS * BINS * FINE * FINE);
    }
}

void drawSamples(Bsdf b, vec3 wo, uint base, inout float sums[8]) {
    for (uint i = 0u; i < SAMPLES; ++i) {
        BsdfSample s = bsdfSample(b, wo, random3(uvec2(gl_GlobalInvocationID.x, i), 0u, 0u));
        float weight = luminance(energy(b, s.wi, s.weight));
        if (s.pdf == 0.0) {
            EXPECT_EQ(s.weight + s.lobeWeight, vec3(0.0));
            sums[MISSED] += 1.0;
            continue;
        }
        EXPECT_NEAR(length(s.wi), 1.0, 1e-5);
        EXPECT_EQ(s.delta, lobeDelta(b, s.lobe));
        sums[SAMPLED] += weight;
        sums[SQUARED] += weight * weight;
        sums[LOBE_SAMPLED] += luminance(energy(b, s.wi, s.lobeWeight));
        if (s.delta) {
            sums[DELTA] += weight;
            sums[DELTA_COUNT] += 1.0;
            EXPECT_NEAR(s.pdf, lobeChance(lobeProbabilities(b, wo), s.lobe), 1e-6);
            EXPECT_EQ(s.lobeWeight, s.weight);
            continue;
        }
        float pdf, lobePdf, sum = 0.0;
        vec3 f = bsdfEval(b, wo, s.wi, pdf), g = lobeEval(b, s.lobe, wo, s.wi, lobePdf);
        EXPECT_EQ(s.pdf, pdf);
        EXPECT_EQ(s.weight, f / pdf);
        EXPECT_EQ(s.lobePdf, lobePdf);
        EXPECT_EQ(s.lobeWeight, g / lobePdf);
        vec3 all = vec3(0.0);
        for (uint l = 0u; l < LOBE_COUNT; ++l) {
            all += lobeEval(b, l, wo, s.wi, lobePdf);
            sum += lobePdf;
        }
        EXPECT_NEAR(sum / pdf, 1.0, 1e-5);
        EXPECT_NEAR(all / max(maxComponent(f), 1e-20), f / max(maxComponent(f), 1e-20), 1e-5);
        uvec2 bin = binOf(s.wi);
        atomicAdd(testScratch[base + COUNTED + bin.x + bin.y * BINS], 1u);
        sums[BINNED] += 1.0;
    }
}

void check(Bsdf b, vec3 wo, uint i, uint angle, uint base) {
    float sums[8], total = 64.0 * float(SAMPLES);
    for (uint k = 0u; k < 8u; ++k) {
        sums[k] = 0.0;
        for (uint lane = 0u; lane < 64u; ++lane) sums[k] += testFloats[base + SUMS + lane * 8u + k];
    }
    // The integral of f |cos|, what samples say of it, and what is known.
    float sampled = sums[SAMPLED] / total, deviation = sqrt(max(0.0, sums[SQUARED] / total - sampled * sampled) / total);
    float albedo = sums[ALBEDO] + sums[DELTA] / total;
    EXPECT_NEAR(sampled, albedo, 4.5 * deviation + 2e-3 * albedo);
    EXPECT_NEAR(sums[LOBE_SAMPLED] / total, albedo, 9.0 * deviation + 6e-3 * albedo);  // the single lobe's weights vary more
    EXPECT_TRUE(albedo <= 1.003);
    if (knownAlbedo(i).x >= 0.0) EXPECT_NEAR(sampled, knownAlbedo(i)[angle], 4.5 * deviation + 2e-3 * albedo);

    // The share of samples per bin of directions is the integral of the density there, and what is refused is what is missing.
    float expectedAll = 0.0, chiSquare = 0.0, rest = 0.0, restCount = 0.0;
    uint used = 0u;
    for (uint bin = 0u; bin < BINS * BINS; ++bin) {
        float expected = testFloats[base + EXPECTED + bin] * total, count = float(testScratch[base + COUNTED + bin]);
        expectedAll += expected;
        if (expected < 20.0) {
            rest += expected;
            restCount += count;
            continue;
        }
        // 1 % of the expectation is allowed for the grid's own error at horizons and in narrow lobes.
        chiSquare += square(max(0.0, abs(count - expected) - 0.01 * expected)) / expected;
        ++used;
    }
    EXPECT_NEAR(sums[BINNED], expectedAll, 4.5 * sqrt(expectedAll) + 2e-3 * total);
    EXPECT_NEAR(restCount, rest, 5.0 * sqrt(rest) + 5.0);
    if (used > 3u) EXPECT_NEAR(chiSquare, 0.0, chiSquareLimit(used - 1u));
    LobeChances chance = lobeProbabilities(b, wo);
    float delta = (reflectionDelta(b) ? chance.scatter.y : 0.0) + (transmissionDelta(b) ? chance.scatter.z : 0.0) +
                  (coatDelta(b) ? chance.scatter.w : 0.0) + chance.through;
    EXPECT_NEAR(sums[DELTA_COUNT] / total, delta, 4.5 * sqrt(delta / total));
    EXPECT_EQ(bsdfAllDelta(b, chance), sums[BINNED] == 0.0);
    EXPECT_NEAR(chanceSum(chance), i == 14u ? 0.0 : 1.0, 1e-6);
}

// What goes straight on is what the delta lobes send there, each of them with its whole value.
void checkStraightOn(Bsdf b, vec3 wo, uint i) {
    vec3 sum = vec3(0.0), value;
    for (uint l = 0u; l < LOBE_COUNT; ++l) {
        if (!lobeDelta(b, l) || lobeChance(lobeProbabilities(b, wo), l) == 0.0) continue;
        vec3 wi = lobeDirection(b, l, wo, vec2(0.5), value);
        if (distance(wi, -wo) < 1e-5) sum += value;
    }
    EXPECT_NEAR(straightOn(b, wo), sum, 1e-6);
    if (i == 0u || i == 4u || i == 10u || i == 24u) EXPECT_EQ(sum, vec3(0.0));  // matt, rough, refracting, a mirror
    if (i == 7u) EXPECT_NEAR(sum, vec3(0.3), 1e-6);
    if (i == 12u) EXPECT_NEAR(sum, vec3(0.6 + 0.4 * (1.0 - fresnelDielectric(dot(NORMAL, wo), 1.5))), 1e-5);
}

void main() {
    uint group = gl_WorkGroupID.x, lane = gl_LocalInvocationID.x, i = group % MATERIALS, angle = group / MATERIALS;
    uint base = group * STRIDE;
    Bsdf b = material(i);
    float cosine = vec3(0.95, 0.5, 0.12)[angle];
    mat3 frame = basisAround(NORMAL);
    vec3 wo = frame * vec3(sqrt(1.0 - cosine * cosine) * vec2(0.6, 0.8), cosine);
    if (dot(wo, b.geometric) < 0.0) wo = 2.0 * dot(wo, NORMAL) * NORMAL - wo;  // the viewer is above the triangle
    if (testPush.pass == 1u) {
        if (lane == 0u) check(b, wo, i, angle, base);
        if (lane == 0u) checkStraightOn(b, wo, i);
        return;
    }
    float sums[8];
    for (uint k = 0u; k < 8u; ++k) sums[k] = 0.0;
    integrate(b, wo, base, lane, sums);
    drawSamples(b, wo, base, sums);
    for (uint k = 0u; k < 8u; ++k) testFloats[base + SUMS + lane * 8u + k] = sums[k];
}
