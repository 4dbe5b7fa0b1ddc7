// SPDX-License-Identifier: MIT
// Light that surfaces send out themselves.
#include "texture/alpha.glsl"
#include "surface/surface.glsl"

/// Emitted radiance at a point of a triangle, on the side it emits to. What covers only in part (BLEND, MASK) emits in part.
vec3 emissionOn(World w, uint material, uvec3 corners, vec2 barycentrics) {
    vec3 emission = w.materials.at[material].emission;
    if (w.materials.at[material].emissiveMap.texture != NONE) {
        vec2 uv = uvOn(w, corners, barycentrics, 0u);
        emission *= readMap(w, w.materials.at[material].emissiveMap, uv, corners, barycentrics).rgb;
    }
    uint flags = w.materials.at[material].flags;
    if ((flags & MATERIAL_UNLIT) != 0u) emission *= vertexColorOn(w, material, corners, barycentrics).rgb;
    if ((flags & (MATERIAL_MASK | MATERIAL_BLEND)) != 0u) {
        float alpha = alphaOn(w, material, corners, barycentrics);
        emission *= (flags & MATERIAL_BLEND) != 0u ? clamp(alpha, 0.0, 1.0) : alpha >= w.materials.at[material].alphaCutoff ? 1.0 : 0.0;
    }
    return emission;
}

/// glTF emits from front faces; double-sided materials from both.
bool emitsTo(World w, uint material, bool frontFace) {
    uint flags = w.materials.at[material].flags;
    return (flags & MATERIAL_EMISSIVE) != 0u && (frontFace || (flags & MATERIAL_DOUBLE_SIDED) != 0u);
}

/// The same of a texel of an impostor, whose coverage is its own.
vec3 emissionOfTexel(World w, Surface s) {
    vec3 emission = w.materials.at[s.material].emission;
    if (w.materials.at[s.material].emissiveMap.texture == NONE) return emission;
    return emission * readMap(w, w.materials.at[s.material].emissiveMap, s.uv, mapLevel(w, w.materials.at[s.material].emissiveMap, s.density)).rgb;
}

/// Radiance that s itself sends to the viewer.
vec3 emittedRadiance(World w, Surface s) {
    if (!emitsTo(w, s.material, s.frontFace)) return vec3(0.0);
    if (isTexel(s.primitive)) return emissionOfTexel(w, s);
    return emissionOn(w, s.material, cornersOf(w, s.primitive), s.barycentrics);
}
