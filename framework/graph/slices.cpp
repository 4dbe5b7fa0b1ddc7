// SPDX-License-Identifier: MIT
#include <framework/graph/slices.h>

#include <algorithm>
#include <cmath>

namespace lodestir {

std::uint32_t Slices::take(Key key, std::uint32_t rows, std::uint32_t grain) {
    if (!cuts()) return rows;
    // What is left behind must be more than one row: a dispatch of one row is spread otherwise.
    const auto orAll = [&](std::uint32_t part) { return part + 2 > rows ? rows : part; };
    const auto known = cost_.find(key);
    if (known == cost_.end()) {
        if (used_ > 0) {
            used_ = budget_;
            return 0;
        }
        used_ = budget_;
        return orAll(2 * grain);
    }
    const double fit = known->second > 0 ? (budget_ - used_) / known->second : double(rows);
    std::uint32_t part = fit >= double(rows) ? rows : std::uint32_t(std::max(fit, 0.0)) / grain * grain;
    if (part == 0 && used_ > 0) return 0;
    part = orAll(std::max(part, std::min(grain, rows)));
    used_ = part < rows ? budget_ : used_ + part * known->second;
    return part;
}

void Slices::measured(Key key, std::uint32_t rows, double milliseconds) {
    if (rows == 0) return;
    // Rows differ (sky here, glass there): the dear ones count for longer.
    double& cost = cost_[key];
    cost = std::max(milliseconds / rows, 0.85 * cost);
}

}  // namespace lodestir
