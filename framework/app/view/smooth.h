// SPDX-License-Identifier: MIT
// Times that can be read while they change.
#pragma once

namespace lodestir {

/// Follows `value`, at once where it is far off.
inline void smooth(double& mean, double value) { mean = mean <= 0 || value > 2 * mean || value < 0.5 * mean ? value : 0.8 * mean + 0.2 * value; }

}  // namespace lodestir
