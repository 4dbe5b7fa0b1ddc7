// SPDX-License-Identifier: MIT
#include <framework/scene/upload/alias_table.h>

#include <numeric>

namespace lodestir {

std::vector<AliasEntry> makeAliasTable(std::span<const double> weights) {
    const std::size_t count = weights.size();
    std::vector<AliasEntry> table(count);
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    if (count == 0) return table;

    // Scaled so that the mean is 1: entries under 1 are filled up by one over 1.
    std::vector<double> scaled(count, 1.0);
    std::vector<std::uint32_t> small, large;
    for (std::size_t i = 0; i < count; ++i) {
        if (total > 0) scaled[i] = weights[i] * double(count) / total;
        table[i] = {float(scaled[i] / double(count)), 1.0f, std::uint32_t(i)};
        (scaled[i] < 1 ? small : large).push_back(std::uint32_t(i));
    }
    while (!small.empty() && !large.empty()) {
        const std::uint32_t low = small.back(), high = large.back();
        small.pop_back();
        table[low].aliasProbability = float(scaled[low]);
        table[low].alias = high;
        scaled[high] -= 1 - scaled[low];
        if (scaled[high] < 1) {
            large.pop_back();
            small.push_back(high);
        }
    }
    // What is left is 1 but for rounding; an entry without weight must not be kept by it.
    const auto settle = [&](std::uint32_t i) {
        if (table[i].pmf > 0) return;
        std::uint32_t heaviest = 0;
        for (std::uint32_t k = 1; k < count; ++k)
            if (table[k].pmf > table[heaviest].pmf) heaviest = k;
        table[i].aliasProbability = 0;
        table[i].alias = heaviest;
    };
    for (std::uint32_t i : small) settle(i);
    for (std::uint32_t i : large) settle(i);
    return table;
}

}  // namespace lodestir
