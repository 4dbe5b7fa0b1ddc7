// SPDX-License-Identifier: MIT
// What a texel of an atlas knows of a surface, its bits, and how texels mix.
//
// shades.x:  square roots of the base colour, unorm8 x 3, which is near to how eyes tell shades apart; alpha, unorm8 (bits 24-31)
// shades.y:  normal, object space, octahedral (packNormal)
// matters.x: depth, unorm16; roughness, unorm8 (bits 16-23); metallic, unorm8 (bits 24-31)
// matters.y: emission, three mantissas of 8 bits and a common exponent (Ward 1991, Real Pixels)
#include "impostor/atlas_views.glsl"

// What an atlas without `matters` says of all surfaces.
const float UNKNOWN_ROUGHNESS = 0.7;
const float UNKNOWN_METALLIC = 0.0;
const float PLANE_DEPTH = 0.5;  // of the view's plane, through the centre

const float ALPHA_LIMIT = 0.5;  // of what is shown: beyond it a pixel shows the object and nothing else, below it nothing of it

/// All but alpha are times alpha: so texels mix by sums, and empty ones bring nothing into what is next to them.
struct AtlasTexel {
    float alpha;      // share that the object covers
    vec3 color;       // base colour, linear Rec. 709
    vec3 normal;      // shading normal, object space
    float depth;      // along the view, in diameters from the near side of the sphere
    float roughness, metallic;
    vec3 emission;
};

AtlasTexel emptyAtlasTexel() { return AtlasTexel(0.0, vec3(0.0), vec3(0.0), 0.0, 0.0, 0.0, vec3(0.0)); }

void addTexel(inout AtlasTexel sum, AtlasTexel t, float share) {
    sum.alpha += share * t.alpha;
    sum.color += share * t.color;
    sum.normal += share * t.normal;
    sum.depth += share * t.depth;
    sum.roughness += share * t.roughness;
    sum.metallic += share * t.metallic;
    sum.emission += share * t.emission;
}

/// Of the surface, no longer times alpha. Normals as long as they agree.
AtlasTexel surfaceOfTexel(AtlasTexel t) {
    AtlasTexel surface = emptyAtlasTexel();
    if (t.alpha > 0.0) addTexel(surface, t, 1.0 / t.alpha);
    surface.alpha = t.alpha;
    return surface;
}

uint packShared(vec3 radiance) {
    float most = maxComponent(radiance);
    if (!(most > 1e-30)) return 0u;
    float exponent = clamp(floor(log2(most)) + 1.0, -126.0, 126.0);
    uvec3 mantissas = uvec3(clamp(radiance * exp2(-exponent) * 256.0, 0.0, 255.0) + 0.5);
    return mantissas.x | mantissas.y << 8 | mantissas.z << 16 | uint(exponent + 128.0) << 24;
}
vec3 unpackShared(uint bits) { return vec3(bits & 0xffu, (bits >> 8) & 0xffu, (bits >> 16) & 0xffu) * exp2(float(bits >> 24) - 136.0); }

uvec2 packShades(AtlasTexel t) {
    AtlasTexel s = surfaceOfTexel(t);
    return uvec2(packUnorm4x8(vec4(sqrt(s.color), t.alpha)), packNormal(safeNormalize(s.normal, vec3(0.0, 0.0, 1.0))));
}
uvec2 packMatters(AtlasTexel t) {
    AtlasTexel s = surfaceOfTexel(t);
    return uvec2(packUnorm2x16(vec2(s.depth, 0.0)) | packUnorm4x8(vec4(0.0, 0.0, s.roughness, s.metallic)), packShared(s.emission));
}

AtlasTexel unpackAtlasTexel(uvec2 shades, uvec2 matters) {
    vec4 color = unpackUnorm4x8(shades.x), matter = unpackUnorm4x8(matters.x);
    AtlasTexel surface = AtlasTexel(1.0, color.rgb * color.rgb, unpackNormal(shades.y), unpackUnorm2x16(matters.x).x, matter.z, matter.w,
                                    unpackShared(matters.y));
    AtlasTexel t = emptyAtlasTexel();
    addTexel(t, surface, color.a);
    return t;
}

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer AtlasWords { uvec2 at[]; };

AtlasTexel atlasTexelAt(Atlases atlases, AtlasRecord object, uint level, uint view, uvec2 texel) {
    uint i = atlasIndex(atlases, level, view, texel);
    if (atlases.isMatched != 0u) return unpackAtlasTexel(AtlasWords(object.shades).at[i], AtlasWords(object.matters).at[i]);
    AtlasTexel t = unpackAtlasTexel(AtlasWords(object.shades).at[i], uvec2(0u));
    t.depth = PLANE_DEPTH * t.alpha;
    t.roughness = UNKNOWN_ROUGHNESS * t.alpha;
    t.metallic = UNKNOWN_METALLIC * t.alpha;
    return t;
}

/// What a view shows at `window` in [0,1]^2, between the four texels around. Beyond its border nothing is, so that no neighbour shines in.
AtlasTexel atlasAt(Atlases atlases, AtlasRecord object, uint level, uint view, vec2 window) {
    int n = int(atlases.resolution >> level);
    vec2 at = clamp(window, -1.0, 2.0) * float(n) - 0.5;
    ivec2 low = ivec2(floor(at));
    vec2 f = at - vec2(low);
    AtlasTexel sum = emptyAtlasTexel();
    for (uint i = 0u; i < 4u; ++i) {
        ivec2 corner = ivec2(i & 1u, i >> 1), texel = low + corner;
        if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, ivec2(n)))) continue;
        vec2 share = mix(1.0 - f, f, vec2(corner));
        addTexel(sum, atlasTexelAt(atlases, object, level, view, uvec2(texel)), share.x * share.y);
    }
    return sum;
}

/// Height of the surface over the view's plane, in radii: where nothing is seen, of what is near, as coarser levels know it. Zero far from everything.
float atlasHeight(Atlases atlases, AtlasRecord object, uint level, uint view, vec2 window) {
    for (; level < atlases.levels; ++level) {
        AtlasTexel t = atlasAt(atlases, object, level, view, window);
        if (t.alpha >= LEAST_ALPHA) return 1.0 - 2.0 * t.depth / t.alpha;
    }
    return 0.0;
}
