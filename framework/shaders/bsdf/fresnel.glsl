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

/// Cosine-weighted mean of fresnelDielectric over the hemisphere, fitted for eta in [0.4, 3] (Kulla and Conty 2017, Revisiting
/// Physically Based Shading at Imageworks, slide 30).
float fresnelDielectricMean(float eta) {
    if (eta >= 1.0) return (eta - 1.0) / (4.08567 + 1.00071 * eta);
    return clamp(0.997118 + eta * (0.1014 + eta * (-0.965241 - 0.130607 * eta)), 0.0, 1.0);
}

/// Schlick's approximation (Schlick 1994), which glTF prescribes for metals.
vec3 fresnelSchlick(vec3 f0, float cosine) {
    float m = clamp(1.0 - cosine, 0.0, 1.0);
    float m2 = m * m;
    return f0 + (1.0 - f0) * (m2 * m2 * m);
}
