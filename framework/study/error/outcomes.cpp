// SPDX-License-Identifier: MIT
#include <framework/core/error.h>
#include <framework/image/temporal.h>
#include <framework/scene/fields.h>
#include <framework/study/error/outcomes.h>
#include <framework/study/error/summary.h>
#include <framework/study/named.h>
#include <framework/study/run_list.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

namespace lodestir {
namespace {

const std::vector<std::string> quantityNames{"spike", "recovery", "popping", "energy", "baseline"};

class OutcomeReader {
public:
    OutcomeReader(const Study& study, Problems& problems) : study_(study), problems_(problems) {}

    OutcomeRules read(const Json& json) {
        Fields fields(json, "\"outcomes\"", problems_);
        std::string baseline;
        fields.text("baseline", baseline);
        if (const Json* name = fields.find("baseline"))
            problems_.attempt([&] {
                rules_.baseline = indexNamed<&Technique::name>(study_.techniques, baseline, "technique", name->where());
                if (study_.techniques[*rules_.baseline].vary.size() > 1)
                    throw Error(name->where(), "several knobs of the baseline vary", "one is enough to find its error at any rays");
            });
        if (const Json* cases = fields.require("cases"))
            problems_.attempt([&] {
                for (const Json& item : cases->items("\"cases\"")) readCase(item);
                if (rules_.cases.empty()) throw Error(cases->where(), "there are no cases");
            });
        fields.finish();
        return std::move(rules_);
    }

private:
    void readCase(const Json& json) {
        Fields fields(json, "a case", problems_);
        FailureCase rule{.where = json.where()};
        fields.require("name"), fields.text("name", rule.name);
        std::string scene;
        fields.text("scene", scene);
        if (const Json* name = fields.require("scene"))
            problems_.attempt([&] { rule.scene = indexNamed<&StudyScene::name>(study_.scenes, scene, "scene", name->where()); });
        std::size_t quantity = 0;
        if (fields.require("quantity")) fields.choice("quantity", quantity, quantityNames);
        rule.quantity = StabilityQuantity(quantity);
        fields.text("measure", rule.measure);
        if (const Json* name = fields.require("measure")) problems_.attempt([&] { checkMeasure(rule, *name); });
        if (const Json* limits = fields.require("limits"))
            problems_.attempt([&] {
                const std::vector<double> numbers = numbersOf(*limits, "\"limits\"", 2);
                rule.limits = {numbers[0], numbers[1]};
                if (!(numbers[0] < numbers[1]))
                    throw Error(limits->where(), "\"limits\" must rise", "a technique holds up to the first and fails above the second");
            });
        fields.finish();
        rules_.cases.push_back(std::move(rule));
    }

    void checkMeasure(const FailureCase& rule, const Json& name) const {
        const std::vector<Measure> measures = measuresOf(study_);
        const std::string& metric = measures[indexNamed<&Measure::name>(measures, rule.measure, "measure", name.where())].metric;
        const auto demand = [&](StabilityQuantity quantity, const char* of) {
            if (rule.quantity == quantity && metric != of)
                throw Error(name.where(), fmt::format("\"{}\" is made of {}, not of {}", nameOf(quantity), of, metric));
        };
        demand(StabilityQuantity::popping, "step_flip");
        demand(StabilityQuantity::energy, "bias");
        if (rule.quantity == StabilityQuantity::baseline && !rules_.baseline)
            throw Error(name.where(), "there is no baseline to hold it against", "name a technique as \"baseline\"");
        const bool comparesBefore =
            rule.quantity == StabilityQuantity::spike || rule.quantity == StabilityQuantity::recovery || rule.quantity == StabilityQuantity::popping;
        // What is measured of steps begins with the second of two frames in a row.
        const auto has = [&](int offset) { return study_.isMeasured(offset) && (!isTemporal(metric) || study_.isMeasured(offset - 1)); };
        if (comparesBefore && std::ranges::none_of(study_.measure, [&](int offset) { return offset < 0 && has(offset); }))
            throw Error(name.where(), fmt::format("{} is never measured before the event", rule.measure),
                        isTemporal(metric) ? "add -2 and -1 to \"measure\"" : "add -1 to \"measure\"");
        if (!has(0)) throw Error(name.where(), fmt::format("{} isn't measured at the event", rule.measure), "add 0 to \"measure\"");
        if (rule.quantity == StabilityQuantity::recovery && study_.measure.back() == 0)
            throw Error(name.where(), "no frame after the event is measured, in which it could recover");
    }

