// SPDX-License-Identifier: MIT
// A discrete distribution to be inverted with a table of cut points (Chen and Asau 1974, "On generating random variates from an empirical
// distribution"). Unlike an alias table's, its inverse moves little where weights do: what a path's number chooses is the same light in the next
// frame, though rounding gives a turned triangle another area.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace lodestir {

struct CumulativeEntry {
    float pmf = 0;            ///< probability of this entry: its share of all 32-bit numbers
    std::uint32_t last = 0;   ///< the last number that chooses it
    std::uint32_t start = 0;  ///< cut point: at place i the entry that the first number x with floor(x n / 2^32) = i chooses, of n entries
};

/// Table of weights >= 0 (at least one positive, else all entries are alike). An entry has a number if and only if its weight is positive. O(n).
std::vector<CumulativeEntry> makeCumulativeTable(std::span<const double> weights);

/// The numbers from `first` on, `count` of them.
struct Numbers {
    std::uint64_t first = 0, count = 0;
};

/// The same of these numbers only, without cut points: it is inverted by bisection. Where numbers are about as few as entries some go without.
std::vector<CumulativeEntry> shareNumbers(std::span<const double> weights, Numbers numbers);

}  // namespace lodestir
