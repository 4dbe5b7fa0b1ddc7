// SPDX-License-Identifier: MIT
#include <framework/study/report/summary_json.h>

#include <framework/image/temporal.h>
#include <framework/study/error/halves.h>
#include <framework/study/report/images.h>

#include <lodestir/revision.h>
#include <nlohmann/json.hpp>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <span>

#include <unistd.h>

namespace lodestir {
namespace {

using OrderedJson = nlohmann::ordered_json;

std::string machineName() {
    std::array<char, 256> name{};
    return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

OrderedJson sceneJson(const StudyScene& scene) { return {{"name", scene.name}, {"file", scene.file.stem().string()}, {"size", {scene.size.x, scene.size.y}}}; }

OrderedJson techniqueJson(const Technique& technique) {
    OrderedJson knobs = OrderedJson::array(), set = OrderedJson::object();
    for (const Knob& knob : technique.vary) knobs.push_back(knob.name);
    for (const Setting& setting : technique.graph.set) set[setting.name] = setting.value.plain();
    return {{"name", technique.name},
            {"graph", technique.graph.graph.filename().string()},
            {"variant", technique.graph.variant ? OrderedJson(*technique.graph.variant) : OrderedJson(nullptr)},
            {"set", std::move(set)},
            {"knobs", std::move(knobs)},
            {"control", technique.control},
            {"planted", technique.planted}};
}

OrderedJson metricJson(const Measure& measure) {
    const MetricScale scale = scaleOf(measure.metric);
    const bool temporal = isTemporal(measure.metric);
    return {{"name", measure.name()},
            {"metric", measure.metric},
            {"unit", scale.unit},
            {"fromZero", scale.fromZero},
            {"about", temporal ? temporalMetricAbout(measure.metric) : metricAbout(measure.metric)},
            {"noiseFree", isNoiseFree(measure.metric)},
            {"temporal", temporal},
            {"mask", measure.mask},
            {"finest", measure.finest}};
}

/// What the numbers were measured under.
OrderedJson studyJson(const Study& study, const std::set<std::string>& devices, std::size_t missing, std::size_t foreign) {
    OrderedJson scenes = OrderedJson::array(), techniques = OrderedJson::array(), metrics = OrderedJson::array();
    for (const StudyScene& scene : study.scenes) scenes.push_back(sceneJson(scene));
    for (const Technique& technique : study.techniques) techniques.push_back(techniqueJson(technique));
    for (const Measure& measure : measuresOf(study)) metrics.push_back(metricJson(measure));
    const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
    return {{"format", 1},
            {"kind", study.kind == StudyKind::error ? "error" : "ensemble"},
            {"study", study.file.stem().string()},
            {"about", study.about},
            {"lodestir", LODESTIR_VERSION},
            {"revision", LODESTIR_REVISION},
            {"date", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::chrono::system_clock::to_time_t(now)))},
            {"machine", machineName()},
            {"devices", devices},
            {"scenes", std::move(scenes)},
            {"seeds", study.seeds.size()},
            {"paired", study.paired},
            {"warmup", study.warmup},
            {"event", study.event},
            {"frames", study.measure},
            {"referenceSamples", study.referenceSamples},
            {"techniques", std::move(techniques)},
            {"metrics", std::move(metrics)},
            {"counts", study.countNames()},
            {"charts", study.charts},
            {"missing", missing},
            {"foreign", foreign}};
}

OrderedJson toJson(const Estimate& estimate) { return {{"mean", estimate.mean}, {"halfWidth", estimate.halfWidth}}; }

OrderedJson cellJson(const Study& study, std::size_t scene, std::size_t technique, const std::vector<Setting>& knobs, int offset) {
    return {{"scene", study.scenes[scene].name}, {"technique", study.techniques[technique].name}, {"knobs", knobJson(knobs)}, {"frame", offset}};
}

OrderedJson cellJson(const Study& study, const Cell& cell) { return cellJson(study, cell.scene, cell.technique, cell.knobs, cell.offset); }

/// Of a ratio the ratio itself and the ends of its interval.
OrderedJson toJson(const Difference& difference) {
    return {
        {"ratio", difference.ratio}, {"paired", difference.paired}, {"middle", difference.middle()}, {"low", difference.low()}, {"high", difference.high()}};
}

OrderedJson comparisonJson(const Study& study, const Summary& summary, const Comparison& comparison) {
    const Cell &cell = summary.cells[comparison.cell], &baseline = summary.cells[comparison.baseline];
    OrderedJson json = cellJson(study, cell), metrics = OrderedJson::object();
    json["baseline"] = {{"technique", study.techniques[baseline.technique].name}, {"knobs", knobJson(baseline.knobs)}};
    const auto& ablation = study.techniques[cell.technique].ablation;
    json["without"] = ablation ? OrderedJson(ablation->parts) : OrderedJson(nullptr);
    for (const auto& [name, difference] : comparison.metrics) metrics[name] = toJson(difference);
    json["metrics"] = std::move(metrics);
    json["ms"] = toJson(comparison.milliseconds);
    json["rays"] = toJson(comparison.rays);
    return json;
}

/// `start`: the measured frames of the same configuration.
OrderedJson cellJson(const Study& study, const Cell& cell, std::span<const Cell> start) {
    OrderedJson json = cellJson(study, cell);
    json["seeds"] = cell.drawn;
    json["runs"] = cell.runs;
    if (cell.seeds == 0) return json;
    json["ms"] = {{"median", cell.milliseconds}, {"fastest", cell.fastest}, {"slowest", cell.slowest}};
    json["rays"] = toJson(cell.rays);
    OrderedJson passes = OrderedJson::object(), metrics = OrderedJson::object();
    for (const PassSummary& pass : cell.passes) passes[pass.name] = {{"ms", pass.milliseconds}, {"rays", pass.purposes}};
    json["passes"] = std::move(passes);
    OrderedJson counts = OrderedJson::object();
    for (const auto& [name, estimate] : cell.counts) counts[name] = toJson(estimate);
    json["counts"] = std::move(counts);
    for (const auto& [name, estimate] : cell.metrics) {
        OrderedJson metric = toJson(estimate);
        metric["values"] = cell.values.at(name);
        const auto first = std::ranges::find_if(start, [&](const Cell& earlier) { return earlier.values.contains(name); });
        metric["againstStart"] = toJson(estimateRatio(cell.values.at(name), first->values.at(name)));
        metrics[name] = std::move(metric);
    }
    json["metrics"] = std::move(metrics);
    json["referenceNoise"] = cell.noise;
    json["exposure"] = cell.exposure;
    if (cell.budget) json["budget"] = {{"given", cell.budget->budget}, {"reached", cell.budget->reached}, {"inRange", cell.budget->inRange}};
    if (cell.offset == study.measure.back())
        for (std::size_t i = 0; i < cell.drawn.size(); ++i) {
            const StudyRun run{cell.scene, cell.technique, cell.knobs, cell.drawn[i]};
            if (isShown(study, run)) json["image"] = shownImageFile(study, run, cell.runs[i]).string();
        }
    return json;
}

/// The mean over the measured frames of one configuration, seed by seed; `cells` are of these frames.
OrderedJson sequenceJson(const Study& study, std::span<const Cell> cells) {
    OrderedJson json = cellJson(study, cells[0].scene, cells[0].technique, cells[0].knobs, 0), metrics = OrderedJson::object();
    json.erase("frame");
    for (const Measure& measure : measuresOf(study)) {
        std::vector<double> sums(cells[0].drawn.size());
        int frames = 0;
        for (const Cell& cell : cells) {
            const auto found = cell.values.find(measure.name());
            if (found == cell.values.end()) continue;  // of a step, and the first frame of it
            for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += found->second[i];
            ++frames;
        }
        for (double& sum : sums) sum /= frames;
        if (frames > 0) metrics[measure.name()] = toJson(estimateMean(sums));
    }
    json["metrics"] = std::move(metrics);
    return json;
}

/// Of the colour that differs most, block by block.
std::vector<double> worstOfBlocks(const EnsembleTests& tests) {
    std::vector<double> worst;
    for (std::size_t block = 0; 3 * block < tests.blocks.size(); ++block) {
        const auto first = tests.blocks.begin() + std::ptrdiff_t(3 * block);
        worst.push_back(std::min_element(first, first + 3, [](const MeanTest& a, const MeanTest& b) { return a.p < b.p; })->t);
    }
    return worst;
}

OrderedJson toJson(const EnsembleResult& result) {
    OrderedJson energy = OrderedJson::object(), faults = OrderedJson::array();
    for (std::size_t i = 0; i < energyNames.size(); ++i) {
        const MeanTest& test = result.tests.energy[i];
        energy[energyNames[i]] = {{"mean", result.energy[i]},
                                  {"reference", result.referenceEnergy[i]},
                                  {"difference", test.difference / result.referenceEnergy[i]},
                                  {"halfWidth", test.halfWidth() / std::abs(result.referenceEnergy[i])},
                                  {"sigmas", test.t}};
    }
    for (const PlantedFault& fault : result.faults)
        faults.push_back({{"size", fault.size}, {"block", fault.block}, {"caught", fault.caught}, {"needed", fault.needed}});
    return {{"verdict", nameOf(result.verdict)},
            {"reason", result.reason},
            {"runs", result.runs},
            {"batches", result.batches},
            {"energy", std::move(energy)},
            {"energyP", result.tests.energyP},
            {"blockP", result.tests.blockP},
            {"blockColumns", result.grid.columns()},
            {"blockSigmas", worstOfBlocks(result.tests)},
            {"faults", std::move(faults)},
            {"falseAlarms", result.falseAlarms}};
}

OrderedJson toJson(const Convergence& convergence) {
    OrderedJson points = OrderedJson::array();
    for (const Convergence::Point& point : convergence.points) points.push_back({{"runs", point.runs}, {"relmse", point.error}});
    return {{"noise", convergence.noise},
            {"bias", convergence.bias},
            {"biasDeviation", convergence.biasDeviation},
            {"difference", convergence.difference},
            {"differenceOfNoise", convergence.differenceOfNoise},
            {"points", std::move(points)}};
}

OrderedJson cellJson(const Study& study, const EnsembleCell& cell) {
    OrderedJson json = cellJson(study, cell.scene, cell.technique, cell.knobs, cell.offset);
    json["complete"] = cell.complete;
    json["chunks"] = cell.chunks;
    if (!cell.complete) return json;
    json["ms"] = cell.milliseconds;
    json["rays"] = cell.rays;
    json["halvesSigmas"] = cell.halvesSigmas;
    json.update(toJson(cell.result));
    if (cell.convergence) {
        json["convergence"] = toJson(*cell.convergence);
        json["image"] = ensembleImageFile(study, cell).string();
    }
    return json;
}

/// Cases by technique; null where a study has no rules.
OrderedJson outcomesJson(const Study& study, const OutcomeMatrix& matrix) {
    if (!study.outcomes) return nullptr;
    OrderedJson cases = OrderedJson::array();
    for (std::size_t i = 0; i < matrix.rows.size(); ++i) {
        const FailureCase& rule = study.outcomes->cases[i];
        OrderedJson cells = OrderedJson::array();
        for (const std::optional<OutcomeCell>& cell : matrix.rows[i])
            cells.push_back(cell ? OrderedJson{{"outcome", nameOf(cell->outcome)}, {"certain", cell->certain}, {"text", numberText(rule, cell->number)}}
                                 : OrderedJson(nullptr));
        cases.push_back({{"name", rule.name},
                         {"scene", study.scenes[rule.scene].name},
                         {"quantity", nameOf(rule.quantity)},
                         {"measure", rule.measure},
                         {"limits", rule.limits},
                         {"cells", std::move(cells)}});
    }
    return {{"columns", matrix.columns}, {"cases", std::move(cases)}};
}

}  // namespace

