// SPDX-License-Identifier: MIT
// Two sides of a comparison that run beside each other, a reference image, the errors that are shown, and the study that is made of it all.
#include "viewer.h"

namespace lodestir::test {
namespace {

class LiveSides : public ViewerTest {
protected:
    /// Without accumulation a frame is what it is wherever frames began; with it, errors fall.
    Path writeGraph() {
        const Path file = ViewerTest::writeGraph();
        OrderedJson graph = readJson(file);
        graph["frame"]["size"] = {96, 54};
        graph["variants"]["frame by frame"] = {{"passes", {{"accumulate", {{"off", true}}}}}};
        write(file.filename().string(), graph);
        return file;
    }
    static bool hasErrors(const OrderedJson& r) { return r.contains("errors") && r["errors"]["b"].contains("mse"); }
    static bool runsBoth(const OrderedJson& r) {
        return rendered(r) && r.contains("a") && r["a"]["kind"] == "live" && r["framesStill"].get<int>() > 2 && r["busy"] == "";
    }
    /// The frame at which it rests.
    static int pause(Viewer& viewer) {
        viewer.key("space");
        int frame = -1;
        auto since = std::chrono::steady_clock::now();
        viewer.await("a pause", [&](const OrderedJson& r) {  // what was changed just before it makes one more frame
            const bool rests = r["paused"] == true && r["b"]["frame"] == frame;
            frame = r["b"]["frame"];
            if (!rests) since = std::chrono::steady_clock::now();
            return std::chrono::steady_clock::now() - since > 800ms;
        });
        return frame;
    }
    /// What A and B show, as they are saved.
    std::pair<Path, Path> save(Viewer& viewer, int frame) {
        viewer.key("s");
        const Path b = folder / "out" / ("display.display." + std::to_string(frame));
        viewer.await("images", [&](const OrderedJson& r) { return r["note"].get<std::string>().find(b.string()) != std::string::npos; });
        return {folder / "out" / ("A.display.display." + std::to_string(frame) + ".exr"), b.string() + ".exr"};
    }
    OrderedJson compared(const Path& test, const Path& reference) {
        const Output output = lodestir({"compare", test.string(), reference.string(), "--metrics", "mse,relmse", "--json"});
        EXPECT_EQ(output.exitCode, 0) << output.err;
        return OrderedJson::parse(output.out);
    }
    static void expectSame(const OrderedJson& shown, const OrderedJson& measured) {
        for (const char* metric : {"mse", "relmse"}) {
            ASSERT_TRUE(shown.contains(metric)) << shown;
            EXPECT_NEAR(shown[metric].get<double>(), measured[metric].get<double>(), 1e-9 * measured[metric].get<double>()) << metric;
        }
    }
};

// If this fails, what stands side by side was seen from two places, at two times, or isn't what a run makes.
TEST_F(LiveSides, ShareCameraAndFrames) {
    const Path graph = writeGraph();
    Viewer viewer(*display, folder, graph, {"--compare", graph.string() + ":frame by frame"});
    viewer.await("both sides", runsBoth, 120s);
    const auto expectTogether = [](const OrderedJson& r) {
        EXPECT_EQ(r["a"]["frame"], r["b"]["frame"]);
        EXPECT_EQ(r["a"]["camera"], r["b"]["camera"]);
    };
    const int frame = pause(viewer);
    expectTogether(viewer.report());
    const auto [a, b] = save(viewer, frame);
    run("run", graph, {"--variant", "frame by frame", "--frames", std::to_string(frame + 1)});
    const ExrFile rendered = readExrFile(folder / "run" / ("display." + std::to_string(frame) + ".exr"));
    EXPECT_TRUE(readExrFile(a).image.values == rendered.image.values) << "A is not the picture of a run";
    EXPECT_FALSE(readExrFile(a).image.values == readExrFile(b).image.values) << "B accumulates";

    viewer.key("n");
    expectTogether(viewer.await("one frame", [&](const OrderedJson& r) { return r["b"]["frame"].get<int>() == frame + 1; }));
    viewer.key("space");
    const auto [x, y] = viewer.picture(-0.2);
    viewer.point(x, y);
    display->xdotool({"mousedown", "1"});
    std::set<std::string> cameras;
    for (int i = 1; i <= 150 && cameras.size() < 6; ++i) {
        viewer.point(x + 3 * (i % 50), y + i % 50);
        std::this_thread::sleep_for(40ms);
        const OrderedJson r = viewer.report();
        expectTogether(r);
        cameras.insert(r["a"]["camera"].dump());
    }
    display->xdotool({"mouseup", "1"});
    EXPECT_GT(cameras.size(), 3u) << "the camera hardly moved";
    EXPECT_EQ(viewer.report()["builds"], 1);
    EXPECT_TRUE(viewer.running());
}

// If this fails, a scene that is saved, or another size, is seen by one side only.
TEST_F(LiveSides, FollowTheSceneAndTheSize) {
    OrderedJson scene = readJson(sourceFolder / "scenes/cornell.json");
    write("scene.json", scene);
    const Path graph = writeGraph();
    Viewer viewer(*display, folder, graph, {"--compare", graph.string() + ":dim", "--scene", (folder / "scene.json").string()});
    viewer.await("both sides", runsBoth, 120s);
    scene["camera"]["fovy"] = 30;
    write("scene.json", scene);
    const OrderedJson seen = viewer.await("another camera", [](const OrderedJson& r) { return r["builds"] == 2 && runsBoth(r); }, 120s);
    EXPECT_NEAR(seen["a"]["camera"]["fovy"].get<double>(), 30, 1e-3);
    EXPECT_EQ(seen["a"]["camera"], seen["b"]["camera"]);
    viewer.click("size");
    viewer.click("size: 240x135");
    const OrderedJson large = viewer.await("another size", [](const OrderedJson& r) { return r["size"][0] == 240 && runsBoth(r) && hasErrors(r); }, 120s);
    EXPECT_EQ(large["builds"], 2) << "shaders are ready";
    EXPECT_EQ(large["a"]["frame"], large["b"]["frame"]);
    const auto [a, b] = save(viewer, pause(viewer));
    EXPECT_EQ(readExrFile(a).image.width, 240);
    EXPECT_EQ(readExrFile(b).image.width, 240);
    EXPECT_TRUE(viewer.running());
}

// What runs is split: both sides are the same until B is edited, and A stays as it was, whatever B becomes.
TEST_F(LiveSides, AGoesOnAsItWas) {
    Viewer viewer(*display, folder, writeGraph(), {});
    viewer.await("frames", rendered);
    viewer.key("l");
    viewer.await("both sides", runsBoth, 120s);
    const auto expectSameBits = [&] {
        const auto [a, b] = save(viewer, pause(viewer));
        EXPECT_TRUE(readExrFile(a).image.values == readExrFile(b).image.values);
        viewer.key("space");
    };
    expectSameBits();

    // A parameter that comes and goes leaves B with as many frames as A: both have begun again.
    const auto expose = [&] {
        viewer.click("display.exposure", 0.6);
        viewer.await("another exposure", [](const OrderedJson& r) { return r["parameters"]["display.exposure"] != 0.0 && runsBoth(r); });
    };
    expose();
    viewer.click("display.exposure back");
    viewer.await("the graph's exposure", [](const OrderedJson& r) { return r["parameters"]["display.exposure"] == 0.0 && runsBoth(r); });
    expectSameBits();

    expose();
    viewer.click("variant");
    viewer.click("variant: frame by frame");
    viewer.await("another variant", [](const OrderedJson& r) { return r["builds"] == 2 && runsBoth(r); }, 120s);
    const auto [a2, b2] = save(viewer, pause(viewer));
    const auto passesOf = [&](const Path& image) { return OrderedJson::parse(readExrFile(image).attributes.at("lodestir"))["passes"]; };
    EXPECT_EQ(passesOf(a2)["display"]["set"]["exposure"], 0.0);
    EXPECT_FALSE(passesOf(a2)["accumulate"].contains("off"));
    EXPECT_GT(passesOf(b2)["display"]["set"]["exposure"].get<double>(), 1.0);
    EXPECT_EQ(passesOf(b2)["accumulate"]["off"], true);
    EXPECT_GT(meanOf(readExrFile(b2).image), 1.3 * meanOf(readExrFile(a2).image));

    // Another of the graph's variants takes A's place; then A is let go.
    viewer.key("space");
    viewer.click("variants of A");
    viewer.click("A: dim");
    viewer.await("a dim A", [](const OrderedJson& r) { return runsBoth(r) && hasErrors(r); }, 120s);
    const auto [a3, b3] = save(viewer, pause(viewer));
    EXPECT_LT(meanOf(readExrFile(a3).image), 0.6 * meanOf(readExrFile(a2).image));
    viewer.key("l");
    viewer.await("no A", [](const OrderedJson& r) { return !r.contains("a") && r["comparison"]["keeps"] == false; });
    EXPECT_TRUE(viewer.running());
}

// If this fails, the panel shows other errors than a comparison of the saved images finds.
TEST_F(LiveSides, ErrorsAreThoseOfSavedImages) {
    const Path graph = writeGraph();
    const Path reference = run("reference", graph, {"--frames", "64"}) / "display.63.exr";
    ASSERT_TRUE(std::filesystem::exists(reference));
    Viewer viewer(*display, folder, graph, {"--compare", graph.string() + ":dim", "--reference", reference.string()});
    viewer.await("errors", [](const OrderedJson& r) { return runsBoth(r) && hasErrors(r) && r["errors"]["points"].get<int>() > 5; }, 120s);
    const int frame = pause(viewer);
    const OrderedJson both = viewer.report()["errors"];
    EXPECT_EQ(both["reference"], "display.63.exr");
    const auto [a, b] = save(viewer, frame);
    expectSame(both["a"], compared(a, reference));
    expectSame(both["b"], compared(b, reference));
    EXPECT_GT(both["a"]["mse"].get<double>(), both["b"]["mse"].get<double>()) << "A is three stops too dark";

    // Without A the image stands in its place; without that, B is held against what is kept.
    viewer.key("l");
    viewer.await("the image as A", [](const OrderedJson& r) { return r.contains("a") && r["a"]["kind"] == "image" && hasErrors(r); });
    viewer.click("let the image go");
    viewer.await("no A", [](const OrderedJson& r) { return !r.contains("a") && !r.contains("errors"); });
    viewer.key("a");
    viewer.await("a kept picture", [](const OrderedJson& r) { return r.contains("a") && r["a"]["kind"] == "kept"; });
    viewer.key("n");
    viewer.await("the next frame", [&](const OrderedJson& r) { return r["b"]["frame"] == frame + 1 && hasErrors(r) && r["errors"]["reference"] == "A"; });
    const auto [none, next] = save(viewer, frame + 1);
    expectSame(viewer.report()["errors"]["b"], compared(next, b));
    EXPECT_TRUE(viewer.running());
}

TEST_F(LiveSides, RefuseWhatDoesNotFit) {
    const Path graph = writeGraph();
    const auto refusal = [&](Arguments arguments) {
        Viewer viewer(*display, folder, graph, std::move(arguments));
        const Output output = viewer.wait();
        EXPECT_NE(output.exitCode, 0);
        EXPECT_EQ(output.err.find("validation"), std::string::npos) << output.err;
        return output.err;
    };
    writeExr(folder / "small.exr", makeImage(32, 18, 3));
    EXPECT_NE(refusal({"--reference", (folder / "small.exr").string()}).find("small.exr: the image is 32x18, frames are 96x54"), std::string::npos);
    writeFile(folder / "none.exr", "no image");
    EXPECT_NE(refusal({"--reference", (folder / "none.exr").string()}).find("none.exr"), std::string::npos);
    EXPECT_NE(refusal({"--compare", graph.string() + ":nowhere"}).find("nowhere"), std::string::npos);
}

// Two graphs, one of them edited by hand, seen through a camera that was moved: as a study they are the same.
TEST_F(LiveSides, BecomeAStudy) {
    const Path graph = writeGraph();
    Viewer viewer(*display, folder, graph, {"--compare", graph.string() + ":dim", "--set", "trace.bounces=2"});
    viewer.await("both sides", runsBoth, 120s);
    viewer.drag("1", 0.1, 0.05);
    viewer.await("a camera of its own", [](const OrderedJson& r) { return r["camera"]["own"] == true; });
    viewer.key("g");
    viewer.click("node: accumulate", 0.5, "3");
    viewer.click("menu: remove");
    viewer.await("an edited graph", [](const OrderedJson& r) { return r["undo"] == "without accumulate" && runsBoth(r); }, 120s);
    viewer.key("g");
    viewer.click("make a study");
    viewer.await("a study", [](const OrderedJson& r) { return r["note"].get<std::string>().find("study.json") != std::string::npos; });

    const Path file = folder / "out/study/study.json";
    OrderedJson study = readJson(file);
    const OrderedJson& a = study["techniques"]["A"];
    EXPECT_EQ(a["graph"], graph.string());
    EXPECT_EQ(a["variant"], "dim");
    EXPECT_EQ(a["set"]["trace.bounces"], 2);
    EXPECT_EQ(study["techniques"]["B"]["graph"], "B.json");
    EXPECT_FALSE(readJson(folder / "out/study/B.json")["passes"].contains("accumulate"));
    EXPECT_EQ(study["size"], (OrderedJson{96, 54}));
    EXPECT_EQ(study["reference"]["set"]["trace.bounces"], 2) << "what longer paths bring isn't the techniques' error";
    EXPECT_EQ(readJson(folder / "out/study/cornell.json")["camera"]["position"], viewer.report()["camera"]["key"]["position"]);

    study["reference"]["spp"] = 64;
    study["seeds"] = 1;
    study["frames"] = {{"warmup", 2}};
    writeFile(file, study.dump(1));
    const Output output = lodestir({"study", file.string(), "--out", (folder / "measured").string()});
    ASSERT_EQ(output.exitCode, 0) << output.err;
    std::map<std::string, double> error;
    for (const OrderedJson& row : readRows(folder / "measured/results.jsonl")) error[row["technique"]] = row["metrics"]["mse"];
    ASSERT_EQ(error.size(), 2u);
    EXPECT_GT(error["B"], 1.5 * error["A"]) << "A has the mean of three frames, B has one";
    EXPECT_TRUE(viewer.running());
}

TEST_F(LiveSides, PictureOfTheWindowLiesInOut) {
    Viewer viewer(*display, folder, writeGraph(), {});
    viewer.await("frames", rendered);
    EXPECT_EQ(viewer.window(folder / "out/view.png").width, 1280);
}

}  // namespace
}  // namespace lodestir::test
