// SPDX-License-Identifier: MIT
// A viewer that is left running: it holds no more memory after many frames and reloads than after a few, lives with a window manager, and ends when it is
// told to.
#include "viewer.h"

#include <limits>

namespace lodestir::test {
namespace {

/// What the system says of a process: MiB in memory, threads, open files.
struct Holdings {
    double memory = 0;
    int threads = 0, files = 0;
};
Holdings holdingsOf(pid_t pid) {
    const Path process = Path("/proc") / std::to_string(pid);
    Holdings found;
    std::ifstream status(process / "status");
    for (std::string name; status >> name;) {
        if (name == "VmRSS:") status >> found.memory;
        if (name == "Threads:") status >> found.threads;
        std::getline(status, name);
    }
    found.memory /= 1024;
    // The least of some looks: its report is a file that is open now and then.
    found.files = std::numeric_limits<int>::max();
    for (int i = 0; i < 20; ++i) {
        int files = 0;
        for ([[maybe_unused]] const auto& file : std::filesystem::directory_iterator(process / "fd")) ++files;
        found.files = std::min(found.files, files);
        std::this_thread::sleep_for(10ms);
    }
    return found;
}

class ViewEndurance : public ViewerTest {
protected:
    /// Renders `frames` frames with `reloads` of graph and shader in turn; the first of each is not counted, because it fills what is kept.
    void endure(int frames, int reloads) {
        std::filesystem::copy(sourceFolder / "framework/shaders", folder / "shaders", std::filesystem::copy_options::recursive);
        const Path shader = folder / "shaders/base/tone_curve.glsl";
        const std::string good = readText(shader);
        Viewer viewer(*display, folder, writeGraph(), {"--size", "64x36"}, {{"LODESTIR_SHADERS", (folder / "shaders").string()}});
        OrderedJson now = viewer.await("frames", rendered);
        const auto reload = [&](int i) {
            const int builds = now["builds"], shaders = now["reloads"];
            if (i % 2 == 0) writeGraph(-1 - i % 4);
            else writeFile(shader, good + "// " + std::to_string(i) + "\n");
            now = viewer.await("reload " + std::to_string(i), [&](const OrderedJson& r) {
                return r["builds"].get<int>() + r["reloads"].get<int>() > builds + shaders && r["framesStill"].get<int>() > 0 && r["busy"] == "";
            });
            EXPECT_TRUE(now["problems"].empty()) << now["problems"];
        };
        const auto render = [&](int more) {
            const int until = now["frames"].get<int>() + more;
            now = viewer.await("frames", [&](const OrderedJson& r) { return r["frames"].get<int>() >= until; }, 300s);
        };
        for (int i = 0; i < 4; ++i) reload(i);
        render(50);
        const Holdings before = holdingsOf(viewer.pid());
        for (int i = 0; i < reloads; ++i) reload(i);
        render(frames);
        const Holdings after = holdingsOf(viewer.pid());
        std::printf("%d frames, %d reloads: %.0f -> %.0f MiB, %d -> %d threads, %d -> %d files\n", frames, reloads, before.memory, after.memory, before.threads,
                    after.threads, before.files, after.files);
        EXPECT_LT(after.memory, before.memory + most);
        EXPECT_EQ(after.threads, before.threads);
        EXPECT_EQ(after.files, before.files);
    }
    /// MiB by which memory may grow, whatever the number of frames and reloads: what an allocator keeps.
    static constexpr double most = 24;
};

// If this fails, a viewer that is worked with all day ends by the system's hand.
TEST_F(ViewEndurance, HoldsNoMoreAfterFramesAndReloads) { endure(300, 12); }

using LongViewEndurance = ViewEndurance;
TEST_F(LongViewEndurance, HoldsNoMoreAfterManyFramesAndReloads) { endure(2000, 50); }

}  // namespace
}  // namespace lodestir::test
