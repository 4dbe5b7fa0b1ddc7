// SPDX-License-Identifier: MIT
// What the shaders of the bake share: their job, the World of the objects, and writing texels.
#include "bake_job.h"
#include "impostor/texel.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer ObjectsMemory { World value; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer JobMemory { BakeJob value; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer MadeShapes { uvec4 at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer MadeWords { uint at[]; };

/// Of this dispatch. Arguments: low and high word of where it lies; level.
BakeJob job() { return JobMemory(packUint2x32(uvec2(argument(0), argument(1)))).value; }
World objects() { return ObjectsMemory(job().objects).value; }

/// `number`: of its material among the mesh's, at the finest level.
void storeTexel(BakeJob work, uint level, uint view, uvec2 texel, ImpostorTexel t, uint number) {
    ImpostorRecord object = work.texels.objects.at[work.mesh];
    uint i = texelIndex(work.texels, level, view, texel);
    MadeShapes(object.shapes).at[i] = packShape(t);
    MadeWords(object.uvs).at[i] = packUv(t.uv);
    if (level == 0u) MadeWords(object.materials).at[i] = number;
    else MadeWords(object.counts).at[i - texelIndex(work.texels, 1u, 0u, uvec2(0u))] = t.counts;
}
