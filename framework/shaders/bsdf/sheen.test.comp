// SPDX-License-Identifier: MIT
// If these fail, cloth makes light, or takes more of what lies under it than it sends back.
// groups: 16
#version 460
#include "base/test.glsl"
#include "bsdf/sheen.glsl"
layout(local_size_x = 64) in;

// Albedo of a white sheen by the midpoint rule, denser at the horizon.
float integrate(float cosO, float roughness) {
    float lambdaO = sheenLambda(cosO, roughness);
    const uint STEPS = 160u;
    float sineO = sqrt(1.0 - cosO * cosO), sum = 0.0;
    for (uint i = 0u; i < STEPS; ++i) {
        float u = (float(i) + 0.5) / float(STEPS), cosI = u * u, sineI = sqrt(1.0 - cosI * cosI), ring = 0.0, lambdaI = sheenLambda(cosI, roughness);
        for (uint k = 0u; k < STEPS; ++k) {
            float phi = PI * (float(k) + 0.5) / float(STEPS);
            vec3 h = normalize(vec3(sineO + sineI * cos(phi), sineI * sin(phi), cosO + cosI));
            ring += sheenValue(cosO, cosI, vec2(1.0), vec2(lambdaO, lambdaI), length(h.xy), roughness);
        }
        sum += ring * cosI * 2.0 * u;
    }
    return sum * TWO_PI / float(STEPS * STEPS);
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < 128u) {
        // The table's own points; its first column stands at 1e-3.
        uint c = i % 16u, k = i / 16u;
        float cosine = c == 0u ? 1e-3 : square(float(c) / 15.0), roughness = 0.1 + 0.9 * square(float(k) / 7.0);
        float expected = integrate(cosine, roughness);
        EXPECT_NEAR(sheenAlbedo(c == 0u ? 0.0 : cosine, roughness), expected, 0.006 + 0.005 * expected);
        return;
    }
    // Between them.
    float roughness = 0.1 + 0.9 * float(i % 32u) / 31.0, cosine = square(0.05 + 0.95 * float(i / 32u - 4u) / 27.0);
    float expected = min(1.0, integrate(cosine, roughness)), albedo = sheenAlbedo(cosine, roughness);
    EXPECT_NEAR(min(1.0, albedo), expected, cosine < 0.02 ? 0.045 : 0.03);
}
