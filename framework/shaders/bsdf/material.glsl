// SPDX-License-Identifier: MIT
// From a material and its textures to the lobes at a point.
#include "bsdf/bsdf.glsl"
#include "texture/material_map.glsl"
#include "world/surface.glsl"

/// Reads the material at s. Back faces scatter like front faces; on a solid's back face the viewer is inside.
Bsdf bsdfAt(World w, Surface s) {
    uint m = s.material, flags = w.materials.at[m].flags;
    uvec3 corners = cornersOf(w, s.primitive);
    vec4 base = w.materials.at[m].baseColor * vertexColorOn(w, m, corners, s.barycentrics);
    float roughness = w.materials.at[m].roughness, metallic = w.materials.at[m].metallic, transmission = w.materials.at[m].transmission;
    // One reading of textures in a loop compiles in half the time of three. What a map without texture loads is its first word.
    for (uint map = 0u; map < 3u; ++map) {
        uint id;
        if (map == 0u) id = w.materials.at[m].baseColorMap.texture;
        else if (map == 1u) id = w.materials.at[m].metallicRoughnessMap.texture;
        else id = w.materials.at[m].transmissionMap.texture;
        if (id == NONE) continue;
        TextureSlotRecord slot;
        if (map == 0u) slot = w.materials.at[m].baseColorMap;
        else if (map == 1u) slot = w.materials.at[m].metallicRoughnessMap;
        else slot = w.materials.at[m].transmissionMap;
        vec4 value = readMap(w, slot, s.uv, corners, s.barycentrics);
        if (map == 0u) {
            base *= value;
        } else if (map == 1u) {
            roughness *= value.g;
            metallic *= value.b;
        } else {
            transmission *= value.r;
        }
    }
    // KHR_materials_ior: 0 stands for a surface that reflects all light, which a very dense one comes near to.
    float ior = w.materials.at[m].ior;
    ior = ior > 0.0 ? max(ior, 1.0) : 1000.0;
    bool solid = (flags & MATERIAL_SOLID) != 0u;

    Bsdf b;
    b.normal = s.shadingNormal;
    b.geometric = s.normal;
    b.base = clamp(base.rgb, 0.0, 1.0);
    b.metallic = clamp(metallic, 0.0, 1.0);
    b.transmission = clamp(transmission, 0.0, 1.0);
    b.alpha = square(clamp(roughness, 0.0, 1.0));
    b.eta = solid && !s.frontFace ? 1.0 / ior : ior;
    b.coverage = (flags & MATERIAL_BLEND) != 0u ? clamp(base.a, 0.0, 1.0) : 1.0;
    b.solid = solid;
    return b;
}

/// Share of light that is left of a path's segment which ends at s after `distance` (KHR_materials_volume, Beer and Lambert): 1 but
/// inside a solid, that is where s is a solid's back face.
vec3 segmentTransmittance(World w, Surface s, float distance) {
    if (s.frontFace || (w.materials.at[s.material].flags & MATERIAL_SOLID) == 0u) return vec3(1.0);
    return exp(-distance * w.materials.at[s.material].attenuation);
}
