// SPDX-License-Identifier: MIT
// What a texel of an impostor knows of the surface, and its bits: 16 bytes of geometry, 4 of texture coordinates, 4 of material.
//
// geometry.x: normal, hemi-octahedral in the view's axes, snorm16 x 2
// geometry.y: depth, float
// geometry.z: length of the normal, unorm16; density in 1/8 of log2 (bits 16-23); flags (bits 24-31)
// geometry.w: alpha, float
// uvs:        texture coordinates modulo 1, in 1/65536
// materials:  finest level: index in World.materials; above: share of each place of the palette, in 15ths, a nibble each
#include "base/pack.glsl"
#include "texture/material_map.glsl"
#include "impostor/views.glsl"

const uint TEXEL_TWO_SIDED = 1u;  // of a material that is seen from both sides: turn the normal towards the viewer, don't drop the texel
const uint TEXEL_BACK = 2u;       // the view saw the back of a triangle; its normal was turned
const uint TEXEL_BUMPED = 4u;     // the normal lies more than 18 degrees off the triangle's: ask depths which side is seen

const float LEAST_ALPHA = 1.0 / 255.0;
const float NORMAL_MEANS = 0.3;  // length of a mean normal from which on it tells which side is seen

struct ImpostorTexel {
    vec3 normal;     // mean of the unit shading normals, in the view's axes: the more they differ the shorter it is
    float depth;     // along the view, in diameters from the near side of the sphere
    float alpha;     // share of the texel that the object covers
    float density;   // log2 of texture coordinates per side of a texel, or DENSITY_NONE
    uint flags;      // TEXEL_*
    vec2 uv;         // of set 0, modulo 1
    uint material;   // finest level: index in World.materials
    uint counts;     // shares of the palette's places in 15ths
};

/// Nothing is seen there.
ImpostorTexel emptyTexel() { return ImpostorTexel(vec3(0.0), 1.0, 0.0, DENSITY_NONE, 0u, vec2(0.0), NONE, 0u); }
bool isSeen(ImpostorTexel t) { return t.alpha >= LEAST_ALPHA; }

/// The hemisphere z >= 0 on [-1, 1]^2 and back (Cigolle et al. 2014, A Survey of Efficient Representations for Independent Unit Vectors, section 3.3).
vec2 hemiOctahedral(vec3 n) {
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + max(n.z, 0.0));
    return vec2(p.x + p.y, p.x - p.y);
}
vec3 fromHemiOctahedral(vec2 p) {
    vec2 n = 0.5 * vec2(p.x + p.y, p.x - p.y);
    return normalize(vec3(n, max(1.0 - abs(n.x) - abs(n.y), 0.0)));
}

uint packDensity(float density) { return density == DENSITY_NONE ? 0u : uint(clamp(floor(density * 8.0 + 192.5), 1.0, 255.0)); }
float unpackDensity(uint code) { return code == 0u ? DENSITY_NONE : float(code) * 0.125 - 24.0; }

uvec4 packGeometry(ImpostorTexel t) {
    float size = length(t.normal);
    ivec2 normal = ivec2(floor(hemiOctahedral(size > 0.0 ? t.normal / size : vec3(0.0, 0.0, 1.0)) * 32767.0 + 0.5));
    uint measures = uint(clamp(size, 0.0, 1.0) * 65535.0 + 0.5) | packDensity(t.density) << 16 | t.flags << 24;
    return uvec4(uint(normal.x & 0xffff) | uint(normal.y) << 16, floatBitsToUint(t.depth), measures, floatBitsToUint(t.alpha));
}

uint packUv(vec2 uv) {
    uvec2 steps = uvec2((uv - floor(uv)) * 65536.0 + 0.5) & 0xffffu;
    return steps.x | steps.y << 16;
}
vec2 unpackUv(uint bits) { return vec2(bits & 0xffffu, bits >> 16) / 65536.0; }

/// `material`: what stands in `materials`, of which the level decides what it means.
ImpostorTexel unpackTexel(uvec4 geometry, uint uv, uint material, uint level) {
    ivec2 normal = ivec2(int(geometry.x << 16) >> 16, int(geometry.x) >> 16);
    float size = float(geometry.z & 0xffffu) / 65535.0;
    return ImpostorTexel(size * fromHemiOctahedral(vec2(normal) / 32767.0), uintBitsToFloat(geometry.y), uintBitsToFloat(geometry.w),
                         unpackDensity((geometry.z >> 16) & 0xffu), geometry.z >> 24, unpackUv(uv), level == 0u ? material : NONE, level == 0u ? 0u : material);
}

layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer ImpostorGeometry { uvec4 at[]; };

/// At the finest level the counts are one material's: 15 of its place.
ImpostorTexel texelAt(Impostors impostors, uint mesh, uint level, uint view, uvec2 texel) {
    ImpostorRecord object = impostors.objects.at[mesh];
    uint i = texelIndex(impostors, level, view, texel);
    ImpostorTexel t = unpackTexel(ImpostorGeometry(object.geometry).at[i], UintArray(object.uvs).at[i], UintArray(object.materials).at[i], level);
    if (level == 0u && t.material != NONE) t.counts = 15u << (4u * UintArray(object.places).at[t.material]);
    return t;
}

/// What places and turns the texel: without texture coordinates and materials.
ImpostorTexel shapeAt(Impostors impostors, uint mesh, uint level, uint view, uvec2 texel) {
    uint i = texelIndex(impostors, level, view, texel);
    return unpackTexel(ImpostorGeometry(impostors.objects.at[mesh].geometry).at[i], 0u, NONE, level);
}
