// SPDX-License-Identifier: MIT
// The mesh that a dispatch bakes, alone in a World. Arguments 0 to 2: the mesh, low and high word of where the World of Frame::objects() lies.
// After pass.glsl.
#include "world/world.h"

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer ObjectsMemory { World value; };

uint bakedMesh() { return argument(0); }
World objects() { return ObjectsMemory(packUint2x32(uvec2(argument(1), argument(2)))).value; }
