// SPDX-License-Identifier: MIT
// Structural similarity of images as displayed: whether brightness, contrast and pattern agree around each pixel (Wang et al. 2004), at one
// scale or several (MS-SSIM: Wang et al. 2003).
#pragma once
#include <framework/image/image.h>

#include <vector>

namespace lodestir {

/// Pixels nearer to the border than this have no window (11 x 11, a Gaussian of sigma 1.5) around them.
inline constexpr int ssimMargin = 5;

/// What is compared, a value a pixel in [0, 1]: Rec. 709 luma of toneMapAces(exposure x value), sRGB-encoded. The first three channels are
/// red, green and blue; with fewer, the first is grey. NaN where a value is not finite.
struct Luma {
    Luma(const ImageData& image, double exposure);

    int width, height;
    std::vector<double> values;
};

/// The similarity of each pixel, row by row, -1 to 1; 1 where equal, and in the margin. Both images have the same size.
LODESTIR_API std::vector<double> ssimMap(const Luma& test, const Luma& reference);

/// MS-SSIM: the product over five scales, each half as large as the one before (means of 2 x 2 pixels; an odd last row or column is left
/// out), of the mean over pixels outside the margin of contrast and structure, to the published powers; the smallest scale counts brightness
/// too. A negative mean counts as 0. Images under 176 pixels a side have as many scales as are 11 pixels and more, their powers scaled to the
/// same sum: compare values of one size only. `mask`: pixels that count, all when empty; on smaller scales those that hold one that counts.
/// NaN where no pixel outside the margin counts, on any scale.
LODESTIR_API double msSsim(const Luma& test, const Luma& reference, const std::vector<bool>& mask = {});

}  // namespace lodestir
