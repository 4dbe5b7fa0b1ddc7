// SPDX-License-Identifier: MIT
// Numbers of the samples of a pixel, the same in all pixels and frames: the additive recurrence of six dimensions, which fills them evenly
// (Roberts 2018, The Unreasonable Effectiveness of Quasirandom Sequences: steps 1/g to 1/g^6 with g^7 = g + 1).
#include "base/random.glsl"

const uvec3 LATTICE_BITS = uvec3(3859688306u, 3468523226u, 3117001274u);
const uvec3 LATTICE_REST = uvec3(2801104767u, 2517223199u, 2262111973u);

uvec3 latticeBits3(uint i) { return 0x80000000u + i * LATTICE_BITS; }

/// [0,1)^3.
vec3 lattice3(uint i) {
    uvec3 bits = 0x80000000u + i * LATTICE_REST;
    return vec3(unitFloat(bits.x), unitFloat(bits.y), unitFloat(bits.z));
}
