// SPDX-License-Identifier: MIT
// Parameters of passes that reuse what last frame held (restir/history.glsl asks by them).
#pragma once
#include <framework/pass/parameter.h>
#include <framework/pass/port.h>

namespace lodestir {

struct History {
    In<Image> duplication;
    Param<float> cap, leastCap, alpha;
    explicit History(Pass* pass)
        : duplication{pass, "duplication",
                      "last frame's map of copies (duplication_map): the more of them were around, the less its confidence counts, which is biased; unwired: "
                      "not asked",
                      Need::optional},
          cap{pass, "cap", 20, {0, 1000}, "most confidence of what last frame held, in frames' own; 0: no temporal reuse (Lin et al. 2022, section 6.2)"},
          leastCap{pass, "leastCap", 1, {0, 1000},
                   "the same where the whole neighbourhood held copies; asked where `duplication` is wired (Lin et al. 2026, section 5)"},
          alpha{pass, "alpha", 0.1f, {0.01f, 10}, "power of the share of copies, by which `cap` goes to `leastCap` (Lin et al. 2026, section 5)"} {}
};

}  // namespace lodestir
