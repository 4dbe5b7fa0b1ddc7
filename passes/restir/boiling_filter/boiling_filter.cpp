// SPDX-License-Identifier: MIT
// What renderers do against single bright reservoirs: a baseline.
#include <framework/pass/pass.h>
#include <passes/restir/paths.h>

using namespace lodestir;

struct BoilingFilter final : Pass {
    In<Paths>    paths{this, "paths", "a path of each pixel"};
    Out<Paths>   pathsOut{this, "paths", "the same without those that outweigh their group", Count::perPixel()};
    Param<float> strength{this, "strength", 0.2f, {0.001f, 1},
                          "a reservoir is cleared where its weight is above 10 / strength - 9 times the mean of its 16x16 group (RTXDI's boiling filter)"};
    PassThrough  off{this, paths, pathsOut};

    /// A group of 8x8 invocations takes 16x16 pixels; 2: never a row, which comes in groups of 64x1.
    void execute(Frame& frame) override { frame.dispatch(shader, glm::max((frame.size() + 1u) / 2u, glm::uvec2(1, 2))); }
};
LODESTIR_PASS(BoilingFilter, "boiling_filter.comp", "Clears reservoirs whose weight stands out of their group: darker and calmer (biased).")
