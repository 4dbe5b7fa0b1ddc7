// SPDX-License-Identifier: MIT
// No more model than a scene needs: the cost of a field of 4,096 boulders while their model grows to 64 times its triangles, and studies that count what
// is shown.
#include "program.h"

namespace lodestir::test {
namespace {

class NeedsTest : public ProgramTest {
protected:
    /// Rows by technique.
    std::map<std::string, std::vector<OrderedJson>> study(const OrderedJson& json) {
        write("study.json", json);
        const Output output = lodestir({"study", (folder / "study.json").string(), "--out", (folder / "out").string()});
        EXPECT_EQ(output.exitCode, 0) << output.err;
        return readRowsByTechnique(folder / "out/results.jsonl");
    }
    static OrderedJson technique(const char* mode, OrderedJson more = OrderedJson::object()) {
        OrderedJson json{{"graph", levels}, {"variant", "no accumulation"}, {"set", {{"lod.mode", mode}, {"trace.spp", 4}}}};
        json.update(more);
        return json;
    }
    static OrderedJson studyOf(const std::vector<std::string>& scenes, const OrderedJson& techniques) {
        OrderedJson files = OrderedJson::array();
        for (const std::string& scene : scenes) files.push_back((sourceFolder / "scenes" / scene).string());
        return {{"format", 1},
                {"scenes", files},
                {"size", {64, 36}},
                {"seeds", 2},
                {"reference", {{"graph", (sourceFolder / "graphs/path_tracer.json").string()}, {"spp", 2}}},
                {"counts", {{"triangles", "lod.triangles"}, {"bytes", "lod.bytes"}}},
                {"countSteps", true},
                {"techniques", techniques},
                {"metrics", {"mse"}},
                {"charts", {"needs"}}};
    }
    /// Means over seeds, in the order of scenes.
    static std::vector<double> counted(const std::vector<OrderedJson>& rows, const std::string& name) {
        std::map<std::string, double> sums;
        std::vector<std::string> scenes;
        for (const OrderedJson& row : rows) {
            const std::string scene = row["scene"];
            if (!sums.contains(scene)) scenes.push_back(scene);
            sums[scene] += row["counts"][name].get<double>() / 2;
        }
        std::vector<double> means;
        for (const std::string& scene : scenes) means.push_back(sums[scene]);
        return means;
    }

