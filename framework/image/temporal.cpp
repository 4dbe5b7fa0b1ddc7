// SPDX-License-Identifier: MIT
// Flicker. With e_t = v(x_t) - v(r_t) and v = log2(1 + luminance), half the mean of (e_t - e_{t-1})^2 and the mean of e_t e_{t-1} add up to
// the mean of (e_t^2 + e_{t-1}^2) / 2. Noise that is new in each frame is all in the first, an error that stays is all in the second.
#include <framework/core/error.h>
#include <framework/image/temporal.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

namespace lodestir {
namespace {

struct Temporal {
    const char* name;
    const char* about;
    double (*evaluate)(const Step& step, const MetricOptions& options);
};

double square(double value) { return value * value; }

/// log2(1 + s Y) of a pixel, negative light taken for none; NaN stays.
double brightness(const ImageData& image, std::size_t pixel, double exposure) {
    const float* c = image.values.data() + pixel * std::size_t(image.channels);
    const double y = image.channels >= 3 ? 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2] : double(c[0]);
    return std::log2(1 + exposure * (y < 0 ? 0 : y));
}

/// The pixel of the frame before that showed the same point; none outside the frame.
std::optional<std::size_t> pixelBefore(const Step& step, int x, int y) {
    if (step.motion) {
        const double fromX = std::floor(x + 0.5 + double(step.motion->at(x, y, 0))),
                     fromY = std::floor(y + 0.5 + double(step.motion->at(x, y, 1)));
        if (!(fromX >= 0 && fromY >= 0 && fromX < step.test.width && fromY < step.test.height)) return {};
        x = int(fromX), y = int(fromY);
    }
    return std::size_t(y) * std::size_t(step.test.width) + std::size_t(x);
}

/// Mean over the pixels that count of `part` of the errors now and before.
double meanOfErrors(const Step& step, const MetricOptions& options, double (*part)(double now, double before)) {
    const double exposure = options.exposure ? *options.exposure : exposureOf(step.reference);
    double sum = 0, count = 0;
    for (int y = 0; y < step.test.height; ++y)
        for (int x = 0; x < step.test.width; ++x) {
            const std::size_t now = std::size_t(y) * std::size_t(step.test.width) + std::size_t(x);
            if (!options.mask.empty() && !options.mask[now]) continue;
            const auto before = pixelBefore(step, x, y);
            if (!before) continue;
            sum += part(brightness(step.test, now, exposure) - brightness(step.reference, now, exposure),
                        brightness(step.testBefore, *before, exposure) - brightness(step.referenceBefore, *before, exposure));
            ++count;
        }
    return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

double uncorrelated(const Step& step, const MetricOptions& options) {
    return meanOfErrors(step, options, [](double now, double before) { return square(now - before) / 2; });
}

double correlated(const Step& step, const MetricOptions& options) {
    return meanOfErrors(step, options, [](double now, double before) { return now * before; });
}

/// FLIP between a frame and the one before it, of each pixel.
std::vector<double> flipOfStep(const ImageData& now, const ImageData& before, const Step& step, const MetricOptions& options) {
    FlipOptions flip = options.flip;
    if (!flip.exposures && !options.displayed) flip.exposures = flipExposures(step.reference);
    return (options.displayed ? flipLdr : flipHdr)(now, before, flip);
}

/// Of the pixels that count.
double meanOf(const std::vector<double>& values, const MetricOptions& options) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!options.mask.empty() && !options.mask[i]) continue;
        sum += values[i];
        ++count;
    }
    return count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
}

double temporalFlip(const Step& step, const MetricOptions& options) {
    std::vector<double> x = flipOfStep(step.test, step.testBefore, step, options);
    const std::vector<double> r = flipOfStep(step.reference, step.referenceBefore, step, options);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = std::abs(x[i] - r[i]);
    return meanOf(x, options);
}

double stepFlip(const Step& step, const MetricOptions& options) { return meanOf(flipOfStep(step.test, step.testBefore, step, options), options); }

constexpr Temporal table[] = {
    {"flicker_uncorrelated",
     "the part of the error that is new in each frame: mean of (e_t - e_(t-1))^2 / 2 with e = log2(1 + Y(x)) - log2(1 + Y(r)), Y the Rec. "
     "709 luminance of images scaled as for relmse; white noise has its variance, an error that stays has 0",
     uncorrelated},
    {"flicker_correlated",
     "the part of the error that stays from frame to frame (boiling, lag, bias): mean of e_t e_(t-1), e as for flicker_uncorrelated; both "
     "add up to the mean of e^2; a constant offset has its square, white noise 0 but for chance",
     correlated},
    {"tflip",
     "mean of |FLIP(x_t, x_(t-1)) - FLIP(r_t, r_(t-1))|, 0 to 1: changes from frame to frame that a viewer sees and the reference hasn't, "
     "or that lack; FLIP as for flip, pixels compared in place",
     temporalFlip},
    {"step_flip",
     "mean of FLIP(x_t, x_(t-1)), 0 to 1: how much of a change a viewer sees from one frame to the next, wanted or not; where the camera stands, a switch of "
     "level adds its popping to what noise does; FLIP as for flip, of which the reference gives the exposures alone",
     stepFlip},
};

const Temporal& metricNamed(std::string_view name) {
    const auto found = std::ranges::find(table, name, [](const Temporal& metric) { return std::string_view(metric.name); });
    if (found == std::end(table))
        throw Error("unknown metric of sequences \"" + std::string(name) + "\"", didYouMean(name, temporalMetricNames()));
    return *found;
}

void check(const Step& step, const MetricOptions& options) {
    const ImageData& first = step.test;
    for (const ImageData* image : {&step.testBefore, &step.reference, &step.referenceBefore})
        if (image->width != first.width || image->height != first.height || image->channels != first.channels)
            throw Error("the frames cannot be compared: they differ in size or channels");
    if (first.values.empty()) throw Error("the frames cannot be compared: they have no pixels");
    if (step.motion && (step.motion->width != first.width || step.motion->height != first.height || step.motion->channels < 2))
        throw Error("the motion needs two channels and the size of the frames");
    if (!options.mask.empty() && options.mask.size() != first.pixelCount()) throw Error("the mask has another size than the frames");
}

}  // namespace

std::vector<std::string> temporalMetricNames() {
    std::vector<std::string> names;
    for (const Temporal& metric : table) names.emplace_back(metric.name);
    return names;
}

bool isTemporal(std::string_view metric) {
    return std::ranges::any_of(table, [&](const Temporal& known) { return metric == known.name; });
}

std::string temporalMetricAbout(std::string_view name) { return metricNamed(name).about; }

double evaluateStep(std::string_view name, const Step& step, const MetricOptions& options) {
    const Temporal& metric = metricNamed(name);
    check(step, options);
    return metric.evaluate(step, options);
}

}  // namespace lodestir
