// SPDX-License-Identifier: MIT
// Coverage of a surface. MASK is deterministic visibility, decided where rays meet triangles; BLEND is a lobe of the BSDF.
#include "texture/material_map.glsl"
#include "world/scene_facts.glsl"

/// Alpha of the base colour: factor, texture and vertex colour.
float alphaOn(World w, uint material, uvec3 corners, vec2 barycentrics) {
    float alpha = w.materials.at[material].baseColor.a * vertexColorOn(w, material, corners, barycentrics).a;
    if (w.materials.at[material].baseColorMap.texture != NONE) {
        vec2 uv = uvOn(w, corners, barycentrics, 0u);
        alpha *= readMap(w, w.materials.at[material].baseColorMap, uv, corners, barycentrics).a;
    }
    return alpha;
}

/// Whether a ray that meets the triangle there hits it. Only MASK materials let rays through.
bool alphaAccepts(World w, uint primitive, vec2 barycentrics) {
    if (SCENE_MASKS == 0) return true;
    uint material = w.primitives.at[primitive].material;
    if ((w.materials.at[material].flags & MATERIAL_MASK) == 0u) return true;
    return alphaOn(w, material, cornersOf(w, primitive), barycentrics) >= w.materials.at[material].alphaCutoff;
}
