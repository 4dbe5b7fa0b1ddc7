// SPDX-License-Identifier: MIT
// The summary of a study of errors as tables for a terminal.
#include <framework/study/error/summary.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace lodestir {
namespace {

std::string textOf(const Estimate& e) { return std::isnan(e.halfWidth) ? fmt::format("{:.4g}", e.mean) : fmt::format("{:.4g} +- {:.2g}", e.mean, e.halfWidth); }

std::string textOf(const Difference& d) {
    if (std::isnan(d.estimate.halfWidth)) return fmt::format("{}{:.4g}", d.ratio ? "x " : "", d.middle());
    return fmt::format("{}{:.4g} ({:.4g} .. {:.4g}){}", d.ratio ? "x " : "", d.middle(), d.low(), d.high(), d.paired ? "" : "*");
}

class Tables {
public:
    Tables(const Study& study, const Summary& summary) : study_(study), summary_(summary) {
        for (const Cell& cell : summary.cells) width_ = std::max(width_, labelOf(study, cell).size());
    }

    std::string text() const {
        std::string text;
        for (std::size_t scene = 0; scene < study_.scenes.size(); ++scene)
            text += study_.scenes[scene].name + "\n" + errors(scene) + budgets(scene) + comparisons(scene) + exponents(scene) + decompositions(scene);
        return text;
    }

private:
    std::string start(const Cell& cell) const { return fmt::format("  {:<{}} {:>5}", labelOf(study_, cell), width_, cell.offset); }
    std::string heading(const char* what = "technique") const { return fmt::format("  {:<{}} {:>5}", what, width_, "frame"); }

    std::string errors(std::size_t scene) const {
        std::string text = heading() + fmt::format(" {:>5} {:>10} {:>10}", "seeds", "ms", "rays/px");
        for (const std::string& name : study_.countNames()) text += fmt::format(" {:>{}}", name, widthOf(name));
        for (const Measure& measure : measuresOf(study_)) text += fmt::format(" {:>30}", measure.name() + " +- 95 %");
        text += "\n";
        for (const Cell& cell : summary_.cells) {
            if (cell.scene != scene || cell.seeds == 0) continue;
            text += start(cell) + fmt::format(" {:>5} {:>10.4g} {:>10.4g}", cell.seeds, cell.milliseconds, cell.rays.mean / study_.scenes[scene].pixels());
            for (const std::string& name : study_.countNames()) text += fmt::format(" {:>{}.4g}", cell.counts.at(name).mean, widthOf(name));
            for (const Measure& measure : measuresOf(study_)) {
                const auto found = cell.metrics.find(measure.name());  // of a sequence, the first frame has none
                text += fmt::format(" {:>30}", found == cell.metrics.end() ? "-" : textOf(found->second));
            }
            text += "\n";
        }
        return text;
    }

    std::string budgets(std::size_t scene) const {
        std::string text;
        for (const Cell& cell : summary_.cells) {
            if (cell.scene != scene || !cell.budget || cell.seeds == 0) continue;
            const BudgetMet& met = *cell.budget;
            const double took = costOf(cell, scene);
            text += start(cell) + fmt::format(" {:.4g} when chosen, {:.4g} measured ({:+.1f} %){}\n", met.reached, took, 100 * (took / met.budget - 1),
                                              met.inRange ? "" : ": the budget is out of its knob's range");
        }
        if (text.empty()) return text;
        const double budget = std::ranges::find_if(summary_.cells, [&](const Cell& c) { return c.scene == scene && c.budget; })->budget->budget;
        return fmt::format("  given {:.4g} {}\n", budget, study_.equal->unit()) + text;
    }

    /// Of a count's column.
    static std::size_t widthOf(const std::string& name) { return std::max<std::size_t>(10, name.size()); }

    /// In the budget's unit.
    double costOf(const Cell& cell, std::size_t scene) const {
        switch (study_.equal->kind) {
            case Budget::Kind::time: return cell.milliseconds;
            case Budget::Kind::rays: return cell.rays.mean / study_.scenes[scene].pixels();
            case Budget::Kind::steps: return cell.counts.at(std::string(stepsName)).mean;
        }
        return 0;
    }

