// SPDX-License-Identifier: MIT
// The judge of bias on a device: path tracing is found unbiased against itself, and what is wrong on purpose is found out.
#include "program.h"
#include "shared_device.h"

#include <framework/study/ensemble/ensemble.h>

#include <sstream>

namespace lodestir::test {
namespace {

StudyGraph pathTracer(std::vector<Setting> set) {
    return {
        .graph = sourceFolder / "graphs/path_tracer.json", .variant = "no accumulation", .set = std::move(set), .port = {}, .where = {}};
}

EnsembleSetup cornell() {
    return {.scene = sourceFolder / "scenes/cornell.json",
            .size = {32, 32},
            .warmup = 1,
            .frame = 3,
            .runs = 64,
            .reference = pathTracer({{"trace.bounces", Json(3)}}),
            .referenceSamples = 2048,
            .device = sharedDevice()};
}

TEST(EnsembleJudge, KnowsRightFromWrong) {
    EnsembleJudge judge(cornell());
    EXPECT_EQ(judge.reference().runs(), 64u);
    const StudyGraph same = pathTracer({{"trace.bounces", Json(3)}, {"trace.spp", Json(12)}});
    const EnsembleResult right = judge.judge(same);
    EXPECT_EQ(right.verdict, Verdict::unbiased) << right.reason;
    EXPECT_LE(right.halfWidth, 0.01);
    EXPECT_EQ(right.runs, 64);

    // Other estimators of the same integral.
    const EnsembleResult light =
        judge.judge(pathTracer({{"trace.bounces", Json(3)}, {"trace.spp", Json(12)}, {"trace.technique", Json("light")}}));
    EXPECT_EQ(light.verdict, Verdict::unbiased) << light.reason;

    // Light of the third scattering is missing: some percent.
    const EnsembleResult wrong = judge.judge(pathTracer({{"trace.bounces", Json(2)}, {"trace.spp", Json(12)}}));
    EXPECT_EQ(wrong.verdict, Verdict::biased) << wrong.reason;
    EXPECT_LT(wrong.energy[0], right.energy[0]);

    // A run is a fresh start whatever ran before it.
    const BlockMeans once = judge.measure(same), again = judge.measure(same);
    EXPECT_TRUE(once.values == again.values);
    EXPECT_NE(once.at(0, 0, 0), once.at(1, 0, 0));
}

TEST(EnsembleJudge, TooFewRunsAreInconclusive) {
    EnsembleSetup setup = cornell();
    setup.runs = 16;
    setup.halfWidth = 0.003;
    const EnsembleResult result = EnsembleJudge(setup).judge(pathTracer({{"trace.bounces", Json(3)}}));
    EXPECT_EQ(result.verdict, Verdict::inconclusive) << result.reason;
}

class EnsembleStudyTest : public ProgramTest {
protected:
    EnsembleStudyTest() {
        const std::string graph = (sourceFolder / "graphs/path_tracer.json").string();
        const auto technique = [&](int bounces) {
            return OrderedJson{{"graph", graph}, {"variant", "no accumulation"}, {"set", {{"trace.bounces", bounces}, {"trace.spp", 12}}}};
        };
        json = {{"format", 1},
                {"kind", "ensemble"},
                {"about", "path tracing against itself"},
                {"scenes", {(sourceFolder / "scenes/cornell.json").string()}},
                {"size", {32, 32}},
                {"runs", 64},
                {"halfWidth", 0.01},
                {"frames", {{"warmup", 1}, {"measure", {0}}}},
                {"reference", {{"graph", graph}, {"set", {{"trace.bounces", 3}}}, {"spp", 2048}}},
                {"techniques", {{"same", technique(3)}, {"shorter", technique(2)}}}};
        json["techniques"]["same"]["control"] = true;
        json["techniques"]["shorter"]["planted"] = true;
        write("study.json", json);
    }
    Output study(const std::string& out, Arguments more = {}) {
        more.insert(more.begin(), {"study", (folder / "study.json").string(), "--out", (folder / out).string()});
        return lodestir(more);
    }
    /// By chunk: what was measured, times aside.
    std::map<std::string, OrderedJson> measured(const Path& out) {
        std::map<std::string, OrderedJson> means;
        for (const std::string& name : filesOf(folder / out)) {
            if (!name.ends_with(".jsonl")) continue;
            std::istringstream lines(readText(folder / out / name));
            for (std::string line; std::getline(lines, line);) {
                const OrderedJson row = OrderedJson::parse(line);
                means[row["run"]] = row["blockMeans"];
            }
        }
        return means;
    }

    OrderedJson json;
};

TEST_F(EnsembleStudyTest, JudgesResumesAndShards) {
    const Output first = study("out");
    EXPECT_EQ(first.exitCode, 0) << first.out << first.err;
    for (const char* part : {"(control) ", "unbiased", "(planted fault) "})
        EXPECT_NE(first.out.find(part), std::string::npos) << part << "\n" << first.out;
    const std::map<std::string, OrderedJson> all = measured("out");
    ASSERT_EQ(all.size(), 6u) << "reference and two techniques, two chunks each";
    EXPECT_EQ(filesOf(folder / "out/images"),
              (std::set<std::string>{"cornell.reference.0.exr", "cornell.same.0.exr", "cornell.same.0.sigmas.png", "cornell.shorter.0.exr",
                                     "cornell.shorter.0.sigmas.png"}));
    const OrderedJson summary = readJson(folder / "out/summary.json");
    EXPECT_EQ(summary["cells"][0]["faults"].size(), 4u);
    EXPECT_TRUE(std::filesystem::exists(folder / "out" / summary["cells"][1]["image"].get<std::string>()));
    EXPECT_TRUE(std::filesystem::exists(folder / "out" / summary["scenes"][0]["reference"].get<std::string>()));

    // As if it had been killed in its fourth line.
    const std::string text = readText(folder / "out/results.jsonl");
    std::size_t third = 0;
    for (int line = 0; line < 3; ++line) third = text.find('\n', third) + 1;
    writeFile(folder / "out/results.jsonl", text.substr(0, third + 100));
    EXPECT_EQ(study("out", {"--resume"}).exitCode, 0);
    EXPECT_TRUE(measured("out") == all) << "a chunk comes out the same whatever ran before it";

    EXPECT_EQ(study("shards", {"--shard", "2/2"}).exitCode, 0) << "nothing to judge yet";
    const Output last = study("shards", {"--shard", "1/2"});
    EXPECT_EQ(last.exitCode, 0) << last.err;
    EXPECT_TRUE(measured("shards") == all);
    EXPECT_EQ(last.out, first.out) << "the same verdicts";

    // Nobody said that it was planted; nothing is rendered again.
    json["techniques"]["shorter"].erase("planted");
    write("study.json", json);
    const Output blamed = study("out", {"--resume"});
    EXPECT_EQ(blamed.exitCode, 1);
    EXPECT_NE(blamed.out.find("biased"), std::string::npos);
    EXPECT_EQ(blamed.err.find("to make on"), std::string::npos) << blamed.err;
}

}  // namespace
}  // namespace lodestir::test
