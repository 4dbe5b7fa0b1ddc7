// SPDX-License-Identifier: MIT
// The graph edited while it runs, by mouse and keys: what is saved has the edit, frames go on, and what can't be built changes nothing.
#include "viewer.h"

namespace lodestir::test {
namespace {

class GraphPanel : public ViewerTest {
protected:
    /// The graph as "Save graph" writes it now.
    OrderedJson saved(Viewer& viewer, const std::string& name) {
        const Path file = folder / "out" / name;
        std::filesystem::remove(file);
        viewer.click("save graph");
        viewer.await("the saved graph", [&](const OrderedJson&) {
            std::error_code none;
            return std::filesystem::exists(file, none);
        });
        std::this_thread::sleep_for(300ms);
        return readJson(file);
    }
    static void open(Viewer& viewer) {
        viewer.key("g");
        viewer.await("the panel", [](const OrderedJson& r) { return r["types"].get<int>() > 20 && r["widgets"].contains("graph"); });
    }
    static void choose(Viewer& viewer, const std::string& pass, const std::string& item) {
        viewer.click("node: " + pass, 0.5, "3");
        viewer.click(item);
    }
    /// From one widget to another; empty: to where nothing is.
    static void drag(Viewer& viewer, const std::string& from, const std::string& to) {
        viewer.pointAt(from);
        viewer.press();
        if (to.empty()) viewer.pointAt("graph", 0.99);
        else viewer.pointAt(to);
        viewer.release();
    }
    static auto did(const std::string& what) {
        return [what](const OrderedJson& r) { return r["undo"] == what && r["busy"] == "" && r["problems"].empty(); };
    }
    static constexpr auto patience = 400s;  // the driver compiles kernels that no other test has
};

TEST_F(GraphPanel, EditsWhatRuns) {
    Viewer viewer(*display, folder, sourceFolder / "graphs/restir_pt.json",
                  {"--scene", (sourceFolder / "scenes/cornell.json").string(), "--size", "96x54", "--set", "temporal.depth=0.5"});
    viewer.await("frames", rendered, patience);
    open(viewer);
    const OrderedJson before = saved(viewer, "restir_pt.json");

    // Another way of temporal reuse, with all wires as they were, but without the parameter that it hasn't; and back.
    viewer.click("node: temporal", 0.5, "3");
    viewer.click("menu: swap");
    viewer.click("swap: temporal_splat");
    const OrderedJson swapped = viewer.await("splatting", did("temporal as temporal_splat"), patience);
    EXPECT_EQ(swapped["builds"], 2);
    const OrderedJson splat = saved(viewer, "restir_pt.json")["passes"]["temporal"];
    EXPECT_EQ(splat["type"], "temporal_splat");
    EXPECT_FALSE(splat["set"].contains("depth"));
    for (const auto& [input, source] : before["passes"]["temporal"]["in"].items()) EXPECT_EQ(splat["in"][input], source) << input;
    viewer.await("more frames", [&](const OrderedJson& r) { return r["frames"].get<int>() > swapped["frames"].get<int>() + 2; }, patience);
    viewer.key("ctrl+z");
    viewer.await("the swap taken back", [](const OrderedJson& r) { return r["undo"] == "" && r["redo"] == "temporal as temporal_splat" && r["busy"] == ""; },
                 patience);
    EXPECT_EQ(saved(viewer, "restir_pt.json"), before);

    // What shades takes a colour that nothing would stand for: one message, and nothing has changed.
    choose(viewer, "spatial", "menu: off");
    const OrderedJson refused = viewer.await("a refusal", [](const OrderedJson& r) { return r["refused"] == "spatial off"; });
    ASSERT_EQ(refused["problems"].size(), 1u) << refused["problems"];
    EXPECT_NE(refused["problems"][0].get<std::string>().find("no input stands for its \"color\""), std::string::npos) << refused["problems"];
    EXPECT_EQ(refused["undo"], "");
    viewer.await("more frames", [&](const OrderedJson& r) { return r["frames"].get<int>() > refused["frames"].get<int>() + 2; });
    viewer.key("Escape");
    viewer.await("the message read", [](const OrderedJson& r) { return r["problems"].empty() && r["refused"] == ""; });
    EXPECT_EQ(saved(viewer, "restir_pt.json"), before);

    // Without that wire it can be off.
    drag(viewer, "in: shade.color", "");
    viewer.await("an input that is free", did("shade.color unwired"), patience);
    choose(viewer, "spatial", "menu: off");
    viewer.await("no spatial reuse", did("spatial off"), patience);
    drag(viewer, "out: temporal.paths", "in: temporal.history");
    viewer.await("its own history", did("temporal.history from temporal.paths@prev"), patience);
    const OrderedJson edited = saved(viewer, "restir_pt.json")["passes"];
    EXPECT_FALSE(edited["shade"]["in"].contains("color")) << edited["shade"];
    EXPECT_EQ(edited["spatial"]["off"], true);
    EXPECT_EQ(edited["temporal"]["in"]["history"], "temporal.paths@prev");

    // A port that is clicked is shown.
    viewer.click("out: hits.motion");
    viewer.await("motion", [](const OrderedJson& r) { return r["shown"] == "hits.motion"; });
    for (const char* what : {"spatial off", "shade.color unwired", ""}) {
        viewer.click("undo");
        viewer.await("a step back", did(what), patience);
    }
    EXPECT_EQ(saved(viewer, "restir_pt.json")["passes"], before["passes"]);
    viewer.key("ctrl+y");
    viewer.await("a step again", did("shade.color unwired"), patience);
    EXPECT_TRUE(viewer.running());
}

// If this fails, what was put together by hand can't be kept.
TEST_F(GraphPanel, WhatIsSavedGivesTheSameImage) {
    Viewer viewer(*display, folder, writeGraph(1), {"--size", "96x54"});
    viewer.await("frames", rendered);
    open(viewer);
    choose(viewer, "accumulate", "menu: remove");
    viewer.await("no accumulation", did("without accumulate"));
    // A second tone mapping, of what the first takes: chosen among all types by part of its name, shown by a click on its output.
    viewer.click("add pass");
    viewer.find("filter");
    display->xdotool({"type", "tone"});
    viewer.click("add: tone_map", 0.1);
    viewer.click("question: color");
    viewer.click("answer: trace.color");
    viewer.click("add");
    viewer.await("one more", did("one more tone_map"));
    viewer.click("out: tone_map.display");
    viewer.await("the new one", [](const OrderedJson& r) { return r["shown"] == "tone_map.display" && r["busy"] == ""; });
    viewer.click("tone_map.exposure", 0.55);
    viewer.await("an exposure", [](const OrderedJson& r) { return r["undo"] == "tone_map.exposure"; });
    const OrderedJson graph = saved(viewer, "graph.json");
    EXPECT_EQ(graph["passes"]["display"]["in"]["color"], "trace.color");
    EXPECT_EQ(graph["passes"]["tone_map"]["in"]["color"], "trace.color");
    EXPECT_FALSE(graph["passes"].contains("accumulate"));
    const int frame = saveImage(viewer);
    expectFrame("tone_map.display", frame, folder / "out/graph.json", {});

    // A parameter and edits are taken back one by one.
    for (const char* what : {"one more tone_map", "without accumulate", ""}) {
        viewer.key("ctrl+z");
        viewer.await("a step back", did(what));
    }
    EXPECT_TRUE(saved(viewer, "graph.json")["passes"].contains("accumulate"));

    // Into the graph's own file: what runs is what it says, and nothing is by hand any more.
    viewer.key("ctrl+y");
    const OrderedJson edited = viewer.await("an edit again", did("without accumulate"));
    viewer.key("ctrl+s");
    const OrderedJson written = viewer.await("the file written", [](const OrderedJson& r) { return r["redo"] == "" && did("")(r); });
    EXPECT_NE(written["note"].get<std::string>().find("wrote into"), std::string::npos) << written["note"];
    const OrderedJson own = readJson(folder / "graph.json");
    EXPECT_FALSE(own["passes"].contains("accumulate"));
    EXPECT_EQ(own["passes"]["display"]["in"]["color"], "trace.color");
    viewer.await("the file read again", [&](const OrderedJson& r) { return r["builds"].get<int>() > edited["builds"].get<int>() && did("")(r); });
    EXPECT_FALSE(saved(viewer, "graph.json")["passes"].contains("accumulate"));
    EXPECT_TRUE(viewer.running());
}

}  // namespace
}  // namespace lodestir::test
