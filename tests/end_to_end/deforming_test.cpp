// SPDX-License-Identifier: MIT
// Meshes that deform look, move and are reused like any other: a box that a node carries, that a joint carries, and that a morph target
// shifts, is the same box.
#include "frames.h"
#include "shift_session.h"

#include <tests/cpu/gltf_model.h>

namespace lodestir::test {
namespace {

enum class Carrier { node, joint, target };

constexpr glm::uvec2 size{64, 40};

class Deformation : public testing::Test {
protected:
    /// A box over a floor that moves by (0.9, 0.3, 0) in the first second, turning by 60 degrees about +Y where `turns`.
    Path write(Carrier carrier, bool turns) {
        GltfModel model;
        const std::vector<float> corners{-.5f, 0, -.5f, .5f, 0, -.5f, .5f, 0, .5f, -.5f, 0, .5f, -.5f, 1, -.5f, .5f, 1, -.5f, .5f, 1, .5f, -.5f, 1, .5f};
        nlohmann::json box = {
            {"attributes", {{"POSITION", model.positions(corners)}}},
            {"indices", model.indices({0, 1, 2, 0, 2, 3, 4, 6, 5, 4, 7, 6, 0, 4, 5, 0, 5, 1, 1, 5, 6, 1, 6, 2, 2, 6, 7, 2, 7, 3, 3, 7, 4, 3, 4, 0})},
            {"material", 0}};
        if (carrier == Carrier::joint) {
            std::vector<float> weights;
            for (int v = 0; v < 8; ++v) weights.insert(weights.end(), {1, 0, 0, 0});
            box["attributes"]["JOINTS_0"] = model.accessor(std::vector<std::uint8_t>(32, 0), 5121, "VEC4", 4);
            box["attributes"]["WEIGHTS_0"] = model.accessor(weights, 5126, "VEC4", 4);
        }
        if (carrier == Carrier::target) {
            std::vector<float> shift;
            for (int v = 0; v < 8; ++v) shift.insert(shift.end(), {0.9f, 0.3f, 0});
            box["targets"] = {{{"POSITION", model.positions(shift)}}};
        }
        model.addMesh(box);
        model.addMesh({{"attributes", {{"POSITION", model.positions({-4, 0, -4, -4, 0, 4, 4, 0, 4, 4, 0, -4})}}},
                       {"indices", model.indices({0, 1, 2, 0, 2, 3})},
                       {"material", 1}});
        for (const float red : {0.8f, 0.5f})
            model.json["materials"].push_back(
                {{"pbrMetallicRoughness", {{"baseColorFactor", {red, 0.5, 0.4, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 0.6}}}});
        int moved = 0;
        if (carrier == Carrier::joint) {
            moved = 2;
            model.json["nodes"].push_back({{"name", "joint"}});
            model.json["scenes"][0]["nodes"].push_back(2);
            model.json["skins"] = {{{"joints", {2}}}};
            model.json["nodes"][0]["skin"] = 0;
        }
        const int times = model.accessor(std::vector<float>{0, 1}, 5126, "SCALAR", 1);
        const bool weights = carrier == Carrier::target;
        const int shift = weights ? model.accessor(std::vector<float>{0, 1}, 5126, "SCALAR", 1) : model.positions({0, 0, 0, 0.9f, 0.3f, 0});
        nlohmann::json samplers = {{{"input", times}, {"output", shift}}};
        nlohmann::json channels = {{{"sampler", 0}, {"target", {{"node", moved}, {"path", weights ? "weights" : "translation"}}}}};
        if (turns) {
            samplers.push_back({{"input", times}, {"output", model.accessor(std::vector<float>{0, 0, 0, 1, 0, 0.5f, 0, 0.8660254f}, 5126, "VEC4", 4)}});
            channels.push_back({{"sampler", 1}, {"target", {{"node", moved}, {"path", "rotation"}}}});
        }
        model.json["animations"] = {{{"samplers", samplers}, {"channels", channels}}};
        const std::string name = "box" + std::to_string(int(carrier)) + (turns ? "turning" : "");
        model.write(folder_.path / (name + ".gltf"));
        const OrderedJson scene = {{"format", 1},
                                   {"models", {{"box", {{"file", name + ".gltf"}}}}},
                                   {"environment", {{"type", "sky"}}},
                                   {"camera", {{"position", {1.5, 2.2, 4.5}}, {"target", {0.3, 0.4, 0}}, {"fovy", 40}}},
                                   {"animation", {{"framesPerSecond", 12}}}};
        writeFile(folder_.path / (name + ".json"), scene.dump(2));
        return folder_.path / (name + ".json");
    }

    struct Seen {
        std::vector<ImageData> motion, normal, color;
    };
    /// Frames of temporal and spatial reuse.
    static Seen see(const Path& scene) {
        OrderedJson hits = hitsNode();
        const OrderedJson passes = {{"hits", hits},
                                    {"initial", initialNode({{"bounces", 2}})},
                                    {"temporal", node("temporal_splat", pathsOf("initial", "temporal"))},
                                    {"shade", shadeNode("temporal")}};
        Frames frames(scene, size, passes, {"shade.color", "hits.motion", "hits.normal"});
        Seen seen;
        for (int i = 0; i < 6; ++i) {
            frames.run();
            seen.motion.push_back(frames.image("hits.motion"));
            seen.normal.push_back(frames.image("hits.normal"));
            seen.color.push_back(frames.image("shade.color"));
        }
        return seen;
    }

    /// Share of the values of two images that differ by more than `tolerance` of one and of the larger.
    static double differing(const ImageData& a, const ImageData& b, float tolerance) {
        EXPECT_EQ(a.values.size(), b.values.size());
        std::size_t count = 0;
        for (std::size_t i = 0; i < a.values.size(); ++i)
            count += std::abs(a.values[i] - b.values[i]) > tolerance * (1 + std::max(std::abs(a.values[i]), std::abs(b.values[i])));
        return double(count) / double(a.values.size());
    }
    /// Rounding differs, so that here and there a ray meets the neighbour or a resampling step decides otherwise; what was decided stays
    /// in a pixel's history.
    void expectSame(const Seen& a, const Seen& b) {
        const auto moves = [](const ImageData& motion) { return std::ranges::any_of(motion.values, [](float v) { return std::abs(v) > 0.5f; }); };
        for (std::size_t i = 0; i < a.color.size(); ++i) {
            EXPECT_EQ(moves(a.motion[i]), i > 0) << "frame " << i;
            EXPECT_LE(differing(a.motion[i], b.motion[i], 1e-3f), 0.002) << "frame " << i;
            EXPECT_LE(differing(a.normal[i], b.normal[i], 1e-3f), 0.002) << "frame " << i;
            EXPECT_LE(differing(a.color[i], b.color[i], 1e-2f), 0.02) << "frame " << i;
            EXPECT_NEAR(sumOf(b.color[i]) / sumOf(a.color[i]), 1, 2e-3) << "frame " << i;
        }
    }

    TemporaryFolder folder_;
};

// If this fails, a character's motion vectors, normals or shifted paths are not those of the surface that is seen.
TEST_F(Deformation, AJointCarriesLikeANode) { expectSame(see(write(Carrier::node, true)), see(write(Carrier::joint, true))); }

TEST_F(Deformation, ATargetShiftsLikeANode) { expectSame(see(write(Carrier::node, false)), see(write(Carrier::target, false))); }

}  // namespace
}  // namespace lodestir::test
