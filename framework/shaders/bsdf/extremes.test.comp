// SPDX-License-Identifier: MIT
// If these fail, NaN or infinity gets into images from grazing views, mirrors, black or matched materials.
// groups: 256
#version 460
#include "base/random.glsl"
#include "base/sampling.glsl"
#include "base/test.glsl"
#include "bsdf/bsdf.glsl"
layout(local_size_x = 64) in;

bool good(vec3 v) { return finite3(v) && all(greaterThanEqual(v, vec3(0.0))) && maxComponent(v) < 1e18; }
bool good(float x) { return good(vec3(x)); }

// Ends of a range as often as its inside.
float extreme(float u) { return u < 0.25 ? 0.0 : u < 0.5 ? 1.0 : 2.0 * u - 1.0; }

void main() {
    uvec2 seed = uvec2(gl_GlobalInvocationID.x, 3u);
    vec3 a = random3(seed, 0u, 0u), b = random3(seed, 0u, 1u), c = random3(seed, 0u, 2u), d = random3(seed, 0u, 3u);
    vec3 n = safeNormalize(c - 0.5, vec3(0, 0, 1));
    if (d.x < 0.1) n = d.x < 0.05 ? vec3(0, 0, -1) : vec3(0, 1, 0);
    mat3 frame = basisAround(n);
    float eta = b.x < 0.2 ? 1.0 : b.x < 0.4 ? 1.0005 : b.x < 0.6 ? 1.002 : b.x < 0.65 ? 1000.0 : 1.0 + b.x;
    if (b.y < 0.4) eta = 1.0 / eta;
    // Widths down to both sides of the delta threshold.
    float alpha = d.y < 0.2 ? 0.0 : d.y < 0.4 ? 0.00099 : d.y < 0.6 ? 0.00101 : d.y < 0.7 ? 1.0 : d.y;
    vec3 geometric = d.z < 0.5 ? n : safeNormalize(n + 0.8 * (random3(seed, 0u, 5u) - 0.5), n);
    vec3 base = vec3(extreme(a.x), extreme(a.y), extreme(a.z));
    Bsdf m = plainBsdf(n, geometric, base, extreme(b.z), extreme(c.x), alpha, eta, extreme(c.y), a.x > 0.5);

    vec3 e = random3(seed, 0u, 6u), f = random3(seed, 0u, 7u), g = random3(seed, 0u, 9u);
    if (e.x < 0.6) {
        m.specular = extreme(e.y);
        m.specularShift = specularShiftOf(eta, m.specular, f.x < 0.3 ? vec3(0.0) : 30.0 * f);
        m.sheen = e.z < 0.4 ? vec3(0.0) : vec3(extreme(f.x), extreme(f.y), extreme(f.z));
        m.sheenRoughness = max(SHEEN_ROUGHNESS_MIN, extreme(e.x / 0.6));
        m.coat = extreme(g.x);
        m.coatAlpha = g.y < 0.3 ? 0.0 : g.y < 0.5 ? 0.00101 : g.y;
        m.coatNormal = g.z < 0.5 ? n : safeNormalize(n + 0.8 * (random3(seed, 0u, 10u) - 0.5), n);
        if (e.y < 0.5) {
            m.tangent = frame[0];
            m.alpha = max(m.alpha, ALPHA_DELTA);
            m.along = mix(m.alpha, 1.0, extreme(f.y));
        }
    }
    for (uint i = 0u; i < 12u; ++i) {
        vec3 u = random3(seed, i, 8u);
        float cosine = i < 3u ? 1e-7 : i < 5u ? 1e-4 : i == 5u ? 1.0 : i == 6u ? 0.0 : u.z;
        float phi = TWO_PI * u.y;
        vec3 wo = frame * vec3(sqrt(1.0 - cosine * cosine) * vec2(cos(phi), sin(phi)), cosine);
        LobeChances chance = lobeProbabilities(m, wo);
        float sum = chanceSum(chance);
        EXPECT_TRUE(all(greaterThanEqual(vec4(chance.scatter.xyz, min(chance.scatter.w, chance.through)), vec4(0.0))) && (sum == 0.0 || abs(sum - 1.0) < 1e-5));
        for (uint k = 0u; k < 6u; ++k) {
            vec3 v = random3(seed, i, 16u + k);
            vec3 wi = k == 0u ? -wo : k == 1u ? reflect(-wo, n) : k == 2u ? wo : k == 3u ? frame * vec3(cos(phi), sin(phi), 0.0)
                    : frame * (cosineHemisphere(v.xy) * (k == 4u ? 1.0 : -1.0));
            float pdf;
            EXPECT_TRUE(good(bsdfEval(m, wo, wi, pdf)));
            EXPECT_TRUE(good(pdf));
            vec3 w = k == 0u ? vec3(0.0) : k == 1u ? vec3(16777215.0 / 16777216.0) : k == 2u ? vec3(v.x, 0.0, v.z) : v;
            BsdfSample s = bsdfSample(m, wo, w);
            EXPECT_TRUE(finite3(s.wi) && good(s.weight) && good(s.lobeWeight) && good(s.pdf) && good(s.lobePdf));
            EXPECT_TRUE(s.pdf == 0.0 || abs(length(s.wi) - 1.0) < 1e-4);
            EXPECT_TRUE(s.pdf == 0.0 || s.lobe < LOBE_COUNT);
            // A sample is on the side of its lobe by both normals.
            float side = s.lobe == LOBE_TRANSMISSION || s.lobe == LOBE_THROUGH ? -1.0 : 1.0;
            EXPECT_TRUE(s.pdf == 0.0 || s.delta || (side * dot(s.wi, s.lobe == LOBE_COAT ? m.coatNormal : n) > 0.0 && side * dot(s.wi, geometric) > 0.0));
            // LOBE_SHARE bounds a lobe's own weight: reflectances and G2 / G1 are at most 1, the diffuse lobe at most 1 / (1 - mean F), and
            // making the sum of five shares 1 costs a quarter at most. Sheen, drawn with the diffuse lobe's directions, has no such bound.
            float most = 1.25 / (LOBE_SHARE * max(1e-6, 1.0 - dielectricShare(m, fresnelDielectricMean(m.eta))));
            if (s.pdf > 0.0 && !m.solid && !(hasSheen(m) && s.lobe == LOBE_DIFFUSE)) EXPECT_TRUE(maxComponent(s.lobeWeight) <= most);
        }
    }
}
