// SPDX-License-Identifier: MIT
// Fresnel reflectance of dielectrics and metals.
#include "base/math.glsl"

/// Unpolarised reflectance of a smooth dielectric interface, exact. eta = index beyond the surface / index before it,
/// cosine >= 0 (Walter et al. 2007, eq. 22). 1 under total internal reflection, 0 where eta = 1.
float fresnelDielectric(float cosine, float eta) {
    float g2 = eta * eta - 1.0 + cosine * cosine;
    if (g2 < 0.0) return 1.0;
    float g = sqrt(g2);
    float a = (g - cosine) / max(g + cosine, 1e-20);
    float b = (cosine * (g + cosine) - 1.0) / (cosine * (g - cosine) + 1.0);
    return min(1.0, 0.5 * a * a * (1.0 + b * b));
}

/// Cosine-weighted mean of fresnelDielectric over the hemisphere. A polynomial in the amplitude (n - 1) / (n + 1), fitted for n in [1, 4]
/// to 1e-3 of what is transmitted, and 0 for n = 1; from inside, what passes is the same divided by n^2 (reciprocity).
float fresnelDielectricMean(float eta) {
    float n = max(eta, 1.0 / eta), x = (n - 1.0) / (n + 1.0);
    float outside = x * (0.551977 + x * (-0.894789 + x * (2.50807 - 1.42559 * x)));
    return eta >= 1.0 ? outside : 1.0 - (1.0 - outside) / (n * n);
}

/// Schlick's approximation (Schlick 1994), which glTF prescribes for metals.
vec3 fresnelSchlick(vec3 f0, float cosine) {
    float m = clamp(1.0 - cosine, 0.0, 1.0);
    float m2 = m * m;
    return f0 + (1.0 - f0) * (m2 * m2 * m);
}
