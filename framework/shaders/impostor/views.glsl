// SPDX-License-Identifier: MIT
// Where the views of an impostor stand, and how their texels lie in space and in memory. No table: each is a function of its number.
#include "impostor/impostors.h"

/// From the object to the camera of a view, unit. 6: vertices of an octahedron; 12: of an icosahedron; 18: the 6 and the middles of a cube's edges, which
/// are the square faces of a rhombicuboctahedron.
vec3 viewDirection(uint views, uint view) {
    bool axes = views != 12u && view < 6u;
    uint i = views == 18u ? view - 6u : view, axis = axes ? view >> 1 : i >> 2;
    vec2 signs = axes ? vec2(0.0, (view & 1u) != 0u ? -1.0 : 1.0) : vec2((i & 1u) != 0u ? -1.0 : 1.0, (i & 2u) != 0u ? -1.0 : 1.0);
    const float golden = 1.61803398874989;
    vec3 d = normalize(vec3(0.0, signs.x, signs.y * (views == 12u ? golden : 1.0)));
    return axis == 0u ? d.zxy : axis == 1u ? d.yzx : d.xyz;
}

struct ImpostorView {
    vec3 x, y, d;  // right, up and towards the camera: orthonormal, right-handed, object space
};

/// From a unit direction. The mesh's Y is up, where it isn't where the camera looks from; there it is Z. A rule that a bake made anew follows again.
ImpostorView viewFrom(vec3 d) {
    vec3 x = normalize(cross(abs(d.y) > 0.99 ? vec3(0.0, 0.0, 1.0) : vec3(0.0, 1.0, 0.0), d));
    return ImpostorView(x, cross(d, x), d);
}

ImpostorView impostorView(uint views, uint view) { return viewFrom(viewDirection(views, view)); }

vec3 intoView(ImpostorView v, vec3 direction) { return vec3(dot(v.x, direction), dot(v.y, direction), dot(v.d, direction)); }
vec3 outOfView(ImpostorView v, vec3 direction) { return direction.x * v.x + direction.y * v.y + direction.z * v.d; }

/// Texels a side at a level.
uint levelResolution(Impostors impostors, uint level) { return impostors.resolution >> level; }

/// Half the window's side, in radii: one of the finest texels more than the sphere on each side, so that the border is empty.
float windowMargin(Impostors impostors) { return float(impostors.resolution) / float(impostors.resolution - 2u); }

/// Side of a texel, object units.
float texelSide(Impostors impostors, float radius, uint level) {
    return 2.0 * radius * windowMargin(impostors) / float(levelResolution(impostors, level));
}

/// The point at `window` in [0,1]^2 (x right, y up) and a depth: 0 on the near side of the sphere, 1 on the far side.
vec3 windowPoint(Impostors impostors, vec3 center, float radius, ImpostorView v, vec2 window, float depth) {
    vec2 place = (2.0 * window - 1.0) * windowMargin(impostors);
    return center + radius * (place.x * v.x + place.y * v.y + (1.0 - 2.0 * depth) * v.d);
}

/// Inverse of windowPoint: window and depth of a point.
vec3 windowOf(Impostors impostors, vec3 center, float radius, ImpostorView v, vec3 point) {
    vec3 p = intoView(v, point - center) / radius;
    return vec3(0.5 + 0.5 * p.xy / windowMargin(impostors), 0.5 - 0.5 * p.z);
}

/// Place of a texel in the arrays of an ImpostorRecord: level after level, in each view after view, in each row after row from the bottom.
/// Before a level lie N^2 + (N/2)^2 + ... texels of each view.
uint texelIndex(Impostors impostors, uint level, uint view, uvec2 texel) {
    uint n = levelResolution(impostors, level), before = (impostors.resolution * impostors.resolution - n * n) / 3u * 4u;
    return before * impostors.views + (view * n + texel.y) * n + texel.x;
}

/// Element of the arrays of blocks that holds a texel, and which of its 16 texels that is.
uint blockIndex(Impostors impostors, uint level, uint view, uvec2 texel) {
    uint n = levelResolution(impostors, level) / 4u;
    return texelIndex(impostors, level, 0u, uvec2(0u)) / 16u + (view * n + texel.y / 4u) * n + texel.x / 4u;
}
uint blockTexel(uvec2 texel) { return (texel.y & 3u) * 4u + (texel.x & 3u); }

/// Level of the texel that is element `index` of the arrays.
uint levelOfTexel(Impostors impostors, uint index) {
    uint level = 0u;
    while (level + 1u < impostors.levels && texelIndex(impostors, level + 1u, 0u, uvec2(0u)) <= index) ++level;
    return level;
}

/// Which texel of an impostor.
struct TexelPlace {
    uint level, view;
    uvec2 texel;  // x right, y up
};

/// Inverse of texelIndex.
TexelPlace texelPlace(Impostors impostors, uint index) {
    uint level = levelOfTexel(impostors, index), n = levelResolution(impostors, level), inLevel = index - texelIndex(impostors, level, 0u, uvec2(0u));
    return TexelPlace(level, inLevel / (n * n), uvec2(inLevel % n, inLevel / n % n));
}

const uint TILE = 8u;  // texels a side

/// Tiles a side of a view at a level: at least one, though the coarsest level has but 4x4 texels.
uint tilesAcross(Impostors impostors, uint level) { return max(1u, levelResolution(impostors, level) / TILE); }
uint tilesInView(Impostors impostors, uint level) { return tilesAcross(impostors, level) * tilesAcross(impostors, level); }

/// Place of a tile in ImpostorRecord.tiles: level after level, in each view after view, in each row after row. All levels but the coarsest have whole tiles.
uint tileIndex(Impostors impostors, uint level, uint view, uvec2 tile) {
    uint n = impostors.resolution / TILE, across = tilesAcross(impostors, level);
    uint before = level + 1u < impostors.levels ? (n * n - across * across) / 3u * 4u : (n * n - 1u) / 3u * 4u + 1u;
    return before * impostors.views + (view * across + tile.y) * across + tile.x;
}
