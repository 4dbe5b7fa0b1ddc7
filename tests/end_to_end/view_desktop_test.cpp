// SPDX-License-Identifier: MIT
// The viewer as a guest of a desktop: small pixels, and a window that opens where it was.
#include "viewer.h"

#include <framework/image/png.h>

namespace lodestir::test {
namespace {

class ViewDesktop : public ViewerTest {
protected:
    /// A desktop for its users' eyes: type and panels `density` times as large.
    void wantsDensity(double density) {
        const std::string resource = "Xft.dpi: " + std::to_string(int(96 * density));
        const Output set = runProcess({"xprop", "-root", "-f", "RESOURCE_MANAGER", "8s", "-set", "RESOURCE_MANAGER", resource}, {{"DISPLAY", display->name()}});
        ASSERT_EQ(set.exitCode, 0) << set.err;
    }
    /// A window manager, there before the first window.
    void manage() {
        manager.emplace(std::vector<std::string>{"openbox"}, Environment{{"DISPLAY", display->name()}});
        const auto manages = [&] { return runProcess({"xdotool", "get_desktop"}, {{"DISPLAY", display->name()}}).exitCode == 0; };
        for (int i = 0; i < 100 && !manages(); ++i) std::this_thread::sleep_for(100ms);
        ASSERT_TRUE(manages());
    }
    /// Corner and size of the viewer's window on the screen, without its frame.
    std::array<int, 4> geometry() {
        const Output output = runProcess({"xdotool", "search", "--name", "Lodestir", "getwindowgeometry", "--shell"}, {{"DISPLAY", display->name()}});
        std::array<int, 4> result{};
        const char* names[] = {"\nX=", "\nY=", "\nWIDTH=", "\nHEIGHT="};
        for (std::size_t i = 0; i < 4; ++i)
            if (const std::size_t at = output.out.find(names[i]); at != std::string::npos)
                result[i] = std::atoi(output.out.c_str() + at + std::strlen(names[i]));
        return result;
    }
    Path kept() const { return folder / "state/lodestir/window.json"; }
    Viewer opened(const Arguments& arguments = {}) {
        std::filesystem::remove(folder / "report.json");  // of the last one
        return Viewer(*display, folder, folder / "graph.json", arguments, {{"XDG_STATE_HOME", (folder / "state").string()}});
    }
    static void close(Viewer& viewer) {
        viewer.key("alt+F4");
        const Output end = viewer.wait();
        EXPECT_EQ(end.exitCode, 0) << end.err;
    }

    void TearDown() override {
        if (manager) manager->kill(SIGTERM);
    }

    std::optional<Process> manager;
};

// With frames around windows, sizes and closing decided by somebody else.
TEST_F(ViewDesktop, LivesWithAWindowManager) {
    if (!isInstalled("openbox")) GTEST_SKIP() << "needs openbox; scripts/setup installs it";
    ASSERT_NO_FATAL_FAILURE(manage());
    Viewer viewer(*display, folder, writeGraph(), {});
    viewer.await("frames", rendered);
    const auto sized = [&](int width, int height) {
        display->xdotool({"search", "--name", "Lodestir", "windowsize", std::to_string(width), std::to_string(height)});
        return viewer.await("a window of another size", [&](const OrderedJson& r) {
            return r["area"][0].get<int>() + r["area"][2].get<int>() == width && r["area"][3].get<int>() < height && r["area"][3].get<int>() > height / 2;
        });
    };
    sized(900, 600);
    const OrderedJson small = sized(640, 480);
    viewer.await("more frames", [&](const OrderedJson& r) { return r["frames"].get<int>() > small["frames"].get<int>() + 5; });
    const OrderedJson large = sized(1100, 700);
    viewer.key("space");  // places of widgets are the window's, and the frame around it moves that
    viewer.await("a pause", [](const OrderedJson& r) { return r["paused"] == true; });
    EXPECT_TRUE(large["problems"].empty()) << large["problems"];
    viewer.key("alt+F4");
    const Output end = viewer.wait();
    EXPECT_EQ(end.exitCode, 0) << end.err;
    EXPECT_EQ(end.err, "");
}

// If this fails, type can't be read on a notebook's fine screen, or clicks land where nothing is.
TEST_F(ViewDesktop, DrawsLargerWherePixelsAreSmall) {
    if (!isInstalled("xprop")) GTEST_SKIP() << "needs xprop; scripts/setup installs it";
    writeGraph();
    ASSERT_NO_FATAL_FAILURE(wantsDensity(1.5));
    std::filesystem::create_directories(kept().parent_path());
    writeFile(kept(), std::string_view(R"({"corner": [0, 0], "size": [1280, 800], "maximised": false})"));
    Viewer viewer = opened({"--size", "43x25", "--screenshot", (folder / "w.png").string()});
    const OrderedJson first = viewer.await("frames", rendered);
    EXPECT_EQ(first["density"], 1.5);
    // A widget is met by the pointer, and the pixel below it is the one that is told.
    viewer.click("pause");
    viewer.await("a pause", [](const OrderedJson& r) { return r["paused"] == true; });
    const auto [x, y] = viewer.picture();
    viewer.point(x, y);
    viewer.await("the pixel in the middle", [](const OrderedJson& r) { return r["pixel"] == OrderedJson{21, 12}; });
    // Whole pixels of the window for each of the image: the columns of the picture change their colour at equal steps.
    const ImageData window = viewer.window(folder / "w.png");
    const int row = int(y);
    std::set<int> steps;
    for (int from = int(x) - 200, last = from, at = from + 1; at < int(x) + 200; ++at)
        if (std::abs(window.at(at, row, 0) - window.at(at - 1, row, 0)) > 1e-4f) {
            if (last != from) steps.insert(at - last);
            last = at;
        }
    int common = 0;
    for (const int step : steps) common = std::gcd(common, step);
    EXPECT_GE(common, 2) << "pixels of the picture are of unequal width";
}

// If this fails, whoever has laid out a desk moves the window each morning.
TEST_F(ViewDesktop, OpensWhereItWas) {
    if (!isInstalled("openbox")) GTEST_SKIP() << "needs openbox; scripts/setup installs it";
    writeGraph();
    ASSERT_NO_FATAL_FAILURE(manage());
    std::array<int, 4> left{};
    {
        Viewer viewer = opened();
        viewer.await("frames", rendered);
        display->xdotool({"search", "--name", "Lodestir", "windowsize", "--sync", "800", "560"});
        display->xdotool({"search", "--name", "Lodestir", "windowmove", "--sync", "210", "130"});
        viewer.await("another size", [](const OrderedJson& r) { return r["area"][0].get<int>() + r["area"][2].get<int>() == 800; });
        left = geometry();
        close(viewer);
    }
    for (int run = 0; run < 2; ++run) {
        Viewer viewer = opened();
        viewer.await("frames", rendered);
        EXPECT_EQ(geometry(), left) << "run " << run;
        close(viewer);
    }
    // What is damaged, or on a screen that is gone, is as if it weren't there: the window can be seen.
    for (const char* text : {"{", R"({"corner": [9000, 9000], "size": [800, 560], "maximised": false})"}) {
        writeFile(kept(), std::string_view(text));
        Viewer viewer = opened();
        viewer.await("frames", rendered);
        const auto [x, y, width, height] = geometry();
        EXPECT_TRUE(x >= 0 && x + width / 2 < 1280 && y >= 0 && y < 800) << text << ": " << x << " " << y;
        close(viewer);
    }
}

}  // namespace
}  // namespace lodestir::test
