// SPDX-License-Identifier: MIT
// What the shaders of the bake share: the World of the objects, and writing texels.
#include "impostor/texel.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer ObjectsMemory { World value; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer MadeGeometry { uvec4 at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer MadeWords { uint at[]; };

/// Of this dispatch. Arguments: mesh, low and high word of where the World of Frame::objects() lies, level.
uint bakedMesh() { return argument(0); }
World objects() { return ObjectsMemory(packUint2x32(uvec2(argument(1), argument(2)))).value; }

void storeTexel(Impostors impostors, uint level, uint view, uvec2 texel, ImpostorTexel t) {
    ImpostorRecord object = impostors.objects.at[bakedMesh()];
    uint i = texelIndex(impostors, level, view, texel);
    MadeGeometry(object.geometry).at[i] = packGeometry(t);
    MadeWords(object.uvs).at[i] = packUv(t.uv);
    MadeWords(object.materials).at[i] = level == 0u ? t.material : t.counts;
}
