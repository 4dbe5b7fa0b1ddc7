// SPDX-License-Identifier: MIT
// FLIP, the difference that a viewer notices when two images are shown in turn (Andersson et al. 2020; HDR-FLIP: Andersson et al. 2021).
#pragma once
#include <framework/image/image.h>

#include <numbers>
#include <optional>
#include <vector>

namespace lodestir {

/// What HDR-FLIP looks at: `count` exposures, evenly spaced in stops.
struct FlipExposures {
    double start = 0, stop = 0;
    int count = 1;

    double stops(int i) const { return count > 1 ? start + i * (stop - start) / (count - 1) : start; }
};

/// From the exposure at which the brightest pixel is shown at 0.85 of white to that at which the median luminance (Rec. 709) is; as many as
/// there are stops between, at least 2. Where the median is 0 it is that of the pixels above 0, for else there would be no end; where no
/// pixel is, one exposure of 0 stops. Values that are not finite don't count. All frames that are to be compared need the same exposures.
LODESTIR_API FlipExposures flipExposures(const ImageData& reference);

struct FlipOptions {
    /// Of the viewer's field: the default is that of a screen 3840 pixels and 0.7 m wide, seen from 0.7 m.
    double pixelsPerDegree = 3840 * std::numbers::pi / 180;
    /// For flipHdr(); unset, flipExposures(reference).
    std::optional<FlipExposures> exposures{};
};

/// LDR-FLIP of images as displayed: linear values (not encoded), clamped to [0, 1]. The error of each pixel, row by row, from 0 to 1.
/// The first three channels are red, green and blue; with fewer, the first is grey. NaN spreads as far as the filters reach (10 pixels).
/// Throws Error when the images differ in size or channels or are empty, or an option makes no sense.
LODESTIR_API std::vector<double> flipLdr(const ImageData& test, const ImageData& reference, const FlipOptions& options = {});

/// HDR-FLIP of radiance: each pixel's largest error by LDR-FLIP over the exposures, tone-mapped with toneMapAces(). Not symmetric: the
/// exposures are the reference's. Otherwise as flipLdr().
LODESTIR_API std::vector<double> flipHdr(const ImageData& test, const ImageData& reference, const FlipOptions& options = {});

}  // namespace lodestir
