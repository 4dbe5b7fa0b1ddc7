// SPDX-License-Identifier: MIT
// Alpha of the coarser levels of a view is stretched so that as many texels reach the limit as do of the finest: means alone let thin things vanish and
// fat ones swell (Castaño 2010, Computing Alpha Mipmaps). One invocation a view.
#version 460
#include "pass.glsl"
#include "made_texel.glsl"

uint alphaByte(uint shade) { return shade >> 24; }

/// Share of a view's texels whose alpha, in 255ths, is at least `least`.
float shareOver(Atlases made, AtlasRecord object, uint level, uint view, uint least) {
    uint n = made.resolution >> level, first = atlasIndex(made, level, view, uvec2(0u)), count = 0u;
    for (uint i = 0u; i < n * n; ++i) count += alphaByte(AtlasWords(object.shades).at[first + i].x) >= least ? 1u : 0u;
    return float(count) / float(n * n);
}

void main() {
    if (skip()) return;
    Atlases made = atlases();
    AtlasRecord object = made.objects.at[bakedMesh()];
    uint view = uint(pixel().x);
    const uint limit = uint(ALPHA_LIMIT * 255.0 + 0.5);
    float wanted = shareOver(made, object, 0u, view, limit);
    for (uint level = 1u; level < made.levels; ++level) {
        uint low = 1u, high = 255u;  // the greatest alpha that enough texels reach
        while (low < high) {
            uint middle = (low + high + 1u) / 2u;
            if (shareOver(made, object, level, view, middle) >= wanted) low = middle;
            else high = middle - 1u;
        }
        uint n = made.resolution >> level, first = atlasIndex(made, level, view, uvec2(0u));
        for (uint i = 0u; i < n * n; ++i) {
            uint shade = AtlasWords(object.shades).at[first + i].x;
            uint alpha = min(255u, (alphaByte(shade) * limit + low / 2u) / low);
            MadeWords(object.shades).at[first + i].x = (shade & 0xffffffu) | alpha << 24;
        }
    }
}
