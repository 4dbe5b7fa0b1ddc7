// SPDX-License-Identifier: MIT
// Tiles by the parameter of the pass. An invocation has a quad of 2x2 pixels, a workgroup one tile of 16x16 or the smaller ones in it. After pass.glsl.

uint tileSide() { return TILE_SIDES[params.tile]; }
uint tileIndex(uvec2 pixel) { return pixel.y / tileSide() * ((frameSize().x + tileSide() - 1) / tileSide()) + pixel.x / tileSide(); }

/// First pixel of the workgroup's 16x16, and of the invocation's quad.
uvec2 groupCorner() { return 2 * (push.base + 8 * gl_WorkGroupID.xy); }
uvec2 quadCorner() { return groupCorner() + 2 * gl_LocalInvocationID.xy; }
uvec2 inQuad(uint i) { return uvec2(i & 1, i >> 1); }
bool inImage(uvec2 p) { return all(lessThan(p, frameSize())); }
