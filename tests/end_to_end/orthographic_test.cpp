// SPDX-License-Identifier: MIT
// Orthographic cameras show things as wide at any distance, and what is known of their pixels agrees.
#include "model.h"
#include "program.h"
#include "render.h"

namespace lodestir::test {
namespace {

using Orthographic = ProgramTest;

// Two squares, near and far, that don't hide each other: 0.5 wide where they stand, and where they were when the camera moved.
TEST_F(Orthographic, SquaresAreAsWideAtAnyDistance) {
    const auto square = [](double x, double z) {
        return Quad{{x - 0.25, -0.25, z}, {0.5, 0, 0}, {0, 0.5, 0}, {.color = Point(0), .emission = Point(1)}};
    };
    writeModel(folder, "squares", {square(-0.5, -2), square(0.5, -800)});
    write("squares.json",
          {{"format", 1},
           {"models", {{"squares", {{"file", "squares.gltf"}}}}},
           {"environment", constantEnvironment(Point(0))},
           {"camera",
            {{"position", {0, 0, 0}},
             {"target", {0, 0, -1}},
             {"orthographic", 1},
             {"keyframes", OrderedJson::array({OrderedJson{{"frame", 0}},
                                               OrderedJson{{"frame", 1}, {"position", {0.125, 0, 0}}, {"target", {0.125, 0, -1}}}})}}}});
    const OrderedJson graph = {
        {"format", 1},
        {"scene", "squares.json"},
        {"frame", {{"size", {64, 32}}, {"count", 2}, {"seed", 1}}},
        {"passes",
         {{"trace", {{"type", "path_tracer"}, {"set", {{"spp", 1}, {"bounces", 0}, {"film", "centre"}}}}},
          {"hits", {{"type", "visibility"}, {"in", {{"worldPrev", "scene.world@prev"}}}, {"set", {{"film", "centre"}}}}}}},
        {"show", "trace"}};
    write("squares.graph.json", graph);
    const Path results = run("out", folder / "squares.graph.json", {"--frames", "2", "--dump", "hits.motion", "--dump", "hits.depth"});
    for (int frame = 0; frame < 2; ++frame) {
        const ImageData image = readExr(results / fmt::format("trace.{}.exr", frame)),
                        motion = readExr(results / fmt::format("hits.motion.{}.exr", frame)),
                        depth = readExr(results / fmt::format("hits.depth.{}.exr", frame));
        for (int y = 0; y < 32; ++y) {
            for (int x = 0; x < 64; ++x) {
                const double at = (x + 0.5) / 32 - 1 + 0.125 * frame, up = 0.5 - (y + 0.5) / 32;
                const bool left = std::abs(at + 0.5) < 0.25, right = std::abs(at - 0.5) < 0.25,
                           inside = (left || right) && std::abs(up) < 0.25;
                ASSERT_EQ(image.at(x, y, 0), inside ? 1 : 0) << frame << ": " << x << ", " << y;
                if (!inside) continue;
                ASSERT_NEAR(motion.at(x, y, 0), frame == 0 ? 0 : 4, 1e-3);
                ASSERT_NEAR(motion.at(x, y, 1), 0, 1e-3);
                ASSERT_NEAR(depth.at(x, y, 0), left ? 2 : 800, 1e-3);
            }
        }
    }
}

// Under a sky of one colour each pixel shows the colour of what it looks at times the sky's, however far.
TEST_F(Orthographic, LightsLikeAnyOther) {
    writeModel(folder, "floor", {{{-50, 0, 50}, {100, 0, 0}, {0, 0, -100}, {.color = Point(0.5)}}});
    for (const double tilt : {0.0, 0.9}) {
        write("floor.json", {{"format", 1},
                             {"models", {{"floor", {{"file", "floor.gltf"}}}}},
                             {"environment", constantEnvironment(Point(2))},
                             {"camera", {{"position", {0, 5, 5 * tilt}}, {"target", {0, 0, 0}}, {"up", {0, 0, -1}}, {"orthographic", 2}}}});
        const std::vector<ImageData> images = render(writeGraph(folder, "floor", 16, 16, {{"spp", 256}, {"bounces", 1}}), "trace", 1);
        ASSERT_EQ(images.size(), 1u);
        EXPECT_NEAR(meanOf(images[0]), 1, 0.002);
    }
}

}  // namespace
}  // namespace lodestir::test
