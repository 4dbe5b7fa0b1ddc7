// SPDX-License-Identifier: MIT
#include <framework/app/view/frame_size.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace lodestir {
namespace {

/// Times within this factor of the one that is wanted are left alone. It is wider than half a step of sizes, 2^(1/8) = 1.09, so that a size whose time
/// lies outside has a neighbour whose time lies inside.
constexpr double band = 1.15;
/// Where half of the frames that are looked at are all this far off, they are others than before: the older ones don't count.
constexpr double otherFrames = 1.5;
constexpr double stepsInHalf = 4;     // of the pixels: each step has 2^(-1/4) as many
constexpr double shortestSide = 48;   // pixels; in fewer nothing is seen
constexpr std::size_t longest = 320;  // frames that are looked at, at most

double distance(double ratio) { return std::abs(std::log2(ratio)); }

}  // namespace

int FrameSize::stepOf(double pixels) const {
    const glm::dvec2 window(window_);
    const int last = std::max(0, int(std::floor(2 * stepsInHalf * std::log2(std::min(window.x, window.y) / shortestSide))));
    return std::clamp(int(std::lround(stepsInHalf * std::log2(window.x * window.y / pixels))), 0, last);
}

glm::uvec2 FrameSize::sizeAt(int step) const { return glm::uvec2(glm::round(glm::dvec2(window_) * std::exp2(-0.5 * step / stepsInHalf))); }

double FrameSize::median(std::size_t frames) const {
    std::vector<double> last(times_.end() - std::ptrdiff_t(frames), times_.end());
    std::ranges::nth_element(last, last.begin() + std::ptrdiff_t(frames / 2));
    return last[frames / 2];
}

/// A time is taken for proportional to the pixels. Where part of it isn't, a change falls short of what is wanted and another follows: never beyond it,
/// so nothing swings. Who turns back was misled by noise or by a burst of other work, and looks at twice as many frames from then on, until a burst is
/// shorter than half of them.
std::optional<glm::uvec2> FrameSize::took(double milliseconds) {
    if (times_.size() == longest) times_.erase(times_.begin());
    times_.push_back(milliseconds);
    if (const std::size_t half = std::max(few, patience_ / 2); times_.size() >= half) {
        const auto [least, most] = std::ranges::minmax(std::span(times_).last(half));
        if (least > otherFrames * wanted_ || otherFrames * most < wanted_) patience_ = half;
    }
    if (times_.size() < patience_) return {};

    const double ratio = median(patience_) / wanted_, pixels = double(size_.x) * double(size_.y);
    const glm::uvec2 next = sizeAt(stepOf(distance(ratio) > std::log2(band) ? pixels / ratio : pixels));
    if (next == size_) return {};
    const int turn = double(next.x) * double(next.y) > pixels ? 1 : -1;
    if (turn == -turn_) patience_ = std::min(2 * patience_, longest);
    turn_ = turn;
    size_ = next;
    times_.clear();
    return size_;
}

}  // namespace lodestir
