// SPDX-License-Identifier: MIT
// The GGX distribution of microfacet normals with the height-correlated Smith term, isotropic.
// Walter et al. 2007, Microfacet Models for Refraction through Rough Surfaces; Heitz 2014, Understanding the Masking-Shadowing
// Function; Dupuy and Benyoub 2023, Sampling Visible GGX Normals with Spherical Caps. Cosines are with the mean surface, positive.
#include "base/math.glsl"

/// D(h), per steradian. |n x h|^2 stands for 1 - (n.h)^2, whose rounding would drown a narrow lobe.
float ggxDistribution(vec3 n, vec3 h, float alpha) {
    vec3 across = cross(n, h);
    float along = dot(n, h) * alpha;
    float d = alpha / (dot(across, across) + along * along);
    return INV_PI * d * d;
}

/// sqrt(alpha^2 + (1 - alpha^2) cosine^2), of which both Smith terms are made: G1 = 2 c / (c + s) for c = cosine, s = this.
float ggxSlope(float cosine, float alpha) { return sqrt(alpha * alpha + (1.0 - alpha * alpha) * cosine * cosine); }

/// G2(o, i) / (4 cosO cosI).
float ggxVisibility(float cosO, float cosI, float alpha) {
    return 0.5 / max(cosI * ggxSlope(cosO, alpha) + cosO * ggxSlope(cosI, alpha), 1e-20);
}

/// Density with which ggxSampleHalf picks h for a view of cosine cosO = dot(n, o) and dot(o, h) > 0, divided by dot(o, h):
/// G1(o) D(h) / cosO. A quarter of it is the density of the mirrored direction.
float ggxVisibleDensity(float cosO, float distribution, float alpha) {
    return 2.0 * distribution / max(cosO + ggxSlope(cosO, alpha), 1e-20);
}

/// A microfacet normal visible from o, both around +Z (Dupuy and Benyoub 2023, listing 3: a spherical cap in the stretched frame).
vec3 ggxSampleHalf(vec3 o, float alpha, vec2 u) {
    vec3 stretched = safeNormalize(vec3(alpha * o.xy, o.z), vec3(0.0, 0.0, 1.0));
    float phi = TWO_PI * u.x;
    float z = (1.0 - u.y) * (1.0 + stretched.z) - stretched.z;
    float r = sqrt(clamp(1.0 - z * z, 0.0, 1.0));
    vec3 h = vec3(r * cos(phi), r * sin(phi), z) + stretched;
    return safeNormalize(vec3(alpha * h.xy, max(h.z, 0.0)), vec3(0.0, 0.0, 1.0));
}
