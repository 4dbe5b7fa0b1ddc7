// SPDX-License-Identifier: MIT
#include <framework/study/error/summary.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lodestir {
namespace {

struct Samples {
    Cell cell;
    std::map<std::string, PassSummary> passes;  ///< sums
    std::vector<std::string> passOrder;

    void add(const ResultRow& row) {
        cell.runs.push_back(row.run);
        cell.drawn.push_back(row.seed);
        cell.times.push_back(row.milliseconds);
        cell.rayCounts.push_back(double(row.rays()));
        for (const PassCost& pass : row.passes) {
            const auto [place, isNew] = passes.try_emplace(pass.name);
            if (isNew) passOrder.push_back(pass.name);
            place->second.milliseconds += pass.milliseconds;
            for (const auto& [purpose, count] : pass.rays) {
                place->second.rays += double(count);
                place->second.purposes[purpose] += double(count);
            }
        }
        for (const auto& [name, value] : row.counts) cell.countValues[name].push_back(value);
        for (const auto& [name, value] : row.metrics) cell.values[name].push_back(value);
        cell.exposure = row.exposure;
        cell.noise = row.noise;
        cell.budget = row.budget;
        cell.deviation = row.deviation;
    }

    Cell finish() {
        cell.seeds = int(cell.times.size());
        if (cell.seeds == 0) return cell;
        cell.milliseconds = medianOf(cell.times);
        cell.fastest = std::ranges::min(cell.times);
        cell.slowest = std::ranges::max(cell.times);
        cell.rays = estimateMean(cell.rayCounts);
        for (const auto& [name, values] : cell.countValues) cell.counts[name] = estimateMean(values);
        for (const std::string& name : passOrder) {
            PassSummary& pass = cell.passes.emplace_back(passes[name]);
            pass.name = name;
            for (double* sum : {&pass.milliseconds, &pass.rays}) *sum /= cell.seeds;
            for (auto& [purpose, sum] : pass.purposes) sum /= cell.seeds;
        }
        for (const auto& [name, values] : cell.values) {
            const auto shared = cell.deviation.find(name);
            cell.metrics[name] = withSharedError(estimateMean(values), shared == cell.deviation.end() ? 0 : shared->second);
        }
        return cell;
    }
};

}  // namespace

std::set<std::string> finishedRuns(const Study& study, const std::vector<ResultRow>& rows) {
    std::map<std::string, std::set<int>> offsets;
    for (const ResultRow& row : rows) offsets[row.run].insert(row.offset);
    std::set<std::string> finished;
    for (const auto& [run, measured] : offsets)
        if (std::ranges::all_of(study.measure, [&there = measured](int offset) { return there.contains(offset); })) finished.insert(run);
    return finished;
}

Summary summarize(const Study& study, const std::vector<StudyRun>& runs, const std::vector<std::string>& names,
                  const std::vector<ResultRow>& rows) {
    Summary summary;
    const std::set<std::string> finished = finishedRuns(study, rows), wanted(names.begin(), names.end());
    std::map<std::pair<std::string, int>, const ResultRow*> found;
    for (const ResultRow& row : rows) {
        if (wanted.contains(row.run))
            found[{row.run, row.offset}] = &row;
        else
            ++summary.foreign;
    }
    std::map<std::string, std::size_t> places;
    std::vector<Samples> all;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const StudyRun& run = runs[i];
        const std::string key = configurationKey(run);
        const auto [place, isNew] = places.emplace(key, all.size());
        if (isNew)
            for (const int offset : study.measure)
                all.push_back({.cell = {.scene = run.scene, .technique = run.technique, .knobs = run.knobs, .offset = offset}});
        if (!finished.contains(names[i])) {
            ++summary.missing;
            continue;
        }
        for (std::size_t frame = 0; frame < study.measure.size(); ++frame) {
            const ResultRow& row = *found.at({names[i], study.measure[frame]});
            all[place->second + frame].add(row);
            summary.devices.insert(row.device);
        }
    }
    for (Samples& samples : all) summary.cells.push_back(samples.finish());
    summary.comparisons = compareCells(study, summary.cells);
    summary.exponents = exponentsOf(study, summary.cells);
    summary.outcomes = judgeOutcomes(study, summary.cells);
    return summary;
}

}  // namespace lodestir
