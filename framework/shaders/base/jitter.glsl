// SPDX-License-Identifier: MIT
// One place inside the pixel for all pixels of a frame. Over the frames of a run the places are the additive recurrence R2 (Roberts 2018, The Unreasonable
// Effectiveness of Quasirandom Sequences), which fills the pixel evenly; over runs they are uniform, because each run moves the sequence by an
// offset of its own (Cranley and Patterson 1976, Randomization of Number Theoretic Methods for Multiple Integration). So the mean over either is that of
// the box filter.
#include "base/random.glsl"

/// [0,1)^2. The sums are taken modulo 2^32, where no frame index loses bits.
vec2 frameJitter(uint frame, uint run) {
    const uvec2 step = uvec2(3242174889u, 2447445414u);  // 2^32 / g and 2^32 / g^2, g^3 = g + 1
    uvec2 offset = pcg4d(uvec4(run, RANDOM_FILM, 0x85ebca6bu, 0xc2b2ae35u)).xy;
    uvec2 bits = offset + frame * step;
    return vec2(unitFloat(bits.x), unitFloat(bits.y));
}
