// SPDX-License-Identifier: MIT
// Scenes that are hard on purpose are what they are named for: light that is all indirect, that passes glass and mirrors, that few paths carry.
#include "frames.h"
#include "program.h"

#include <array>
#include <cstdint>
#include <iostream>

namespace lodestir::test {
namespace {

const Path builtScenes = LODESTIR_BUILD_DIR "/scenes";

OrderedJson graphPasses(const char* graph) { return OrderedJson::parse(readText(sourceFolder / "graphs" / (std::string(graph) + ".json")))["passes"]; }

OrderedJson pathTracer(int samples, int bounces) { return {{"trace", {{"type", "path_tracer"}, {"set", {{"spp", samples}, {"bounces", bounces}}}}}}; }

/// Mean light of an image whose values must be finite.
double lightOf(const ImageData& image) {
    EXPECT_TRUE(allFinite(image));
    return meanOf(image);
}

/// A copy of scenes/NAME.json with some of its members changed.
Path changedScene(const TemporaryFolder& folder, const std::string& name, const OrderedJson& changes) {
    OrderedJson scene = OrderedJson::parse(readText(sceneFile(name)));
    scene.merge_patch(changes);
    writeFile(folder.path / "changed.json", scene.dump());
    return folder.path / "changed.json";
}

/// A copy of a binary glTF file (section 4.4 of its specification) in which some materials are black and opaque.
void writeBlackened(const Path& from, const Path& to, const std::vector<std::string>& names) {
    const std::string file = readText(from);
    std::uint32_t length;
    std::memcpy(&length, file.data() + 12, sizeof length);
    OrderedJson model = OrderedJson::parse(file.substr(20, length));
    std::size_t found = 0;
    for (OrderedJson& material : model["materials"])
        for (const std::string& name : names)
            if (material["name"] == name) {
                material = {{"name", name},
                            {"doubleSided", true},
                            {"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 0, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 1}}},
                            {"extensions", {{"KHR_materials_ior", {{"ior", 1}}}}}};
                ++found;
            }
    ASSERT_EQ(found, names.size());
    std::string text = model.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string head = file.substr(0, 20);
    const auto chunk = static_cast<std::uint32_t>(text.size()), whole = static_cast<std::uint32_t>(file.size() - length + chunk);
    std::memcpy(head.data() + 8, &whole, sizeof whole);
    std::memcpy(head.data() + 12, &chunk, sizeof chunk);
    writeFile(to, head + text + file.substr(20 + length));
}

class HardScene : public testing::TestWithParam<const char*> {};

// If this fails, a scene that techniques are judged on brings values that are not finite, or nothing at all.
TEST_P(HardScene, IsRenderedByEveryReuse) {
    for (const char* graph : {"restir_pt", "restir_pt_enhanced"}) {
        SCOPED_TRACE(graph);
        Frames frames(sceneFile(GetParam()), {96, 54}, graphPasses(graph), {"shade"});
        frames.run(3);
        EXPECT_GT(lightOf(frames.image("shade")), 0);
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, HardScene, testing::Values("veach_ajar", "bathroom", "kitchen"), [](const auto& scene) { return scene.param; });
INSTANTIATE_TEST_SUITE_P(LongScenes, HardScene, testing::Values("veach_ajar_metal"), [](const auto& scene) { return scene.param; });

class DoorAjar : public testing::TestWithParam<const char*> {};

// If this fails, a lamp is seen from the room of the teapots. The view is from beside the door over all of that room.
TEST_P(DoorAjar, AllLightIsIndirect) {
    const TemporaryFolder folder;
    const OrderedJson view = {{"position", {-0.3, 1.5, 0.12}}, {"target", {-0.1, 1.2, 1.5}}, {"up", {0, 1, 0}}, {"fovy", 125}};
    const Path scene = changedScene(folder, GetParam(), {{"camera", view}});
    Frames direct(scene, {128, 96}, pathTracer(64, 1), {"trace"});
    direct.run();
    EXPECT_EQ(lightOf(direct.image("trace")), 0);
    Frames indirect(scene, {128, 96}, pathTracer(64, 3), {"trace"});
    indirect.run();
    EXPECT_GT(lightOf(indirect.image("trace")), 0);
}

INSTANTIATE_TEST_SUITE_P(Walls, DoorAjar, testing::Values("veach_ajar", "veach_ajar_metal"), [](const auto& scene) { return scene.param; });

// If this fails, most of the light in the bathroom never meets glass or a mirror: black ones would leave more than half of it.
TEST(Bathroom, MostLightMeetsGlassOrAMirror) {
    const TemporaryFolder folder;
    writeBlackened(builtScenes / "bathroom.glb", folder.path / "bathroom.glb", {"shower_glass", "amber_glass", "mirror", "chrome"});
    std::array<double, 2> light{};
    for (const bool black : {false, true}) {
        Frames frames(black ? changedScene(folder, "bathroom", OrderedJson::object()) : sceneFile("bathroom"), {96, 54}, pathTracer(256, 8), {"trace"});
        frames.run();
        light[black] = lightOf(frames.image("trace"));
    }
    std::cout << "black glass and mirrors leave " << 100 * light[1] / light[0] << " % of the light\n";
    EXPECT_LT(light[1], 0.5 * light[0]);
}

// If this fails, reuse in the kitchen makes few more copies than elsewhere.
TEST(Kitchen, ManyPixelsCopyOnePath) {
    std::array<double, 2> copies{};
    for (const bool kitchen : {false, true}) {
        OrderedJson passes = graphPasses("restir_pt");
        passes["copies"] = {{"type", "duplication_map"}, {"in", {{"paths", "spatial"}}}};
        Frames frames(sceneFile(kitchen ? "kitchen" : "interior"), {128, 72}, passes, {"copies"});
        frames.run(16);
        copies[kitchen] = sumOf(frames.image("copies")) / (128 * 72);
    }
    std::cout << "share of neighbours that hold a copy: " << copies[1] << " in the kitchen, " << copies[0] << " in the living room\n";
    EXPECT_GT(copies[1], 1.5 * copies[0]);
}

}  // namespace
}  // namespace lodestir::test
