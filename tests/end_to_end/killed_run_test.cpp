// SPDX-License-Identifier: MIT
// A run that is killed leaves whole files under final names, or none.
#include "program.h"

#include <framework/image/png.h>

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

}  // namespace
}  // namespace lodestir::test
