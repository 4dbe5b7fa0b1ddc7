// SPDX-License-Identifier: MIT
// Blocks of 4x4 values in [0, 1] as BC4_UNORM has them (Khronos Data Format Specification, RGTC): two end points of 8 bits and 3 bits a texel, 64 bits in all.
// The first end point larger: 8 values from one to the other; otherwise 6, and 0 and 1.

/// What a code stands for between two end points, in 1/255.
float bc4Value(uvec2 ends, uint code) {
    vec2 e = vec2(ends) / 255.0;
    float steps = ends.x > ends.y ? 7.0 : 5.0, from = float(code) - 1.0;
    if (code < 2u) return code == 0u ? e.x : e.y;
    return ends.x <= ends.y && code >= 6u ? float(code - 6u) : ((steps - from) * e.x + from * e.y) / steps;
}

/// The value of a texel of the block: 0 to 15, row after row.
float bc4Decode(uvec2 block, uint texel) {
    uint codes = texel < 8u ? block.x >> 16 | block.y << 16 : block.y >> 8;
    return bc4Value(uvec2(block.x & 0xffu, block.x >> 8 & 0xffu), codes >> (3u * (texel & 7u)) & 7u);
}
