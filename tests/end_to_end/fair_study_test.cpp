// SPDX-License-Identifier: MIT
// Studies that are fair: processes that share the work change no value, budgets are met, parts are taken away, and what is planted comes out as large as it is.
#include "planted_faults.h"
#include "program.h"

#include <framework/study/error/comparison.h>

#include <cmath>
#include <map>
#include <set>

namespace lodestir::test {
namespace {

const std::string pathTracing = (sourceFolder / "graphs/path_tracer.json").string(), restir = (sourceFolder / "graphs/restir_pt.json").string();

const std::string calm = (sourceFolder / "scenes/ensemble_diffuse.json").string();  ///< where a few samples tell much

class FairStudyTest : public ProgramTest {
protected:
    FairStudyTest() {
        json = {{"format", 1},
                {"scenes", {(sourceFolder / "scenes/cornell.json").string()}},
                {"size", {32, 18}},
                {"seeds", 4},
                {"reference", {{"graph", pathTracing}, {"spp", 1024}}},
                {"techniques", {{"path tracing", samples(4)}}},
                {"metrics", {"mse", "bias"}},
                {"charts", {"error_vs_rays"}}};
    }
    static OrderedJson samples(int spp) { return {{"graph", pathTracing}, {"variant", "no accumulation"}, {"set", {{"trace.spp", spp}}}}; }

    /// Runs it; its rows, by technique. Fails the test where it fails.
    std::map<std::string, std::vector<OrderedJson>> study(const std::string& out, Arguments more = {}) {
        write("study.json", json);
        more.insert(more.begin(), {"study", (folder / "study.json").string(), "--out", (folder / out).string()});
        const Output output = lodestir(more);
        EXPECT_EQ(output.exitCode, 0) << output.err;
        said = output.err;
        told = output.out;
        return readRowsByTechnique(folder / out / "results.jsonl");
    }
    static std::map<std::string, OrderedJson> metricsOf(const std::map<std::string, std::vector<OrderedJson>>& rows) {
        std::map<std::string, OrderedJson> metrics;
        for (const auto& [technique, all] : rows)
            for (const OrderedJson& row : all) metrics[row["run"].get<std::string>() + row["frame"].dump()] = row["metrics"];
        return metrics;
    }
    static double meanMetric(const std::vector<OrderedJson>& rows, const std::string& name) {
        double sum = 0;
        for (const OrderedJson& row : rows) sum += row["metrics"][name].get<double>() / double(rows.size());
        return sum;
    }
    /// Processes that share the work write rows in any order.
    static std::set<std::uint32_t> seedsOf(const std::vector<OrderedJson>& rows) {
        std::set<std::uint32_t> seeds;
        for (const OrderedJson& row : rows) seeds.insert(row["seed"].get<std::uint32_t>());
        return seeds;
    }
    static double raysOf(const OrderedJson& row) {
        double rays = 0;
        for (const auto& pass : row["passes"])
            for (const auto& count : pass["rays"]) rays += count.get<double>();
        return rays / (32 * 18);
    }