OrderedJson summaryJson(const Study& study, const Summary& summary) {
    OrderedJson json = studyJson(study, summary.devices, summary.missing, summary.foreign);
    for (std::size_t i = 0; i < study.scenes.size(); ++i) json["scenes"][i]["reference"] = shownReferenceFile(study, i).string();
    json["baseline"] = study.techniques[study.baseline].name;
    if (study.equal) json["equal"] = study.equal->unit();
    json["outcomes"] = outcomesJson(study, summary.outcomes);
    const std::size_t frames = study.measure.size();
    OrderedJson cells = OrderedJson::array();
    for (std::size_t i = 0; i < summary.cells.size(); ++i)
        cells.push_back(cellJson(study, summary.cells[i], std::span(summary.cells).subspan(i / frames * frames, frames)));
    json["cells"] = std::move(cells);
    OrderedJson sequences = OrderedJson::array();
    for (std::size_t i = 0; i < summary.cells.size(); i += frames) sequences.push_back(sequenceJson(study, std::span(summary.cells).subspan(i, frames)));
    json["sequences"] = std::move(sequences);
    for (const char* name : {"comparisons", "exponents", "decompositions"}) json[name] = OrderedJson::array();
    for (const Comparison& comparison : summary.comparisons) json["comparisons"].push_back(comparisonJson(study, summary, comparison));
    for (const Exponent& exponent : summary.exponents) {
        OrderedJson one = cellJson(study, summary.cells[exponent.cell]);
        one.update({{"over", exponent.over}, {"metric", exponent.metric}, {"exponent", toJson(exponent.estimate)}});
        json["exponents"].push_back(std::move(one));
    }
    for (const Decomposition& parts : summary.decompositions) {
        OrderedJson one = cellJson(study, summary.cells[parts.cell]);
        one.update({{"metric", parts.metric}, {"squaredBias", toJson(parts.bias)}, {"variance", toJson(parts.variance)}});
        json["decompositions"].push_back(std::move(one));
    }
    return json;
}

OrderedJson summaryJson(const Study& study, const EnsembleSummary& summary) {
    OrderedJson json = studyJson(study, summary.devices, summary.missing, summary.foreign);
    json["halfWidth"] = study.halfWidth;
    json["blockSize"] = blockSize;
    json["batches"] = batchesOf(study);
    OrderedJson cells = OrderedJson::array();
    for (const EnsembleCell& cell : summary.cells) cells.push_back(cellJson(study, cell));
    json["cells"] = std::move(cells);
    for (std::size_t i = 0; i < study.scenes.size(); ++i) json["scenes"][i]["reference"] = ensembleReferenceFile(study, i, study.measure.back()).string();
    return json;
}

}  // namespace lodestir
