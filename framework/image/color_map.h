// SPDX-License-Identifier: MIT
// Colours for error maps, from black over purple and orange to pale yellow.
#pragma once
#include <framework/image/image.h>

namespace lodestir {

/// Linear RGB of the first channel's values: 0 and less are darkest, `top` and more are brightest, lightness growing all the way between.
/// NaN is green, which no value is.
LODESTIR_API ImageData colorMap(const ImageData& image, double top);

}  // namespace lodestir
