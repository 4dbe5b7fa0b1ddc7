// SPDX-License-Identifier: MIT
#include <framework/study/ensemble/results.h>
#include <framework/study/results.h>
#include <framework/study/error/summary.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace lodestir {
namespace {

using OrderedJson = nlohmann::ordered_json;

/// With no more digits than a 32-bit number has; null where it isn't finite.
OrderedJson shortened(double value) {
    if (!std::isfinite(value)) return nullptr;
    return std::stod(fmt::format("{}", float(value)));
}

/// The chunks of one configuration, in order.
struct Group {
    EnsembleChunk chunk;
    std::vector<std::string> names;
};

std::vector<Group> groupsOf(const std::vector<EnsembleChunk>& chunks, const std::vector<std::string>& names) {
    std::vector<Group> groups;
    for (std::size_t i = 0; i < chunks.size(); ++i) {
        if (groups.empty() || !groups.back().chunk.isSeriesOf(chunks[i])) groups.push_back({chunks[i], {}});
        groups.back().names.push_back(names[i]);
    }
    return groups;
}

using RowsByChunk = std::map<std::pair<std::string, int>, const EnsembleRow*>;

/// What a group measured of a frame, all its chunks joined.
EnsembleRow joined(const Group& group, int offset, const RowsByChunk& rows) {
    EnsembleRow whole;
    for (const std::string& name : group.names) {
        const EnsembleRow& row = *rows.at({name, offset});
        const double before = double(whole.means.runs()), more = double(row.means.runs());
        whole.milliseconds = (whole.milliseconds * before + row.milliseconds * more) / (before + more);
        whole.rays = (whole.rays * before + row.rays * more) / (before + more);
        whole.means.append(row.means);
    }
    return whole;
}

double halvesSigmas(const BlockMeans& reference) {
    Moments halves[2];
    for (std::size_t run = 0; run < reference.runs(); ++run) halves[2 * run / reference.runs()].add(energyOf(reference, run)[0]);
    return compareMeans(halves[0], halves[1], 0).t;
}

}  // namespace

OrderedJson toJson(const EnsembleRow& row) {
    OrderedJson means = OrderedJson::array();
    const std::size_t width = 3 * row.means.grid.count();
    for (std::size_t run = 0; run < row.means.runs(); ++run) {
        OrderedJson values = OrderedJson::array();
        for (std::size_t i = 0; i < width; ++i) values.push_back(shortened(row.means.values[run * width + i]));
        means.push_back(std::move(values));
    }
    return {{"scene", row.scene},
            {"technique", row.technique.empty() ? OrderedJson(nullptr) : OrderedJson(row.technique)},
            {"knobs", row.knobs},
            {"frame", row.offset},
            {"first", row.first},
            {"size", {row.means.grid.width, row.means.grid.height}},
            {"ms", row.milliseconds},
            {"rays", row.rays},
            {"device", row.device},
            {"run", row.run},
            {"blockMeans", std::move(means)}};
}

EnsembleRow ensembleRowOf(const OrderedJson& json) {
    EnsembleRow row{
        .run = json.at("run"), .scene = json.at("scene"), .knobs = json.at("knobs"), .offset = json.at("frame"), .first = json.at("first")};
    if (!json.at("technique").is_null()) row.technique = json.at("technique");
    row.means.grid = {json.at("size").at(0), json.at("size").at(1)};
    row.milliseconds = json.at("ms");
    row.rays = json.at("rays");
    row.device = json.at("device");
    for (const OrderedJson& run : json.at("blockMeans"))
        for (std::size_t i = 0; i < 3 * row.means.grid.count(); ++i)
            row.means.values.push_back(run.at(i).is_null() ? std::numeric_limits<double>::quiet_NaN() : run.at(i).get<double>());
    return row;
}

std::vector<EnsembleRow> readEnsembleRows(const Path& folder) {
    std::vector<EnsembleRow> rows;
    readLines(folder, [&](const OrderedJson& line) { rows.push_back(ensembleRowOf(line)); });
    return rows;
}

bool EnsembleSummary::failed(const Study& study) const {
    return std::ranges::any_of(cells, [&](const EnsembleCell& cell) {
        return cell.complete && !study.techniques[cell.technique].planted && cell.result.verdict != Verdict::unbiased;
    });
}

std::set<std::string> finishedChunks(const Study& study, const std::vector<EnsembleRow>& rows) {
    std::map<std::string, std::set<int>> offsets;
    for (const EnsembleRow& row : rows) offsets[row.run].insert(row.offset);
    std::set<std::string> finished;
    for (const auto& [run, measured] : offsets)
        if (std::ranges::all_of(study.measure, [&there = measured](int offset) { return there.contains(offset); })) finished.insert(run);
    return finished;
}

EnsembleSummary summarizeEnsemble(const Study& study, const std::vector<EnsembleChunk>& chunks, const std::vector<std::string>& names,
                                  const std::vector<EnsembleRow>& rows) {
    EnsembleSummary summary;
    const std::set<std::string> finished = finishedChunks(study, rows), wanted(names.begin(), names.end());
    RowsByChunk found;
    for (const EnsembleRow& row : rows) {
        if (wanted.contains(row.run)) {
            found[{row.run, row.offset}] = &row;
            summary.devices.insert(row.device);
        } else {
            ++summary.foreign;
        }
    }
    summary.missing = std::size_t(std::ranges::count_if(names, [&](const std::string& name) { return !finished.contains(name); }));
    const auto isThere = [&](const Group& group) {
        return std::ranges::all_of(group.names, [&](const std::string& name) { return finished.contains(name); });
    };
    std::map<int, EnsembleRow> references;  ///< of the scene at hand
    Group reference;
    for (const Group& group : groupsOf(chunks, names)) {
        if (!group.chunk.technique) {
            reference = group;
            references.clear();
            if (isThere(group))
                for (const int offset : study.measure) references[offset] = joined(group, offset, found);
            continue;
        }
        for (const int offset : study.measure) {
            EnsembleCell cell{.scene = group.chunk.scene,
                              .technique = *group.chunk.technique,
                              .knobs = group.chunk.knobs,
                              .offset = offset,
                              .chunks = group.names,
                              .referenceChunks = reference.names,
                              .complete = isThere(group) && references.contains(offset)};
            if (cell.complete) {
                const EnsembleRow measured = joined(group, offset, found);
                cell.milliseconds = measured.milliseconds;
                cell.rays = measured.rays;
                cell.halvesSigmas = halvesSigmas(references[offset].means);
                cell.result = judgeEnsemble(measured.means, references[offset].means, {.halfWidth = study.halfWidth});
            }
            summary.cells.push_back(std::move(cell));
        }
    }
    return summary;
}

}  // namespace lodestir
