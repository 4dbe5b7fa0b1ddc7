// SPDX-License-Identifier: MIT
// From pixels that were traced to those between: what images of lower resolution are shown by.
#include <framework/pass/pass.h>
#include <passes/rate/rates.h>

using namespace lodestir;

struct Upsample final : Pass {
    In<Image>    color{this, "color", "radiance, of which the traced pixels count"};
    In<Rates>    rates{this, "rates", "which pixels those are"};
    In<Image>    depths{this, "depths", "depth of each pixel's hit"};
    In<Image>    normals{this, "normals", "its normal"};
    Out<Image>   colorOut{this, "color", "the same, with the pixels between filled, linear Rec. 709", Format::rgba32f};
    Param<int>   radius{this, "radius", 2, {1, 8}, "of the square that is searched for traced pixels"};
    Param<float> sharpness{this, "sharpness", 16, {0, 256}, "power of the cosine between normals"};
    Param<float> tolerance{this, "tolerance", 0.02f, {1e-4f, 1}, "difference of depth, relative, that weighs 1 / e"};
    PassThrough  off{this, color, colorOut};
};
LODESTIR_PASS(Upsample, "upsample.comp", "Fills pixels that were not traced from traced ones around that see the same surface (joint bilateral upsampling).")
