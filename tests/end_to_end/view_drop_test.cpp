// SPDX-License-Identifier: MIT
// Files dropped on the viewer's window: what is seen is what `lodestir run` makes of them.
#include "viewer.h"

#include "level_model.h"

namespace lodestir::test {
namespace {

class ViewDrop : public ViewerTest {
protected:
    void drop(const std::vector<Path>& files) {
        Arguments command{DRAG_SOURCE};
        for (const Path& file : files) {
            std::string uri = "file://" + file.string();
            for (std::size_t i; (i = uri.find(' ')) != std::string::npos;) uri.replace(i, 1, "%20");
            command.push_back(uri);
        }
        const Output output = runProcess(command, {{"DISPLAY", display->name()}});
        EXPECT_EQ(output.exitCode, 0) << output.err;
    }
};

// If this fails, a file that is dropped isn't taken for what it is, or what runs is lost with one that can't be used.
TEST_F(ViewDrop, FilesAreTakenForWhatTheyAre) {
    const Path model = writeLevels(folder, "bowl", {{.cells = 6, .place = bowl}}), scene = folder / "a scene.json", other = folder / "other.json";
    write(scene.filename(), {{"format", 1},
                             {"models", {{"bowl", {{"file", "bowl.gltf"}}}}},
                             {"instances", {{{"model", "bowl"}, {"name", "bowl"}}}},
                             {"environment", {{"type", "constant"}}},
                             {"camera", {{"position", {0, 2.4, 2.6}}, {"target", {0, 0.2, 0}}, {"fovy", 45}}}});
    const Path graph = writeGraph();
    OrderedJson changed = readJson(graph);
    changed["passes"]["trace"]["set"] = {{"bounces", 1}};
    changed["show"] = "trace.color";
    write(other.filename(), changed);
    Viewer viewer(*display, folder, graph, {"--size", "96x54", "--show", "trace.color"});
    viewer.await("frames", rendered);
    viewer.key("space");
    viewer.await("a pause", [](const OrderedJson& r) { return r["paused"].get<bool>(); });
    const auto runs = [](const std::string& graphFile, const std::string& sceneFile) {
        return [=](const OrderedJson& r) { return r["graph"] == graphFile && r["of"] == sceneFile && r["busy"] == "" && r.contains("mean"); };
    };

    drop({model});
    viewer.await("the model", runs("graph.json", "bowl.gltf"));
    expectFrame("trace.color", saveImage(viewer), graph, {"--scene", model.string(), "--size", "96x54"});
    drop({scene});
    viewer.await("the scene", runs("graph.json", "a scene.json"));
    const int frame = saveImage(viewer);
    expectFrame("trace.color", frame, graph, {"--scene", scene.string(), "--size", "96x54"});
    drop({other});
    viewer.await("the graph, in the scene that was asked for", runs("other.json", "a scene.json"));
    expectFrame("trace.color", saveImage(viewer), other, {"--scene", scene.string(), "--size", "96x54"});

    const Path image = folder / "out" / ("trace.color." + std::to_string(frame) + ".exr");
    drop({image});
    viewer.await("errors", [&](const OrderedJson& r) { return r.contains("errors") && r["errors"]["reference"] == image.filename().string(); });

    // Files that can't be used, two at once: the last is told of, what runs goes on.
    changed["passes"]["trace"]["type"] = "path_tracker";
    write("broken.json", changed);
    writeFile(folder / "broken.glb", "no model");
    drop({folder / "broken.json", folder / "broken.glb"});
    const OrderedJson refused = viewer.await("a refusal", [](const OrderedJson& r) { return r["refused"] == "broken.glb"; });
    EXPECT_NE(refused["problems"][0].get<std::string>().find("broken.glb"), std::string::npos) << refused["problems"];
    viewer.key("space");
    viewer.await("frames", [&](const OrderedJson& r) { return runs("other.json", "a scene.json")(r) && r["framesStill"].get<int>() > 3; });
    EXPECT_TRUE(viewer.running());
}

}  // namespace
}  // namespace lodestir::test
