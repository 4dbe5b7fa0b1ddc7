// SPDX-License-Identifier: MIT
// The mean of an image over frames.
#include <framework/pass/pass.h>

using namespace lodestir;

struct Accumulate final : Pass {
    In<Image>    color{this, "color", "an unbiased image"};
    State<Image> sum{this, "sum", "sum of the images so far, and their number in the fourth channel", Format::rgba32f};
    Out<Image>   mean{this, "mean", "their mean", Format::rgba32f};
    PassThrough  off{this, color, mean};
    Accumulate() { restartOnChange = true; }
    void execute(Frame& frame) override { frame.dispatch(shader, frame.sizeOf(mean)); }
};
LODESTIR_PASS(Accumulate, "accumulate.comp", "Averages an image over frames; starts again when anything changes.")
