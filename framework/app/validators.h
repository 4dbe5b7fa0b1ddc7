// SPDX-License-Identifier: MIT
// Checks of command line values that CLI11 lacks: it takes NaN for a number and nothing for anything.
#pragma once
#include <charconv>
#include <cmath>
#include <string>

namespace lodestir {

/// A finite number above 0.
inline std::string checkPositive(const std::string& text) {
    double value = 0;
    const char* end = text.data() + text.size();
    const auto [rest, failure] = std::from_chars(text.data(), end, value);
    const bool good = failure == std::errc() && rest == end && std::isfinite(value) && value > 0;
    return good ? std::string() : "\"" + text + "\" is no number above 0";
}

inline std::string checkNotEmpty(const std::string& text) { return text.empty() ? "nothing is given" : std::string(); }

}  // namespace lodestir
