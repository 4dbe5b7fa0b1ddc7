// SPDX-License-Identifier: MIT
// Parameters of passes that reuse what last frame held.
#pragma once
#include <framework/pass/parameter.h>

namespace lodestir {

struct History {
    Param<float> cap;
    explicit History(Pass* pass)
        : cap{pass, "cap", 20, {0, 1000}, "most confidence of what last frame held, in frames' own; 0: no temporal reuse (Lin et al. 2022, section 6.2)"} {}
};

}  // namespace lodestir
