// SPDX-License-Identifier: MIT
// What is known of a surface that a ray has hit.
#include "base/math.glsl"

struct Surface {
    vec3 position;       // interpolated from the corners: origin + t * direction would carry the error of t off the triangle
    vec3 normal;         // of the triangle, unit, towards the viewer
    float twiceArea;     // world space, per area of barycentrics: of the triangle; of a texel, whose edges are half sides, a quarter of its area
    float rounding;      // of the position, and of where rays meet the triangle, along its normal (surface/rounding.glsl)
    vec3 shadingNormal;  // unit, towards the viewer; its mirror direction lies above the triangle
    vec2 uv;             // set 0
    vec2 barycentrics;
    uint primitive, instance, material;  // a primitive from TEXEL on: a texel of an impostor, which has texture coordinates of set 0 alone
    bool frontFace;      // the viewer sees the triangle's front
    vec3 view;           // unit, towards the viewer
    mat3 frame;          // tangent, bitangent, normal without normal map, of the front side; tangents only where the material uses them
    float density;       // of a texel: log2 of texture coordinates per side of it, which textures are read for; else DENSITY_NONE
    float normalLength;  // of a texel: of the mean of its unit normals, the shorter the more they differ; else 1
};

/// Bends the shading normal n just so far that the mirror direction of `view` is not below the surface with normal ng
/// (Keller et al. 2017, The Iray Light Transport Simulation and Rendering System, appendix A.3: the mirror direction is
/// raised along n to the horizon, and the normal set halfway between it and the view). All unit; dot(ng, view) >= 0.
vec3 bendNormal(vec3 n, vec3 ng, vec3 view) {
    vec3 mirrored = 2.0 * dot(n, view) * n - view;
    float below = dot(ng, mirrored);
    if (below >= 0.0) return n;
    vec3 raised = mirrored - n * (below / max(0.001, dot(n, ng)));
    return safeNormalize(view + safeNormalize(raised, ng), ng);
}
