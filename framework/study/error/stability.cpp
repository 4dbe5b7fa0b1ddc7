// SPDX-License-Identifier: MIT
#include <framework/study/error/stability.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lodestir {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

StabilityNumber intervalOf(const Estimate& estimate) { return {estimate.mean, estimate.mean - estimate.halfWidth, estimate.mean + estimate.halfWidth}; }

/// Of each run, its mean over the frames of a side of the event.
std::vector<double> meansOf(const Course& course, bool before) {
    std::vector<double> means(course.runs());
    double frames = 0;
    for (std::size_t i = 0; i < course.offsets.size(); ++i) {
        if ((course.offsets[i] < 0) != before) continue;
        for (std::size_t run = 0; run < means.size(); ++run) means[run] += course.values[i][run];
        ++frames;
    }
    for (double& mean : means) mean /= frames;
    return means;
}

/// Mean over the frames from the event on.
double raysOf(const Course& course) {
    double sum = 0, frames = 0;
    for (std::size_t i = 0; i < course.offsets.size(); ++i)
        if (course.offsets[i] >= 0) sum += course.rays[i], ++frames;
    return sum / frames;
}

double recovery(const Course& errors, double factor) {
    const double level = estimateMean(meansOf(errors, true)).mean;
    double since = infinity;
    for (std::size_t i = errors.offsets.size(); i-- > 0 && errors.offsets[i] >= 0;) {
        if (!(estimateMean(errors.values[i]).mean <= factor * level)) break;
        since = errors.offsets[i];
    }
    return since;
}

}  // namespace

Course Course::without(std::size_t run) const {
    Course rest = *this;
    for (std::vector<double>& frame : rest.values) frame.erase(frame.begin() + std::ptrdiff_t(run));
    return rest;
}

StabilityNumber spikeHeight(const Course& errors) {
    std::size_t highest = 0;
    double most = -infinity;
    for (std::size_t i = 0; i < errors.offsets.size() && !std::isnan(most); ++i)
        if (const double mean = estimateMean(errors.values[i]).mean; errors.offsets[i] >= 0 && !(mean <= most)) most = mean, highest = i;
    return intervalOf(estimateRatio(errors.values[highest], meansOf(errors, true)));
}

StabilityNumber recoveryTime(const Course& errors, double factor) {
    StabilityNumber time{recovery(errors, factor), infinity, -infinity};
    if (errors.runs() < 2) return {time.value, std::nan(""), std::nan("")};
    for (std::size_t run = 0; run < errors.runs(); ++run) {
        const double other = recovery(errors.without(run), factor);
        time.low = std::min(time.low, other), time.high = std::max(time.high, other);
    }
    return time;
}

StabilityNumber poppingIndex(const Course& stepFlip) {
    std::vector<double> differences = meansOf(stepFlip, true);
    const auto event = std::size_t(std::ranges::find(stepFlip.offsets, 0) - stepFlip.offsets.begin());
    for (std::size_t run = 0; run < differences.size(); ++run) differences[run] = stepFlip.values[event][run] - differences[run];
    return intervalOf(estimateMean(differences));
}

StabilityNumber energyError(const Course& bias) {
    double squares = 0, frames = 0;
    for (std::size_t i = 0; i < bias.offsets.size(); ++i) {
        if (bias.offsets[i] < 0) continue;
        if (!bias.deviations.empty()) squares += bias.deviations[i] * bias.deviations[i];
        ++frames;
    }
    return intervalOf(withSharedError(estimateMean(meansOf(bias, false)), std::sqrt(squares) / frames));
}

std::optional<StabilityNumber> errorAgainst(const Course& errors, const std::vector<Course>& baselines) {
    /// A baseline's logarithm, and the half-width of that.
    struct Point {
        double rays, error, halfWidth;
    };
    std::vector<Point> points;
    for (const Course& baseline : baselines) {
        const Estimate mean = estimateMean(meansOf(baseline, false));
        points.push_back({baselines.size() > 1 ? raysOf(baseline) : 0, std::log(mean.mean), mean.halfWidth / mean.mean});
    }
    std::ranges::sort(points, {}, &Point::rays);
    const Point* below = &points.front();
    const Point* above = below;
    double share = 0;  // of the way from below to above
    if (points.size() > 1) {
        const double rays = raysOf(errors);
        const auto next = std::ranges::find_if(points, [&](const Point& point) { return point.rays >= rays; });
        if (next == points.end() || (next == points.begin() && next->rays > rays)) return {};
        above = &*next;
        below = next == points.begin() ? above : above - 1;
        if (below != above) share = std::log(rays / below->rays) / std::log(above->rays / below->rays);
    }
    const Estimate mean = estimateMean(meansOf(errors, false));
    const double ratio = mean.mean / std::exp((1 - share) * below->error + share * above->error);
    const double ofBaseline = std::hypot((1 - share) * below->halfWidth, share * above->halfWidth);
    return intervalOf({.mean = ratio, .halfWidth = std::abs(ratio) * std::hypot(mean.halfWidth / mean.mean, ofBaseline)});
}

}  // namespace lodestir
