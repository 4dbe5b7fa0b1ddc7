// SPDX-License-Identifier: MIT
// What became of one path on its way into another pixel or frame and back.
#ifndef LODESTIR_SHIFT_CHECK_H
#define LODESTIR_SHIFT_CHECK_H
#include "base/shared.h"

LODESTIR_SHARED_BEGIN

struct ShiftCheck {
    uint outcome;          // CHECK_*; 0: there was no path or nowhere to shift it to, and the rest means nothing
    uint shape;            // of the path, as in Reservoir
    float errorF;          // largest change of a component of F after the way there and back, relative to the largest component
    float errorJacobian;   // |J J' - 1|
    float errorMis;        // |sum of the resampling MIS weights - 1|: of the path where it came from and, where the shift succeeded, where it went
    float targetError;     // |p^ J J' / p^ - 1| of the same way: what the two forms of "the target from i" differ by
    float energy;          // p^(x) W of the path where it came from, 0 where the shift fails
    float energyShifted;   // p^(T x) J W where it went, likewise; both sums estimate one integral for two pixels that exchange paths
    float stretch;         // G of x_k there / here, times light sampling's density here / there: paths that stretch there shrink on the way back
};

// Bits of ShiftCheck.outcome. Where CHECK_BACK is missing no error but errorMis is known.
const uint CHECK_TRIED = 1u;
const uint CHECK_THERE = 2u;  // the shift succeeded
const uint CHECK_BACK = 4u;   // and so did the shift back
const uint CHECK_SAME = 8u;   // which led to the same path: vertices, lengths, technique, lobes

LODESTIR_SHARED_END
LODESTIR_SHARED(ShiftCheck, "shift_check.h")
#endif
