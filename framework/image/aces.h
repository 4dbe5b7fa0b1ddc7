// SPDX-License-Identifier: MIT
// A filmic tone curve for metrics that judge radiance as a viewer would see it.
#pragma once
#include <array>

namespace lodestir {

/// Coefficients k of the fit of the ACES reference rendering to one curve (Narkowicz 2015), its factor of 0.6 before the curve taken in, as
/// FLIP has them: (k0 x^2 + k1 x + k2) / (k3 x^2 + k4 x + k5).
inline constexpr std::array<double, 6> acesCoefficients{0.9036, 0.018, 0, 0.8748, 0.354, 0.14};

/// Linear, in [0, 1]; negative light is none. NaN unless x is finite.
inline double toneMapAces(double x) {
    const auto& k = acesCoefficients;
    if (x < 0) return 0;
    const double y = ((k[0] * x + k[1]) * x + k[2]) / ((k[3] * x + k[4]) * x + k[5]);
    return y > 1 ? 1 : y;
}

}  // namespace lodestir