    OrderedJson json;
    std::string said, told;
};

TEST_F(FairStudyTest, ProcessesShareTheWorkAndChangeNothing) {
    json["techniques"]["ReSTIR PT"] = {{"graph", restir}};
    json["frames"] = {{"warmup", 2}, {"measure", {0, 1}}};
    const auto one = study("one", {"--jobs", "1"});
    EXPECT_EQ(said.find("processes"), said.npos) << said;
    const auto two = study("two", {"--jobs", "2"});
    EXPECT_NE(said.find("8 of 8 runs to make on"), said.npos) << said;
    EXPECT_NE(said.find("by 2 processes"), said.npos) << said;
    EXPECT_EQ(metricsOf(one).size(), 16u);
    EXPECT_EQ(metricsOf(one), metricsOf(two));
    EXPECT_EQ(filesOf(folder / "one/references"), filesOf(folder / "two/references"));
    const std::string once = told;
    study("two", {"--resume"});
    EXPECT_EQ(told, once) << "nothing was left to do";
    json["charts"] = {"error_vs_time"};
    study("timed");
    EXPECT_NE(said.find("by one process: times are judged"), said.npos) << said;
}

TEST_F(FairStudyTest, BudgetsAreMet) {
    json["techniques"]["solved"] = {{"graph", pathTracing}, {"variant", "no accumulation"}, {"solve", {{"trace.spp", {1, 64}}}}};
    json["techniques"]["too few"] = {{"graph", pathTracing}, {"variant", "no accumulation"}, {"solve", {{"trace.spp", {1, 2}}}}};
    json["equal"] = {{"rays", "path tracing"}};
    const auto rows = study("rays");
    for (const OrderedJson& row : rows.at("solved")) {
        EXPECT_EQ(row["knobs"]["trace.spp"], 4);
        EXPECT_NEAR(raysOf(row), row["budget"]["value"].get<double>(), 0.05 * raysOf(row)) << "but for other seeds";
        EXPECT_EQ(row["budget"]["inRange"], true);
    }
    EXPECT_EQ(rows.at("too few").front()["knobs"]["trace.spp"], 2);
    EXPECT_EQ(rows.at("too few").front()["budget"]["inRange"], false);
    EXPECT_NE(said.find("\"too few\" can't cost"), said.npos) << said;
    EXPECT_NE(told.find("when chosen"), told.npos) << told;
    const std::string equal = readText(folder / "rays/equal.json");
    std::filesystem::remove(folder / "rays/results.jsonl");
    study("rays", {"--resume"});
    EXPECT_EQ(readText(folder / "rays/equal.json"), equal) << "what was solved stays";
}

// If this fails, a study that is resumed takes a value that was solved for where other parameters followed the knob.
TEST_F(FairStudyTest, WhatFollowsTheKnobIsPartOfWhatWasSolved) {
    json["seeds"] = 1;
    json["reference"]["spp"] = 2;
    json["techniques"]["solved"] = {{"graph", pathTracing}, {"variant", "no accumulation"}, {"solve", {{"trace.spp", {1, 16}}}}};
    json["equal"] = {{"rays", "path tracing"}};
    study("study");
    const OrderedJson alone = readJson(folder / "study/equal.json");
    json["techniques"]["solved"]["alike"] = {{"trace.bounces", "trace.spp"}};
    study("study", {"--resume"});
    OrderedJson both = readJson(folder / "study/equal.json");
    EXPECT_EQ(alone.size(), 2u) << "the budget, and the knob";
    ASSERT_EQ(both.size(), 3u);
    EXPECT_EQ((--both.end()).value()["budget"], alone.begin().value()["cost"]);
    EXPECT_NE((--both.end()).value()["tried"]["1"], (--alone.end()).value()["tried"]["1"]) << "a path of one bounce is shorter";
}

// However busy the machine is: what is judged is what the solver measured itself. If this fails, techniques are compared at times of which one step of their
// knob is nearer to the budget, or rows say that they took another value than was chosen.
TEST_F(FairStudyTest, ATimeIsMetWithinAStepOfTheKnob) {
    // What 48 samples take here and now, so that most and least of the range are far from it.
    const Output first = lodestir({"run", pathTracing, "--variant", "no accumulation", "--scene", json["scenes"][0], "--set", "trace.spp=48", "--size", "32x18",
                                   "--frames", "3", "--out", (folder / "first").string()});
    ASSERT_EQ(first.exitCode, 0) << first.err;
    const double budget = readJson(folder / "first/run.json")["frames"].back()["ms"];
    json["seeds"] = 2;
    json["techniques"]["solved"] = {{"graph", pathTracing}, {"variant", "no accumulation"}, {"solve", {{"trace.spp", {1, 4096}}}}};
    json["equal"] = {{"time", budget}};
    const auto rows = study("time");
    EXPECT_NE(said.find("by one process: times are judged"), said.npos) << said;

    const OrderedJson solved = readJson(folder / "time/equal.json").begin().value();
    EXPECT_EQ(solved["unit"], "ms");
    EXPECT_NEAR(solved["budget"].get<double>(), budget, 1e-9 * budget);
    EXPECT_EQ(solved["inRange"], true) << solved;
    std::map<int, double> tried;
    for (const auto& [value, ms] : solved["tried"].items()) tried[std::stoi(value)] = ms;
    const int chosen = solved["value"];
    ASSERT_TRUE(tried.contains(chosen)) << solved;
    EXPECT_EQ(solved["reached"], tried[chosen]);
    // Two values side by side, of which one fits and one doesn't; the chosen is the nearest of all that were tried, so no farther than half of that step.
    const auto fits = [&](const auto& one) { return one.second <= budget; };
    const auto brackets = [&](const auto& one) { return fits(one) && tried.contains(one.first + 1) && tried[one.first + 1] > budget; };
    const auto below = std::ranges::find_if(tried, brackets);
    ASSERT_NE(below, tried.end()) << solved;
    const auto distance = [&](double ms) { return std::abs(std::log(ms / budget)); };
    for (const auto& [value, ms] : tried) EXPECT_LE(distance(tried[chosen]), distance(ms)) << value << solved;
    EXPECT_LE(distance(tried[chosen]), 0.5 * std::log(tried[below->first + 1] / below->second) + 1e-9) << solved;
    EXPECT_GT(tried.rbegin()->second, tried.begin()->second) << "more samples take longer: " << solved;

    ASSERT_EQ(rows.at("solved").size(), 2u);
    for (const OrderedJson& row : rows.at("solved")) {
        EXPECT_EQ(row["knobs"]["trace.spp"], chosen);
        EXPECT_EQ(row["passes"]["trace"]["rays"]["primary"], 32 * 18 * chosen) << "it really took them";
        EXPECT_EQ(row["budget"], (OrderedJson{{"value", solved["budget"]}, {"reached", solved["reached"]}, {"inRange", true}}));
        EXPECT_GT(row["ms"], 0);
    }
    EXPECT_NE(told.find("when chosen"), told.npos) << told;

    // Shards would each find another value; once one is found they all take it.
    const auto shard = [&](const char* out) {
        return lodestir({"study", (folder / "study.json").string(), "--out", (folder / out).string(), "--shard", "1/2"});
    };
    const Output refused = shard("shards");
    EXPECT_EQ(refused.exitCode, 1);
    EXPECT_NE(refused.err.find("shards would each solve for a time of their own"), refused.err.npos) << refused.err;
    std::filesystem::create_directories(folder / "shards");
    std::filesystem::copy_file(folder / "time/equal.json", folder / "shards/equal.json");
    const Output shared = shard("shards");
    EXPECT_EQ(shared.exitCode, 0) << shared.err;
    EXPECT_EQ(readText(folder / "shards/equal.json"), readText(folder / "time/equal.json"));
}

TEST_F(FairStudyTest, PartsAreTakenAway) {
    json["frames"] = {{"warmup", 4}};
    json["decompose"] = true;
    json["masks"] = {{"seen", "hits.depth"}};
    json["techniques"]["ReSTIR PT"] = {{"graph", restir}, {"ablate", "pairs"}};
    const auto rows = study("parts");
    for (const char* part : {"temporal", "spatial", "initial.roulette", "temporal and spatial"}) {
        ASSERT_TRUE(rows.contains(std::string("ReSTIR PT without ") + part)) << part;
        EXPECT_EQ(seedsOf(rows.at(std::string("ReSTIR PT without ") + part)), seedsOf(rows.at("ReSTIR PT"))) << "seed by seed";
    }
    const auto has = [&](const char* technique, const char* pass) { return rows.at(technique).front()["passes"].contains(pass); };
    EXPECT_TRUE(has("ReSTIR PT", "spatial"));
    EXPECT_FALSE(has("ReSTIR PT without spatial", "spatial"));
    EXPECT_TRUE(has("ReSTIR PT without spatial", "temporal"));
    EXPECT_FALSE(has("ReSTIR PT without temporal and spatial", "temporal"));
    EXPECT_LT(raysOf(rows.at("ReSTIR PT without temporal and spatial").front()), raysOf(rows.at("ReSTIR PT").front()));
    EXPECT_GT(meanMetric(rows.at("ReSTIR PT without temporal and spatial"), "mse"), 1.5 * meanMetric(rows.at("ReSTIR PT"), "mse"));
    EXPECT_TRUE(rows.at("path tracing").front()["metrics"].contains("mse.seen"));
    const std::size_t table = told.find("without parts of \"ReSTIR PT\", 95 %, seed by seed");
    ASSERT_NE(table, told.npos) << told;
    EXPECT_LT(told.find("temporal and spatial", table), told.find("initial.roulette  ", table)) << "what is worth most comes first\n" << told;
    EXPECT_NE(told.find("squared bias"), told.npos) << told;
}

// The same twice, each with seeds of its own: if this fails, intervals are too narrow, or seeds are shared.
TEST_F(FairStudyTest, TheSameTwiceCoincides) {
    json["scenes"] = {calm};
    json["seeds"] = 16;
    json["techniques"] = {{"one", samples(16)}, {"other", samples(16)}};
    const auto rows = study("null");
    std::vector<double> errors[2];
    std::vector<std::uint32_t> seeds[2];
    for (const int i : {0, 1})
        for (const OrderedJson& row : rows.at(i == 0 ? "one" : "other")) {
            errors[i].push_back(row["metrics"]["mse"]);
            seeds[i].push_back(row["seed"]);
        }
    const Difference difference = compareValues(errors[1], seeds[1], errors[0], seeds[0]);
    EXPECT_FALSE(difference.paired);
    EXPECT_LE(difference.low(), 1);
    EXPECT_GE(difference.high(), 1);
    EXPECT_LT(difference.high() / difference.low(), 2) << "an interval that says nothing";
}

// If this fails, a bias is told larger or smaller than it is. What accumulates is 8 % too bright.
TEST_F(FairStudyTest, APlantedBiasIsAsLargeAsItIs) {
    const Fault brighter{.type = "bright", .pass = "accumulate", .file = "accumulate.comp", .right = "vec4(colorRgba(p).rgb, 1)",
                         .wrong = "vec4(1.08 * colorRgba(p).rgb, 1)"};
    plant(folder / "faults", {brighter});
    write("bright.json", {{"format", 1},
                          {"passes", {{"trace", {{"type", "path_tracer"}, {"set", {{"spp", 64}, {"bounces", 4}}}}},
                                      {"sum", {{"type", "bright"}, {"in", {{"color", "trace"}}}}}}},
                          {"show", "sum"}});
    json["scenes"] = {calm};
    json["seeds"] = 16;
    json["decompose"] = true;
    json["reference"]["spp"] = 8192;
    json["techniques"] = {{"right", samples(64)}, {"bright", {{"graph", (folder / "bright.json").string()}}}};
    const auto rows = study("bias", {"--passes", (folder / "faults").string()});
    EXPECT_NEAR(meanMetric(rows.at("bright"), "bias"), 0.08, 0.008);
    EXPECT_NEAR(meanMetric(rows.at("right"), "bias"), 0, 0.008);
    EXPECT_NE(told.find("mse: squared bias"), told.npos);
}

}  // namespace
}  // namespace lodestir::test
