// SPDX-License-Identifier: MIT
// The size of frames that keeps the time of each near what is asked for. No window, no GPU.
#pragma once
#include <framework/core/api.h>

#include <glm/glm.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace lodestir {

class FrameSize {
public:
    /// `milliseconds`: that a frame is to take. `window`: the largest size, whose aspect all have. `now`: the size that frames have.
    FrameSize(double milliseconds, glm::uvec2 window, glm::uvec2 now) : wanted_(milliseconds), window_(window), size_(now) {}

    /// After a frame that took so long: the size of the next ones, where it is to be another.
    LODESTIR_API std::optional<glm::uvec2> took(double milliseconds);

private:
    int stepOf(double pixels) const;
    glm::uvec2 sizeAt(int step) const;
    double median(std::size_t frames) const;

    /// The fewest frames that tell: their median isn't moved by two that prepare something after a change.
    static constexpr std::size_t few = 5;

    double wanted_;
    glm::uvec2 window_, size_;
    std::size_t patience_ = few;  ///< frames to look at before the next change
    int turn_ = 0;                ///< of the last change: 1 to more pixels, -1 to fewer
    std::vector<double> times_;   ///< of frames of this size, the latest last
};

}  // namespace lodestir
