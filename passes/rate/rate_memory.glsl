// SPDX-License-Identifier: MIT
// The packed word of a RateMemory: rates of the last four frames in 8 bits, and two counters.
//
// A rate is 2 bits: which axes of a quad of 2x2 pixels share one path. One frame may miss an edge that the next one sees, so the finest of the last four
// counts, axis by axis (the software variable rate shading of Call of Duty: Modern Warfare).
#include "rate/rate_memory.h"

const uint RATE_HALF_X = 1u, RATE_HALF_Y = 2u;
const uint RATE_FULL = 0u, RATE_QUARTER = RATE_HALF_X | RATE_HALF_Y;

const uint MEMORY_RATES = 0u, MEMORY_AGE = 8u, MEMORY_FRAMES = 16u;  // bits of RateMemory.packed
const uint MEMORY_MOST = 255u;                                      // of age and frames

uint packMemory(uint rates, uint age, uint frames) {
    return rates << MEMORY_RATES | min(age, MEMORY_MOST) << MEMORY_AGE | min(frames, MEMORY_MOST) << MEMORY_FRAMES;
}
uint ratesOf(RateMemory m) { return bitfieldExtract(m.packed, int(MEMORY_RATES), 8); }
uint ageOf(RateMemory m) { return bitfieldExtract(m.packed, int(MEMORY_AGE), 8); }
uint framesOf(RateMemory m) { return bitfieldExtract(m.packed, int(MEMORY_FRAMES), 8); }

/// The last four with a new one, which is in the lowest bits.
uint pushRate(uint rates, uint rate) { return (rates << 2 | rate) & 0xffu; }

/// The finest of the newest `count` (1 to 4): an axis is halved where all of them halve it.
uint finestRate(uint rates, uint count) {
    uint finest = RATE_QUARTER;
    for (uint i = 0u; i < count; ++i) finest &= rates >> 2u * i;
    return finest;
}
