// SPDX-License-Identifier: MIT
#include <framework/study/report/chart.h>
#include <framework/study/ensemble/report.h>
#include <framework/study/report/page.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace lodestir {
namespace {

constexpr double mapTop = 5;  // sigmas that have full colour
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

std::string percent(double share) { return std::isfinite(share) ? fmt::format("{:+.3f} %", 100 * share) : "unknown"; }

double differenceOf(const EnsembleCell& cell) { return cell.result.tests.energy[0].difference / cell.result.referenceEnergy[0]; }

std::string roleOf(const Technique& technique) { return technique.control ? "control" : technique.planted ? "planted fault" : ""; }

/// Of the colour that differs most, block by block.
std::vector<double> worstOfBlocks(const EnsembleTests& tests) {
    std::vector<double> worst;
    for (std::size_t block = 0; 3 * block < tests.blocks.size(); ++block) {
        const auto first = tests.blocks.begin() + std::ptrdiff_t(3 * block);
        worst.push_back(std::min_element(first, first + 3, [](const MeanTest& a, const MeanTest& b) { return a.p < b.p; })->t);
    }
    return worst;
}

class EnsembleReport {
public:
    EnsembleReport(const Study& study, const EnsembleSummary& summary) : study_(study), summary_(summary) {}

    std::string page() const {
        std::string html = conditions();
        for (std::size_t scene = 0; scene < study_.scenes.size(); ++scene) html += sceneSection(scene);
        return pageHtml(study_.file.stem().string(), study_.about, html);
    }

private:
    std::string conditions() const {
        std::string device;
        for (const std::string& name : summary_.devices) device += (device.empty() ? "" : " and ") + name;
        std::string html = fmt::format(
            "<p class=\"note\">{} × {} pixels; {} independent runs of each technique, whose measured frames ({} of warm-up before frame 0) "
            "are averaged and "
            "held against a path-traced reference of {} samples a pixel in {} batches; on {}. Two tests, each blaming correct code once in "
            "a thousand: of the "
            "energy (luminance and the three colours), and of the means of blocks of {} × {} pixels and three colours. Both are Welch's t "
            "over runs, corrected "
            "for skewness (Johnson 1978, Hall 1992), with Bonferroni's correction; the reference's noise counts. <b>Unbiased</b>: neither "
            "test rejects, the "
            "energy is known to ±{:g} % (95 %), and planted faults that such an interval promises to show are caught at least 95 times in "
            "100. "
            "<b>Inconclusive</b> is a failure, too.",
            study_.sizes.front().x, study_.sizes.front().y, study_.seeds.size(), study_.warmup, study_.referenceSamples, batchesOf(study_),
            escapeHtml(device.empty() ? "no device yet" : device), blockSize, blockSize, 100 * study_.halfWidth);
        html += study_.paired
                    ? " Every technique draws the same seeds: differences between techniques can be taken run by run, and what all of them "
                      "show alike is one observation."
                    : " Every technique and value of a knob draws seeds of its own.";
        html +=
            " All are held against one draw of a scene's reference, whose error they share: signs that agree within its noise say nothing.";
        if (summary_.missing > 0) html += fmt::format(" <b>{} chunks of runs are still missing.</b>", summary_.missing);
        return html + "</p>\n";
    }

    std::string nameOf(const EnsembleCell& cell) const {
        return labelOf(study_, cell) + (study_.measure.size() > 1 ? fmt::format(", frame {}", cell.offset) : "");
    }

    std::string sceneSection(std::size_t scene) const {
        std::vector<const EnsembleCell*> cells;
        for (const EnsembleCell& cell : summary_.cells)
            if (cell.scene == scene && cell.complete) cells.push_back(&cell);
        std::string html = fmt::format("<h2>{}</h2>\n", escapeHtml(study_.scenes[scene].name));
        if (cells.empty()) return html + "<p>Nothing to judge yet.</p>\n";
        return html + verdicts(cells) + "<div class=\"charts\">\n" + intervals(cells) + "</div>\n" + maps(cells) + convergence(cells) + power(cells);
    }

