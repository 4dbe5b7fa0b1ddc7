// SPDX-License-Identifier: MIT
// `lodestir study` as it is used: rows and report, resuming, shards, and numbers that make sense.
#include "program.h"

#include <map>
#include <sstream>

namespace lodestir::test {
namespace {

class StudyRunTest : public ProgramTest {
protected:
    StudyRunTest() {
        const std::string graph = (sourceFolder / "graphs/path_tracer.json").string();
        write("study.json", {{"format", 1},
                             {"about", "samples"},
                             {"scenes", {(sourceFolder / "scenes/cornell.json").string()}},
                             {"size", {32, 18}},
                             {"seeds", 2},
                             {"paired", true},  // what is told of two seeds is told of differences between techniques
                             {"reference", {{"graph", graph}, {"spp", 64}}},
                             {"techniques", {{"path tracing", {{"graph", graph}, {"vary", {{"trace.spp", {1, 8}}}}}}}},
                             {"metrics", {"mse", "relmse", "bias"}},
                             {"charts", {"error_vs_time", "error_vs_rays", "time_by_pass"}}});
    }

    Output study(const std::string& out, Arguments more = {}) {
        more.insert(more.begin(), {"study", (folder / "study.json").string(), "--out", (folder / out).string()});
        return lodestir(more);
    }
    /// Where Python or one of its packages isn't there, the program says so, and what it measured is complete all the same.
    static bool reportIsDrawn(const Output& output) {
        if (output.err.find("report.html") != std::string::npos) return true;
        EXPECT_NE(output.err.find("install"), std::string::npos) << output.err;
        return false;
    }
    std::vector<OrderedJson> rows(const Path& file) { return readRows(folder / file); }
    /// By what a row is of: what was measured, times aside.
    std::map<std::string, OrderedJson> measured(const std::vector<OrderedJson>& all) {
        std::map<std::string, OrderedJson> byRun;
        for (const OrderedJson& row : all) byRun[row["run"].get<std::string>() + row["frame"].dump()] = row["metrics"];
        return byRun;
    }
};

TEST_F(StudyRunTest, MeasuresResumesAndReports) {
    const Output first = study("out");
    ASSERT_EQ(first.exitCode, 0) << first.err;
    EXPECT_NE(first.out.find("path tracing, spp 8"), std::string::npos) << first.out;
    const std::vector<OrderedJson> all = rows("out/results.jsonl");
    ASSERT_EQ(all.size(), 4u) << "two values, two seeds";
    std::map<int, double> mse, rays;
    for (const OrderedJson& row : all) {
        EXPECT_EQ(row["scene"], "cornell");
        EXPECT_GT(row["ms"], 0);
        const int spp = row["knobs"]["trace.spp"];
        EXPECT_EQ(row["passes"]["trace"]["rays"]["primary"], 32 * 18 * spp);
        EXPECT_NEAR(row["metrics"]["bias"].get<double>(), 0, 0.3);
        mse[spp] += row["metrics"]["mse"].get<double>() / 2;
    }
    EXPECT_GT(mse[8], 0);
    EXPECT_GT(mse[1], 3 * mse[8]) << "eight times the samples, an eighth of the error";
    EXPECT_LT(mse[1], 25 * mse[8]);
    EXPECT_NE(all[0]["metrics"]["mse"], all[2]["metrics"]["mse"]) << "seeds differ";

    const std::string text = readText(folder / "out/results.jsonl");
    const OrderedJson summary = readJson(folder / "out/summary.json");
    ASSERT_EQ(summary["cells"].size(), 2u);
    for (const OrderedJson& cell : summary["cells"]) {
        const int spp = cell["knobs"]["trace.spp"];
        EXPECT_NEAR(cell["metrics"]["mse"]["mean"].get<double>(), mse[spp], 1e-12) << "that of the rows";
        EXPECT_TRUE(std::filesystem::exists(folder / "out" / cell["image"].get<std::string>()));
    }
    EXPECT_EQ(filesOf(folder / "out/images").size(), 3u) << "of each value the first seed, and the reference";
    if (reportIsDrawn(first)) {
        const std::string report = readText(folder / "out/report.html");
        for (const char* part : {"</html>", "mse against rays", "id=\"images\""}) EXPECT_NE(report.find(part), std::string::npos) << part;
        EXPECT_TRUE(filesOf(folder / "out/figures").contains("cornell.error_vs_time.mse.pdf"));
    }
    EXPECT_EQ(filesOf(folder / "out/references").size(), 2u) << "both halves";

    const Output again = study("out");
    EXPECT_EQ(again.exitCode, 1);
    EXPECT_NE(again.err.find("--resume"), std::string::npos) << again.err;
    ASSERT_EQ(study("out", {"--resume"}).exitCode, 0);
    EXPECT_EQ(readText(folder / "out/results.jsonl"), text) << "nothing was left to do";

    // As if it had been killed while it wrote its third row.
    const std::size_t second = text.find('\n', text.find('\n') + 1) + 1;
    writeFile(folder / "out/results.jsonl", text.substr(0, second + 40));
    ASSERT_EQ(study("out", {"--resume"}).exitCode, 0);
    EXPECT_EQ(readText(folder / "out/results.jsonl").substr(0, second), text.substr(0, second)) << "what was measured is kept";
    const std::vector<OrderedJson> resumed = rows("out/results.jsonl");
    EXPECT_EQ(resumed.size(), 4u);
    EXPECT_EQ(measured(resumed), measured(all)) << "a run comes out the same whatever ran before it";

    // Two machines, one folder.
    std::filesystem::create_directories(folder / "shards");
    std::filesystem::copy(folder / "out/references", folder / "shards/references");
    const Output half = study("shards", {"--shard", "2/2"});
    ASSERT_EQ(half.exitCode, 0);
    EXPECT_EQ(rows("shards/results.2-of-2.jsonl").size(), 2u);
    EXPECT_EQ(half.out, "") << "no numbers of half a study";
    EXPECT_NE(half.err.find("2 runs are still missing; once all shards are done, `lodestir study "), half.err.npos) << half.err;
    EXPECT_NE(half.err.find("--resume` makes what is left, merges and reports"), half.err.npos) << half.err;
    for (const char* file : {"summary.json", "report.html", "figures"}) EXPECT_FALSE(std::filesystem::exists(folder / "shards" / file)) << file;
    const Output rest = study("shards", {"--shard", "1/2"});
    ASSERT_EQ(rest.exitCode, 0);
    EXPECT_EQ(rest.err.find("still missing"), rest.err.npos) << rest.err;
    EXPECT_NE(rest.out.find("path tracing, spp 8"), rest.out.npos) << "the last one reports: " << rest.out;
    std::vector<OrderedJson> both = rows("shards/results.1-of-2.jsonl");
    for (const OrderedJson& row : rows("shards/results.2-of-2.jsonl")) both.push_back(row);
    EXPECT_EQ(measured(both), measured(all));
    EXPECT_EQ(readJson(folder / "shards/summary.json")["missing"], 0);
}

TEST_F(StudyRunTest, FlickerIsMeasuredOfFramesInARow) {
    OrderedJson json = readJson(folder / "study.json");
    const std::string graph = json["reference"]["graph"];
    json["reference"]["spp"] = 1024;
    json["frames"] = {{"measure", {0, 1, 2, 4}}};
    json["techniques"] = {{"new noise", {{"graph", graph}, {"variant", "no accumulation"}, {"set", {{"trace.spp", 16}}}}},
                          {"too dark", {{"graph", graph}, {"variant", "no accumulation"}, {"set", {{"trace.spp", 64}, {"trace.bounces", 0}}}}}};
    json["metrics"] = {"mse", "flicker_uncorrelated", "flicker_correlated", "tflip"};
    json["charts"] = {"error_vs_time", "error_vs_frame", "stability"};
    write("study.json", json);
    const Output output = study("out");
    ASSERT_EQ(output.exitCode, 0) << output.err;
    std::map<std::string, double> isNew, stays;
    for (const OrderedJson& row : rows("out/results.jsonl")) {
        const OrderedJson& metrics = row["metrics"];
        EXPECT_TRUE(metrics.contains("mse"));
        const bool follows = row["frame"] == 1 || row["frame"] == 2;
        EXPECT_EQ(metrics.contains("tflip"), follows) << row["frame"] << ": frames 0 and 4 have no measured frame right before them";
        if (!follows) continue;
        EXPECT_GT(metrics["tflip"].get<double>(), 0);
        isNew[row["technique"]] += metrics["flicker_uncorrelated"].get<double>() / 4;
        stays[row["technique"]] += metrics["flicker_correlated"].get<double>() / 4;
    }
    EXPECT_GT(isNew["new noise"], 3 * std::abs(stays["new noise"]));
    EXPECT_GT(stays["too dark"], 10 * isNew["too dark"]);
    EXPECT_GT(isNew["too dark"], 0);
    const OrderedJson summary = readJson(folder / "out/summary.json");
    EXPECT_EQ(summary["metrics"][3]["temporal"], true);
    EXPECT_EQ(summary["cells"][1]["metrics"]["tflip"]["againstStart"]["mean"], 1) << "its first step ends in frame 1";
    if (reportIsDrawn(output)) {
        EXPECT_NE(readText(folder / "out/report.html").find("Stability: tflip against that of frame 1"), std::string::npos);
    }

    json["frames"]["measure"] = {0, 2};
    write("study.json", json);
    const Output refused = study("other");
    EXPECT_EQ(refused.exitCode, 1);
    EXPECT_NE(refused.err.find("\"tflip\" needs two measured frames in a row"), std::string::npos) << refused.err;
}

// One frame of a graph without samples a pixel is one sample. If this fails, a reference is a single draw that counts as many, or the same draw many times.
TEST_F(StudyRunTest, AReferenceIsTheMeanOfFramesWhereNoPassTakesSamples) {
    write("seen.json", {{"format", 1},
                        {"scene", (sourceFolder / "scenes/cornell.json").string()},
                        {"frame", {{"size", {32, 18}}}},
                        {"passes", {{"hits", {{"type", "visibility"}, {"set", {{"lens", false}}}}}}},
                        {"show", "hits.albedo"}});
    OrderedJson json = readJson(folder / "study.json");
    const std::string graph = (folder / "seen.json").string();
    constexpr int samples = 64;
    json["reference"] = {{"graph", graph}, {"spp", samples}};
    json["seeds"] = 8;
    json["techniques"] = {{"a sample", {{"graph", graph}}}};
    json["metrics"] = {"mse", "bias"};
    json["charts"] = {"comparison"};
    write("study.json", json);
    const Output output = study("out");
    ASSERT_EQ(output.exitCode, 0) << output.err;
    double error = 0, noise = 0, bias = 0;
    for (const OrderedJson& row : rows("out/results.jsonl")) {
        error += row["metrics"]["mse"].get<double>();
        noise += row["referenceNoise"]["mse"].get<double>();
        bias += row["metrics"]["bias"].get<double>() / 8;
    }
    EXPECT_NEAR(error / noise, samples, 0.4 * samples);  // of the few pixels on an outline
    EXPECT_NEAR(bias, 0, 0.01);

    json["reference"]["set"] = json["techniques"]["a sample"]["set"] = {{"hits.film", "centre"}};
    write("study.json", json);
    const Output same = study("same");
    EXPECT_EQ(same.exitCode, 1);
    EXPECT_NE(same.err.find("the reference is the same whatever the seed"), std::string::npos) << same.err;
    EXPECT_NE(same.err.find("\"exact\": true"), std::string::npos) << same.err;
}

// If this fails, who has no Python learns nothing of a study, or not why there is no page.
TEST_F(StudyRunTest, WithoutPythonTheResultsAreThere) {
    const Arguments command{LODESTIR_BINARY, "study", (folder / "study.json").string(), "--out", (folder / "out").string()};
    const Output output = runProcess(command, {{"PATH", (folder / "empty").string()}});
    EXPECT_EQ(output.exitCode, 0) << output.err;
    EXPECT_NE(output.err.find("there is no python3 to draw the report with; install it"), std::string::npos) << output.err;
    EXPECT_EQ(readJson(folder / "out/summary.json")["missing"], 0);
    EXPECT_FALSE(std::filesystem::exists(folder / "out/report.html"));
}

TEST_F(StudyRunTest, WrongStudiesAreRefusedBeforeAnythingRuns) {
    OrderedJson json = readJson(folder / "study.json");
    json["techniques"]["path tracing"]["vary"] = {{"trace.spp", {1, 0}}, {"trace.sp", {2}}};
    json["techniques"]["other"] = {{"graph", json["reference"]["graph"]}, {"variant", "no such"}};
    write("study.json", json);
    const Output output = study("out");
    EXPECT_EQ(output.exitCode, 1);
    for (const char* part : {"study.json:", "1..4096", "\"spp\"", "no such"})
        EXPECT_NE(output.err.find(part), std::string::npos) << part << " in\n" << output.err;
    EXPECT_TRUE(filesOf(folder / "out").empty());
    EXPECT_EQ(study("out", {"--shard", "3/2"}).exitCode, 2);
}

// The cube takes its coarser level at frame 40.
TEST_F(StudyRunTest, ErrorsWhereLevelsSwitchAndAgainstTheFinest) {
    const std::string graph = (sourceFolder / "graphs/restir_lod.json").string();
    OrderedJson json = readJson(folder / "study.json");
    json.update(OrderedJson{{"scenes", {(sourceFolder / "scenes/cube.json").string()}},
                            {"frames", {{"warmup", 6}, {"event", 40}, {"measure", {-1, 0}}}},
                            {"techniques",
                             {{"ours", {{"graph", graph}, {"variant", "published"}}},
                              {"cleared", {{"graph", graph}, {"variant", "published"}, {"clear", {0}}}}}},
                            {"mask", "switched"},
                            {"metrics", {"mse"}}});
    json["reference"]["finest"] = true;
    write("study.json", json);
    const Output output = study("switch");
    ASSERT_EQ(output.exitCode, 0) << output.err;
    std::map<std::string, double> sums;
    for (const OrderedJson& row : rows("switch/results.jsonl")) {
        const auto& metrics = row["metrics"];
        EXPECT_EQ(metrics.size(), 4u);
        for (const auto& [name, value] : metrics.items()) sums[row["technique"].get<std::string>() + row["frame"].dump() + name] += value.get<double>();
        // Before the switch all is at its finest; after it, what the finest has and the coarse level hasn't is an error of its own.
        EXPECT_EQ(metrics["mse"] == metrics["mse.finest"], row["frame"] == -1);
        EXPECT_NE(metrics["mse"], metrics["mse.switched"]);
    }
    EXPECT_EQ(sums["ours-1mse.switched"], sums["cleared-1mse.switched"]) << "cleared only from the switch on";
    EXPECT_NE(sums["ours0mse.switched"], sums["cleared0mse.switched"]);

    json["frames"]["event"] = 20;
    write("study.json", json);
    const Output nothing = study("nothing");
    EXPECT_EQ(nothing.exitCode, 1);
    EXPECT_NE(nothing.err.find("no pixel sees an object that takes another level"), std::string::npos) << nothing.err;
}

}  // namespace
}  // namespace lodestir::test