    const Study& study_;
    Problems& problems_;
    OutcomeRules rules_;
};

Outcome outcomeOf(const FailureCase& rule, double value) {
    return value <= rule.limits[0] ? Outcome::holds : value <= rule.limits[1] ? Outcome::strained : Outcome::fails;
}

std::optional<StabilityNumber> quantityOf(StabilityQuantity quantity, const Course& course, const std::vector<Course>& baselines) {
    switch (quantity) {
    case StabilityQuantity::spike: return spikeHeight(course);
    case StabilityQuantity::recovery: return recoveryTime(course);
    case StabilityQuantity::popping: return poppingIndex(course);
    case StabilityQuantity::energy: return energyError(course);
    case StabilityQuantity::baseline: return errorAgainst(course, baselines);
    }
    return {};
}

/// A technique with values of its knobs, but for what was solved for, which differs from scene to scene.
std::string columnOf(const Study& study, const Cell& cell) {
    return labelOf(study, cell.technique, std::span(cell.knobs).first(study.techniques[cell.technique].vary.size()));
}

/// What a case is judged by, of each column; of columns that the case's measure was taken of.
std::map<std::string, Course> coursesOf(const FailureCase& rule, const Study& study, const std::vector<Cell>& cells) {
    std::map<std::string, Course> courses;
    for (const Cell& cell : cells) {
        const auto found = cell.values.find(rule.measure);
        if (cell.scene != rule.scene || found == cell.values.end()) continue;
        Course& course = courses[columnOf(study, cell)];
        course.offsets.push_back(cell.offset);
        course.values.push_back(found->second);
        const auto deviation = cell.deviation.find(rule.measure);
        course.deviations.push_back(deviation == cell.deviation.end() ? 0 : deviation->second);
        course.rays.push_back(cell.rays.mean / study.scenes[cell.scene].pixels());
    }
    return courses;
}

}  // namespace

OutcomeRules readOutcomes(const Json& json, const Study& study, Problems& problems) { return OutcomeReader(study, problems).read(json); }

std::string_view nameOf(StabilityQuantity quantity) { return quantityNames[std::size_t(quantity)]; }

std::string_view nameOf(Outcome outcome) {
    constexpr std::string_view names[] = {"holds", "strained", "fails"};
    return names[std::size_t(outcome)];
}

OutcomeCell judge(const FailureCase& rule, const StabilityNumber& number) {
    StabilityNumber size = number;
    if (rule.quantity == StabilityQuantity::energy) {  // too dark is as bad as too bright
        size.value = std::abs(number.value);
        size.high = std::max(std::abs(number.low), std::abs(number.high));
        size.low = number.low * number.high <= 0 ? 0 : std::min(std::abs(number.low), std::abs(number.high));
    }
    const Outcome outcome = outcomeOf(rule, size.value);
    const bool hasInterval = !std::isnan(size.low) && !std::isnan(size.high);
    return {number, outcome, hasInterval && outcomeOf(rule, size.low) == outcome && outcomeOf(rule, size.high) == outcome};
}

OutcomeMatrix judgeOutcomes(const Study& study, const std::vector<Cell>& cells) {
    OutcomeMatrix matrix;
    if (!study.outcomes) return matrix;
    std::vector<std::string> ofBaseline;  // columns
    for (const Cell& cell : cells) {
        const std::string column = columnOf(study, cell);
        if (std::ranges::find(matrix.columns, column) != matrix.columns.end()) continue;
        matrix.columns.push_back(column);
        if (study.outcomes->baseline == cell.technique) ofBaseline.push_back(column);
    }
    for (const FailureCase& rule : study.outcomes->cases) {
        const std::map<std::string, Course> courses = coursesOf(rule, study, cells);
        std::vector<Course> baselines;
        for (const std::string& column : ofBaseline)
            if (const auto course = courses.find(column); course != courses.end()) baselines.push_back(course->second);
        auto& row = matrix.rows.emplace_back();
        for (const std::string& column : matrix.columns) {
            row.emplace_back();
            const auto course = courses.find(column);
            if (course == courses.end()) continue;
            const bool isBaseline = std::ranges::find(ofBaseline, column) != ofBaseline.end();
            const bool hasBaseline = !baselines.empty() && baselines.size() == ofBaseline.size();
            if (rule.quantity == StabilityQuantity::baseline && (isBaseline || !hasBaseline)) continue;
            if (const auto number = quantityOf(rule.quantity, course->second, baselines)) row.back() = judge(rule, *number);
        }
    }
    return matrix;
}

std::string numberText(const FailureCase& rule, const StabilityNumber& number) {
    const bool hasInterval = !std::isnan(number.low) && !std::isnan(number.high);
    if (rule.quantity == StabilityQuantity::recovery) {
        const auto frames = [](double value) { return std::isinf(value) ? std::string("unsettled") : fmt::format("{:.0f}", value); };
        return frames(number.value) + (hasInterval && number.low != number.high ? fmt::format(" ({} to {})", frames(number.low), frames(number.high)) : "");
    }
    const double unit = rule.quantity == StabilityQuantity::energy ? 100 : 1;
    const char* sign = rule.quantity == StabilityQuantity::energy ? " %" : "";
    if (!hasInterval) return fmt::format("{:.3g}{}", unit * number.value, sign);
    return fmt::format("{:.3g} +- {:.2g}{}", unit * number.value, unit * (number.high - number.low) / 2, sign);
}

std::string outcomesText(const Study& study, const OutcomeMatrix& matrix) {
    if (!study.outcomes) return {};
    std::vector<std::vector<std::string>> lines{{"case", "scene", "quantity", "limits"}};
    for (const std::string& column : matrix.columns) lines.front().push_back(column);
    for (std::size_t i = 0; i < matrix.rows.size(); ++i) {
        const FailureCase& rule = study.outcomes->cases[i];
        lines.push_back({rule.name, study.scenes[rule.scene].name, fmt::format("{}, {}", nameOf(rule.quantity), rule.measure),
                         fmt::format("{:g}, {:g}", rule.limits[0], rule.limits[1])});
        for (const std::optional<OutcomeCell>& cell : matrix.rows[i])
            lines.back().push_back(cell ? fmt::format("{}{} {}", nameOf(cell->outcome), cell->certain ? "" : "?", numberText(rule, cell->number)) : "-");
    }
    std::vector<std::size_t> widths(lines.front().size());
    for (const auto& line : lines)
        for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
    std::string text = "outcomes (?: the 95 % interval reaches another; -: not measured, or at rays that the baseline has no error at)\n";
    for (const auto& line : lines) {
        for (std::size_t i = 0; i < line.size(); ++i) text += fmt::format("  {:<{}}", line[i], widths[i]);
        text.erase(text.find_last_not_of(' ') + 1);
        text += "\n";
    }
    return text;
}

}  // namespace lodestir
