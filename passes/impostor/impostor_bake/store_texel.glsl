// SPDX-License-Identifier: MIT
// Writing texels, after pass.glsl. Argument 3 is the level.
#include "impostor/objects.glsl"
#include "impostor/texel.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 16) buffer MadeGeometry { uvec4 at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer MadeWords { uint at[]; };

void storeTexel(Impostors impostors, uint level, uint view, uvec2 texel, ImpostorTexel t) {
    ImpostorRecord object = impostors.objects.at[bakedMesh()];
    uint i = texelIndex(impostors, level, view, texel);
    MadeGeometry(object.geometry).at[i] = packGeometry(t);
    MadeWords(object.uvs).at[i] = packUv(t.uv);
    MadeWords(object.materials).at[i] = level == 0u ? t.material : t.counts;
}
