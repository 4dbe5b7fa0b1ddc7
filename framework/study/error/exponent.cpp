// SPDX-License-Identifier: MIT
#include <framework/image/metrics.h>
#include <framework/study/error/exponent.h>

#include <algorithm>
#include <set>

namespace lodestir {
namespace {

constexpr std::size_t least = 3;  // points: two lie on a line whatever they are

using Points = std::vector<std::size_t>;  ///< cells

void addExponents(std::vector<Exponent>& exponents, const std::vector<Cell>& cells, const Points& points, const std::vector<double>& x,
                  const std::string& over) {
    if (std::set<double>(x.begin(), x.end()).size() < least || std::ranges::any_of(x, [](double v) { return !(v > 0); })) return;
    const Cell& first = cells[points.front()];
    for (const auto& [metric, values] : first.values) {
        if (!scaleOf(metric.substr(0, metric.find('.'))).fromZero) continue;
        std::vector<std::vector<double>> runs(values.size());
        bool whole = true;
        for (const std::size_t point : points) {
            const auto found = cells[point].values.find(metric);
            whole = whole && found != cells[point].values.end() && found->second.size() == runs.size() &&
                    std::ranges::all_of(found->second, [](double v) { return v > 0; });
            if (!whole) break;
            for (std::size_t i = 0; i < runs.size(); ++i) runs[i].push_back(found->second[i]);
        }
        if (whole) exponents.push_back({points.front(), over, metric, estimateExponent(x, runs)});
    }
}

/// But for the last knob.
bool sameButLast(const Cell& a, const Cell& b) {
    if (a.scene != b.scene || a.technique != b.technique || a.offset != b.offset) return false;
    for (std::size_t i = 0; i + 1 < a.knobs.size(); ++i)
        if (a.knobs[i].value.dump(-1) != b.knobs[i].value.dump(-1)) return false;
    return true;
}

}  // namespace

std::vector<Exponent> exponentsOf(const Study& study, const std::vector<Cell>& cells) {
    std::vector<Exponent> exponents;
    std::vector<bool> seen(cells.size());
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (seen[i] || cells[i].seeds == 0 || study.techniques[cells[i].technique].vary.empty()) continue;
        Points points;
        std::vector<double> x;
        for (std::size_t j = i; j < cells.size(); ++j) {
            if (!sameButLast(cells[i], cells[j])) continue;
            seen[j] = true;
            if (!cells[j].knobs.back().value.isNumber()) continue;
            points.push_back(j);
            x.push_back(cells[j].knobs.back().value.asNumber());
        }
        if (!points.empty() && !study.techniques[cells[i].technique].solve) addExponents(exponents, cells, points, x, cells[i].knobs.back().name);
    }
    const std::size_t frames = study.measure.size();
    if (frames < least) return exponents;
    for (std::size_t i = 0; i + frames <= cells.size(); i += frames) {  // frames of one configuration stand together
        if (cells[i].seeds == 0 || !study.techniques[cells[i].technique].clear.empty()) continue;
        Points points;
        std::vector<double> x;
        for (std::size_t frame = 0; frame < frames; ++frame) {
            points.push_back(i + frame);
            x.push_back(study.warmup + study.measure[frame] + 1);
        }
        addExponents(exponents, cells, points, x, {});
    }
    return exponents;
}

}  // namespace lodestir
