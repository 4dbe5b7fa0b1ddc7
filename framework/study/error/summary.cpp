// SPDX-License-Identifier: MIT
#include <framework/study/error/summary.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lodestir {
namespace {

struct Samples {
    Cell cell;
    std::vector<double> milliseconds, rays;
    std::map<std::string, std::pair<double, double>> passes;  ///< sums of milliseconds and rays
    std::vector<std::string> passOrder;

    void add(const ResultRow& row) {
        milliseconds.push_back(row.milliseconds);
        rays.push_back(double(row.rays()));
        for (const PassCost& pass : row.passes) {
            const auto [place, isNew] = passes.try_emplace(pass.name);
            if (isNew) passOrder.push_back(pass.name);
            place->second.first += pass.milliseconds;
            for (const auto& [purpose, count] : pass.rays) place->second.second += double(count);
        }
        for (const auto& [name, value] : row.metrics) cell.values[name].push_back(value);
        cell.noise = row.noise;
        cell.deviation = row.deviation;
    }

    Cell finish() {
        cell.seeds = int(milliseconds.size());
        if (cell.seeds == 0) return cell;
        cell.milliseconds = medianOf(milliseconds);
        cell.fastest = std::ranges::min(milliseconds);
        cell.slowest = std::ranges::max(milliseconds);
        cell.rays = estimateMean(rays);
        for (const std::string& name : passOrder)
            cell.passes.push_back({name, passes[name].first / cell.seeds, passes[name].second / cell.seeds});
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
        const std::string key = fmt::format("{} {} {}", run.scene, run.technique, knobJson(run.knobs).dump());
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
    summary.outcomes = judgeOutcomes(study, summary.cells);
    return summary;
}

std::string labelOf(const Study& study, const Cell& cell) {
    const std::string knobs = knobText(cell.knobs, cell.knobs.size());
    return study.techniques[cell.technique].name + (knobs.empty() ? "" : ", " + knobs);
}

std::string knobText(const std::vector<Setting>& knobs, std::size_t count) {
    std::string text;
    for (std::size_t i = 0; i < std::min(count, knobs.size()); ++i) {
        const Json& value = knobs[i].value;
        text += fmt::format("{}{} {}", i == 0 ? "" : ", ", knobs[i].name.substr(knobs[i].name.find('.') + 1),
                            value.isString() ? value.asString() : value.dump(-1));
    }
    return text;
}

std::string summaryText(const Study& study, const Summary& summary) {
    std::string text;
    std::size_t width = 9;
    for (const Cell& cell : summary.cells) width = std::max(width, labelOf(study, cell).size());
    for (std::size_t scene = 0; scene < study.scenes.size(); ++scene) {
        text += fmt::format("{}\n  {:<{}} {:>5} {:>5} {:>10} {:>10}", study.scenes[scene].name, "technique", width, "frame", "seeds", "ms",
                            "rays/px");
        for (const Measure& measure : measuresOf(study)) text += fmt::format(" {:>30}", measure.name() + " +- 95 %");
        text += "\n";
        for (const Cell& cell : summary.cells) {
            if (cell.scene != scene || cell.seeds == 0) continue;
            text += fmt::format("  {:<{}} {:>5} {:>5} {:>10.4g} {:>10.4g}", labelOf(study, cell), width, cell.offset, cell.seeds, cell.milliseconds,
                                cell.rays.mean / study.scenes[scene].pixels());
            for (const Measure& measure : measuresOf(study)) {
                const auto found = cell.metrics.find(measure.name());
                if (found == cell.metrics.end()) {  // of a sequence, and the first of it
                    text += fmt::format(" {:>30}", "-");
                    continue;
                }
                const Estimate& e = found->second;
                text += fmt::format(" {:>30}", std::isnan(e.halfWidth) ? fmt::format("{:.4g}", e.mean)
                                                                       : fmt::format("{:.4g} +- {:.2g}", e.mean, e.halfWidth));
            }
            text += "\n";
        }
    }
    return text;
}

}  // namespace lodestir
