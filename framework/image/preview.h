// SPDX-License-Identifier: MIT
// Any image made fit to be looked at.
#pragma once
#include <framework/image/image.h>

namespace lodestir {

/// Colour (3 or 4 channels) as it is, without opacity; with values below zero, as normals have, c becomes (c + 1) / 2. One channel: divided by its
/// largest value. Two channels, as motion has: (0, 0) becomes mid-grey and the largest length is full red and green.
LODESTIR_API ImageData preview(const ImageData& image);

}  // namespace lodestir
