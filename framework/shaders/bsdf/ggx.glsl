// SPDX-License-Identifier: MIT
// The GGX distribution of microfacet normals with the height-correlated Smith term, with two widths.
// Walter et al. 2007, Microfacet Models for Refraction through Rough Surfaces; Heitz 2014, Understanding the Masking-Shadowing
// Function; Dupuy and Benyoub 2023, Sampling Visible GGX Normals with Spherical Caps. Cosines are with the mean surface, positive.
#include "base/math.glsl"

/// A rough surface: `alpha` is its width across the tangent, `along` that along it. With two equal widths the tangent means nothing.
struct Facets {
    vec3 normal, tangent;
    float alpha, along;
};

/// D(h), per steradian: 1 / (PI ax ay q^2) with q = (t.h / ax)^2 + (b.h / ay)^2 + (n.h)^2. |n x h|^2 stands for (t.h)^2 + (b.h)^2, and for
/// 1 - (n.h)^2, whose rounding would drown a narrow lobe.
float ggxDistribution(Facets f, vec3 h) {
    vec3 across = cross(f.normal, h);
    float n = dot(f.normal, h) * f.alpha, t = dot(f.tangent, h), ratio = f.alpha / f.along;
    float flat2 = t * t * ratio * ratio;
    float d = f.alpha / (n * n + max(dot(across, across) - t * t + flat2, flat2));
    return INV_PI * ratio * d * d;
}

/// sqrt((ax t.o)^2 + (ay b.o)^2 + (n.o)^2), of which both Smith terms are made: G1 = 2 c / (c + s) for c = cosine = n.o, s = this.
float ggxSlope(Facets f, vec3 o, float cosine) {
    float t = dot(f.tangent, o), a2 = f.alpha * f.alpha;
    return sqrt(max(0.0, a2 + (1.0 - a2) * cosine * cosine + (f.along * f.along - a2) * t * t));
}

/// G2(o, i) / (4 cosO cosI), given the slopes.
float ggxVisibility(float cosO, float slopeO, float cosI, float slopeI) { return 0.5 / max(cosI * slopeO + cosO * slopeI, 1e-20); }

/// Density with which ggxSampleHalf picks h for a view of cosine cosO = dot(n, o) and dot(o, h) > 0, divided by dot(o, h):
/// G1(o) D(h) / cosO. A quarter of it is the density of the mirrored direction.
float ggxVisibleDensity(float cosO, float slopeO, float distribution) { return 2.0 * distribution / max(cosO + slopeO, 1e-20); }

/// A microfacet normal visible from o, both around +Z (Dupuy and Benyoub 2023, listing 3: a spherical cap in the stretched frame). `widths`
/// are those along X and Y.
vec3 ggxSampleHalf(vec3 o, vec2 widths, vec2 u) {
    vec3 stretched = safeNormalize(vec3(widths * o.xy, o.z), vec3(0.0, 0.0, 1.0));
    float phi = TWO_PI * u.x;
    float z = (1.0 - u.y) * (1.0 + stretched.z) - stretched.z;
    float r = sqrt(clamp(1.0 - z * z, 0.0, 1.0));
    vec3 h = vec3(r * cos(phi), r * sin(phi), z) + stretched;
    return safeNormalize(vec3(widths * h.xy, max(h.z, 0.0)), vec3(0.0, 0.0, 1.0));
}
