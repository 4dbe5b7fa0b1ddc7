// SPDX-License-Identifier: MIT
#include <framework/study/error/comparison.h>

#include <algorithm>
#include <cmath>

namespace lodestir {
namespace {

bool allPositive(const std::vector<double>& values) {
    return std::ranges::all_of(values, [](double value) { return value > 0; });
}

std::vector<double> logarithms(const std::vector<double>& values) {
    std::vector<double> logs;
    for (const double value : values) logs.push_back(std::log(value));
    return logs;
}

/// As far as both vary the same.
bool sameKnobs(const Study& study, const Cell& a, const Cell& b) {
    const std::size_t count = study.techniques[a.technique].vary.size();
    if (study.techniques[b.technique].vary.size() != count) return false;
    for (std::size_t i = 0; i < count; ++i)
        if (a.knobs[i].name != b.knobs[i].name || a.knobs[i].value.dump(-1) != b.knobs[i].value.dump(-1)) return false;
    return true;
}

/// Index of what a cell is held against; as many as there are cells: nothing.
std::size_t baselineOf(const Study& study, const std::vector<Cell>& cells, const Cell& cell) {
    const auto& ablation = study.techniques[cell.technique].ablation;
    const std::size_t technique = ablation ? ablation->whole : study.baseline;
    std::size_t found = cells.size(), last = cells.size();
    int count = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const Cell& other = cells[i];
        if (other.scene != cell.scene || other.technique != technique || other.offset != cell.offset) continue;
        ++count;
        last = i;
        if (sameKnobs(study, cell, other)) found = i;
    }
    if (found == cells.size() && count == 1) found = last;
    return found < cells.size() && cells[found].seeds > 0 && &cells[found] != &cell ? found : cells.size();
}

}  // namespace

double Difference::middle() const { return ratio ? std::exp(estimate.mean) : estimate.mean; }
double Difference::low() const { return ratio ? std::exp(estimate.mean - estimate.halfWidth) : estimate.mean - estimate.halfWidth; }
double Difference::high() const { return ratio ? std::exp(estimate.mean + estimate.halfWidth) : estimate.mean + estimate.halfWidth; }

Difference compareValues(const std::vector<double>& values, const std::vector<std::uint32_t>& seeds, const std::vector<double>& baseline,
                         const std::vector<std::uint32_t>& baselineSeeds) {
    std::vector<double> mine, other;  // of the seeds that both have
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto same = std::ranges::find(baselineSeeds, seeds[i]);
        if (same == baselineSeeds.end()) continue;
        mine.push_back(values[i]);
        other.push_back(baseline[std::size_t(same - baselineSeeds.begin())]);
    }
    Difference difference{.ratio = allPositive(values) && allPositive(baseline), .paired = !mine.empty(), .estimate = {}};
    if (!difference.paired) mine = values, other = baseline;
    if (difference.ratio) mine = logarithms(mine), other = logarithms(other);
    difference.estimate = difference.paired ? estimatePairedDifference(mine, other) : estimateDifference(mine, other);
    return difference;
}

std::vector<Comparison> compareCells(const Study& study, const std::vector<Cell>& cells) {
    std::vector<Comparison> comparisons;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const Cell& cell = cells[i];
        if (cell.seeds == 0) continue;
        const std::size_t found = baselineOf(study, cells, cell);
        if (found == cells.size()) continue;
        const Cell& baseline = cells[found];
        const auto compare = [&](const std::vector<double>& mine, const std::vector<double>& other) {
            return compareValues(mine, cell.drawn, other, baseline.drawn);
        };
        Comparison comparison{.cell = i,
                              .baseline = found,
                              .metrics = {},
                              .milliseconds = compare(cell.times, baseline.times),
                              .rays = compare(cell.rayCounts, baseline.rayCounts)};
        for (const auto& [name, values] : cell.values)
            if (const auto other = baseline.values.find(name); other != baseline.values.end()) comparison.metrics[name] = compare(values, other->second);
        comparisons.push_back(std::move(comparison));
    }
    return comparisons;
}

}  // namespace lodestir
