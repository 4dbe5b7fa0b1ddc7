// SPDX-License-Identifier: MIT
// scripts/slurm with a sbatch that runs jobs at once: shards, the merge behind them, and what is said of wrong use.
#include "program.h"

namespace lodestir::test {
namespace {

class SlurmTest : public ProgramTest {
protected:
    SlurmTest() {
        const std::string graph = (sourceFolder / "graphs/path_tracer.json").string();
        write("study.json", {{"format", 1},
                             {"scenes", {(sourceFolder / "scenes/cornell.json").string()}},
                             {"size", {24, 16}},
                             {"seeds", 5},
                             {"reference", {{"graph", graph}, {"spp", 8}}},
                             {"techniques", {{"path tracing", {{"graph", graph}, {"variant", "no accumulation"}}}}},
                             {"charts", {"error_vs_rays"}}});
        // What it is given is kept; the second job of an array is lost.
        writeFile(folder / "bin/sbatch", R"(#!/usr/bin/env bash
set -eu
echo "$*" >> "$JOBS"
array=
while [[ ${1:-} == --* ]]; do [[ $1 != --array=* ]] || array=${1#--array=}; shift; done
if [ -z "$array" ]; then "$@" >&2
else for ((i = ${array%-*}; i <= ${array#*-}; i++)); do [ "$i" = 2 ] || SLURM_ARRAY_TASK_ID=$i "$@" >&2; done; ls "$REPORTS" > "$JOBS.left"; fi
wc -l < "$JOBS"
)");
        std::filesystem::permissions(folder / "bin/sbatch", std::filesystem::perms::owner_all);
    }
    Output submit(Arguments arguments) {
        arguments.insert(arguments.begin(), (sourceFolder / "scripts/slurm/submit").string());
        const std::string path = (folder / "bin").string() + ":" + std::getenv("PATH");
        return runProcess(arguments, {{"PATH", path},
                                      {"JOBS", (folder / "jobs").string()},
                                      {"REPORTS", (folder / "out").string()},
                                      {"LODESTIR", LODESTIR_BINARY}});
    }
};

TEST_F(SlurmTest, SharesTheStudyOutAndMerges) {
    const Output output = submit({(folder / "study.json").string(), (folder / "out").string(), "3", "--time=5"});
    ASSERT_EQ(output.exitCode, 0) << output.err;
    EXPECT_NE(output.out.find("shards: job 1, 1 to 3; merge: job 2"), std::string::npos) << output.out;
    const std::string jobs = readText(folder / "jobs");
    EXPECT_NE(jobs.find("--time=5 --job-name=lodestir-study --array=1-3"), std::string::npos) << jobs;
    EXPECT_NE(jobs.find("--time=5 --job-name=lodestir-study-merge --dependency=afterany:1"), std::string::npos) << jobs;
    const std::string out = (folder / "out").string();
    const auto rows = [&](const char* file) { return std::ranges::count(readText(Path(out) / file), '\n'); };
    EXPECT_EQ(rows("results.1-of-3.jsonl"), 2);
    EXPECT_EQ(rows("results.3-of-3.jsonl"), 1);
    EXPECT_EQ(rows("results.jsonl"), 2) << "what a lost job left, the merge makes";
    EXPECT_EQ(readText(folder / "jobs.left").find("summary.json"), std::string::npos) << "shards leave it to the merge to report";
    EXPECT_EQ(readJson(Path(out) / "summary.json")["missing"], 0);
    EXPECT_NE(output.err.find("once all shards are done"), std::string::npos) << output.err;
}

TEST_F(SlurmTest, WrongUseIsSaid) {
    EXPECT_EQ(submit({}).exitCode, 2);
    EXPECT_NE(submit({(folder / "study.json").string(), "out", "none"}).err.find("\"none\" is no number of shards"), std::string::npos);
    EXPECT_NE(submit({(folder / "nothing.json").string(), "out", "2"}).err.find("there is no study"), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(folder / "jobs"));
}

TEST_F(SlurmTest, ScriptsHaveNoKnownFaults) {
    for (const char* name : {"submit", "job"}) {
        const std::string file = (sourceFolder / "scripts/slurm" / name).string();
        EXPECT_EQ(runProcess({"bash", "-n", file}).exitCode, 0);
        const Output output = runProcess({"bash", "-c", "command -v shellcheck >/dev/null || exit 0; shellcheck " + file});
        EXPECT_EQ(output.exitCode, 0) << output.out;
    }
}

}  // namespace
}  // namespace lodestir::test
