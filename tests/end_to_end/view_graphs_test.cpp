// SPDX-License-Identifier: MIT
// The viewer opens every graph that ships, and each example of a pass. Before a release; by default examples_test runs them all without a window.
#include "viewer.h"

namespace lodestir::test {
namespace {

using ViewGraphs = ViewerTest;

// Nobody takes the World of this one: there is no pass that has its pose, nor one to put an edit of the scene behind.
TEST_F(ViewGraphs, WithoutAWorld) {
    Viewer viewer(*display, folder, sourceFolder / "passes/impostor/impostor_bake/impostor_bake.json", {"--size", "64x36"});
    viewer.await("frames", [](const OrderedJson& r) { return r["frames"].get<int>() >= 3; });
    viewer.key("o");
    viewer.await("the panel", [](const OrderedJson& r) { return r.contains("scene"); });
    viewer.click("tab: Levels");
    viewer.click("all coarser");
    const OrderedJson refused = viewer.await("a refusal", [](const OrderedJson& r) { return r["refused"] != ""; });
    EXPECT_NE(refused["problems"].dump().find("World"), std::string::npos) << refused["problems"];
    EXPECT_TRUE(viewer.running());
}

using LongViewGraphs = ViewerTest;

// If this fails, a graph that `lodestir run` renders can't be looked at.
TEST_F(LongViewGraphs, AllOpen) {
    for (const char* from : {"graphs", "passes"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(sourceFolder / from)) {
            if (entry.path().extension() != ".json") continue;
            SCOPED_TRACE(entry.path());
            std::filesystem::remove(folder / "report.json");  // of the last one
            Viewer viewer(*display, folder, entry.path(), {"--size", "64x36", "--frames", "4"});
            const Output end = viewer.wait();
            EXPECT_EQ(end.exitCode, 0) << end.err;
            EXPECT_EQ(end.err.find("validation"), std::string::npos) << end.err;
            const OrderedJson last = readJson(folder / "report.json");
            EXPECT_GE(last["frames"], 4);
            EXPECT_TRUE(last["problems"].empty()) << last["problems"];
        }
}

}  // namespace
}  // namespace lodestir::test
