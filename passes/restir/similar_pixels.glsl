// SPDX-License-Identifier: MIT
// Which pixels are alike by the parameters of the pass (similarity.h). After pass.glsl.
#include "restir/similarity.glsl"

bool similarPixels(PixelView a, PixelView b) { return similarViews(a, b, params.normal, params.depth); }
