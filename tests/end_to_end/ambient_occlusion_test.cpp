// SPDX-License-Identifier: MIT
// ambient_occlusion against openings whose cosine-weighted share is known. By Malley's construction that share is an area of the unit disk.
#include "frames.h"
#include "model.h"
#include "program.h"

#include <cmath>
#include <numbers>

namespace lodestir::test {
namespace {

constexpr glm::uvec2 size{32, 32};
constexpr int rays = 64;
constexpr double pi = std::numbers::pi;
const double fourSigma = 4 * 0.5 / std::sqrt(double(size.x * size.y * rays));  // of a share near one half; of any other it is less

const Quad ground{{-1000, 0, 1000}, {2000, 0, 0}, {0, 0, -2000}, {}};
Quad ceiling(double height) { return {{-1000, height, -1000}, {2000, 0, 0}, {0, 0, 2000}, {}}; }
Quad wall(double height) { return {{0, 0, 1000}, {0, 0, -2000}, {0, height, 0}, {}}; }  // at x = 0, faces +x

/// From straight above, so near that all pixels show one point of the ground.
View above(double x, double height) { return {{x, height, 0}, {x, 0, 0}, {0, 0, -1}, 0.1}; }

class AmbientOcclusion : public testing::Test {
protected:
    /// What is open of a scene of these quads, pixel by pixel.
    ImageData open(const std::vector<Quad>& quads, const View& view, double radius, const OrderedJson& material = OrderedJson::object()) {
        writeModel(folder_.path, "scene", quads);
        if (!material.empty()) {
            OrderedJson model = OrderedJson::parse(readText(folder_.path / "scene.gltf"));
            model["materials"].back().update(material);
            writeFile(folder_.path / "scene.gltf", model.dump());
        }
        writeScene(folder_.path, "scene", view, constantEnvironment(Point(1)));
        const OrderedJson passes = {
            {"hits", {{"type", "visibility"}, {"in", {{"worldPrev", "scene.world@prev"}}}}},
            {"occlusion", {{"type", "ambient_occlusion"}, {"in", {{"hits", "hits.hits"}}}, {"set", {{"rays", rays}, {"radius", radius}}}}}};
        Frames frames(folder_.path / "scene.json", size, passes, {"occlusion.open"});
        frames.run();
        rays_ = frames.rays("occlusion");
        return firstChannels(frames.image("occlusion.open"), 1);
    }
    RayCounts rays_;  ///< of the last image

private:
    TemporaryFolder folder_;
};

void expectAll(const ImageData& image, float value) {
    for (const float v : image.values) ASSERT_EQ(v, value);
}

TEST_F(AmbientOcclusion, APlaneAloneIsOpenOnBothSidesAndSoIsTheSky) {
    expectAll(open({ground}, {{0, 3, 5}, {0, 0, 0}}, 0), 1);  // with sky above
    EXPECT_EQ(rays_[RAYS_CONTINUE] + rays_[RAYS_PRIMARY] + rays_[RAYS_NEE], 0u);
    expectAll(open({ground}, {{0, 5, 0.1}, {0, 0, 0}}, 0), 1);
    EXPECT_EQ(rays_[RAYS_VISIBILITY], size.x * size.y * rays);
    expectAll(open({ground, ceiling(3)}, {{0, -5, 0.1}, {0, 0, 0}}, 0), 1);  // from below, where nothing is
}

TEST_F(AmbientOcclusion, WallsHideWhatTheyShould) {
    EXPECT_NEAR(meanOf(open({ground, wall(1000)}, above(0.002, 0.5), 0)), 0.5, fourSigma) << "the foot of an infinite wall";
    // A long wall as high as it is far: (1 - cos(45 degrees)) / 2 is hidden.
    EXPECT_NEAR(meanOf(open({ground, wall(1)}, above(1, 0.5), 0)), 0.5 + 0.25 * std::sqrt(2.0), fourSigma);
    // A high wall at half the radius: the segment of the unit disk beyond c = 1/2 is hidden.
    const double c = 0.5, hidden = (std::acos(c) - c * std::sqrt(1 - c * c)) / pi;
    EXPECT_NEAR(meanOf(open({ground, wall(1000)}, above(1, 0.5), 2)), 1 - hidden, fourSigma);
    expectAll(open({ground, wall(1000)}, above(1, 0.5), 0.9), 1);  // out of reach
}

TEST_F(AmbientOcclusion, ACeilingWithinTheRadiusHidesACap) {
    // What lies within the angle whose cosine is height / radius: sin^2 of it.
    EXPECT_NEAR(meanOf(open({ground, ceiling(1)}, above(0, 0.5), 2)), 0.25, fourSigma);
    EXPECT_NEAR(meanOf(open({ground, ceiling(1)}, above(0, 0.5), 1.25)), 0.64, fourSigma);
}

TEST_F(AmbientOcclusion, AClosedBoxIsClosed) {
    const std::vector<Quad> room = box({-2, -2, -2}, {2, 2, 2}, {}, true);
    expectAll(open(room, {{1.5, 1.2, 1.1}, {-1.5, -1.2, -0.9}, {0, 1, 0}, 80}, 0), 0);
    EXPECT_GT(meanOf(open(room, {{1.5, 1.2, 1.1}, {-1.5, -1.2, -0.9}, {0, 1, 0}, 80}, 0.1)), 0.9);
}

// What a mask cuts away hides nothing; glass hides as walls do.
TEST_F(AmbientOcclusion, MasksAreSeen) {
    const auto lid = [](const char* mode, double alpha) {
        return OrderedJson{{"alphaMode", mode}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, alpha}}}}};
    };
    expectAll(open({ground, ceiling(1)}, above(0, 0.5), 0, lid("MASK", 0.4)), 1);
    // All but the directions that go by between the far rims: less than one ray in a million.
    EXPECT_LT(meanOf(open({ground, ceiling(1)}, above(0, 0.5), 0, lid("MASK", 0.6))), 1e-4);
    EXPECT_LT(meanOf(open({ground, ceiling(1)}, above(0, 0.5), 0, lid("BLEND", 0.4))), 1e-4);
}

}  // namespace
}  // namespace lodestir::test
