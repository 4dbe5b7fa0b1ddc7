// SPDX-License-Identifier: MIT
// From a material and its textures to the lobes at a point.
#include "bsdf/bsdf.glsl"
#include "bsdf/normal_spread.glsl"
#include "texture/material_map.glsl"
#include "world/scene_facts.glsl"
#include "surface/surface.glsl"

/// What the maps of a material with layers make of their factors.
struct LayerValues {
    float specular;
    vec3 specularColor, sheen;
    float sheenRoughness;
    vec3 anisotropy;  // direction in the tangent frame and strength
    float coat, coatRoughness;
    vec3 coatNormal;  // in the tangent frame, on the front side
};

LayerValues layerFactors(World w, uint layers) {
    return LayerValues(w.layers.at[layers].specular, w.layers.at[layers].specularColor, w.layers.at[layers].sheenColor,
                       w.layers.at[layers].sheenRoughness, vec3(w.layers.at[layers].anisotropyDirection, w.layers.at[layers].anisotropy),
                       w.layers.at[layers].coat, w.layers.at[layers].coatRoughness, vec3(0.0, 0.0, 1.0));
}

void applyLayerMap(inout LayerValues v, uint map, vec4 value, float coatNormalScale) {
    if (map == LAYER_SPECULAR) v.specular *= value.a;
    if (map == LAYER_SPECULAR_COLOR) v.specularColor *= value.rgb;
    if (map == LAYER_SHEEN_COLOR) v.sheen *= value.rgb;
    if (map == LAYER_SHEEN_ROUGHNESS) v.sheenRoughness *= value.a;
    if (map == LAYER_ANISOTROPY) {
        vec2 d = value.rg * 2.0 - 1.0, turned = v.anisotropy.x * d + v.anisotropy.y * vec2(-d.y, d.x);
        v.anisotropy = vec3(turned, v.anisotropy.z * value.b);
    }
    if (map == LAYER_COAT) v.coat *= value.r;
    if (map == LAYER_COAT_ROUGHNESS) v.coatRoughness *= value.g;
    if (map == LAYER_COAT_NORMAL) v.coatNormal = vec3((value.xy * 2.0 - 1.0) * coatNormalScale, value.z * 2.0 - 1.0);
}

/// The layers' part of the BSDF.
void applyLayers(inout Bsdf b, Surface s, LayerValues v) {
    float specular = clamp(v.specular, 0.0, 1.0);
    b.specular = specular;
    b.specularShift = specularShiftOf(b.eta, specular, max(v.specularColor, 0.0));
    b.sheen = clamp(v.sheen, 0.0, 1.0);
    b.sheenRoughness = clamp(v.sheenRoughness, SHEEN_ROUGHNESS_MIN, 1.0);
    b.coat = clamp(v.coat, 0.0, 1.0);
    b.coatAlpha = square(clamp(v.coatRoughness, 0.0, 1.0));
    mat3 frame = s.frame;
    vec3 coatNormal = safeNormalize(frame * v.coatNormal, frame[2]);
    b.coatNormal = bendNormal(s.frontFace ? coatNormal : -coatNormal, s.normal, s.view);
    float strength = clamp(v.anisotropy.z, 0.0, 1.0);
    if (strength > 0.0) {
        // KHR_materials_anisotropy: the lobe is drawn out along the direction, towards width 1.
        vec3 along = frame * vec3(v.anisotropy.xy, 0.0);
        b.tangent = safeNormalize(along - dot(along, b.normal) * b.normal, basisAround(b.normal)[0]);
        b.alpha = max(b.alpha, ALPHA_DELTA);
        b.along = mix(b.alpha, 1.0, strength * strength);
    }
}

/// Reads the material at s. Back faces scatter like front faces; on a solid's back face the viewer is inside.
Bsdf bsdfAt(World w, Surface s) {
    uint m = s.material, flags = w.materials.at[m].flags;
    bool ofTexel = isTexel(s.primitive);
    uvec3 corners = ofTexel ? uvec3(0u) : cornersOf(w, s.primitive);
    vec4 base = w.materials.at[m].baseColor;
    if (!ofTexel) base *= vertexColorOn(w, m, corners, s.barycentrics);
    float roughness = w.materials.at[m].roughness, metallic = w.materials.at[m].metallic, transmission = w.materials.at[m].transmission;
    uint layers = SCENE_LAYERS != 0 ? w.materials.at[m].layers : NONE;
    LayerValues values;
    if (layers != NONE) values = layerFactors(w, layers);
    // One reading of textures in a loop compiles in half the time of three. What a map without texture loads is its first word.
    for (uint map = 0u; map < (layers == NONE ? 3u : 3u + LAYER_MAPS); ++map) {
        uint id;
        if (map >= 3u) id = w.layers.at[layers].maps[map - 3u].texture;
        else if (map == 0u) id = w.materials.at[m].baseColorMap.texture;
        else if (map == 1u) id = w.materials.at[m].metallicRoughnessMap.texture;
        else id = w.materials.at[m].transmissionMap.texture;
        if (id == NONE) continue;
        TextureSlotRecord slot;
        if (map >= 3u) slot = w.layers.at[layers].maps[map - 3u];
        else if (map == 0u) slot = w.materials.at[m].baseColorMap;
        else if (map == 1u) slot = w.materials.at[m].metallicRoughnessMap;
        else slot = w.materials.at[m].transmissionMap;
        vec2 uv = slot.uvSet != 0u && !ofTexel ? uvOn(w, corners, s.barycentrics, slot.uvSet) : s.uv;
        vec4 value = readMap(w, slot, uv, ofTexel ? mapLevel(w, slot, s.density) : 0.0);
        if (map >= 3u) {
            applyLayerMap(values, map - 3u, value, w.layers.at[layers].coatNormalScale);
        } else if (map == 0u) {
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

    Bsdf b = plainBsdf(s.shadingNormal, s.normal, clamp(base.rgb, 0.0, 1.0), clamp(metallic, 0.0, 1.0), clamp(transmission, 0.0, 1.0),
                       square(clamp(roughness, 0.0, 1.0)), solid && !s.frontFace ? 1.0 / ior : ior,
                       (flags & MATERIAL_BLEND) != 0u ? clamp(base.a, 0.0, 1.0) : 1.0, solid);
    // Unlit models are made for viewers that leave out back faces: one looks into their rooms through the walls.
    if ((flags & (MATERIAL_UNLIT | MATERIAL_DOUBLE_SIDED)) == MATERIAL_UNLIT && !s.frontFace) b.coverage = 0.0;
    if (layers != NONE) applyLayers(b, s, values);
    if (ofTexel && s.normalLength < 1.0) {
        b.alpha = spreadWidth(b.alpha, s.normalLength);
        b.along = spreadWidth(b.along, s.normalLength);
        b.coatAlpha = spreadWidth(b.coatAlpha, s.normalLength);
    }
    return b;
}

/// Share of light that is left of a path's segment which ends at s after `distance` (KHR_materials_volume, Beer and Lambert): 1 but
/// inside a solid, that is where s is a solid's back face.
vec3 segmentTransmittance(World w, Surface s, float distance) {
    if (s.frontFace || (w.materials.at[s.material].flags & MATERIAL_SOLID) == 0u) return vec3(1.0);
    return exp(-distance * w.materials.at[s.material].attenuation);
}
