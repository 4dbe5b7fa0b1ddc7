// SPDX-License-Identifier: MIT
// What is not black, and a band around it: the mask that errors of an object and its outline are taken over.
#include <framework/pass/pass.h>

using namespace lodestir;

struct Dilate final : Pass {
    In<Image>  image{this, "image", "any"};
    Out<Image> mask{this, "mask", "1 within `radius` of a pixel of which any channel but alpha isn't 0, else 0", Format::r32f};
    Param<int> radius{this, "radius", 8, {0, 64}, "pixels to all sides, diagonals included"};
};
LODESTIR_PASS(Dilate, "dilate.comp", "Marks the pixels in which an image isn't black, and those around them.")
