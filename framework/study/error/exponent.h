// SPDX-License-Identifier: MIT
// How errors fall with samples or frames: the exponent p of error ~ n^p, which is -1 of squared errors of independent samples, nearer to 0 where frames
// share history or a bias stays.
#pragma once
#include <framework/study/error/cell.h>

#include <string>
#include <vector>

namespace lodestir {

struct Exponent {
    std::size_t cell = 0;  ///< the first of those that it runs through, whose other knobs, or whose frame, all share
    std::string over;      ///< the last knob, "trace.spp"; empty: frames since the start, warm-up included
    std::string metric;
    Estimate estimate;
};

/// Along the last knob where it takes three numbers or more, and over the measured frames where there are three or more and all begin at the study's start;
/// of metrics that are errors, where all values are positive.
std::vector<Exponent> exponentsOf(const Study& study, const std::vector<Cell>& cells);

}  // namespace lodestir
