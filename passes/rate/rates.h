// SPDX-License-Identifier: MIT
// The bundle by which passes are told which pixels to trace, and how they walk them (rate/walk.glsl).
#pragma once
#include <framework/pass/bundle.h>
#include <passes/rate/trace_rate.h>

namespace lodestir {

struct Rates {
    static constexpr std::string_view name = "Rates";
    static constexpr std::array members{bundled<TraceRate>("pixels", "whether each pixel is traced, and with which chance"),
                                        bundled<uint>("order",
                                                      "all pixels, tile by tile of 16x16, the traced ones of each tile first: lanes that walk them in this "
                                                      "order have the same to do")};
};

/// Of a dispatch that walks pixels in the order of the rates: one row. Images of more pixels than every device takes workgroups in a row for are walked as
/// they lie.
inline glm::uvec2 walkExtent(glm::uvec2 size, bool ordered) {
    constexpr std::uint32_t most = 64 * 65535;
    return ordered && size.x * size.y <= most ? glm::uvec2(size.x * size.y, 1) : size;
}

}  // namespace lodestir
