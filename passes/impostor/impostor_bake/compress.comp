// SPDX-License-Identifier: MIT
// Blocks of a level of a mesh's views, side by side, from the texels as they were made.
#version 460
#include "pass.glsl"
#include "impostor/bc4_encode.glsl"
#include "store_texel.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 16) buffer MadeBlocks { ShapeBlock at[]; };

const uint CHANNELS = 5u;  // alpha, spread, density and the two of the normal

void main() {
    if (skip()) return;
    BakeJob work = job();
    ImpostorRecord from = work.texels.objects.at[work.mesh], to = impostors().objects.at[work.mesh];
    uint level = argument(2), n = levelResolution(work.texels, level), view = uint(pixel().x) / (n / 4u);
    uvec2 corner = 4u * uvec2(uint(pixel().x) % (n / 4u), pixel().y);
    uint block = blockIndex(work.texels, level, view, corner), coarser = texelIndex(work.texels, 1u, 0u, uvec2(0u));

    float values[CHANNELS][16];
    uint seen = 0u;
    uint depths[8], numbers[8];
    uvec2 flags = uvec2(0u);
    for (uint i = 0u; i < 16u; ++i) {
        uvec2 texel = corner + uvec2(i & 3u, i >> 2);
        uint index = texelIndex(work.texels, level, view, texel);
        ImpostorTexel t = shapeAt(work.texels, work.mesh, level, view, texel);
        bool counts = isSeen(t);
        seen |= uint(counts) << i;
        float size = length(t.normal);
        vec2 normal = 0.5 + 0.5 * hemiOctahedral(t.normal / max(size, 1e-30));
        values[0][i] = counts ? t.alpha : 0.0;
        values[1][i] = sqrt(clamp(1.0 - size, 0.0, 1.0));
        values[2][i] = float(packDensity(t.density)) / 255.0;
        values[3][i] = normal.x;
        values[4][i] = normal.y;
        flags[i >> 3] |= t.flags << (4u * (i & 7u));
        uint depth = uint((counts ? t.depth : 1.0) * 65535.0 + 0.5), number = 0xffffu;
        MadeWords(to.uvs).at[index] = MadeWords(from.uvs).at[index];
        if (level > 0u) MadeWords(to.counts).at[index - coarser] = counts ? MadeWords(from.counts).at[index - coarser] : 0u;
        else if (counts) number = MadeWords(from.materials).at[index] & 0xffffu;
        depths[i >> 1] = (i & 1u) == 0u ? depth : depths[i >> 1] | depth << 16;
        numbers[i >> 1] = (i & 1u) == 0u ? number : numbers[i >> 1] | number << 16;
    }

    uvec2 made[CHANNELS];
    for (uint c = 0u; c < CHANNELS; ++c) made[c] = bc4Encode(values[c], c == 0u ? 0xffffu : seen, c == 0u || c == 2u);
    MadeBlocks(to.shapes).at[block] = ShapeBlock(uvec2[2](made[3], made[4]), made[0], made[1], made[2], flags, depths);
    if (level > 0u) return;
    for (uint pair = 0u; pair < 8u; ++pair)
        MadeWords(to.materials).at[texelIndex(work.texels, level, view, corner + uvec2(2u * (pair & 1u), pair >> 1)) >> 1] = numbers[pair];
}
