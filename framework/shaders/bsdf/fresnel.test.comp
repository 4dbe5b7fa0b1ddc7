// SPDX-License-Identifier: MIT
// If these fail, glass and metal reflect too much or too little.
// groups: 4
#version 460
#include "base/random.glsl"
#include "base/test.glsl"
#include "bsdf/fresnel.glsl"
layout(local_size_x = 64) in;

void main() {
    uint id = gl_GlobalInvocationID.x;
    vec2 u = random2(uvec2(id, 0), 0u, 0u);
    float eta = 1.0 + 2.0 * u.x, cosine = u.y;
    // Both ways through the interface reflect alike.
    float inside = sqrt(1.0 - (1.0 - cosine * cosine) / (eta * eta));
    EXPECT_NEAR(fresnelDielectric(inside, 1.0 / eta), fresnelDielectric(cosine, eta), 2e-4);
    // Independent form: Fresnel's two polarisations.
    float s = (cosine - eta * inside) / (cosine + eta * inside), p = (eta * cosine - inside) / (eta * cosine + inside);
    EXPECT_NEAR(fresnelDielectric(cosine, eta), 0.5 * (s * s + p * p), 2e-6);
    EXPECT_NEAR(fresnelDielectricMean(1.0 / eta), 1.0 - (1.0 - fresnelDielectricMean(eta)) / (eta * eta), 1e-6);
    // The mean by quadrature; the cosine is a square to resolve grazing angles.
    float mean = 0.0;
    for (int i = 0; i < 512; ++i) {
        float t = (float(i) + 0.5) / 512.0;
        mean += 4.0 * t * t * t * fresnelDielectric(t * t, eta) / 512.0;
    }
    EXPECT_NEAR(fresnelDielectricMean(eta), mean, 1.2e-3);
    if (id > 0u) return;
    EXPECT_NEAR(fresnelDielectric(1.0, 1.5), 0.04, 1e-7);
    EXPECT_NEAR(fresnelDielectric(0.0, 1.5), 1.0, 1e-6);
    EXPECT_NEAR(fresnelDielectric(0.0, 1.0), 0.0, 1e-6);
    EXPECT_NEAR(fresnelDielectric(0.3, 1.0), 0.0, 1e-6);
    EXPECT_NEAR(fresnelDielectric(0.55470020, 1.5), 0.07396450, 1e-6);  // Brewster's angle: half of ((n^2 - 1) / (n^2 + 1))^2
    EXPECT_EQ(fresnelDielectric(0.7, 1.0 / 1.5), 1.0);                  // beyond the critical angle, cosine 0.745
    EXPECT_TRUE(fresnelDielectric(0.75, 1.0 / 1.5) < 1.0);
    EXPECT_EQ(fresnelDielectricMean(1.0), 0.0);
    EXPECT_NEAR(fresnelDielectricMean(1.5), 0.09178, 1e-3);             // Duntley's integral
    EXPECT_EQ(fresnelSchlick(vec3(0.2, 0.5, 1.0), 1.0), vec3(0.2, 0.5, 1.0));
    EXPECT_EQ(fresnelSchlick(vec3(0.2, 0.5, 1.0), 0.0), vec3(1.0));
    EXPECT_NEAR(fresnelSchlick(vec3(0.04), 0.5), vec3(0.07), 1e-6);
}
