// SPDX-License-Identifier: MIT
// What a tile of 8x8 texels shows as a whole: the range of its depths and a cone around its normals.
#version 460
#include "pass.glsl"
#include "store_texel.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer MadeTiles { TileRecord at[]; };

// Normals of these may be seen from elsewhere than they say.
const uint UNCERTAIN = TEXEL_TWO_SIDED | TEXEL_BUMPED;

void main() {
    if (skip()) return;
    Impostors made = impostors();
    uint mesh = job().mesh, level = argument(2), across = tilesAcross(made, level), n = min(TILE, levelResolution(made, level));
    uint view = uint(pixel().x) / across;
    uvec2 tile = uvec2(uint(pixel().x) % across, pixel().y);
    TileRecord record = TileRecord(0u, -1.0, 1.0, 0.0);
    vec3 sum = vec3(0.0);
    bool certain = true;
    for (uint i = 0u; i < n * n; ++i) {
        ImpostorTexel t = shapeAt(made, mesh, level, view, tile * TILE + uvec2(i % n, i / n));
        if (!isSeen(t)) continue;
        record.nearest = min(record.nearest, t.depth);
        record.farthest = max(record.farthest, t.depth);
        sum += t.normal;
        certain = certain && (t.flags & UNCERTAIN) == 0u && length(t.normal) >= NORMAL_MEANS;
    }
    record.axis = packNormal(safeNormalize(sum, vec3(0.0, 0.0, 1.0)));
    if (certain) {
        record.cosine = 1.0;
        for (uint i = 0u; i < n * n; ++i) {
            ImpostorTexel t = shapeAt(made, mesh, level, view, tile * TILE + uvec2(i % n, i / n));
            if (isSeen(t)) record.cosine = min(record.cosine, dot(normalize(t.normal), unpackNormal(record.axis)));
        }
    }
    MadeTiles(made.objects.at[mesh].tiles).at[tileIndex(made, level, view, tile)] = record;
}
