// SPDX-License-Identifier: MIT
// Gradient magnitude similarity: whether edges are as strong as in the reference (Xue et al. 2014, "Gradient Magnitude Similarity
// Deviation: A Highly Efficient Perceptual Image Quality Index").
#pragma once
#include <framework/image/ssim.h>

#include <vector>

namespace lodestir {

/// The similarity of each pixel, row by row, 0 to 1; 1 where the gradients are equally strong. As in the paper: means of 2 x 2 pixels,
/// gradients by the Prewitt filter divided by 3, c = 0.0026 for values in [0, 1]. All pixels of such a square have its similarity, so that
/// their deviation is that of the squares. Beyond the border the outermost values are repeated. Both images have the same size.
LODESTIR_API std::vector<double> gradientSimilarity(const Luma& test, const Luma& reference);

}  // namespace lodestir
