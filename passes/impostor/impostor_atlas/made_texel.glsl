// SPDX-License-Identifier: MIT
// Writing texels, after pass.glsl.
#include "impostor/atlas_texel.glsl"
#include "impostor/objects.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 8) buffer MadeWords { uvec2 at[]; };

void storeTexel(Atlases made, uint level, uint view, uvec2 texel, AtlasTexel t) {
    AtlasRecord object = made.objects.at[bakedMesh()];
    uint i = atlasIndex(made, level, view, texel);
    MadeWords(object.shades).at[i] = packShades(t);
    if (made.isMatched != 0u) MadeWords(object.matters).at[i] = packMatters(t);
}
