// SPDX-License-Identifier: MIT
// What a texel of an impostor knows of the surface, and its bits: 16 bytes of shape, 4 of texture coordinates, 4 of material. Compressed, the shape takes 5
// (ShapeBlock) and the material of the finest level 2.
//
// shape.x: normal, hemi-octahedral in the view's axes, snorm16 x 2
// shape.y: depth, float
// shape.z: length of the normal, unorm16; density in 1/8 of log2 (bits 16-23); flags (bits 24-31)
// shape.w: alpha, float
// uvs:     texture coordinates modulo 1, in 1/65536
// counts:  share of each place of the palette, in 15ths, a nibble each
#include "base/pack.glsl"
#include "impostor/bc4.glsl"
#include "texture/material_map.glsl"
#include "impostor/views.glsl"

const uint TEXEL_TWO_SIDED = 1u;  // of a material that is seen from both sides: turn the normal towards the viewer, don't drop the texel
const uint TEXEL_BACK = 2u;       // the view saw the back of a triangle; its normal was turned
const uint TEXEL_BUMPED = 4u;     // the normal lies more than 18 degrees off the triangle's: ask depths which side is seen

const float LEAST_ALPHA = 1.0 / 255.0;
const float NORMAL_MEANS = 0.3;  // length of a mean normal from which on it tells which side is seen
const float SAME_LAYER = 4.0;    // sides of a texel up to which what lies behind belongs to the same surface
const float SAME_CHART = 0.125;  // difference of texture coordinates up to which they are averaged

struct ImpostorTexel {
    vec3 normal;     // mean of the unit shading normals, in the view's axes: the more they differ the shorter it is
    float depth;     // along the view, in diameters from the near side of the sphere
    float alpha;     // share of the texel that the object covers
    float density;   // log2 of the side of a square as large as what it shows of the texture, in coordinates; or DENSITY_NONE
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

uvec4 packShape(ImpostorTexel t) {
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

/// Texture coordinates and materials are left empty.
ImpostorTexel unpackShape(uvec4 bits) {
    ImpostorTexel t = emptyTexel();
    ivec2 normal = ivec2(int(bits.x << 16) >> 16, int(bits.x) >> 16);
    t.normal = float(bits.z & 0xffffu) / 65535.0 * fromHemiOctahedral(vec2(normal) / 32767.0);
    t.depth = uintBitsToFloat(bits.y);
    t.alpha = uintBitsToFloat(bits.w);
    t.density = unpackDensity((bits.z >> 16) & 0xffu);
    t.flags = bits.z >> 24;
    return t;
}

/// The same of texel 0 to 15 of a block.
ImpostorTexel unpackShape(ShapeBlockArray blocks, uint block, uint texel) {
    ImpostorTexel t = emptyTexel();
    t.alpha = bc4Decode(blocks.at[block].alpha, texel);
    if (!isSeen(t)) return t;
    vec2 normal = 2.0 * vec2(bc4Decode(blocks.at[block].normal[0], texel), bc4Decode(blocks.at[block].normal[1], texel)) - 1.0;
    float spread = bc4Decode(blocks.at[block].spread, texel);
    t.normal = (1.0 - spread * spread) * fromHemiOctahedral(normal);
    t.depth = float((blocks.at[block].depths[texel >> 1] >> (16u * (texel & 1u))) & 0xffffu) / 65535.0;
    t.density = unpackDensity(uint(255.0 * bc4Decode(blocks.at[block].density, texel) + 0.5));
    t.flags = (blocks.at[block].flags[texel >> 3] >> (4u * (texel & 7u))) & 15u;
    return t;
}

layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer ShapeArray { uvec4 at[]; };

/// Share of a place of the palette, in 15ths.
uint countOf(uint counts, uint place) { return (counts >> (4u * place)) & 15u; }

/// The one material of a texel that isn't asked for all of them: of any 15 texels beside each other each place of the palette has as many as its shares are,
/// so that the mean is right, and always the same ones, so that nothing flickers.
uint materialOf(ImpostorRecord object, ImpostorTexel t, uvec2 texel) {
    uint turn = (7u * texel.x + 13u * texel.y) % 15u, place = 0u;
    for (uint before = countOf(t.counts, 0u); before <= turn && place + 1u < PALETTE;) before += countOf(t.counts, ++place);
    return object.palette[place];
}

/// What places and turns the texel: without texture coordinates and materials.
ImpostorTexel shapeAt(Impostors impostors, uint mesh, uint level, uint view, uvec2 texel) {
    uint64_t shapes = impostors.objects.at[mesh].shapes;
    if (impostors.compressed != 0u) return unpackShape(ShapeBlockArray(shapes), blockIndex(impostors, level, view, texel), blockTexel(texel));
    return unpackShape(ShapeArray(shapes).at[texelIndex(impostors, level, view, texel)]);
}

/// Share of the texel that the object covers.
float alphaAt(Impostors impostors, uint mesh, uint level, uint view, uvec2 texel) {
    uint64_t shapes = impostors.objects.at[mesh].shapes;
    if (impostors.compressed != 0u) return bc4Decode(ShapeBlockArray(shapes).at[blockIndex(impostors, level, view, texel)].alpha, blockTexel(texel));
    return uintBitsToFloat(ShapeArray(shapes).at[texelIndex(impostors, level, view, texel)].w);
}

/// Number among the mesh's materials that a texel of the finest level has.
uint materialNumber(Impostors impostors, ImpostorRecord object, uint index) {
    if (impostors.compressed == 0u) return UintArray(object.materials).at[index];
    uint number = (UintArray(object.materials).at[index >> 1] >> (16u * (index & 1u))) & 0xffffu;
    return number == 0xffffu ? NONE : number;
}

/// At the finest level the counts are one material's: 15 of its place.
ImpostorTexel texelAt(Impostors impostors, uint mesh, uint level, uint view, uvec2 texel) {
    ImpostorRecord object = impostors.objects.at[mesh];
    uint i = texelIndex(impostors, level, view, texel);
    ImpostorTexel t = shapeAt(impostors, mesh, level, view, texel);
    t.uv = unpackUv(UintArray(object.uvs).at[i]);
    if (level > 0u) {
        t.counts = UintArray(object.counts).at[i - texelIndex(impostors, 1u, 0u, uvec2(0u))];
        return t;
    }
    uint number = materialNumber(impostors, object, i);
    if (number == NONE) return t;
    t.material = UintArray(object.names).at[2u * number];
    t.counts = 15u << (4u * UintArray(object.names).at[2u * number + 1u]);
    return t;
}