    inline static const std::string levels = (sourceFolder / "graphs/path_tracer_lod.json").string();
};

// With levels by their error on the screen, 64 times the triangles cost less than a tenth more steps. At its finest the model costs two fifths more where eight
// lanes share a walk, a fifth where each walks by itself.
TEST_F(NeedsTest, ATenthBuysSixtyFourTimesTheTriangles) {
    auto rows = study(studyOf({"boulders_1x.json", "boulders_64x.json"}, {{"finest", technique("finest")}, {"screen error", technique("screen_error")}}));
    std::map<std::string, double> growth;
    for (const std::string name : {"finest", "screen error"}) {
        const std::vector<double> steps = counted(rows[name], "steps");
        ASSERT_EQ(steps.size(), 2u);
        growth[name] = steps[1] / steps[0];
        std::printf("%s: %.1f -> %.1f steps a pixel, x %.3f\n", name.c_str(), steps[0], steps[1], growth[name]);
    }
    EXPECT_LT(growth["screen error"], 1.10);
    EXPECT_GT(growth["screen error"], 0.95);
    EXPECT_GT(growth["finest"], 1.1);
    EXPECT_GT(growth["finest"] - 1, 5 * (growth["screen error"] - 1));
    const std::vector<double> triangles = counted(rows["finest"], "triangles");
    const double ground = 256 * 256 * 2;
    EXPECT_EQ(triangles, (std::vector<double>{4096.0 * 4800 + ground, 4096.0 * 307200 + ground}));
}

// A budget of many samples goes into a finer model than one of few, and follows the samples that a study varies.
TEST_F(NeedsTest, MoreSamplesAreGivenMoreModel) {
    OrderedJson chosen = technique("total_error", {{"alike", {{"lod.samples", "trace.spp"}}}, {"vary", {{"trace.spp", {1, 16}}}}});
    chosen["set"].erase("trace.spp");
    const auto rows = study(studyOf({"boulders_64x.json"}, {{"total error", chosen}, {"finest", technique("finest")}})).at("total error");
    std::map<int, double> triangles;
    for (const OrderedJson& row : rows) triangles[row["knobs"]["trace.spp"]] = row["counts"]["triangles"];
    std::printf("total error: %.4g triangles for a sample a pixel, %.4g for 16\n", triangles[1], triangles[16]);
    EXPECT_GT(triangles[16], 1.2 * triangles[1]);
    const OrderedJson summary = readJson(folder / "out/summary.json");
    EXPECT_EQ(summary["counts"], OrderedJson::parse(R"(["triangles", "bytes", "steps"])"));
    EXPECT_EQ(summary["cells"][0]["counts"]["triangles"]["mean"], triangles[1]);
}

// A budget is split between model and samples: what the finest levels take for 4 samples a pixel buys more samples of a coarser model, whose levels are those
// for as many.
TEST_F(NeedsTest, ABudgetIsSplitBetweenModelAndSamples) {
    OrderedJson chosen = technique("total_error", {{"alike", {{"lod.samples", "trace.spp"}}}, {"solve", {{"trace.spp", {1, 64}}}}});
    chosen["set"].erase("trace.spp");
    OrderedJson json = studyOf({"boulders_64x.json"}, {{"finest", technique("finest")}, {"total error", chosen}});
    json["equal"] = {{"steps", "finest"}};
    const auto rows = study(json);
    const OrderedJson& row = rows.at("total error").front();
    const int samples = row["knobs"]["trace.spp"];
    const double given = counted(rows.at("finest"), "steps").front(), taken = counted(rows.at("total error"), "steps").front();
    std::printf("%d samples a pixel for %.1f of %.1f steps\n", samples, taken, given);
    EXPECT_GE(samples, 5);
    EXPECT_LE(samples, 8);
    EXPECT_NEAR(taken, given, 0.6 * given / samples) << "half of what a sample costs";
    json["countSteps"] = false;
    write("study.json", json);
    const Output output = lodestir({"study", (folder / "study.json").string(), "--out", (folder / "none").string()});
    EXPECT_EQ(output.exitCode, 1);
    EXPECT_NE(output.err.find("add \"countSteps\": true"), std::string::npos) << output.err;
}

TEST_F(NeedsTest, WhatIsNoNumberIsRefused) {
    OrderedJson json = studyOf({"boulders_1x.json"}, {{"finest", technique("finest")}});
    json["counts"] = {{"changed", "lod.changed"}, {"pixels", "trace.color"}, {"nothing", "lod.nothing"}};
    write("study.json", json);
    const Output output = lodestir({"study", (folder / "study.json").string(), "--out", (folder / "out").string()});
    EXPECT_EQ(output.exitCode, 1);
    for (const char* part : {"study.json:", "lod.changed is no number", "trace.color is no number", "no port \"nothing\""})
        EXPECT_NE(output.err.find(part), std::string::npos) << part << " in\n" << output.err;
}

// If this fails, everything costs 0 steps on a device whose driver traces.
TEST_F(NeedsTest, StepsThatAreNotToldAreRefused) {
    write("study.json", studyOf({"boulders_1x.json"}, {{"finest", technique("finest")}}));
    const Output output = lodestir({"study", (folder / "study.json").string(), "--out", (folder / "out").string(), "--rays", "ray_query"});
    EXPECT_EQ(output.exitCode, 1);
    EXPECT_NE(output.err.find("ray_query"), std::string::npos) << output.err;
    EXPECT_EQ(readText(folder / "out/results.jsonl"), "") << "no row says 0 steps";
}

}  // namespace
}  // namespace lodestir::test
