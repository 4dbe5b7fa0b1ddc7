// SPDX-License-Identifier: MIT
#include <framework/scene/upload/cumulative_table.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

namespace lodestir {
namespace {

constexpr std::uint64_t allNumbers = 1ull << 32;

}  // namespace

std::vector<CumulativeEntry> shareNumbers(std::span<const double> weights, Numbers numbers) {
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
        const std::int64_t bound = std::min<std::int64_t>(std::llround(sum * double(numbers.count)), std::int64_t(numbers.count));
        shares[i] = bound - before;
        before = bound;
    }
    // Rounding must neither starve an entry nor feed one without weight: the largest evens it out.
    const std::int64_t least = count <= numbers.count ? 1 : 0;
    std::int64_t left = std::int64_t(numbers.count) - before;
    for (std::size_t i = 0; i < count; ++i) {
        const bool chosen = !(total > 0) || weights[i] > 0;
        const std::int64_t share = chosen ? std::max(shares[i], least) : 0;
        left += shares[i] - share;
        shares[i] = share;
    }
    *std::ranges::max_element(shares) += left;

    std::uint64_t end = numbers.first;
    for (std::size_t i = 0; i < count; ++i) {
        end += std::uint64_t(shares[i]);
        table[i].pmf = float(double(shares[i]) / double(allNumbers));
        table[i].last = end > 0 ? std::uint32_t(end - 1) : 0;
    }
    return table;
}

std::vector<CumulativeEntry> makeCumulativeTable(std::span<const double> weights) {
    std::vector<CumulativeEntry> table = shareNumbers(weights, {0, allNumbers});
    const std::uint64_t count = table.size();
    std::uint64_t cut = 0;
    for (std::size_t i = 0; i < count; ++i) {
        if (table[i].pmf == 0) continue;
        // The first number x of part `cut` has floor(x n / 2^32) = cut.
        for (; cut < count && (cut << 32) + count - 1 < (std::uint64_t(table[i].last) + 1) * count; ++cut) table[cut].start = std::uint32_t(i);
    }
    return table;
}

}  // namespace lodestir
