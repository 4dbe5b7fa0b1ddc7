// SPDX-License-Identifier: MIT
// The bundle by which passes are told which pixels to trace.
#pragma once
#include <framework/pass/bundle.h>
#include <passes/rate/trace_rate.h>

namespace lodestir {

struct Rates {
    static constexpr std::string_view name = "Rates";
    static constexpr std::array members{bundled<TraceRate>("pixels", "whether each pixel is traced, and with which chance"),
                                        bundled<uint>("order", "all pixels, tile by tile of 16x16, the traced ones of each tile first: lanes that walk them in this "
                                                               "order have the same to do")};
};

}  // namespace lodestir
