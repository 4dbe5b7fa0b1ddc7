// SPDX-License-Identifier: MIT
#include <framework/study/ensemble/report.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lodestir {
namespace {

std::string percent(double share) { return std::isfinite(share) ? fmt::format("{:+.3f} %", 100 * share) : "unknown"; }

double differenceOf(const EnsembleCell& cell) { return cell.result.tests.energy[0].difference / cell.result.referenceEnergy[0]; }

std::string roleOf(const Technique& technique) { return technique.control ? "control" : technique.planted ? "planted fault" : ""; }

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

}  // namespace lodestir
