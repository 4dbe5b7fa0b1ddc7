// SPDX-License-Identifier: MIT
// Errors of a sequence of frames: what changes from one frame to the next that does not change in the reference. Each is measured of a
// step, a frame and the one right before it; a sequence's value is the mean over its steps.
#pragma once
#include <framework/image/metrics.h>

#include <string>
#include <string_view>
#include <vector>

namespace lodestir {

/// A frame and the one before it, as rendered and as they should be; images of one size and the same channels.
struct Step {
    const ImageData &test, &testBefore, &reference, &referenceBefore;
    /// Two channels: from each pixel to where the frame before showed the same point, pixels, x to the right, y down. Absent: nothing moves. A pixel
    /// whose point was outside the frame does not count.
    const ImageData* motion = nullptr;
};

LODESTIR_API std::vector<std::string> temporalMetricNames();
LODESTIR_API bool isTemporal(std::string_view metric);
/// The definition in a sentence. Error when there is no such metric.
LODESTIR_API std::string temporalMetricAbout(std::string_view name);

/// The value of one step; NaN where a pixel that counts is, or none counts. `options`: its exposures need to be set for steps to be
/// comparable; unset they are those of `reference`. Throws Error when there is no such metric, the images differ in size or channels, are
/// empty, or the mask has another size.
LODESTIR_API double evaluateStep(std::string_view name, const Step& step, const MetricOptions& options = {});

}  // namespace lodestir
