// SPDX-License-Identifier: MIT
// A texel of an impostor as a surface that light falls on. Needs TEXEL_SURFACES.
#include "bsdf/material.glsl"
#include "impostor/texel.glsl"
#include "light/emission.glsl"

const float FACING_LEAST = 0.02;  // cosine that normals keep to the viewer: of what leans away from it at silhouettes

/// How much an instance enlarges its mesh.
float placementScale(Placement p) { return pow(abs(placementDeterminant(p)), 1.0 / 3.0); }

/// n, or what it becomes when it is turned towards the viewer until it is seen. Both unit.
vec3 facing(vec3 n, vec3 view) { return safeNormalize(n + max(0.0, FACING_LEAST - dot(n, view)) * view, view); }

/// `side`: of the texel, world units. `front`: a front face is seen, and not one's back. Rays leave it from so far off that the coarse mesh which stands
/// for the object elsewhere doesn't hide it from itself.
Surface texelSurface(uint instance, uint material, vec3 position, vec3 normal, vec3 view, vec2 uv, float density, float side, bool front) {
    Surface s;
    s.view = view;
    s.position = position;
    s.normal = facing(normal, view);
    s.twiceArea = 2.0 * square(side);
    s.rounding = 2.0 * side;
    s.shadingNormal = bendNormal(s.normal, s.normal, view);
    s.uv = uv;
    s.barycentrics = vec2(0.0);
    s.primitive = NONE;
    s.instance = instance;
    s.material = material;
    s.frontFace = front;
    s.frame = mat3(vec3(0.0), vec3(0.0), front ? s.normal : -s.normal);
    s.density = density;
    return s;
}

/// Radiance that the texel itself sends to the viewer.
vec3 texelEmission(World w, Surface s) {
    if (!emitsTo(w, s.material, s.frontFace)) return vec3(0.0);
    vec3 emission = w.materials.at[s.material].emission;
    if (w.materials.at[s.material].emissiveMap.texture != NONE)
        emission *= readMap(w, w.materials.at[s.material].emissiveMap, s.uv, mapLevel(w, w.materials.at[s.material].emissiveMap, s.density)).rgb;
    return emission;
}

/// Mean cosine of a von Mises-Fisher lobe whose concentration is k, given 1/k: coth k - k^-1.
float meanCosine(float inverse) {
    if (inverse < 0.1) return 1.0 - inverse;  // coth k is 1 to 4e-9
    float e = exp(-2.0 / inverse);
    return inverse > 10.0 ? 1.0 / (3.0 * inverse) : (1.0 + e) / (1.0 - e) - inverse;
}

/// 1/k of the lobe with a mean of that length (Banerjee et al. 2005, Clustering on the Unit Hypersphere using von Mises-Fisher Distributions, Eq. 4.4).
float inverseConcentration(float size) {
    float squared = clamp(square(size), 1e-8, 1.0);
    return (1.0 - squared) / (sqrt(squared) * (3.0 - squared));
}

/// GGX width of a lobe whose normals differ as those within a texel do, by the length of their mean. Widths stand for lobes by 2 / alpha^2 = k, and means
/// of lobes of lobes multiply, so that one material over many normals comes out as if each had been asked (Han et al. 2007, Frequency Domain Normal
/// Map Filtering, section 4).
float spreadWidth(float alpha, float size) {
    return max(alpha, min(1.0, sqrt(2.0 * inverseConcentration(size * meanCosine(0.5 * square(alpha))))));
}
