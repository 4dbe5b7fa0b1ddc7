// SPDX-License-Identifier: MIT
// What a viewer knows about itself, as a JSON file for tests: where its widgets are, what it shows, how quickly it answers.
#pragma once
#include <framework/app/view/panels.h>

#include <chrono>
#include <vector>

namespace lodestir {

class SelfReport {
public:
    explicit SelfReport(Path file) : file_(std::move(file)) {}
    bool wanted() const { return !file_.empty(); }
    /// Input that came at the earliest at `since` was answered on the screen just now.
    void answered(std::chrono::steady_clock::time_point since);
    /// Writes the file, where it is wanted: after each drawing. `area`: of the picture, pixels; widgets are told
    /// in pixels, too.
    void write(const ViewStatus& status, const Panels& panels, const Viewport& viewport, const Rectangle& area, float density);

private:
    Path file_;
    std::vector<double> latencies_;  ///< milliseconds
    std::uint64_t drawn_ = 0;
};

}  // namespace lodestir
