// SPDX-License-Identifier: MIT
// Paired spatial reuse makes what spatial reuse makes that has the same neighbours, from half as many shifts, in whatever order they are made.
#include "shift_session.h"

#include <passes/restir/sample_hit.h>

namespace lodestir::test {
namespace {

OrderedJson passes(const std::string& type, OrderedJson set) {
    OrderedJson in = pathsOf("temporal");
    in["pairing"] = "pairing";
    set["rounds"] = 2;
    return {{"hits", hitsNode()},
            {"initial", initialNode({{"bounces", 4}})},
            {"temporal", node("temporal_reprojection", pathsOf("initial", "temporal"))},
            {"pairing", {{"type", "pairing_textures"}, {"set", {{"radius", 8}}}}},
            {"spatial", node(type, in, std::move(set))}};
}

struct Made {
    std::vector<Reservoir> paths;
    std::vector<SampleHit> hits;
    ImageData color;
    RayCounts rays;
};

class PairedReuse : public testing::TestWithParam<const char*> {
protected:
    Made made(const std::string& type, OrderedJson set = OrderedJson::object()) {
        Frames frames(sceneFile(GetParam()), {80, 48}, passes(type, std::move(set)), {"spatial.color", "spatial.paths.reservoirs", "spatial.paths.samples"});
        frames.run(3);
        return {frames.records<Reservoir>("spatial.paths.reservoirs"), frames.records<SampleHit>("spatial.paths.samples"), frames.image("spatial.color"),
                frames.rays("spatial")};
    }
};

template <class T> bool sameBits(const T& a, const T& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

TEST_P(PairedReuse, IsWhatEachPixelWouldHaveMadeAlone) {
    const Made paired = made("spatial_paired_reuse"), alone = made("spatial_reuse", {{"neighbours", 3}});
    ASSERT_EQ(paired.paths.size(), 80u * 48u);
    std::size_t other = 0, held = 0;
    for (std::size_t i = 0; i < paired.paths.size(); ++i) {
        Reservoir a = paired.paths[i], b = alone.paths[i];
        EXPECT_EQ(a.W > 0, b.W > 0) << i;
        if (a.W == 0) continue;
        ++held;
        // Sums of weights may differ in their last bits, W with them; what is kept is the same path.
        EXPECT_NEAR(a.W / b.W, 1, 1e-4) << i;
        a.W = b.W;
        other += !sameBits(a, b) || !sameBits(paired.hits[i], alone.hits[i]);
    }
    EXPECT_GT(held, paired.paths.size() / 4);
    EXPECT_EQ(other, 0u) << "of " << held;
    for (std::size_t purpose = 0; purpose < paired.rays.size(); ++purpose) EXPECT_EQ(2 * paired.rays[purpose], alone.rays[purpose]) << purpose;
    EXPECT_GT(paired.rays[RAYS_CONNECT], 0u);
}

TEST_P(PairedReuse, IsTheSameInAnyOrder) {
    const Made listed = made("spatial_paired_reuse", {{"compaction", true}}), together = made("spatial_paired_reuse", {{"compaction", false}});
    EXPECT_EQ(listed.color.values, together.color.values);
    for (std::size_t i = 0; i < listed.paths.size(); ++i) {
        ASSERT_TRUE(sameBits(listed.paths[i], together.paths[i])) << i;
        ASSERT_TRUE(sameBits(listed.hits[i], together.hits[i])) << i;
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, PairedReuse, testing::Values("ensemble_glossy", "ensemble_glass", "ensemble_panes", "ensemble_lens", "ensemble_lights"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace lodestir::test
