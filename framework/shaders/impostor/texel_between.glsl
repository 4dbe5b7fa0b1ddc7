// SPDX-License-Identifier: MIT
// What a texel shows off its middle: its neighbours' share in normal and texture coordinates. Without it each pixel shows a place up to 0.7 texels beside its
// own, and highlights and patterns as fine as texels are ragged.
#include "impostor/texel_plane.glsl"

/// Sums over texels of one surface, weighted by their shares of a place.
struct TexelMix {
    vec3 normal;  // of unit normals: how far they lie apart is no width of a highlight
    float size;   // of the mean normals
    float weight;
    vec2 uv;      // from the own texel's
    float uvWeight;
};

TexelMix mixOf(ImpostorTexel own, float share) {
    return TexelMix(share * safeNormalize(own.normal, vec3(0.0, 0.0, 1.0)), share * length(own.normal), share, vec2(0.0), share);
}

/// A neighbour's part in it: nothing, where it shows another surface; and none of its texture coordinates, where they are another material's or chart's.
/// `side`: of both, in diameters.
void mixIn(inout TexelMix m, ImpostorTexel own, ImpostorTexel other, float share, float side) {
    if (!isSeen(other) || ((own.flags ^ other.flags) & TEXEL_BACK) != 0u || abs(own.depth - other.depth) > SAME_LAYER * side) return;
    m.normal += share * safeNormalize(other.normal, vec3(0.0, 0.0, 1.0));
    m.size += share * length(other.normal);
    m.weight += share;
    vec2 apart = other.uv - own.uv;
    apart -= floor(apart + 0.5);
    if (own.counts != other.counts || max(abs(apart.x), abs(apart.y)) >= SAME_CHART) return;
    m.uv += share * apart;
    m.uvWeight += share;
}

/// The own texel with what was mixed of it.
ImpostorTexel mixed(ImpostorTexel own, TexelMix m) {
    own.normal = m.size / m.weight * safeNormalize(m.normal, own.normal);
    own.uv += m.uv / m.uvWeight;
    own.uv -= floor(own.uv);
    return own;
}

/// `t`: of texel x. `place`: from its middle, in half sides; beyond its border it is the border's.
ImpostorTexel texelBetween(Impostors made, uint mesh, TexelPlace x, ImpostorTexel t, vec2 place) {
    vec2 off = min(0.5 * abs(place), vec2(0.5));
    ivec2 way = ivec2(place.x < 0.0 ? -1 : 1, place.y < 0.0 ? -1 : 1);
    TexelMix m = mixOf(t, (1.0 - off.x) * (1.0 - off.y));
    for (int i = 1; i < 4; ++i) {
        bvec2 beside = bvec2((i & 1) != 0, (i & 2) != 0);
        ivec2 texel = ivec2(x.texel) + way * ivec2(beside);
        if (any(lessThan(texel, ivec2(0))) || any(greaterThanEqual(texel, ivec2(levelResolution(made, x.level))))) continue;
        vec2 share = mix(1.0 - off, off, beside);
        mixIn(m, t, texelAt(made, mesh, x.level, x.view, uvec2(texel)), share.x * share.y, 0.5 * texelSide(made, 1.0, x.level));
    }
    return mixed(t, m);
}
