// SPDX-License-Identifier: MIT
// The ten things that somebody new to the viewer wants first, each with as many clicks and keys as docs/view.md says.
#include "viewer.h"

#include "level_model.h"

namespace lodestir::test {
namespace {

class ViewTasks : public ViewerTest {
protected:
    /// A bowl of three levels before a camera.
    Path writeBowl() {
        writeLevels(folder, "bowl", {{.cells = 20, .place = bowl}, {.cells = 6, .place = bowl}, {.cells = 3, .place = bowl}});
        write("bowl.json", {{"format", 1},
                            {"models", {{"bowl", {{"file", "bowl.gltf"}}}}},
                            {"instances", {{{"model", "bowl"}, {"name", "bowl"}}}},
                            {"environment", {{"type", "constant"}}},
                            {"camera", {{"position", {0, 2.4, 2.6}}, {"target", {0, 0.2, 0}}, {"fovy", 45}}}});
        return folder / "bowl.json";
    }
    /// "| what | clicks |": those of the table under the heading, in order.
    static std::vector<int> promised() {
        std::vector<int> counts;
        bool inside = false;
        std::istringstream page(readText(sourceFolder / "docs/view.md"));
        for (std::string line; std::getline(page, line);) {
            if (line.starts_with("## ")) inside = line == "## Ten things, and the clicks they take";
            const std::size_t last = line.rfind('|', line.size() - 2);
            const bool isRow = inside && line.starts_with("| ") && std::isdigit(static_cast<unsigned char>(line[last + 2]));
            if (isRow) counts.push_back(std::stoi(line.substr(last + 2)));
        }
        return counts;
    }
};

// If this fails, docs/view.md promises what takes more than it says.
TEST_F(ViewTasks, TakeTheClicksThatAreTold) {
    constexpr auto patience = 400s;  // the driver compiles kernels that no other test has
    Viewer viewer(*display, folder, sourceFolder / "graphs/restir_lod.json",
                  {"--scene", writeBowl().string(), "--size", "96x54", "--show", "shade.color"});
    viewer.await("frames", rendered, patience);
    std::vector<int> taken;
    const auto task = [&](const std::string& what, const std::function<void()>& act, const std::function<bool(const OrderedJson&)>& done) {
        const int before = viewer.actions();
        act();
        const OrderedJson r = viewer.await(what, [&](const OrderedJson& report) { return report["busy"] == "" && done(report); }, patience);
        EXPECT_TRUE(r["problems"].empty()) << what << ": " << r["problems"];
        taken.push_back(viewer.actions() - before);
    };
    const auto wrote = [&](const std::string& name) {
        return [&, name](const OrderedJson&) {
            std::error_code none;
            return std::filesystem::exists(folder / "out" / name, none);
        };
    };

    task("the pass that takes longest", [] {},
         [](const OrderedJson& r) { return r["widgets"].contains("times of spatial") && r["runs"]["spatial"].get<int>() > 0; });
    task("what a pass hands on", [&] { viewer.key("g"), viewer.click("out: hits.normal"); },
         [](const OrderedJson& r) { return r["shown"] == "hits.normal"; });
    task("another way of reuse", [&] { viewer.click("node: temporal", 0.5, "3"), viewer.click("menu: swap"), viewer.click("swap: temporal_reprojection"); },
         [](const OrderedJson& r) { return r["undo"] == "temporal as temporal_reprojection"; });
    task("that taken back", [&] { viewer.key("ctrl+z"); }, [](const OrderedJson& r) { return r["undo"] == ""; });
    viewer.key("g");
    task("what happened to a pixel",
         [&] {
             const auto [x, y] = viewer.picture();
             viewer.seen([&] { viewer.point(x, y); });
             viewer.key("p");
         },
         [](const OrderedJson& r) { return r.contains("told") && r["told"]["passes"]["temporal"]["ports"].contains("paths.reservoirs"); });
    viewer.key("Escape");
    task("two caps side by side", [&] { viewer.key("l"), viewer.dragAcross("temporal.cap", 0.3, 0.9); },
         [](const OrderedJson& r) { return r.contains("a") && r["a"]["kind"] == "live" && r["undo"] == "temporal.cap"; });
    viewer.key("l");
    task("a coarser level", [&] { viewer.key("o"), viewer.click("all coarser"); },
         [](const OrderedJson& r) { return r.contains("scene") && r["scene"]["levels"] == OrderedJson({1}); });
    task("a camera's path as a scene file",
         [&] {
             viewer.click("tab: Camera");
             viewer.click("add key");
             viewer.drag("1", 0.1, 0);
             viewer.click("add key");
             viewer.click("save path");
         },
         [](const OrderedJson& r) { return r["note"].get<std::string>().find("wrote") != std::string::npos; });
    task("the picture, with its graph", [&] { viewer.key("s"); },
         [](const OrderedJson& r) { return r["note"].get<std::string>().find(".exr") != std::string::npos; });
    task("times for a spreadsheet and Perfetto", [&] { viewer.key("t"); }, wrote("times.csv"));
    EXPECT_EQ(taken, promised());
    EXPECT_TRUE(viewer.running());
}

}  // namespace
}  // namespace lodestir::test
