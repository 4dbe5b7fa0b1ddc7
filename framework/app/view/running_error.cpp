// SPDX-License-Identifier: MIT
#include <framework/app/view/running_error.h>

#include <framework/image/metrics.h>

#include <fmt/format.h>

namespace lodestir {
namespace {

constexpr std::size_t histogramBins = 64;
constexpr std::size_t mostPoints = 256;  // of a curve: more than the panel has pixels for

ErrorPoint errorOf(std::uint32_t frames, const ImageData& test, const ImageData& reference) {
    const std::map<std::string, double> errors = evaluateAll({"mse", "relmse"}, test, reference);
    return {frames, errors.at("mse"), errors.at("relmse")};
}

/// A frame that is measured again, because other numbers of it are shown, counts once. Every other point goes where there are many: along the
/// logarithm of the frames the curve stays as it was.
void append(std::vector<ErrorPoint>& curve, const ErrorPoint& point) {
    if (!curve.empty() && curve.back().frames == point.frames) curve.pop_back();
    if (curve.size() == mostPoints) {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < curve.size(); i += 2) curve[kept++] = curve[i];
        curve.resize(kept);
    }
    curve.push_back(point);
}

std::string kindOf(const ImageData& image) { return fmt::format("{}x{} with {} colours", image.width, image.height, image.channels); }

bool alike(const ImageData& a, const ImageData& b) { return a.width == b.width && a.height == b.height && a.channels == b.channels; }

}  // namespace

void RunningError::clear() {
    numbers_.reset();
    next_ = {};
}

void RunningError::measure(std::uint32_t frames, const ImageData& a, const ImageData& b, const ImageData* reference, const std::string& name,
                           std::uint32_t pick) {
    const auto start = std::chrono::steady_clock::now();
    auto numbers = std::make_shared<ComparedNumbers>();
    if (goesOn_ && numbers_) *numbers = *numbers_;
    goesOn_ = true;
    numbers->reference = name;
    const std::array<const ImageData*, 2> both{&a, &b};
    numbers->histograms = histogramsOf(both, pick, histogramBins);
    const ImageData colorA = withoutOpacity(a), colorB = withoutOpacity(b), against = withoutOpacity(reference ? *reference : a);
    numbers->without = alike(colorB, against) ? "" : fmt::format("B is {}, {} {}", kindOf(colorB), name, kindOf(against));
    if (alike(colorB, against)) append(numbers->b, errorOf(frames, colorB, against));
    if (reference && alike(colorA, against)) append(numbers->a, errorOf(frames, colorA, against));
    numbers_ = std::move(numbers);
    const auto end = std::chrono::steady_clock::now();
    next_ = end + 9 * (end - start);
}

}  // namespace lodestir
