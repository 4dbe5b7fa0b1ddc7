// SPDX-License-Identifier: MIT
// Maps of uniform numbers in [0,1)^2 to simple domains.
#include "base/math.glsl"

/// Point of the unit disk, uniform.
vec2 uniformDisk(vec2 u) {
    float phi = TWO_PI * u.y;
    return sqrt(u.x) * vec2(cos(phi), sin(phi));
}

/// Direction around +Z with density cos / PI.
vec3 cosineHemisphere(vec2 u) {
    vec2 p = uniformDisk(u);
    return vec3(p, sqrt(1.0 - u.x));
}

/// Weights of a triangle's second and third vertex, uniform by area.
vec2 uniformTriangle(vec2 u) {
    float s = sqrt(u.x);
    return s * vec2(1.0 - u.y, u.y);
}

/// Direction around +Z within the cone of cosine >= cosMax, uniform by solid angle.
vec3 uniformCone(vec2 u, float cosMax) {
    float z = 1.0 - u.x * (1.0 - cosMax);
    float phi = TWO_PI * u.y;
    return vec3(sqrt(max(0.0, 1.0 - z * z)) * vec2(cos(phi), sin(phi)), z);
}

float uniformConePdf(float cosMax) { return 1.0 / (TWO_PI * (1.0 - cosMax)); }
