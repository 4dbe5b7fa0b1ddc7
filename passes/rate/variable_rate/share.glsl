// SPDX-License-Identifier: MIT
// The share of a tile's pixels that is to be traced. After pass.glsl.
#include "rate/block.glsl"

const float LEAST_NEED = 1.0 / 16.0;  // of a tile, when a budget is shared out: none is left with nothing

uint coarsestStep() { return params.coarsest == coarsest_4x4 && params.tile != tile_2x2 ? 3 : 2; }  // of SHARES
float budgetShare(float need, float balance) { return clamp(balance * max(need, LEAST_NEED), SHARES[coarsestStep()], 1.0); }
