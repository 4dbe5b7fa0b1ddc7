// SPDX-License-Identifier: MIT
// What is killed leaves whole files under final names, or none, and no scraps; what is done again succeeds.
#include "program.h"

#include <framework/image/png.h>

#include <cstdlib>
#include <map>
#include <random>
#include <sstream>
#include <thread>

namespace lodestir::test {
namespace {

class KilledRun : public ProgramTest {};

// If this fails, a study that was cut off takes half an image for a result.
TEST_F(KilledRun, LeavesNoHalfFile) {
    // Mostly writing: first hits alone, large images.
    write("graph.json", {{"format", 1},
                         {"scene", (sourceFolder / "scenes/cornell.json").string()},
                         {"frame", {{"size", {512, 384}}, {"count", 1000}, {"seed", 1}}},
                         {"passes", {{"hits", {{"type", "visibility"}}}}},
                         {"show", "hits.normal"}});
    for (int round = 0; round < 6; ++round) {
        const Path out = folder / ("out" + std::to_string(round));
        Process process({LODESTIR_BINARY, "run", (folder / "graph.json").string(), "--out", out.string(), "--dump", "hits.hits", "--dump",
                         "hits.depth"});
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
        while (filesOf(out).size() < 8 && process.running() && std::chrono::steady_clock::now() < end)
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        std::this_thread::sleep_for(std::chrono::milliseconds(7 * round));  // another moment of the cycle each time
        ASSERT_TRUE(process.running()) << process.wait(std::chrono::seconds(1)).err;
        process.kill(SIGKILL);
        EXPECT_EQ(process.wait(std::chrono::seconds(10)).signal, SIGKILL);

        int whole = 0;
        for (const std::string& name : filesOf(out)) {
            const Path path = out / name;
            if (!name.starts_with("hits.")) continue;  // what was being written aside
            ++whole;
            if (path.extension() == ".exr") {
                EXPECT_NO_THROW(readExr(path)) << name;
            } else if (path.extension() == ".png") {
                EXPECT_NO_THROW(readPng(path)) << name;
            } else {
                EXPECT_EQ(std::filesystem::file_size(path), std::filesystem::file_size(out / "hits.hits.0.npy")) << name;
            }
        }
        EXPECT_GE(whole, 7);
        EXPECT_FALSE(std::filesystem::exists(out / "run.json")) << "run.json says that the run is complete";
        std::filesystem::remove_all(out);
    }
}

// If this fails, a long run that is stopped leaves images of which nothing tells how they were made.
TEST_F(KilledRun, WhatIsInterruptedSaysWhatIsDone) {
    write("graph.json", {{"format", 1},
                         {"scene", (sourceFolder / "scenes/cornell.json").string()},
                         {"frame", {{"size", {64, 48}}, {"count", 100000}, {"seed", 1}}},
                         {"passes", {{"hits", {{"type", "visibility"}}}}},
                         {"show", "hits.normal"}});
    for (const auto& [signal, name] : {std::pair(SIGINT, "SIGINT"), std::pair(SIGTERM, "SIGTERM")}) {
        const Path out = folder / name;
        Process process({LODESTIR_BINARY, "run", (folder / "graph.json").string(), "--out", out.string(), "--trace", (out / "trace.json").string()});
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
        while (filesOf(out).size() < 8 && process.running() && std::chrono::steady_clock::now() < end)
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        process.kill(signal);
        const Output output = process.wait(std::chrono::seconds(30));
        EXPECT_EQ(output.exitCode, 1) << output.err;
        EXPECT_NE(output.err.find(std::string("interrupted by ") + name + " after "), std::string::npos) << output.err;
        const OrderedJson json = readJson(out / "run.json");
        EXPECT_EQ(json["interrupted"], name);
        const std::size_t done = json["frames"].size();
        EXPECT_GE(done, 3u);
        for (std::size_t frame = 0; frame < done; ++frame) {
            EXPECT_EQ(json["frames"][frame]["frame"], frame);
            EXPECT_NO_THROW(readExr(out / ("hits.normal." + std::to_string(frame) + ".exr")));
        }
        EXPECT_EQ(filesOf(out).size(), 2 * done + 2) << "images of more frames than run.json tells of";
        EXPECT_TRUE(std::filesystem::exists(out / "trace.json"));
    }
}

/// Names that begin with a dot, in a folder and all below: what was being written aside.
std::vector<std::string> scrapsIn(const Path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.path().filename().string().starts_with(".")) names.push_back(entry.path().string());
    return names;
}

/// By what a row is of: what was measured, times aside. Fails the test where a row is there twice.
std::map<std::string, OrderedJson> measuredIn(const Path& file) {
    std::map<std::string, OrderedJson> byRun;
    std::istringstream lines(readText(file));
    for (std::string line; std::getline(lines, line);) {
        const OrderedJson row = OrderedJson::parse(line);
        const std::string key = row["run"].get<std::string>() + row["frame"].dump();
        EXPECT_FALSE(byRun.contains(key)) << "twice: " << line;
        byRun[key] = row["metrics"];
    }
    return byRun;
}

// If this fails, a study that is stopped and resumed again and again, as on a cluster, ends with rows missing or doubled, or a full disk. Killed at moments
// that are drawn anew for each of LODESTIR_KILLS seeds (3), by one process and by two.
TEST_F(KilledRun, StudiesResumeAfterAnyKill) {
    write("study.json", {{"format", 1},
                         {"scenes", {(sourceFolder / "scenes/cornell.json").string()}},
                         {"size", {24, 16}},
                         {"seeds", 12},
                         {"frames", {{"measure", {0, 1}}}},
                         {"charts", {"error_vs_rays"}},
                         {"reference", {{"graph", (sourceFolder / "graphs/path_tracer.json").string()}, {"spp", 8}}},
                         {"techniques", {{"one", {{"graph", (sourceFolder / "graphs/path_tracer.json").string()}, {"variant", "no accumulation"}}},
                                         {"two", {{"graph", (sourceFolder / "graphs/path_tracer.json").string()}}}}}});
    const auto command = [&](const std::string& out, int jobs) {
        return Arguments{LODESTIR_BINARY, "study",    (folder / "study.json").string(), "--out", (folder / out).string(),
                         "--resume",      "--jobs", std::to_string(jobs)};
    };
    const auto start = std::chrono::steady_clock::now();
    ASSERT_EQ(runProcess(command("undisturbed", 1)).exitCode, 0);
    const double whole = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const std::map<std::string, OrderedJson> expected = measuredIn(folder / "undisturbed/results.jsonl");
    ASSERT_EQ(expected.size(), 2u * 12u * 2u);
    const char* asked = std::getenv("LODESTIR_KILLS");
    int killed = 0;
    for (int seed = 1; seed <= (asked ? std::atoi(asked) : 3); ++seed) {
        std::mt19937 random{std::uint32_t(seed)};
        const Arguments study = command("killed" + std::to_string(seed), 1 + seed % 2);
        for (int round = 0; round < 3; ++round) {
            Process process(study);
            std::this_thread::sleep_for(std::chrono::duration<double>(whole * std::uniform_real_distribution<double>(0.1, 1)(random)));
            if (!process.running()) break;
            process.kill(SIGKILL);
            process.wait(std::chrono::seconds(10));
            ++killed;
        }
        const Output output = runProcess(study);
        ASSERT_EQ(output.exitCode, 0) << output.err;
        EXPECT_EQ(measuredIn(Path(study[4]) / "results.jsonl"), expected) << "seed " << seed;
        EXPECT_EQ(readJson(Path(study[4]) / "summary.json")["missing"], 0);
        EXPECT_TRUE(scrapsIn(study[4]).empty()) << scrapsIn(study[4])[0];
    }
    EXPECT_GT(killed, 0);
}

// If this fails, what a study has measured so far can't be looked at when it is stopped, or processes of it stay behind.
TEST_F(KilledRun, AnInterruptedStudyReportsWhatItHas) {
    write("study.json",
          {{"format", 1},
           {"scenes", {(sourceFolder / "scenes/cornell.json").string()}},
           {"size", {24, 16}},
           {"seeds", 5000},
           {"reference", {{"graph", (sourceFolder / "graphs/path_tracer.json").string()}, {"spp", 8}}},
           {"techniques", {{"one", {{"graph", (sourceFolder / "graphs/path_tracer.json").string()}, {"variant", "no accumulation"}}}}}});
    for (const char* jobs : {"1", "2"}) {
        const Path out = folder / jobs;
        Process process({LODESTIR_BINARY, "study", (folder / "study.json").string(), "--out", out.string(), "--jobs", jobs});
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(100);
        const auto rows = [&] {
            return std::filesystem::exists(out / "results.jsonl") ? std::ranges::count(readText(out / "results.jsonl"), '\n') : 0;
        };
        while (rows() < 2 && process.running() && std::chrono::steady_clock::now() < end)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        process.kill(SIGINT);  // to all of its processes, as a terminal sends it
        const Output output = process.wait(std::chrono::seconds(60));
        EXPECT_EQ(output.exitCode, 1) << output.err;
        EXPECT_NE(output.err.find("interrupted by SIGINT; go on with --resume"), std::string::npos) << output.err;
        EXPECT_GE(rows(), 2);
        EXPECT_LT(rows(), 5000);
        EXPECT_EQ(measuredIn(out / "results.jsonl").size(), std::size_t(rows()));
        EXPECT_EQ(readJson(out / "summary.json")["missing"], 5000 - rows());
    }
}

// If this fails, a model or a map that was cut off is taken for a whole one.
TEST_F(KilledRun, ModelsAndMapsAreWholeOrNotThere) {
    ImageData image = makeImage(1500, 1000, 3);
    for (std::size_t i = 0; i < image.values.size(); ++i) image.values[i] = float(i * 2654435761u % 1000) / 1000;
    writeExr(folder / "image.exr", image);
    const std::string picture = (folder / "image.exr").string();
    const Arguments commands[]{
        {LODESTIR_BINARY, "lod", (sceneFolder() / "cube.glb").string(), "--levels", "2", "--out", (folder / "out/cube.glb").string()},
        {LODESTIR_BINARY, "compare", picture, picture, "--metrics", "mse", "--map", (folder / "out/map.exr").string()}};
    for (const Arguments& command : commands) {
        const auto start = std::chrono::steady_clock::now();
        ASSERT_EQ(runProcess(command).exitCode, 0);
        const auto time = std::chrono::steady_clock::now() - start;
        const auto [name, size] = std::pair(command.back(), std::filesystem::file_size(command.back()));
        for (const double share : {0.3, 0.7, 0.9, 0.97}) {
            std::filesystem::remove(name);
            Process process(command);
            std::this_thread::sleep_for(share * time);
            process.kill(SIGKILL);
            process.wait(std::chrono::seconds(10));
            EXPECT_TRUE(!std::filesystem::exists(name) || std::filesystem::file_size(name) == size) << name;
            EXPECT_TRUE(scrapsIn(folder).empty()) << scrapsIn(folder)[0];
        }
        EXPECT_EQ(runProcess(command).exitCode, 0);
    }
}

}  // namespace
}  // namespace lodestir::test
