// SPDX-License-Identifier: MIT
#include <framework/image/metrics.h>
#include <framework/image/temporal.h>
#include <framework/study/report/chart.h>
#include <framework/study/error/halves.h>
#include <framework/study/report/page.h>
#include <framework/study/report/report.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace lodestir {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::string list(const std::vector<std::string>& parts) {
    std::string text;
    for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
    return text;
}

std::string estimateHtml(const Estimate& e) {
    if (std::isnan(e.halfWidth)) return fmt::format("{:.4g}", e.mean);
    return fmt::format("{:.4g} <span class=\"pm\">± {:.2g}</span>", e.mean, e.halfWidth);
}

/// A measure as an axis has it, with its unit.
std::string axisName(const Measure& measure) {
    const std::string_view unit = scaleOf(measure.metric).unit;
    return unit.empty() ? measure.name() : fmt::format("{}, {}", measure.name(), unit);
}

using Cells = std::vector<const Cell*>;

class Report {
public:
    struct ChartKind {
        std::string_view name;
        std::string (*draw)(const Report& report, const Measure& measure, const Cells& cells);
        bool once = false;  ///< of no measure; else there is one of each
    };
    static std::span<const ChartKind> chartKinds() {
        static constexpr ChartKind kinds[] = {
            {"error_vs_time", [](const Report& r, const Measure& m, const Cells& c) { return r.errorAlong(m, c, true); }},
            {"error_vs_rays", [](const Report& r, const Measure& m, const Cells& c) { return r.errorAlong(m, c, false); }},
            {"error_vs_frame", [](const Report& r, const Measure& m, const Cells& c) { return r.measuresFrames() ? r.errorByFrame(m, c, false) : ""; }},
            {"time_by_pass", [](const Report& r, const Measure&, const Cells& c) { return r.costByPass(c, true); }, true},
            {"rays_by_pass", [](const Report& r, const Measure&, const Cells& c) { return r.costByPass(c, false); }, true},
            {"stability", [](const Report& r, const Measure& m,
                             const Cells& c) { return r.measuresFrames() && scaleOf(m.metric).fromZero ? r.errorByFrame(m, c, true) : ""; }},
        };
        return kinds;
    }

    Report(const Study& study, const Summary& summary) : study_(study), summary_(summary) {
        for (const std::string& device : summary.devices) device_ += (device_.empty() ? "" : " and ") + device;
        // The frame that charts without a frame axis show: the event's own, else the last.
        const bool hasEvent = std::ranges::find(study.measure, 0) != study.measure.end();
        shown_ = hasEvent ? 0 : study.measure.back();
    }

    std::string page() const {
        std::string html = conditions();
        for (std::size_t scene = 0; scene < study_.scenes.size(); ++scene) html += sceneSection(scene);
        if (study_.sizes.size() > 1) html += sizesSection();
        return pageHtml(study_.file.stem().string(), study_.about, html);
    }

private:
    double pixelsOf(const Cell& cell) const { return study_.scenes[cell.scene].pixels(); }
    double raysOf(const Cell& cell) const { return cell.rays.mean / pixelsOf(cell); }

    std::string conditions() const {
        std::vector<std::string> sizes;
        for (const glm::uvec2 size : study_.sizes) sizes.push_back(fmt::format("{} × {}", size.x, size.y));
        std::string html = fmt::format(
            "<p class=\"note\">{} pixels, {} seeds, measured on {}. Times are the device's own and medians over seeds (bars: fastest "
            "to slowest), errors are means over "
            "seeds with 95 % intervals of Student's t. References have {} samples a pixel",
            list(sizes), study_.seeds.size(), escapeHtml(device_.empty() ? "no device yet" : device_), study_.referenceSamples);
        std::vector<std::string> clean, noisy;
        for (const std::string& metric : study_.metrics) (isNoiseFree(metric) ? clean : noisy).push_back(metric);
        html += " in two independent halves A and B";
        if (!clean.empty())
            html += fmt::format(
                "; {} {} the mean of (x − A)(x − B), which the noise of the reference does not raise (and which may fall below 0 where the "
                "error is far smaller than that noise)",
                list(clean), clean.size() == 1 ? "is" : "are");
        html += ". All seeds are judged by one reference: intervals tell the spread of the technique";
        html += std::ranges::find(study_.metrics, "bias") == study_.metrics.end() ? " and not of the reference."
                                                                                  : ", those of bias the reference's noise as well.";
        html += study_.paired
                    ? " Every technique draws the same seeds, so that differences between techniques can be taken run by run; what all of "
                      "them show alike is one observation."
                    : " Every technique and value of a knob draws seeds of its own.";
        if (!noisy.empty())
            html += fmt::format(" {} {} measured against (A + B) / 2 and include that image's noise.", list(noisy),
                                noisy.size() == 1 ? "is" : "are");
        if (study_.warmup > 0) html += fmt::format(" Frames of warm-up before frame 0: {}.", study_.warmup);
        if (device_.find("llvmpipe") != std::string::npos) html += " Times on a CPU driver say nothing of a GPU; rays and ratios do.";
        if (summary_.missing > 0) html += fmt::format(" <b>{} runs are still missing.</b>", summary_.missing);
        html += "</p>\n<ul class=\"note\">\n";
        for (const std::string& metric : study_.metrics)
            html +=
                fmt::format("<li><b>{}</b>: {}</li>\n", escapeHtml(metric), escapeHtml(isTemporal(metric) ? temporalMetricAbout(metric) : metricAbout(metric)));
        for (const Mask& mask : study_.masks)
            html += fmt::format("<li><b>.{}</b>: only where {}</li>\n", escapeHtml(mask.name),
                                mask.graph ? "the study's mask isn't 0" : "objects are seen that take another level at frame 0 or later");
        if (study_.referenceFinest)
            html += "<li><b>.finest</b>: against the scene at its finest levels, so that what a coarser level loses counts too</li>\n";
        return html + "</ul>\n";
    }

