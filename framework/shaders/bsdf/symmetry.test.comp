// SPDX-License-Identifier: MIT
// If these fail, light takes another share on its way back: reuse of paths seen from elsewhere, and any two-way method, is biased.
// groups: 64
#version 460
#include "base/random.glsl"
#include "base/sampling.glsl"
#include "base/test.glsl"
#include "bsdf/bsdf.glsl"
layout(local_size_x = 64) in;

void expectSame(vec3 a, vec3 b) {
    float size = max(maxComponent(a), 1e-2);
    EXPECT_NEAR(b / size, a / size, 1e-3);
}

void main() {
    uvec2 seed = uvec2(gl_GlobalInvocationID.x, 7u);
    vec3 mix1 = random3(seed, 0u, 0u), mix2 = random3(seed, 0u, 1u);
    vec3 n = safeNormalize(random3(seed, 0u, 3u) - 0.5, vec3(0, 0, 1));
    mat3 frame = basisAround(n);
    vec3 a = frame * cosineHemisphere(random2(seed, 0u, 4u)), c = frame * cosineHemisphere(random2(seed, 0u, 5u));
    Bsdf b = plainBsdf(n, n, random3(seed, 0u, 2u), mix1.x, mix1.y, 0.05 + 0.95 * mix1.z, 1.1 + 0.9 * mix2.x, mix2.y, mix2.z > 0.5);
    // Half of them with layers: a coat with its own normal on both sides' front, cloth, brushed, tinted.
    vec3 e = random3(seed, 0u, 6u), f = random3(seed, 0u, 7u);
    if (e.x < 0.5) {
        b.specular = e.y;
        b.specularShift = specularShiftOf(b.eta, e.y, 4.0 * f);
        b.sheen = random3(seed, 0u, 8u);
        b.sheenRoughness = max(SHEEN_ROUGHNESS_MIN, e.z);
        b.coat = f.x;
        b.coatAlpha = 0.05 + 0.95 * f.y;
        b.tangent = frame[0];
        b.along = mix(b.alpha, 1.0, f.z);
    }
    float pdf;

    // Reflection: f(a, c) = f(c, a).
    expectSame(bsdfEval(b, a, c, pdf) / dot(n, c), bsdfEval(b, c, a, pdf) / dot(n, a));

    // Transmission: f / eta^2 is the same both ways; the way back starts on the other side, where a solid's ratio of indices is inverse.
    Bsdf back = b;
    back.normal = back.geometric = back.coatNormal = -n;
    if (b.solid) back.eta = 1.0 / b.eta;
    vec3 away = -c;
    vec3 there = bsdfEval(b, a, away, pdf) / abs(dot(n, away));
    vec3 here = bsdfEval(back, away, a, pdf) / abs(dot(n, a));
    expectSame(there, b.solid ? here / (b.eta * b.eta) : here);
}
