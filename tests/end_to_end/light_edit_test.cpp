// SPDX-License-Identifier: MIT
// Lights changed by a pass: a power of two as factor is one in the picture, to the last bit; a turn is a turn of the scene file's.
#include "frames.h"
#include "level_model.h"

namespace lodestir::test {
namespace {

class LightEdit : public FolderTest {
protected:
    /// A bowl of two levels below lamps and an environment.
    Path writeScene(const OrderedJson& environment, const OrderedJson& lights, const LevelModelLook& look = {}) {
        writeLevels(folder, "bowl", {{.cells = 6, .place = bowl}, {.cells = 3, .place = bowl}}, look);
        const OrderedJson scene = {{"format", 1},
                                   {"models", {{"bowl", {{"file", "bowl.gltf"}}}}},
                                   {"environment", environment},
                                   {"lights", lights},
                                   {"camera", {{"position", {0, 2.4, 2.6}}, {"target", {0, 0.2, 0}}, {"fovy", 45}}}};
        writeFile(folder / "scene.json", scene.dump());
        return folder / "scene.json";
    }
    static OrderedJson lamp(const std::string& name, double x) { return {{"type", "point"}, {"name", name}, {"position", {x, 2, 0}}, {"intensity", 3}}; }
    static ImageData picture(Frames& frames) {
        frames.restart(0);
        frames.run();
        return frames.image("trace.color");
    }
    static void expectTimes(double factor, const ImageData& before, const ImageData& after) {
        ASSERT_EQ(before.values.size(), after.values.size());
        EXPECT_GT(sumOf(before), 1);
        for (std::size_t i = 0; i < before.values.size(); ++i)
            EXPECT_EQ(after.values[i], (i % 4 < 3 ? float(factor) : 1) * before.values[i]) << i;
    }
    static OrderedJson passes() { return {{"edit", {{"type", "light_edit"}}}, {"trace", {{"type", "path_tracer"}, {"set", {{"spp", 2}}}}}}; }
};

TEST_F(LightEdit, LampsAreScaled) {
    Frames frames(writeScene({{"type", "constant"}, {"strength", 0}}, {lamp("left", -1), lamp("right", 1)}), {32, 18}, passes(), {"trace.color"});
    const ImageData before = picture(frames);
    frames.set("edit.intensity", Json(4.0));
    expectTimes(4, before, picture(frames));
    frames.set("edit.intensity", Json(0.0));
    EXPECT_EQ(sumOf(picture(frames)), 32 * 18);  // opacity
    // Both by themselves are both together.
    frames.set("edit.light", Json("left"));
    const ImageData right = picture(frames);
    frames.set("edit.light", Json("right"));
    const ImageData left = picture(frames);
    EXPECT_GT(sumOf(left), 32 * 18 + 1);
    for (std::size_t i = 0; i < before.values.size(); ++i)
        EXPECT_NEAR(left.values[i] + right.values[i], (i % 4 < 3 ? 1 : 2) * before.values[i], 1e-5f + 1e-4f * before.values[i]) << i;
    frames.set("edit.light", Json("rihgt"));
    try {
        frames.run();
        FAIL() << "there is no such light";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("did you mean \"right\""), std::string::npos) << error.what();
    }
}

// If this fails, what glows at a coarser level is forgotten when any light is edited.
TEST_F(LightEdit, KeepsLightsOfCoarserLevels) {
    const Path scene = writeScene({{"type", "constant"}, {"strength", 0}}, OrderedJson::array({lamp("lamp", 1)}), {.emission = {2, 3, 4}});
    OrderedJson passes{{"lod", {{"type", "lod_select"}, {"set", {{"mode", "fixed"}, {"level", 1}}}}},
                       {"edit", {{"type", "light_edit"}, {"in", {{"world", "lod.world"}}}}},
                       {"trace", {{"type", "path_tracer"}, {"in", {{"world", "edit.world"}}}, {"set", {{"spp", 2}}}}}};
    Frames edited(scene, {32, 18}, passes, {"trace.color"});
    passes["edit"]["off"] = true;
    Frames plain(scene, {32, 18}, passes, {"trace.color"});
    const ImageData expected = picture(plain);
    EXPECT_GT(sumOf(expected), 32 * 18 + 1);
    EXPECT_TRUE(picture(edited).values == expected.values);
    edited.set("edit.intensity", Json(2.0));
    EXPECT_FALSE(picture(edited).values == expected.values);
}

TEST_F(LightEdit, EnvironmentIsScaledAndTurned) {
    const OrderedJson sky{{"type", "sky"}, {"sunDirection", {0.6, 0.5, 0.2}}};
    OrderedJson turned = sky;
    turned["rotationDegrees"] = 90;
    Frames frames(writeScene(sky, OrderedJson::array()), {32, 18}, passes(), {"trace.color"});
    const ImageData before = picture(frames);
    frames.set("edit.environment", Json(2.0));
    expectTimes(2, before, picture(frames));
    frames.set("edit.environment", Json(1.0));
    frames.set("edit.turn", Json(90.0));
    const ImageData byPass = picture(frames);
    Frames file(writeScene(turned, OrderedJson::array()), {32, 18}, passes(), {"trace.color"});
    const ImageData byFile = picture(file);
    double apart = 0;
    for (std::size_t i = 0; i < byFile.values.size(); ++i) apart += std::abs(byFile.values[i] - byPass.values[i]);
    EXPECT_LT(apart, 1e-3 * sumOf(byFile));
    EXPECT_GT(std::abs(sumOf(before) - sumOf(byFile)), 1e-3 * sumOf(byFile));
}

}  // namespace
}  // namespace lodestir::test
