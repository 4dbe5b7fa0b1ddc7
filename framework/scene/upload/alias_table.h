// SPDX-License-Identifier: MIT
// Vose's alias method (Vose 1991, "A linear algorithm for generating random numbers with a given distribution").
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace lodestir {

struct AliasEntry {
    float pmf = 0;              ///< probability of this entry
    float aliasProbability = 1; ///< keep the uniformly chosen entry when u < aliasProbability, else take `alias`
    std::uint32_t alias = 0;
};

/// Table of weights >= 0 (at least one positive, else all entries are alike). O(n), deterministic.
std::vector<AliasEntry> makeAliasTable(std::span<const double> weights);

}  // namespace lodestir
