// SPDX-License-Identifier: MIT
#include <framework/scene/upload/cumulative_table.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace lodestir {

std::vector<CumulativeEntry> makeCumulativeTable(std::span<const double> weights) {
    constexpr double numbers = 4294967296.0;  // 2^32
    const std::size_t count = weights.size();
    std::vector<CumulativeEntry> table(count);
    if (count == 0) return table;

    // How many numbers each has: bounds are rounded, not shares, so that all together have them all.
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::vector<std::int64_t> shares(count);
    double sum = 0;
    std::int64_t before = 0;
    for (std::size_t i = 0; i < count; ++i) {
        sum += total > 0 ? weights[i] / total : 1.0 / double(count);
        const std::int64_t bound = std::min(std::llround(sum * numbers), std::llround(numbers));
        shares[i] = bound - before;
        before = bound;
    }
    // Rounding must neither starve an entry nor feed one without weight: the largest evens it out.
    std::int64_t left = std::llround(numbers) - before;
    for (std::size_t i = 0; i < count; ++i) {
        const bool chosen = !(total > 0) || weights[i] > 0;
        const std::int64_t share = chosen ? std::max<std::int64_t>(shares[i], 1) : 0;
        left += shares[i] - share;
        shares[i] = share;
    }
    *std::ranges::max_element(shares) += left;

    std::int64_t end = 0;
    for (std::size_t i = 0, cut = 0; i < count; ++i) {
        end += shares[i];
        table[i].pmf = float(double(shares[i]) / numbers);
        table[i].last = end > 0 ? std::uint32_t(end - 1) : 0;
        // The first number x of part `cut` has floor(x n / 2^32) = cut.
        for (; cut < count && (std::int64_t(cut) << 32) + std::int64_t(count) - 1 < end * std::int64_t(count); ++cut) table[cut].start = std::uint32_t(i);
    }
    return table;
}

}  // namespace lodestir
