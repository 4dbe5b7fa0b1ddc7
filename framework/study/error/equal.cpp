// SPDX-License-Identifier: MIT
#include <framework/core/error.h>
#include <framework/core/is_file.h>
#include <framework/core/log.h>
#include <framework/study/content.h>
#include <framework/study/error/equal.h>
#include <framework/study/error/statistics.h>
#include <framework/study/frame_cost.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace lodestir {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr int timings = 3;  // runs whose median is a value's time: single ones are disturbed

/// A configuration that costs something: one with a knob to solve for, or the one whose cost is the budget.
struct Configuration {
    std::size_t scene = 0, technique = 0;
    std::vector<Setting> knobs;
    std::string key, name;  ///< name: hash of all that its cost depends on
};

double costOf(const StagedFrame& frame, Budget::Kind kind, double pixels) {
    switch (kind) {
        case Budget::Kind::time: return frame.report.milliseconds;
        case Budget::Kind::rays: return raysOf(frame.report) / pixels;
        case Budget::Kind::steps: return frame.counts.at(std::string(stepsName));
    }
    return 0;
}

/// In the budget's unit, of the measured frames.
double costOf(Stage& stage, const Study& study, StudyRun run) {
    std::vector<double> costs;
    const Budget::Kind kind = study.equal->kind;
    for (int i = 0; i < (kind == Budget::Kind::time ? timings : 1); ++i) {
        double sum = 0;
        const std::vector<StagedFrame> frames = stage.render(run);
        for (const StagedFrame& frame : frames) sum += costOf(frame, kind, study.scenes[run.scene].pixels());
        costs.push_back(sum / double(frames.size()));
    }
    return medianOf(costs);
}

/// equal.json: what was solved, by content.
class EqualFile {
public:
    explicit EqualFile(Path file) : file_(std::move(file)) {
        if (!isFile(file_)) return;
        try {
            json_ = OrderedJson::parse(readText(file_));
        } catch (const OrderedJson::exception&) {
            throw Error(Where{file_.string()}, "is no file of budgets", "remove it: they will be solved for again");
        }
    }
    const OrderedJson* find(const std::string& name) const { return json_.contains(name) ? &json_[name] : nullptr; }
    void add(const std::string& name, OrderedJson entry) {
        json_[name] = std::move(entry);
        writeFile(file_, json_.dump(1) + "\n");
    }

private:
    Path file_;
    OrderedJson json_ = OrderedJson::object();
};

OrderedJson toJson(const Solution& solution) {
    OrderedJson tried = OrderedJson::object();
    for (const auto& [value, cost] : solution.tried) tried[std::to_string(value)] = cost;
    return {{"value", solution.value}, {"reached", solution.reached}, {"inRange", solution.inRange}, {"tried", std::move(tried)}};
}

Solution solutionOf(const OrderedJson& json) {
    Solution solution{.value = json.at("value"), .reached = json.at("reached"), .inRange = json.at("inRange"), .tried = {}};
    for (const auto& [value, cost] : json.at("tried").items()) solution.tried[std::stoi(value)] = cost;
    return solution;
}

class Solver {
public:
    Solver(Stage& stage, const Study& study, StudyPlace& place) : stage_(stage), study_(study), place_(place), file_(place.out / "equal.json") {
        for (std::size_t technique = 0; technique < study.techniques.size(); ++technique)
            if (study.techniques[technique].name == study.equal->technique) named_ = technique;
    }

    Equal solve() {
        if (named_) solveAll(configurations(*named_), "budgets");
        std::vector<Configuration> all;
        for (std::size_t technique = 0; technique < study_.techniques.size(); ++technique)
            if (study_.techniques[technique].solve) std::ranges::move(configurations(technique), std::back_inserter(all));
        if (place_.problem.empty() && !place_.stops()) solveAll(all, "budgets' knobs");
        Equal equal;
        for (const Configuration& configuration : all) {
            const OrderedJson* entry = file_.find(configuration.name);
            if (!entry) continue;
            equal.entries[configuration.key] = {budgetOf(configuration.scene), solutionOf(*entry)};
            tell(configuration, equal.entries[configuration.key]);
        }
        return equal;
    }

private:
    std::vector<Configuration> configurations(std::size_t technique) {
        std::vector<Configuration> all;
        for (std::size_t scene = 0; scene < study_.scenes.size(); ++scene)
            for (auto& knobs : combinations(study_.techniques[technique]))
                all.push_back({scene, technique, knobs, configurationKey(scene, technique, knobs), {}});
        for (Configuration& configuration : all) configuration.name = nameOf(configuration);
        return all;
    }

    double budgetOf(std::size_t scene) {
        if (!named_) return study_.equal->value;
        const OrderedJson* entry = file_.find(nameOf({scene, *named_, {}, {}, {}}));
        return entry ? entry->at("cost").get<double>() : std::nan("");
    }

    std::string nameOf(const Configuration& configuration) {
        const Technique& technique = study_.techniques[configuration.technique];
        Hash hash;
        const StudyRun run{configuration.scene, configuration.technique, configuration.knobs, study_.seeds.front()};
        hash.add(stage_.nameOf(run)).addValue(int(study_.equal->kind));
        if (!technique.solve) return hash.hex();
        // What follows the knob is in no run's name before the knob has a value.
        for (const Alike& alike : technique.graph.alike) hash.add(alike.name + "\n" + alike.from + "\n");
        hash.add(technique.solve->name).addValue(technique.solve->low).addValue(technique.solve->high).addValue(budgetOf(configuration.scene));
        return hash.hex();
    }