    std::string verdicts(const std::vector<const EnsembleCell*>& cells) const {
        std::string html =
            "<table><tr><th>technique</th><th>role</th><th>runs</th><th>verdict</th><th>energy against the reference</th><th>p of "
            "energy</th><th>p of "
            "blocks</th><th>ms</th><th>rays a pixel</th><th class=\"reason\">because</th></tr>\n";
        for (const EnsembleCell* cell : cells) {
            const EnsembleResult& r = cell->result;
            html += fmt::format(
                "<tr><td>{}</td><td>{}</td><td>{}</td><td class=\"{}\">{}</td><td>{} <span class=\"pm\">± {:.3f} "
                "%</span></td><td>{:.2g}</td><td>{:.2g}</td>"
                "<td>{:.4g}</td><td>{:.4g}</td><td class=\"reason\">{}</td></tr>\n",
                escapeHtml(nameOf(*cell)), roleOf(study_.techniques[cell->technique]), r.runs, lodestir::nameOf(r.verdict), lodestir::nameOf(r.verdict),
                percent(differenceOf(*cell)), 100 * r.halfWidth, r.tests.energyP, r.tests.blockP, cell->milliseconds,
                cell->rays / study_.scenes[cell->scene].pixels(), escapeHtml(r.reason));
        }
        html += "</table>\n<p class=\"note\">The reference's halves differ by ";
        std::map<int, double> halves;
        for (const EnsembleCell* cell : cells) halves[cell->offset] = cell->halvesSigmas;
        bool first = true;
        for (const auto& [offset, sigmas] : halves) {
            html +=
                fmt::format("{}{:+.2f} sigmas{}", first ? "" : ", ", sigmas, halves.size() > 1 ? fmt::format(" (frame {})", offset) : "");
            first = false;
        }
        return html + ".</p>\n";
    }

    std::string intervals(const std::vector<const EnsembleCell*>& cells) const {
        std::vector<Interval> all;
        for (const EnsembleCell* cell : cells)
            all.push_back(
                {.name = nameOf(*cell),
                 .about = fmt::format("{}: {} ± {:.3f} %", nameOf(*cell), percent(differenceOf(*cell)), 100 * cell->result.halfWidth),
                 .value = 100 * differenceOf(*cell),
                 .halfWidth = 100 * cell->result.halfWidth,
                 .good = cell->result.verdict == Verdict::unbiased});
        return drawIntervals("Energy against the reference, 95 % intervals",
                             "difference of mean luminance, % (band: the half-width asked for)", all, 100 * study_.halfWidth);
    }

    std::string maps(const std::vector<const EnsembleCell*>& cells) const {
        std::string html =
            "<h3>Blocks</h3>\n<p class=\"note\">Sigmas of each block's mean against the reference's, in the colour that differs most: red "
            "is too "
            "bright, blue too dark, full colour at 5.</p>\n<div class=\"maps\">\n";
        for (const EnsembleCell* cell : cells)
            html += drawGrid(nameOf(*cell), cell->result.grid.columns(), worstOfBlocks(cell->result.tests), mapTop);
        return html + "</div>\n";
    }

    std::string convergence(const std::vector<const EnsembleCell*>& cells) const {
        LineChart chart{
            .title = "Error of the mean over runs", .xLabel = "time of the frame in all runs, ms", .yLabel = "RelMSE of luminance", .logX = true, .logY = true};
        std::string rows;
        for (const EnsembleCell* cell : cells) {
            if (!cell->convergence) continue;
            const Convergence& c = *cell->convergence;
            ChartSeries series{.name = nameOf(*cell)};
            for (const Convergence::Point& point : c.points)
                series.points.push_back({.x = point.runs * cell->milliseconds,
                                         .y = point.error,
                                         .low = unknown,
                                         .high = unknown,
                                         .left = unknown,
                                         .right = unknown,
                                         .about = fmt::format("{}: {} runs, {:.4g}", nameOf(*cell), point.runs, point.error)});
            chart.series.push_back(std::move(series));
            rows += fmt::format("<tr><td>{}</td><td>{:.4g}</td><td>{:.2g}{}</td><td>{:.2f} %</td><td>{:.2f} %</td></tr>\n", escapeHtml(nameOf(*cell)), c.noise,
                                c.bias, std::isnan(c.biasDeviation) ? "" : fmt::format(" <span class=\"pm\">± {:.2g}</span>", 2 * c.biasDeviation),
                                100 * c.difference, 100 * c.differenceOfNoise);
        }
        if (rows.empty()) return {};
        return "<h3>Convergence</h3>\n<div class=\"charts\">\n" + drawLines(chart) +
               "</div>\n<table><tr><th>technique</th><th>noise of a run</th><th>bias</th><th>mean difference</th><th>that of noise</th></tr>\n" + rows +
               "</table>\n<p class=\"note\">Of luminance, by pixel; the reference's noise is taken out, so that what has no bias may fall below 0. Noise "
               "of a run and bias are RelMSE: by the spread of the runs, and of the mean over endlessly many (± two standard deviations, by leaving out "
               "chunks of runs). One run's error is their sum, that of the mean over n runs noise / n + bias. Mean difference: "
               "|mean over all runs - reference| / reference; beside it what noise alone makes of it.</p>\n";
    }

