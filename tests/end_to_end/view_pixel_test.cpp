// SPDX-License-Identifier: MIT
// A pixel that is asked in the viewer: what is told is what `lodestir probe` tells, and it leaves what runs as it was.
#include "viewer.h"

#include <fmt/format.h>

namespace lodestir::test {
namespace {

class ViewPixel : public ViewerTest {};

// If this fails, paths that are drawn over the picture are not those that made it.
TEST_F(ViewPixel, TellsWhatTheProbeTells) {
    const Path graph = writeGraph();
    Viewer viewer(*display, folder, graph, {"--size", "96x54"});
    constexpr auto patience = 300s;  // the driver compiles kernels that no other test has
    viewer.await("frames", rendered);
    viewer.click("pause");
    const OrderedJson paused = viewer.await("a pause", [](const OrderedJson& r) { return r["paused"] == true && r["busy"] == ""; });
    const int frame = paused["nextFrame"].get<int>() - 1;

    const auto [x, y] = viewer.picture(-0.2, 0.1);
    viewer.seen([&] { viewer.point(x, y); });
    viewer.key("p");
    const OrderedJson asked = viewer.await("an answer", [](const OrderedJson& r) { return r.contains("told") && r["busy"] == ""; }, patience);
    const OrderedJson& told = asked["told"];
    EXPECT_EQ(told["pixel"], asked["pixel"]);
    EXPECT_EQ(told["frame"], frame);
    EXPECT_EQ(told["first"], std::max(frame - 8, 0));
    EXPECT_GT(told["paths"].get<int>(), 0);
    EXPECT_EQ(asked["frames"], paused["frames"]) << "what runs has gone on";
    EXPECT_TRUE(asked["problems"].empty()) << asked["problems"];

    // A path of this frame is the same whatever came before it; what is accumulated is not.
    const Output output = runProcess({LODESTIR_BINARY, "probe", graph.string(), "--size", "96x54", "--frame", std::to_string(frame), "--pixel",
                                      fmt::format("{},{}", told["pixel"][0].get<int>(), told["pixel"][1].get<int>())}, {}, patience);
    ASSERT_EQ(output.exitCode, 0) << output.err;
    EXPECT_EQ(told["passes"]["trace"], OrderedJson::parse(output.out)["passes"]["trace"]);

    viewer.key("Escape");
    viewer.await("the panel closed", [](const OrderedJson& r) { return !r.contains("told"); });
    EXPECT_TRUE(viewer.running());
}

}  // namespace
}  // namespace lodestir::test
