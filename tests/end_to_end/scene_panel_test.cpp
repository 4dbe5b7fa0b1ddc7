// SPDX-License-Identifier: MIT
// The scene edited while it runs, by mouse and keys: what is seen is what files that say the same give in `lodestir run`, bit for bit.
#include "viewer.h"

#include "level_model.h"

namespace lodestir::test {
namespace {

class ScenePanelTest : public ViewerTest {
protected:
    static void open(Viewer& viewer, const std::string& tab) {
        viewer.key("o");
        viewer.await("the panel", [](const OrderedJson& r) { return r.contains("scene"); });
        viewer.click("tab: " + tab);
    }
    /// Two bowls, of which the left one has a switch to a coarser level at a frame, if any.
    Path writeBowls(const std::string& name, std::optional<int> frame = {}) {
        writeLevels(folder, "bowl", {{.cells = 20, .place = bowl}, {.cells = 6, .place = bowl}, {.cells = 3, .place = bowl}});
        OrderedJson scene{{"format", 1},
                          {"models", {{"bowl", {{"file", "bowl.gltf"}}}}},
                          {"instances",
                           {{{"model", "bowl"}, {"name", "left"}, {"translation", {-0.9, 0, 0}}, {"scale", 0.8}},
                            {{"model", "bowl"}, {"name", "right"}, {"translation", {0.9, 0, 0}}, {"scale", 0.8}}}},
                          {"environment", {{"type", "constant"}}},
                          {"camera", {{"position", {0, 2.4, 2.6}}, {"target", {0, 0.2, 0}}, {"fovy", 45}}}};
        if (frame) scene["lod"] = {{"mode", "schedule"}, {"schedule", {{{"frame", *frame}, {"instance", "left"}, {"level", 1}}}}};
        write(name, scene);
        return folder / name;
    }
    /// Frame after frame by itself, so that a picture tells which frame it is of.
    Path writeFrames(const Path& scene) {
        write("frames.json", {{"format", 1},
                              {"scene", scene.string()},
                              {"frame", {{"size", {96, 54}}, {"seed", 1}}},
                              {"passes", {{"trace", {{"type", "path_tracer"}}}, {"display", {{"type", "tone_map"}, {"in", {{"color", "trace"}}}}}}},
                              {"show", "trace.color"}});
        return folder / "frames.json";
    }
};

// A level forced by hand is a switch like one of a scene file: reuse sees it, and goes on over it, in the same way.
TEST_F(ScenePanelTest, ForcedLevelIsASwitchOfTheScene) {
    constexpr auto patience = 400s;  // the driver compiles kernels that no other test has
    const Path graph = sourceFolder / "graphs/restir_lod.json";
    Viewer viewer(*display, folder, graph, {"--scene", writeBowls("bowls.json").string(), "--size", "96x54", "--show", "shade.color"});
    viewer.await("frames", rendered, patience);
    viewer.key("space");
    viewer.await("a pause", [](const OrderedJson& r) { return r["paused"].get<bool>(); });
    open(viewer, "Levels");
    const OrderedJson before = viewer.await("the levels", [](const OrderedJson& r) { return r["scene"]["levels"] == OrderedJson({0, 0}); });
    EXPECT_EQ(before["scene"]["triangles"], 2 * 2 * 20 * 20);
    EXPECT_GT(before["scene"]["pixels"][0].get<int>(), 100);

    // A click on the left bowl picks it.
    viewer.clickPicture(-0.2);
    const int frame = viewer.await("the left one", [](const OrderedJson& r) { return r["scene"]["picked"] == 0; })["nextFrame"].get<int>();
    viewer.click("coarser");
    const OrderedJson after = viewer.await("a level", [](const OrderedJson& r) { return r["scene"]["levels"] == OrderedJson({1, 0}); });
    EXPECT_EQ(after["nextFrame"], frame + 1);  // while it is paused an edit shows its frame
    EXPECT_EQ(after["parameters"]["lod.force"], "left=1");
    EXPECT_EQ(after["builds"], 1);
    viewer.key("n");
    viewer.await("one frame more", [&](const OrderedJson& r) { return r["nextFrame"] == frame + 2; });
    EXPECT_EQ(saveImage(viewer), frame + 1);
    expectFrame("shade.color", frame + 1, graph, {"--scene", writeBowls("switched.json", frame).string(), "--size", "96x54"});

    viewer.click("all coarser");
    viewer.await("all one coarser", [](const OrderedJson& r) { return r["scene"]["levels"] == OrderedJson({2, 1}); });
    viewer.click("all as chosen");
    viewer.await("as chosen", [](const OrderedJson& r) { return r["scene"]["levels"] == OrderedJson({0, 0}) && r["parameters"]["lod.force"] == ""; });
    viewer.key("ctrl+z");
    viewer.await("taken back", [](const OrderedJson& r) { return r["scene"]["levels"] == OrderedJson({2, 1}); });
    EXPECT_TRUE(viewer.running());
}

// A graph without a pass that chooses levels gets one, and is saved with it.
TEST_F(ScenePanelTest, GraphWithoutLevelsGetsThem) {
    Viewer viewer(*display, folder, writeFrames(writeBowls("bowls.json")), {});
    viewer.await("frames", rendered);
    open(viewer, "Levels");
    viewer.click("level: right / bowl");
    viewer.click("level 2");
    const OrderedJson forced = viewer.await("a level", [](const OrderedJson& r) { return r["scene"]["levels"] == OrderedJson({0, 2}) && r["busy"] == ""; });
    EXPECT_EQ(forced["builds"], 2);
    viewer.click("save graph");
    viewer.await("the graph", [](const OrderedJson& r) { return r["note"].get<std::string>().find("frames.json") != std::string::npos; });
    const OrderedJson passes = readJson(folder / "out/frames.json")["passes"];
    EXPECT_EQ(passes["lod_select"]["set"]["force"], "right=2");
    EXPECT_EQ(passes["trace"]["in"]["world"], "lod_select.world");
    const int frame = saveImage(viewer);
    expectFrame("trace.color", frame, folder / "out/frames.json", {});
    viewer.click("show levels");
    viewer.await(
        "levels in colours", [](const OrderedJson& r) { return r["shown"] == "level_colors.color"; }, 200s);
}

// A path of two keys is played as a run plays the scene file that is made of it; views are kept from one viewer to the next.
TEST_F(ScenePanelTest, PathIsPlayedByRun) {
    const Path graph = writeFrames(writeBowls("bowls.json"));
    {
        Viewer viewer(*display, folder, graph, {});
        viewer.await("frames", rendered);
        open(viewer, "Camera");
        viewer.click("store view");
        viewer.click("add key");
        viewer.drag("1", 0.13, 0.07);
        const OrderedJson moved =
            viewer.await("a camera of its own", [](const OrderedJson& r) { return r["camera"]["own"].get<bool>() && r["framesStill"].get<int>() > 3; });
        viewer.click("add key");
        viewer.click("view: view 1");
        viewer.await("the first view", [&](const OrderedJson& r) { return r["camera"]["key"] != moved["camera"]["key"]; });
        viewer.click("play path");
        viewer.await("on its way", [](const OrderedJson& r) { return r["camera"]["own"].get<bool>() && r["nextFrame"].get<int>() < 60; });
        viewer.key("space");
        viewer.await("a pause", [](const OrderedJson& r) { return r["paused"].get<bool>(); });
        viewer.click("save path");
        viewer.await("the scene", [](const OrderedJson& r) { return r["note"].get<std::string>().find("bowls.path.json") != std::string::npos; });
        const int frame = saveImage(viewer);
        expectFrame("trace.color", frame, graph, {"--scene", (folder / "out/bowls.path.json").string()});
        viewer.click("hold pose");
        viewer.await("held", [](const OrderedJson& r) { return r["parameters"]["scene.animate"] == false; });
    }
    EXPECT_EQ(readJson(folder / "out/bowls.path.json")["camera"]["keyframes"].size(), 2u);
    EXPECT_EQ(readJson(folder / "out/bowls.views.json")["views"][0]["name"], "view 1");
    std::filesystem::remove(folder / "report.json");
    Viewer again(*display, folder, graph, {});
    again.await("frames", rendered);
    open(again, "Camera");
    again.click("delete view: view 1");
    EXPECT_TRUE(readJson(folder / "out/bowls.views.json")["views"].empty());
}

// A lamp is turned up and back: the picture follows, and what is saved gives it. The slider is in candela, the graph has factors.
TEST_F(ScenePanelTest, LightsAreEdited) {
    const Path bowls = writeBowls("bowls.json");
    OrderedJson scene = readJson(bowls);
    scene["environment"]["strength"] = 0;
    scene["lights"] = {{{"type", "point"}, {"name", "lamp"}, {"position", {0, 2, 0}}, {"intensity", 2}}};
    write("lamp.json", scene);
    const Path graph = writeFrames(folder / "lamp.json");
    Viewer viewer(*display, folder, graph, {});
    const double mean = viewer.await("frames", rendered)["mean"].get<double>();
    open(viewer, "Lights");
    viewer.click("light_edit lamp.intensity", 0.5);
    const OrderedJson brighter =
        viewer.await("more light", [&](const OrderedJson& r) { return r["busy"] == "" && r.contains("mean") && r["mean"].get<double>() > 3 * mean; });
    EXPECT_EQ(brighter["builds"], 2);
    EXPECT_NEAR(brighter["parameters"]["light_edit.intensity"].get<double>(), 10, 1.5);
    viewer.click("save graph");
    viewer.await("the graph", [](const OrderedJson& r) { return r["note"].get<std::string>().find("frames.json") != std::string::npos; });
    EXPECT_EQ(readJson(folder / "out/frames.json")["passes"]["light_edit"]["set"]["light"], "lamp");
    const int frame = saveImage(viewer);
    expectFrame("trace.color", frame, folder / "out/frames.json", {});
    viewer.type("light_edit lamp.intensity", "5");
    viewer.await("five candela, where the scene has two", [](const OrderedJson& r) { return r["parameters"]["light_edit.intensity"] == 2.5; });
    viewer.click("light_edit lamp.intensity back");
    viewer.await("as it was", [&](const OrderedJson& r) { return r.contains("mean") && std::abs(r["mean"].get<double>() - mean) < 0.2 * mean; });
    EXPECT_EQ(viewer.report()["builds"], 2);
}

// If this fails, a material that is edited looks otherwise than one of a file that says the same.
TEST_F(ScenePanelTest, AMaterialIsThatOfAFile) {
    const Path graph = writeFrames(writeBowls("bowls.json"));
    OrderedJson model = readJson(folder / "bowl.gltf");
    OrderedJson& clay = model["materials"][0];
    clay["name"] = "clay";
    write("bowl.gltf", model);
    Viewer viewer(*display, folder, graph, {});
    viewer.await("frames", rendered);
    open(viewer, "Materials");
    viewer.clickPicture(-0.2);  // picks the left bowl, and opens what it is made of
    viewer.click("material_edit clay.red", 0);
    viewer.await("no red", [](const OrderedJson& r) { return r["busy"] == "" && r["parameters"].value("material_edit.red", 1.0) == 0; });
    const int frame = saveImage(viewer);
    clay["pbrMetallicRoughness"]["baseColorFactor"][0] = 0;
    write("bowl.gltf", model);
    expectFrame("trace.color", frame, graph, {});
}

// Of an impostor, too: what is picked is edited by itself, and is what a run makes of the graph's own edit of all materials.
TEST_F(ScenePanelTest, AnImpostorsMaterialIsEdited) {
    const Path graph = sourceFolder / "graphs/impostor.json";
    Arguments small{"--scene", (sourceFolder / "scenes/impostor_sphere.json").string(), "--size", "96x54", "--set", "bake.resolution=64"};
    Arguments shown = small;
    shown.insert(shown.end(), {"--show", "shade.color"});
    Viewer viewer(*display, folder, graph, shown);
    const OrderedJson start = viewer.await("frames", rendered, 120s);
    viewer.key("space");
    open(viewer, "Materials");
    viewer.clickPicture();
    viewer.await("the ball", [](const OrderedJson& r) { return r["scene"]["picked"] == 0; });
    viewer.click("material_edit sphere.red", 0);
    const OrderedJson edited = viewer.await("a ball that reflects no red", [](const OrderedJson& r) {
        return r["busy"] == "" && r.contains("mean") && r["parameters"].value("material_edit.red", 1.0) == 0;
    });
    EXPECT_LT(edited["mean"].get<double>(), 0.9 * start["mean"].get<double>());
    small.insert(small.end(), {"--set", "edit.red=0"});
    expectFrame("shade.color", saveImage(viewer), graph, small);

    // Once the pass is there, what is baked stays.
    const OrderedJson bakes = viewer.report()["runs"]["bake"];
    viewer.click("material_edit sphere.roughness", 0.1);
    viewer.await("a smoother ball", [](const OrderedJson& r) {
        const double roughness = r["parameters"].value("material_edit.roughness", -1.0);
        return roughness >= 0 && roughness < 0.2 && r["framesStill"].get<int>() > 0;
    });
    EXPECT_EQ(viewer.report()["runs"]["bake"], bakes) << "baked again";
}

}  // namespace
}  // namespace lodestir::test
