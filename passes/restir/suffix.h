// SPDX-License-Identifier: MIT
// The parameter of passes that shift paths between frames (restir/suffix.glsl asks by it).
#pragma once
#include <framework/pass/parameter.h>

namespace lodestir {

enum class Suffix { automatic, kept, walked };

struct SuffixRule {
    Param<Suffix> suffix;
    explicit SuffixRule(Pass* pass)
        : suffix{pass, "suffix", Suffix::automatic, {"automatic", "kept", "walked"},
                 "what follows the reconnection vertex of a path that goes between frames: walked anew where anything but the camera changed, always kept "
                 "(biased where things change), always walked anew"} {}
};

}  // namespace lodestir
