// SPDX-License-Identifier: MIT
// The errors of pictures while their frames go on, measured at a rate that leaves the frames their time. No window, no GPU.
#pragma once
#include <framework/app/view/view_state.h>

#include <chrono>
#include <optional>

namespace lodestir {

class RunningError {
public:
    /// Whether the next measurement would leave nine tenths of the time to others.
    bool due() const { return std::chrono::steady_clock::now() >= next_; }
    void restart() { goesOn_ = false; }  ///< the next measurement begins curves of its own
    LODESTIR_API void clear();           ///< what was measured is another thing
    /// Of pictures so many frames after anything was changed. `reference`: an image that both are held against; null: B is held against A.
    /// `name`: of what they are held against. `pick`: the number that histograms are of.
    LODESTIR_API void measure(std::uint32_t frames, const ImageData& a, const ImageData& b, const ImageData* reference, const std::string& name,
                              std::uint32_t pick);
    std::shared_ptr<const ComparedNumbers> numbers() const { return numbers_; }

private:
    std::shared_ptr<const ComparedNumbers> numbers_;
    bool goesOn_ = false;
    std::chrono::steady_clock::time_point next_{};
};

}  // namespace lodestir
