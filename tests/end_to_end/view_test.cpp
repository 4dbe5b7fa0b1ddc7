// SPDX-License-Identifier: MIT
// The viewer's picture, panels and keys, and files that are edited meanwhile; how quickly it answers is measured, too.
#include "viewer.h"

#include <framework/app/session.h>

namespace lodestir::test {
namespace {

class View : public ViewerTest {};

TEST(ViewWithoutDisplay, IsOneClearError) {
    const Output output =
        runProcess({"env", "-u", "DISPLAY", "-u", "WAYLAND_DISPLAY", LODESTIR_BINARY, "view", (sourceFolder / "graphs/path_tracer.json").string()});
    EXPECT_EQ(output.exitCode, 1);
    EXPECT_NE(output.err.find("no display"), std::string::npos) << output.err;
    EXPECT_NE(output.err.find("lodestir run"), std::string::npos) << output.err;
    EXPECT_EQ(std::ranges::count(output.err, '\n'), 1) << output.err;
}

TEST_F(View, EndsAfterItsFramesWithAPictureOfItself) {
    const Path shot = folder / "window.png";
    Viewer viewer(*display, folder, writeGraph(), {"--frames", "4", "--screenshot", shot.string()});
    const Output output = viewer.wait();
    EXPECT_EQ(output.exitCode, 0) << output.err;
    EXPECT_EQ(output.err.find("validation"), std::string::npos) << output.err;
    const OrderedJson report = readJson(folder / "report.json");
    EXPECT_EQ(report["frames"], 4);
    const ImageData window = readPng(shot);
    ASSERT_EQ(window.width, 1280);
    ASSERT_EQ(window.height, 800);
    // In the middle of the picture the box is lit; panels are beside it.
    const int x = report["area"][0].get<int>() + report["area"][2].get<int>() / 2, y = report["area"][1].get<int>() + report["area"][3].get<int>() / 3;
    double light = 0;
    for (int dy = -20; dy < 20; ++dy)
        for (int dx = -20; dx < 20; ++dx) light += window.at(x + dx, y + dy, 1) / 1600;
    EXPECT_GT(light, 0.05);
    EXPECT_LT(window.at(4, 790, 1), 0.05f);
}

TEST_F(View, AnswersMouseAndKeys) {
    Viewer viewer(*display, folder, writeGraph(), {});
    const OrderedJson start = viewer.await("frames", rendered);
    EXPECT_FALSE(start["camera"]["own"].get<bool>());

    // A drag orbits: the target stays, the position doesn't. Another one moves both. The wheel comes closer. C takes it all back.
    viewer.drag("1", 0.15, 0.05);
    const OrderedJson orbited =
        viewer.await("a camera of its own", [](const OrderedJson& r) { return r["camera"]["own"].get<bool>() && r["framesStill"].get<int>() > 2; });
    EXPECT_EQ(orbited["camera"]["key"]["target"], start["camera"]["key"]["target"]);
    EXPECT_NE(orbited["camera"]["key"]["position"], start["camera"]["key"]["position"]);
    viewer.drag("3", 0.1, 0);
    viewer.await("a moved target", [&](const OrderedJson& r) { return r["camera"]["key"]["target"] != start["camera"]["key"]["target"]; });
    // Shift and a drag look around from where it stands; held arrows fly, and the target flies along.
    const auto atRest = [&] {
        viewer.seen([] {});  // all that the drag was
        return viewer.await("rest", [](const OrderedJson& r) { return r["framesStill"].get<int>() > 2; })["camera"]["key"];
    };
    const OrderedJson stood = atRest();
    display->xdotool({"keydown", "shift"});
    viewer.drag("1", 0.1, 0);
    display->xdotool({"keyup", "shift"});
    const OrderedJson turned = atRest();
    EXPECT_NE(turned["target"], stood["target"]);
    EXPECT_EQ(turned["position"], stood["position"]);
    display->xdotool({"keydown", "Up"});
    viewer.await("a flight", [&](const OrderedJson& r) { return r["camera"]["key"]["position"] != stood["position"]; });
    display->xdotool({"keyup", "Up"});
    const OrderedJson flown = atRest();
    const auto along = [&](const char* place) {
        double sum = 0;
        for (std::size_t i = 0; i < 3; ++i)
            sum += (flown[place][i].get<double>() - turned[place][i].get<double>()) *
                   (turned["target"][i].get<double>() - turned["position"][i].get<double>());
        return sum;
    };
    EXPECT_GT(along("position"), 0);
    EXPECT_NEAR(along("target"), along("position"), 1e-3 * along("position"));
    const double focus = viewer.report()["camera"]["key"]["focus"].get<double>();
    display->xdotool({"click", "4"});
    viewer.await("a closer camera", [&](const OrderedJson& r) { return r["camera"]["key"]["focus"].get<double>() < focus - 0.1; });
    viewer.key("c");
    viewer.await("the scene's camera", [&](const OrderedJson& r) { return r["camera"] == start["camera"]; });

    // The pixel under the pointer: the middle of the picture is the middle of the image, at any zoom.
    const auto [x, y] = viewer.picture();
    viewer.point(x, y);
    viewer.await("the middle pixel",
                 [](const OrderedJson& r) { return std::abs(r["pixel"][0].get<int>() - 80) <= 1 && std::abs(r["pixel"][1].get<int>() - 45) <= 1; });
    viewer.key("8");
    viewer.await("zoom 8", [](const OrderedJson& r) { return r["zoom"] == 8.0 && std::abs(r["pixel"][0].get<int>() - 80) <= 1; });
    viewer.key("0");

    // Space pauses, N makes one frame.
    viewer.key("space");
    const int frames = viewer.await("a pause", [](const OrderedJson& r) { return r["paused"].get<bool>(); })["frames"].get<int>();
    std::this_thread::sleep_for(600ms);
    const int paused = viewer.report()["frames"].get<int>();
    EXPECT_LE(paused, frames + 1);
    viewer.key("n");
    viewer.await("one frame", [&](const OrderedJson& r) { return r["frames"].get<int>() == paused + 1; });
    viewer.key("space");
    viewer.await("frames again", [&](const OrderedJson& r) { return r["frames"].get<int>() > paused + 2; });
    EXPECT_TRUE(viewer.running());
}

TEST_F(View, WidgetsChangeTheImageAndWhatIsSaved) {
    Viewer viewer(*display, folder, writeGraph(), {});
    const OrderedJson start = viewer.await("frames", rendered);
    const double mean = start["mean"].get<double>();

    // The slider of the exposure, clicked at 3/5 of its -20..20: 4 stops more.
    viewer.click("display.exposure", 0.6);
    const OrderedJson brighter =
        viewer.await("a brighter image", [&](const OrderedJson& r) { return r.contains("mean") && r["mean"].get<double>() > 1.5 * mean; });
    const double exposure = brighter["parameters"]["display.exposure"].get<double>();
    EXPECT_NEAR(exposure, 4, 1.5);
    EXPECT_EQ(brighter["builds"], 1);  // a uniform costs nothing

    // The graph that is saved has it, and is a graph.
    viewer.click("save graph");
    viewer.await("a graph", [](const OrderedJson& r) { return r["note"].get<std::string>().find("graph.json") != std::string::npos; });
    EXPECT_NEAR(readJson(folder / "out/graph.json")["passes"]["display"]["set"]["exposure"].get<double>(), exposure, 1e-4);
    EXPECT_EQ(lodestir({"check", (folder / "out/graph.json").string()}).exitCode, 0);
    viewer.click("save");
    viewer.await("an image", [](const OrderedJson& r) { return r["note"].get<std::string>().find(".exr") != std::string::npos; });
    bool found = false;
    for (const std::string& name : filesOf(folder / "out")) {
        if (!name.ends_with(".exr")) continue;
        const ExrFile saved = readExrFile(folder / "out" / name);
        EXPECT_GT(meanOf(saved.image), 1.5 * mean);
        EXPECT_NE(saved.attributes.at("lodestir").find("accumulate"), std::string::npos);
        found = true;
    }
    EXPECT_TRUE(found);

    // The dot beside it takes it back.
    viewer.click("display.exposure back");
    viewer.await("the graph's exposure",
                 [&](const OrderedJson& r) { return r["parameters"]["display.exposure"] == 0.0 && std::abs(r["mean"].get<double>() - mean) < 0.1 * mean; });

    // A variant is another graph; another port another picture.
    viewer.click("variant");
    viewer.click("variant: dim");
    viewer.await("a dim image", [&](const OrderedJson& r) { return r["builds"] == 2 && r.contains("mean") && r["mean"].get<double>() < 0.6 * mean; });
    viewer.click("port");
    viewer.click("port: trace.color");
    viewer.await("another port", [](const OrderedJson& r) { return r["shown"] == "trace.color"; });
    EXPECT_TRUE(viewer.running());
}

// If this fails, what is told of passes' times can't be taken elsewhere, or is of other frames.
TEST_F(View, SavesTheTimesOfTheLastFrames) {
    const Path shot = folder / "window.png";
    Viewer viewer(*display, folder, writeGraph(), {"--size", "64x36", "--screenshot", shot.string()});
    viewer.await("frames", [](const OrderedJson& r) { return rendered(r) && r["frames"].get<int>() >= 20; });
    viewer.click("save times");
    viewer.await("times", [](const OrderedJson& r) { return r["note"].get<std::string>().find("times.csv") != std::string::npos; });
    std::istringstream lines(readText(folder / "out/times.csv"));
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "frame,pass,ms,primary rays,nee rays,continue rays,replay rays,connect rays,visibility rays");
    std::map<std::string, std::vector<int>> frames;
    while (std::getline(lines, line)) {
        std::vector<std::string> cells;
        std::istringstream row(line);
        for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
        ASSERT_EQ(cells.size(), 9u) << line;
        frames[cells[1]].push_back(std::stoi(cells[0]));
        EXPECT_GT(std::stod(cells[2]), 0) << line;
        EXPECT_EQ(cells[3], cells[1] == "trace" ? std::to_string(64 * 36) : "0") << line;
    }
    ASSERT_GE(frames["trace"].size(), 20u);
    EXPECT_EQ(frames["trace"].back() - frames["trace"].front(), int(frames["trace"].size()) - 1) << "some are missing";
    const OrderedJson trace = readJson(folder / "out/trace.json");
    const auto named = std::ranges::count_if(trace["traceEvents"], [](const OrderedJson& event) { return event["name"] == "trace"; });
    EXPECT_EQ(std::size_t(named), frames["trace"].size());

