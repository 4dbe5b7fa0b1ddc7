// SPDX-License-Identifier: MIT
// How what is seen moves from frame to frame: what flicker has to be told from.
#pragma once
#include <framework/image/image.h>
#include <framework/study/error/switched_masks.h>

#include <vector>

namespace lodestir {

/// Of each measured frame and the centre of each pixel, from where a point is seen to where the frame before showed it, in pixels; two
/// channels.
std::vector<ImageData> measuredMotions(const MaskStage& stage);

}  // namespace lodestir