    std::string row(const Comparison& comparison, const std::string& label) const {
        std::string text = fmt::format("  {:<{}} {:>5}", label, width_, summary_.cells[comparison.cell].offset);
        for (const Measure& measure : measuresOf(study_)) {
            const auto found = comparison.metrics.find(measure.name());
            text += fmt::format(" {:>30}", found == comparison.metrics.end() ? "-" : textOf(found->second));
        }
        return text + fmt::format(" {:>30} {:>30}\n", textOf(comparison.milliseconds), textOf(comparison.rays));
    }

    /// Those against one cell of the baseline's or, of its ablations, by what they lose, the dearest first.
    std::string comparisons(std::size_t scene) const {
        std::vector<std::vector<const Comparison*>> groups;
        for (const Comparison& comparison : summary_.comparisons) {
            if (summary_.cells[comparison.cell].scene != scene) continue;
            const auto isSame = [&](const auto& group) {
                return isAblation(*group.front()) == isAblation(comparison) &&
                       summary_.cells[group.front()->baseline].technique == summary_.cells[comparison.baseline].technique;
            };
            const auto group = std::ranges::find_if(groups, isSame);
            if (group == groups.end()) groups.push_back({&comparison});
            else group->push_back(&comparison);
        }
        std::string text;
        for (auto& group : groups) {
            const Comparison& first = *group.front();
            const bool ablation = isAblation(first);
            text += fmt::format("  {} \"{}\", 95 %{}\n", ablation ? "without parts of" : "against",
                                study_.techniques[summary_.cells[first.baseline].technique].name,
                                std::ranges::all_of(group, isPaired) ? ", seed by seed" : " (*: seeds of their own)");
            text += heading(ablation ? "without" : "technique");
            for (const Measure& measure : measuresOf(study_)) text += fmt::format(" {:>30}", measure.name());
            text += fmt::format(" {:>30} {:>30}\n", "ms", "rays");
            if (ablation) std::ranges::stable_sort(group, std::ranges::greater(), [&](const Comparison* c) { return lossOf(*c); });
            for (const Comparison* comparison : group) text += row(*comparison, nameOf(*comparison));
        }
        return text;
    }
    bool isAblation(const Comparison& c) const { return study_.techniques[summary_.cells[c.cell].technique].ablation.has_value(); }
    static bool isPaired(const Comparison* c) { return c->rays.paired; }
    /// Of the first metric over the whole frame, by whose middle the parts are ranked.
    double lossOf(const Comparison& c) const {
        const auto found = c.metrics.find(study_.metrics.front());
        return found == c.metrics.end() ? 0 : found->second.middle();
    }
    std::string nameOf(const Comparison& c) const {
        const Cell& cell = summary_.cells[c.cell];
        const auto& ablation = study_.techniques[cell.technique].ablation;
        if (!ablation) return labelOf(study_, cell);
        std::string parts;
        for (const std::string& part : ablation->parts) parts += (parts.empty() ? "" : " and ") + part;
        const std::string knobs = knobText(cell.knobs);
        return parts + (knobs.empty() ? "" : ", " + knobs);
    }

    std::string exponents(std::size_t scene) const {
        std::string text;
        for (const Exponent& exponent : summary_.exponents) {
            const Cell& cell = summary_.cells[exponent.cell];
            if (cell.scene != scene) continue;
            const std::span knobs(cell.knobs);
            text += fmt::format("  {}: {} ~ {}^({})\n", labelOf(study_, cell.technique, exponent.over.empty() ? knobs : knobs.first(knobs.size() - 1)),
                                exponent.metric, exponent.over.empty() ? "frames" : exponent.over, textOf(exponent.estimate));
        }
        return text;
    }

    std::string decompositions(std::size_t scene) const {
        std::string text;
        for (const Decomposition& parts : summary_.decompositions) {
            const Cell& cell = summary_.cells[parts.cell];
            if (cell.scene != scene) continue;
            text += start(cell) + fmt::format(" {}: squared bias {}, variance {}\n", parts.metric, textOf(parts.bias), textOf(parts.variance));
        }
        return text;
    }

    const Study& study_;
    const Summary& summary_;
    std::size_t width_ = 9;
};

}  // namespace

std::string summaryText(const Study& study, const Summary& summary) { return Tables(study, summary).text(); }

}  // namespace lodestir