    // The pointer on a pass: its history opens over the picture.
    viewer.key("space");
    viewer.await("a pause", [](const OrderedJson& r) { return r["paused"] == true; });
    const ImageData before = viewer.window(shot);
    const OrderedJson box = viewer.report()["widgets"]["times of trace"];
    viewer.point(box[0].get<double>() + 20, 0.5 * (box[1].get<double>() + box[3].get<double>()));
    std::this_thread::sleep_for(600ms);
    const ImageData after = viewer.window(shot);
    int changed = 0;
    for (std::size_t i = 0; i < before.values.size(); i += std::size_t(before.channels)) changed += before.values[i] != after.values[i];
    EXPECT_GT(changed, 300 * 60) << "no plot";
    EXPECT_TRUE(viewer.running());
}

// A picture is kept, a darker variant comes: they stand side by side, the line between them is dragged, the difference is what the variant lacks.
TEST_F(View, ComparesWithWhatWasKept) {
    const Path shot = folder / "window.png";
    Viewer viewer(*display, folder, writeGraph(), {"--screenshot", shot.string()});
    viewer.await("frames", rendered);
    viewer.key("a");
    viewer.await("a kept picture", [](const OrderedJson& r) { return r["comparison"]["keeps"] == true; });
    viewer.click("variant");
    viewer.click("variant: dim");
    viewer.await("the other variant", [](const OrderedJson& r) { return r["builds"] == 2 && r["framesStill"].get<int>() > 3; });
    /// Mean of the picture left and right of its middle, at the same distance, where both show much the same.
    const auto halves = [&] {
        const ImageData window = viewer.window(shot);
        const OrderedJson area = viewer.report()["area"];
        const int x = area[0].get<int>() + area[2].get<int>() / 2, y = area[1].get<int>() + area[3].get<int>() / 2;
        std::pair<double, double> mean;
        for (int dy = -120; dy < 120; ++dy)
            for (int dx = 20; dx < 120; ++dx) {
                mean.first += window.at(x - dx, y + dy, 1) / 24000;
                mean.second += window.at(x + dx, y + dy, 1) / 24000;
            }
        return mean;
    };
    const auto side = [](int wanted) { return [wanted](const OrderedJson& r) { return r["comparison"]["side"] == wanted; }; };
    const auto split = halves();
    EXPECT_GT(split.first, 2 * split.second) << "the kept picture at the left, three stops darker at the right";
    // The line, dragged to three quarters.
    const auto [x, y] = viewer.picture();
    const auto [to, same] = viewer.picture(0.25);
    viewer.point(x, y);
    std::this_thread::sleep_for(300ms);
    display->xdotool({"mousedown", "1"});
    std::this_thread::sleep_for(300ms);  // a hand rests before it drags
    viewer.point(to, same);
    std::this_thread::sleep_for(300ms);
    display->xdotool({"mouseup", "1"});
    const OrderedJson dragged = viewer.await("the line elsewhere", [](const OrderedJson& r) { return r["comparison"]["split"].get<double>() > 0.7; });
    EXPECT_NEAR(dragged["comparison"]["split"].get<double>(), 0.75, 0.02);
    EXPECT_EQ(dragged["camera"]["own"], false) << "the drag has moved the camera";

    viewer.key("b");
    viewer.await("A alone", side(1));
    const auto kept = halves();
    viewer.key("b");
    viewer.await("B alone", side(2));
    const auto now = halves();
    viewer.click("side 3");
    viewer.await("the difference", side(3));
    const auto difference = halves();
    EXPECT_GT(kept.second, 2 * now.second);
    EXPECT_LT(difference.first, kept.first);
    EXPECT_GT(difference.first, now.first) << "what three stops take is more than they leave";
    viewer.click("keep");
    viewer.await("nothing kept", [](const OrderedJson& r) { return r["comparison"]["keeps"] == false; });
    EXPECT_TRUE(viewer.running());
}

// If this fails, whoever edits a material while an impostor is shown waits for a bake, or sees another picture than a run of the edited graph makes.
TEST_F(View, AMaterialIsEditedLive) {
    const Path graph = sourceFolder / "graphs/impostor.json";
    const Arguments small{"--scene", (sourceFolder / "scenes/impostor_sphere.json").string(), "--size", "96x96", "--set", "bake.resolution=64"};
    Viewer viewer(*display, folder, graph, small);
    const OrderedJson start = viewer.await("frames", rendered, 120s);
    viewer.click("edit.red", 0);
    const OrderedJson edited = viewer.await("a ball that reflects no red", [&](const OrderedJson& r) {
        return r.contains("mean") && r["mean"].get<double>() < 0.9 * start["mean"].get<double>();
    });
    EXPECT_EQ(edited["builds"], 1);
    EXPECT_GT(edited["runs"]["shade"].get<int>(), start["runs"]["shade"].get<int>());
    EXPECT_EQ(edited["runs"]["bake"], start["runs"]["bake"]) << "baked again";

    viewer.click("save");
    viewer.await("an image", [](const OrderedJson& r) { return r["note"].get<std::string>().find(".exr") != std::string::npos; });
    Arguments run{"run", graph.string(), "--frames", "1", "--out", (folder / "run").string(), "--set",
                  "edit.red=" + edited["parameters"]["edit.red"].dump()};
    run.insert(run.end(), small.begin(), small.end());
    ASSERT_EQ(lodestir(run).exitCode, 0);
    const auto image = [&](const Path& in) {
        for (const std::string& name : filesOf(in))
            if (name.ends_with(".exr")) return readExrFile(in / name).image.values;
        return std::vector<float>();
    };
    EXPECT_FALSE(image(folder / "out").empty());
    EXPECT_TRUE(image(folder / "out") == image(folder / "run")) << "not the picture of a run";
}

// If this fails, frames take another time than was asked for, their size doesn't come to rest, or a frame isn't what a run of its size makes.
TEST_F(View, TheSizeFollowsTheTime) {
    const Path graph = writeGraph();
    Viewer viewer(*display, folder, graph, {"--size", "240x135", "--show", "trace.color"});
    const OrderedJson start = viewer.await("frames", [](const OrderedJson& r) { return rendered(r) && r["frames"].get<int>() >= 6; });
    // Times that no machine comes near to, so that it doesn't matter what else this one does; tests/cpu/frame_size_test.cpp has those between.
    viewer.type("frame time", "0.01");
    const OrderedJson small =
        viewer.await("the least frames", [](const OrderedJson& r) { return r["size"][0].get<int>() < 100 && r["framesStill"].get<int>() >= 12; });
    EXPECT_LT(small["frameMs"].get<double>(), start["frameMs"].get<double>());
    EXPECT_NEAR(small["size"][0].get<double>() / small["size"][1].get<double>(), small["area"][2].get<double>() / small["area"][3].get<double>(), 0.05);
    EXPECT_GT(small["zoom"].get<double>() * small["size"][0].get<double>(), 0.98 * small["area"][2].get<double>()) << "the picture doesn't fill its place";
    EXPECT_EQ(small["builds"], 1);

    viewer.key("space");
    const OrderedJson paused = viewer.await("a pause", [](const OrderedJson& r) { return r["paused"].get<bool>(); });
    const std::string size = std::to_string(paused["size"][0].get<int>()) + "x" + std::to_string(paused["size"][1].get<int>());
    const int frame = saveImage(viewer);
    expectFrame("trace.color", frame, graph, {"--size", size});
    viewer.drag("1", 0.1, 0);
    viewer.await("another camera", [](const OrderedJson& r) { return r["camera"]["own"] == true; });

    viewer.key("space");
    viewer.type("frame time", "100000");
    viewer.await("frames as large as their place", [](const OrderedJson& r) { return r["size"][0] == r["area"][2] && r["size"][1] == r["area"][3]; });

    // A size that is chosen stays.
    viewer.click("size");
    viewer.click("size: 240x135");
    const OrderedJson chosen = viewer.await("the chosen size", [](const OrderedJson& r) { return r["size"][0] == 240 && r["framesStill"].get<int>() >= 12; });
    EXPECT_EQ(chosen["builds"], 1);
    EXPECT_TRUE(viewer.running());
}

TEST_F(View, LivesThroughBrokenEdits) {
    // A copy of the shaders, so that one can be broken: an include of tone_map, not its own file.
    std::filesystem::copy(sourceFolder / "framework/shaders", folder / "shaders", std::filesystem::copy_options::recursive);
    const Path shader = folder / "shaders/base/tone_curve.glsl";
    const std::string good = readText(shader);
    const Path graph = writeGraph();
    Viewer viewer(*display, folder, graph, {}, {{"LODESTIR_SHADERS", (folder / "shaders").string()}});
    const double mean = viewer.await("frames", rendered)["mean"].get<double>();

    const auto told = [](const std::string& part) {
        return [part](const OrderedJson& r) { return !r["problems"].empty() && r["problems"][0].get<std::string>().find(part) != std::string::npos; };
    };
    const auto goesOn = [&](int frames) { viewer.await("more frames", [&](const OrderedJson& r) { return r["frames"].get<int>() > frames + 2; }); };

    const int broken = int(std::ranges::count(good, '\n')) + 1;
    writeFile(shader, good + "vec3 toneBroken(vec3 c) { return nowhere; }\n");
    const OrderedJson withMessage = viewer.await("the shader's message", told("tone_curve.glsl:" + std::to_string(broken)));
    EXPECT_NE(withMessage["problems"][0].get<std::string>().find("nowhere"), std::string::npos);
    goesOn(withMessage["frames"].get<int>());

    // Mended, and twice as bright: the message goes, the image changes, nothing else was built anew.
    const std::string curve = "vec3 toneNeutral(vec3 c) {\n";
    std::string brighter = good;
    brighter.insert(brighter.find(curve) + curve.size(), "    c *= 2;\n");
    writeFile(shader, brighter);
    const OrderedJson mended = viewer.await("the message gone", [&](const OrderedJson& r) {
        return r["problems"].empty() && r["reloads"].get<int>() >= 1 && r["mean"].get<double>() > 1.2 * mean;
    });
    EXPECT_EQ(mended["builds"], 1);

    // The graph: a mistake is told with its place, a mended one takes effect.
    const std::string text = readText(graph);
    std::string wrong = text;
    wrong.replace(wrong.find("path_tracer"), 11, "path_tracker");
    writeFile(graph, wrong);
    const OrderedJson graphMessage = viewer.await("the graph's message", told("graph.json:"));
    EXPECT_NE(graphMessage["problems"][0].get<std::string>().find("path_tracker"), std::string::npos);
    goesOn(graphMessage["frames"].get<int>());
    writeGraph(-3);
    viewer.await("the mended graph", [&](const OrderedJson& r) {
        return r["problems"].empty() && r["builds"] == 2 && r["parameters"]["display.exposure"] == -3.0 && r["mean"].get<double>() < mean;
    });

    // Once more with a syntax error in the JSON: the place is line and column.
    writeFile(graph, text.substr(0, text.size() / 2));
    viewer.await("the parser's message", told("graph.json:"));
    EXPECT_TRUE(viewer.running());
}

// Frames that take a second: input must not wait for them. On a machine that does other work both take longer, so the limits are shares of the
// frame; docs/view.md says what was measured.
TEST_F(View, InputDoesNotWaitForFrames) {
    Viewer viewer(*display, folder, sourceFolder / "graphs/restir_pt.json", {"--size", "480x270"});
    viewer.await("frames", rendered, 150s);
    for (int i = 0; i < 4; ++i) {
        viewer.drag("1", i % 2 ? 0.02 : -0.02, 0);
        std::this_thread::sleep_for(300ms);
    }
    const OrderedJson report = viewer.await("answers", [](const OrderedJson& r) { return r["input"]["count"].get<int>() >= 20; });
    std::printf("a frame takes %.0f ms; input was answered in %.0f ms (median), %.0f (95 %%), %.0f (largest of %d)\n", report["frameMs"].get<double>(),
                report["input"]["median"].get<double>(), report["input"]["p95"].get<double>(), report["input"]["largest"].get<double>(),
                report["input"]["count"].get<int>());
    const double frame = report["frameMs"].get<double>();
    EXPECT_LT(report["input"]["median"].get<double>(), std::max(100.0, frame / 8));
    EXPECT_LT(report["input"]["p95"].get<double>(), std::max(200.0, frame / 4));
}

// If this fails, where a frame is cut changes what it holds.
TEST(CutFrames, HaveTheSameBits) {
    const auto device = std::make_shared<const gpu::Device>();
    SessionOptions options;
    options.graph = sourceFolder / "graphs/restir_pt.json";
    options.changes.size = glm::uvec2(150, 83);
    options.changes.scene = sourceFolder / "scenes/cornell_glossy.json";
    options.dumps = {"spatial.paths.reservoirs", "hits.motion"};
    const auto render = [&](double slice) {
        Session session(options, {.device = device, .slice = slice});
        std::vector<std::vector<std::byte>> results;
        FrameReport report;
        for (int frame = 0; frame < 3; ++frame) report = session.runner().run();
        results.push_back(session.runner().readBytes(session.graph().show));
        for (const Source& source : session.dumps()) results.push_back(session.runner().readBytes(source));
        return std::pair(results, report);
    };
    const auto [whole, wholeReport] = render(0);
    for (const double slice : {0.3, 2.0, 20.0}) {
        const auto [cut, cutReport] = render(slice);
        EXPECT_TRUE(cut == whole) << slice;
        for (std::size_t i = 0; i < cutReport.passes.size(); ++i) EXPECT_EQ(cutReport.passes[i].rays, wholeReport.passes[i].rays) << slice;
    }
    EXPECT_EQ(device->validationMessages(), std::vector<std::string>{});
}

}  // namespace
}  // namespace lodestir::test
