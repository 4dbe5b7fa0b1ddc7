// SPDX-License-Identifier: MIT
// Alpha of the coarser levels of a view is stretched so that as many texels reach the limit as do of the finest: means alone let thin things vanish and
// fat ones swell (Castaño 2010, Computing Alpha Mipmaps). In turns (argument 3): alphas are counted texel by texel (0), of each view and level is found which
// alpha as many reach (1), and texels are stretched (2).
#version 460
#include "pass.glsl"
#include "made_texel.glsl"

const uint BINS = 256u;  // alphas that a texel can have
const uint LIMIT = uint(ALPHA_LIMIT * 255.0 + 0.5);

uint levelOf(Atlases made, uint index) {
    uint level = 0u;
    while (level + 1u < made.levels && atlasIndex(made, level + 1u, 0u, uvec2(0u)) <= index) ++level;
    return level;
}

/// Texels of a view's level with at least that alpha.
uint countOver(uint group, uint alpha) {
    uint count = 0u;
    for (; alpha < BINS; ++alpha) count += counts(group * BINS + alpha);
    return count;
}

/// The greatest alpha that the share of texels reaches that reaches the limit at the finest level.
uint limitOf(Atlases made, uint group) {
    uint level = group % made.levels, wanted = countOver(group - level, LIMIT), count = 0u, alpha = BINS;
    do count += counts(group * BINS + --alpha) << (2u * level);
    while (alpha > 1u && count < wanted);
    return alpha;
}

void main() {
    if (skip()) return;
    Atlases made = atlases();
    AtlasRecord object = made.objects.at[bakedMesh()];
    if (argument(3) == 1u) {
        storeLimits(uint(pixel().x), limitOf(made, uint(pixel().x)));
        return;
    }
    uint i = uint(pixel().y) * push.extent.x + uint(pixel().x);
    if (i >= atlasIndex(made, made.levels, 0u, uvec2(0u))) return;
    uint level = levelOf(made, i), n = made.resolution >> level, view = (i - atlasIndex(made, level, 0u, uvec2(0u))) / (n * n);
    uint group = view * made.levels + level, shade = AtlasWords(object.shades).at[i].x, alpha = shade >> 24;
    if (argument(3) == 0u) {
        addCounts(group * BINS + alpha, 1u);
    } else if (level > 0u) {
        uint limit = limits(group), stretched = min(255u, (alpha * LIMIT + limit / 2u) / limit);
        MadeWords(object.shades).at[i].x = (shade & 0xffffffu) | stretched << 24;
    }
}