    std::string labelOf(const Cell& cell, std::size_t knobs) const {
        const std::string text = knobText(cell.knobs, knobs);
        return study_.techniques[cell.technique].name + (text.empty() ? "" : ", " + text);
    }
    std::string labelOf(const Cell& cell) const { return labelOf(cell, cell.knobs.size()); }
    /// Of the curve that a cell is a point of: its last knob runs along it.
    std::string curveOf(const Cell& cell) const { return labelOf(cell, cell.knobs.empty() ? 0 : cell.knobs.size() - 1); }

    std::string sceneSection(std::size_t scene) const {
        std::vector<const Cell*> cells;
        for (const Cell& cell : summary_.cells)
            if (cell.scene == scene && cell.seeds > 0) cells.push_back(&cell);
        std::string html = fmt::format("<h2>{}</h2>\n", escapeHtml(study_.scenes[scene].name));
        if (cells.empty()) return html + "<p>Nothing measured yet.</p>\n";
        html += "<div class=\"charts\">\n";
        for (const std::string& chart : study_.charts) html += charts(chart, cells);
        return html + "</div>\n" + table(cells);
    }

    std::string table(const Cells& cells) const {
        std::string html =
            "<table><tr><th>technique</th><th>frame</th><th>seeds</th><th>ms</th><th>fastest – slowest</th><th>rays a pixel</th>";
        for (const Measure& measure : measuresOf(study_)) html += fmt::format("<th>{}</th>", escapeHtml(measure.name()));
        html += "</tr>\n";
        for (const Cell* cell : cells) {
            html += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{:.4g}</td><td>{:.4g} – {:.4g}</td><td>{:.4g}</td>", escapeHtml(labelOf(*cell)),
                                cell->offset, cell->seeds, cell->milliseconds, cell->fastest, cell->slowest, raysOf(*cell));
            for (const Measure& measure : measuresOf(study_)) {
                const auto found = cell->metrics.find(measure.name());
                html += found != cell->metrics.end() ? fmt::format("<td>{}</td>", estimateHtml(found->second)) : "<td></td>";
            }
            html += "</tr>\n";
        }
        std::string noise;
        for (const auto& [name, value] : cells.front()->noise) noise += fmt::format("{}{} {:.3g}", noise.empty() ? "" : ", ", name, value);
        html += "</table>\n";
        return noise.empty()
                   ? html
                   : html + fmt::format("<p class=\"note\">Noise of the reference itself, taken out above: {}.</p>\n", escapeHtml(noise));
    }

    std::string charts(const std::string& name, const Cells& cells) const {
        const auto kind = std::ranges::find(chartKinds(), name, &ChartKind::name);
        if (kind->once) return (kind->draw)(*this, {}, cells);
        std::string html;
        for (const Measure& measure : measuresOf(study_)) html += (kind->draw)(*this, measure, cells);
        return html;
    }

    bool measuresFrames() const { return study_.measure.size() > 1; }

    static ChartSeries& seriesNamed(std::vector<ChartSeries>& all, const std::string& name) {
        const auto found = std::ranges::find(all, name, &ChartSeries::name);
        return found != all.end() ? *found : all.emplace_back(ChartSeries{name, {}});
    }

    static ChartPoint pointOf(double x, const Estimate& e, std::string about) {
        const bool hasInterval = !std::isnan(e.halfWidth);
        return {.x = x,
                .y = e.mean,
                .low = hasInterval ? e.mean - e.halfWidth : nan,
                .high = hasInterval ? e.mean + e.halfWidth : nan,
                .left = nan,
                .right = nan,
                .about = std::move(about)};
    }

    /// What a metric of sequences says first is said of the frame after the first.
    int shownOf(const std::string& metric, const Cells& cells) const {
        const auto has = [&](const Cell* cell) { return cell->offset >= shown_ && cell->metrics.contains(metric); };
        const auto found = std::ranges::find_if(cells, has);
        return found == cells.end() ? shown_ : (*found)->offset;
    }

    std::string errorAlong(const Measure& measure, const Cells& cells, bool time) const {
        const std::string metric = measure.name();
        const int shown = shownOf(metric, cells);
        LineChart chart{.title = metric + (time ? " against time" : " against rays") +
                                 (study_.measure.size() > 1 ? fmt::format(", frame {}", shown) : ""),
                        .xLabel = time ? "time of the frame, ms (" + device_ + ")" : "rays a pixel",
                        .yLabel = axisName(measure),
                        .logX = true,
                        .logY = scaleOf(measure.metric).fromZero};
        for (const Cell* cell : cells) {
            if (cell->offset != shown || !cell->metrics.contains(metric)) continue;
            const Estimate& e = cell->metrics.at(metric);
            ChartPoint point = pointOf(time ? cell->milliseconds : raysOf(*cell), e,
                                       fmt::format("{}: {:.4g} ms, {:.4g} rays a pixel, {} {:.4g} ± {:.2g}", labelOf(*cell), cell->milliseconds, raysOf(*cell),
                                                   metric, e.mean, e.halfWidth));
            if (time) point.left = cell->fastest, point.right = cell->slowest;
            seriesNamed(chart.series, curveOf(*cell)).points.push_back(std::move(point));
        }
        return drawLines(chart);
    }

    /// `relative`: the error as a multiple of the first measured frame's, which shows what an event does to a technique whatever its level.
    std::string errorByFrame(const Measure& measure, const Cells& cells, bool relative) const {
        const std::string metric = measure.name();
        const auto known = std::ranges::find_if(cells, [&](const Cell* cell) { return cell->metrics.contains(metric); });
        const int start = known == cells.end() ? study_.measure.front() : (*known)->offset;
        LineChart chart{.title = relative ? fmt::format("Stability: {} against that of frame {}", metric, start)
                                          : metric + " against the frame",
                        .xLabel = "frame, counted from the event",
                        .yLabel = relative ? metric + ", ratio" : axisName(measure),
                        .logX = false,
                        .logY = scaleOf(measure.metric).fromZero};
        const Cell* first = nullptr;
        for (const Cell* cell : cells) {
            if (cell->offset == start) first = cell;
            if (!first || !cell->metrics.contains(metric)) continue;
            const Estimate e = relative ? estimateRatio(cell->values.at(metric), first->values.at(metric)) : cell->metrics.at(metric);
            seriesNamed(chart.series, labelOf(*cell))
                .points.push_back(pointOf(cell->offset, e,
                                          fmt::format("{}, frame {}: {:.4g} ± {:.2g}", labelOf(*cell), cell->offset, e.mean, e.halfWidth)));
        }
        return drawLines(chart);
    }

    std::string costByPass(const Cells& cells, bool time) const {
        std::vector<Bar> bars;
        for (const Cell* cell : cells) {
            if (cell->offset != shown_) continue;
            Bar bar{.name = labelOf(*cell)};
            for (const PassSummary& pass : cell->passes) bar.parts.push_back({pass.name, time ? pass.milliseconds : pass.rays / pixelsOf(*cell)});
            bars.push_back(std::move(bar));
        }
        return drawBars(std::string(time ? "Time by pass" : "Rays by pass") + (measuresFrames() ? fmt::format(", frame {}", shown_) : ""),
                        time ? "mean time, ms (" + device_ + ")" : "rays a pixel", bars);
    }

    /// Of each scene file: what a frame takes at the sizes of its image.
    std::string sizesSection() const {
        std::string html = "<h2>Cost with resolution</h2>\n<div class=\"charts\">\n";
        for (std::size_t first = 0; first < study_.scenes.size(); first += study_.sizes.size())
            for (const bool time : {true, false}) {
                LineChart chart{.title = fmt::format("{}: {} of a frame against pixels", study_.scenes[first].file.stem().string(), time ? "time" : "rays"),
                                .xLabel = "pixels of the frame",
                                .yLabel = time ? "time of the frame, ms (" + device_ + ")" : "rays a pixel",
                                .logX = true,
                                .logY = time};
                for (const Cell& cell : summary_.cells) {
                    if (cell.seeds == 0 || cell.offset != shown_ || cell.scene < first || cell.scene >= first + study_.sizes.size()) continue;
                    const double value = time ? cell.milliseconds : raysOf(cell);
                    const std::string about = fmt::format("{}: {} pixels, {:.4g} {}", labelOf(cell), pixelsOf(cell), value, time ? "ms" : "rays a pixel");
                    ChartPoint point{.x = pixelsOf(cell), .y = value, .low = nan, .high = nan, .left = nan, .right = nan, .about = about};
                    if (time) point.low = cell.fastest, point.high = cell.slowest;
                    seriesNamed(chart.series, labelOf(cell)).points.push_back(std::move(point));
                }
                html += drawLines(chart);
            }
        return html + "</div>\n";
    }

    const Study& study_;
    const Summary& summary_;
    std::string device_;
    int shown_ = 0;
};

}  // namespace

std::vector<std::string> chartNames() {
    std::vector<std::string> names;
    for (const auto& kind : Report::chartKinds()) names.emplace_back(kind.name);
    return names;
}

std::string reportHtml(const Study& study, const Summary& summary) { return Report(study, summary).page(); }

}  // namespace lodestir
