// SPDX-License-Identifier: MIT
// The parameter of passes that weigh a pixel's path against those of its neighbours (restir/pairwise.glsl asks by it).
#pragma once
#include <framework/pass/parameter.h>

namespace lodestir {

enum class Mis { defensive, pairwise };

struct PairwiseRule {
    Param<Mis> mis;
    explicit PairwiseRule(Pass* pass)
        : mis{pass, "mis", Mis::defensive, {"defensive", "pairwise"},
              "resampling MIS weights: pairwise, with or without a share that is the pixel's own whatever neighbours say"} {}
};

}  // namespace lodestir