    std::string solveOne(const Configuration& configuration) {
        const auto& solve = study_.techniques[configuration.technique].solve;
        StudyRun run{configuration.scene, configuration.technique, configuration.knobs, 0};
        run.seed = drawnSeed(study_, run.technique, run.knobs, study_.seeds.front());
        if (!solve) return OrderedJson{{"cost", costOf(stage_, study_, run)}}.dump();
        run.knobs.push_back({solve->name, {}});
        const auto cost = [&](int value) {
            run.knobs.back().value = Json(value);
            run.knobs.back().value.moveTo(solve->where);
            return costOf(stage_, study_, run);
        };
        return toJson(solveKnob(cost, solve->low, solve->high, budgetOf(configuration.scene))).dump();
    }

    void solveAll(std::vector<Configuration> configurations, const char* what) {
        const std::size_t all = configurations.size();
        std::erase_if(configurations, [&](const Configuration& c) { return file_.find(c.name) != nullptr; });
        if (configurations.empty()) return;
        if (place_.shard.count > 1 && study_.equal->kind == Budget::Kind::time)
            throw Error(study_.equal->where, "shards would each solve for a time of their own",
                        "run the study once without --shard first, as far as its first run");
        Work work{.what = what, .count = fmt::format("{} of {} {}", configurations.size(), all, what)};
        for (const Configuration& configuration : configurations) work.items.push_back({.group = configuration.scene, .scene = configuration.scene});
        work.open = [&] { return stage_.workDevice(); };
        work.make = [&](std::size_t item) { return solveOne(configurations[item]); };
        work.take = [&](std::size_t item, const std::string& text) {
            const Configuration& c = configurations[item];
            OrderedJson entry{{"scene", study_.scenes[c.scene].name}, {"technique", study_.techniques[c.technique].name}, {"knobs", knobJson(c.knobs)},
                              {"unit", study_.equal->unit()}};
            if (const auto& solve = study_.techniques[c.technique].solve) entry.update({{"solved", solve->name}, {"budget", budgetOf(c.scene)}});
            entry.update(OrderedJson::parse(text));
            file_.add(c.name, std::move(entry));
        };
        work.stops = place_.stops;
        place_.problem = doWork(work, place_.jobs);
    }

    void tell(const Configuration& configuration, const Equal::Entry& entry) const {
        const Technique& technique = study_.techniques[configuration.technique];
        const Solution& solution = entry.solution;
        if (!solution.inRange)
            log::warn("{}: \"{}\" can't cost {:.4g} {}: with {} {} it costs {:.4g}", study_.scenes[configuration.scene].name, technique.name, entry.budget,
                      study_.equal->unit(), technique.solve->name, solution.value, solution.reached);
    }

    Stage& stage_;
    const Study& study_;
    StudyPlace& place_;
    EqualFile file_;
    std::optional<std::size_t> named_;  ///< technique whose cost is the budget
};

}  // namespace

Solution solveKnob(const std::function<double(int)>& cost, int low, int high, double budget) {
    Solution solution;
    const auto at = [&](int value) {
        const auto [place, isNew] = solution.tried.emplace(value, 0);
        if (isNew) place->second = cost(value);
        return place->second;
    };
    int below = low, above = low;  // costs at most the budget; costs more
    if (at(low) <= budget) {
        while (below < high && above == low) {
            const int next = int(std::min<std::int64_t>(high, std::max<std::int64_t>(std::int64_t(below) + 1, 2 * std::int64_t(below))));
            (at(next) <= budget ? below : above) = next;
        }
        for (bool halve = false; above - below > 1; halve = !halve) {
            const double slope = (at(above) - at(below)) / (above - below), guess = below + (budget - at(below)) / slope;
            const int middle = halve || !std::isfinite(guess) ? std::midpoint(below, above) : int(std::lround(guess));
            const int next = std::clamp(middle, below + 1, above - 1);
            (at(next) <= budget ? below : above) = next;
        }
    }
    const auto distance = [&](const auto& tried) { return std::abs(std::log(tried.second / budget)); };
    const auto nearest = std::ranges::min_element(solution.tried, {}, distance);
    solution.value = nearest->first;
    solution.reached = nearest->second;
    solution.inRange = at(low) <= budget && above > low;
    return solution;
}

const Equal::Entry* Equal::find(std::size_t scene, std::size_t technique, const std::vector<Setting>& knobs) const {
    const auto found = entries.find(configurationKey(scene, technique, knobs));
    return found == entries.end() ? nullptr : &found->second;
}

BudgetMet Equal::met(const StudyRun& run) const {
    const Entry& entry = *find(run.scene, run.technique, {run.knobs.begin(), run.knobs.end() - 1});
    return {entry.budget, entry.solution.reached, entry.solution.inRange};
}

Equal solveEqual(Stage& stage, const Study& study, StudyPlace& place) { return study.equal ? Solver(stage, study, place).solve() : Equal{}; }

std::vector<StudyRun> expandRuns(const Study& study, const Equal& equal) {
    std::vector<StudyRun> runs = expandRuns(study);
    for (StudyRun& run : runs) {
        const auto& solve = study.techniques[run.technique].solve;
        const Equal::Entry* entry = solve ? equal.find(run.scene, run.technique, run.knobs) : nullptr;
        if (!entry) continue;
        run.knobs.push_back({solve->name, Json(entry->solution.value)});
        run.knobs.back().value.moveTo(solve->where);
    }
    return runs;
}

}  // namespace lodestir