    std::string power(const std::vector<const EnsembleCell*>& cells) const {
        const auto sound = std::ranges::find_if(cells, [](const EnsembleCell* cell) { return !cell->result.faults.empty(); });
        if (sound == cells.end()) return {};
        std::string html = "<h3>Power</h3>\n<table><tr><th>technique</th>";
        for (const PlantedFault& fault : (*sound)->result.faults)
            html += fmt::format("<th>{:g} % {}</th>", 100 * fault.size, fault.block ? "in one block" : "everywhere");
        html += "<th>false alarms</th></tr>\n";
        for (const EnsembleCell* cell : cells) {
            if (cell->result.faults.empty()) continue;  // its values are not finite
            html += fmt::format("<tr><td>{}</td>", escapeHtml(nameOf(*cell)));
            for (const PlantedFault& fault : cell->result.faults)
                html +=
                    fmt::format("<td{}>{:.1f} %</td>", fault.needed && fault.caught < 0.95 ? " class=\"biased\"" : "", 100 * fault.caught);
            html += fmt::format("<td>{:.1f} %</td></tr>\n", 100 * cell->result.falseAlarms);
        }
        return html + fmt::format(
                          "</table>\n<p class=\"note\">Share of bootstrapped ensembles in which a fault is seen that was put in on "
                          "purpose; its size is a share of the "
                          "whole image's energy, appearing or lost. Faults of {:g} % and more have to be seen. False alarms: the same "
                          "without a fault; "
                          "0.2 % are expected.</p>\n",
                          300 * study_.halfWidth);
    }

    const Study& study_;
    const EnsembleSummary& summary_;
};

}  // namespace

namespace {

/// How large the error of a run is, and how much of it stays in the mean of all.
std::string convergenceText(const Study& study, const EnsembleSummary& summary, std::size_t scene, std::size_t width) {
    std::string text;
    for (const EnsembleCell& cell : summary.cells) {
        if (cell.scene != scene || !cell.convergence) continue;
        const Convergence& c = *cell.convergence;
        if (text.empty())
            text = fmt::format("  {:<{}} {:>5} {:>10} {:>12} {:>24} {:>22}\n", "RelMSE of luminance", width, "frame", "rays/px", "noise of run",
                               "bias +- 2 sigmas", "|difference| (noise)");
        text += fmt::format("  {:<{}} {:>5} {:>10.4g} {:>12.4g} {:>24} {:>22}\n", labelOf(study, cell), width, cell.offset,
                            cell.rays / study.scenes[scene].pixels(), c.noise,
                            std::isnan(c.biasDeviation) ? fmt::format("{:.2g}", c.bias) : fmt::format("{:.2g} +- {:.2g}", c.bias, 2 * c.biasDeviation),
                            fmt::format("{:.2f} % ({:.2f} %)", 100 * c.difference, 100 * c.differenceOfNoise));
    }
    return text;
}

}  // namespace

std::string ensembleText(const Study& study, const EnsembleSummary& summary) {
    std::string text;
    std::size_t width = std::string_view("RelMSE of luminance").size();
    for (const EnsembleCell& cell : summary.cells) width = std::max(width, labelOf(study, cell).size());
    for (std::size_t scene = 0; scene < study.scenes.size(); ++scene) {
        text += fmt::format("{}\n  {:<{}} {:>5} {:>5}  {:<12} {:>22}  because\n", study.scenes[scene].name, "technique", width, "frame",
                            "runs", "verdict", "energy +- 95 %");
        for (const EnsembleCell& cell : summary.cells) {
            if (cell.scene != scene || !cell.complete) continue;
            const EnsembleResult& r = cell.result;
            const std::string role = roleOf(study.techniques[cell.technique]);
            text += fmt::format("  {:<{}} {:>5} {:>5}  {:<12} {:>22}  {}{}\n", labelOf(study, cell), width, cell.offset, r.runs,
                                nameOf(r.verdict), fmt::format("{} +- {:.3f}", percent(differenceOf(cell)), 100 * r.halfWidth),
                                role.empty() ? "" : "(" + role + ") ", r.reason);
        }
        text += convergenceText(study, summary, scene, width);
    }
    return text;
}

std::string ensembleHtml(const Study& study, const EnsembleSummary& summary) { return EnsembleReport(study, summary).page(); }

}  // namespace lodestir
