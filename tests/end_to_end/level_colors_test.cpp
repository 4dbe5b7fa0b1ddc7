// SPDX-License-Identifier: MIT
// level_colors on sheets whose levels are known. If this fails, a picture of levels shows what the World says, not what was hit.
#include "sheets.h"

namespace lodestir::test {
namespace {

constexpr glm::uvec2 size{32, 16};

/// A flat sheet, two wide, around `middle`.
SheetLevel sheet(int cells, double middle) {
    return {.cells = cells, .place = [middle](glm::dvec2 p) { return flat(p) + glm::dvec3(middle, 0, 0); }};
}

class LevelColors : public Sheets {
protected:
    /// Seen from above: on the left a sheet of four levels, on the right one of a single level, sky between.
    Path scene() {
        writeLevels(folder.path, "fine", {sheet(16, -2), sheet(8, -2), sheet(4, -2), sheet(2, -2)});
        writeLevels(folder.path, "plain", {sheet(4, 2)});
        return write("scene", {"fine", "plain"}, OrderedJson::array(),
                     {{"camera", {{"position", {0, 100, 0}}, {"target", {0, 0, 0}}, {"up", {0, 0, -1}}, {"fovy", 1.7}}}});
    }
    static OrderedJson passes(const OrderedJson& more = OrderedJson::object()) {
        // The colours are asked of a World that shows the finest levels: the hits know better.
        OrderedJson in = {{"world", "scene.world"}, {"hits", "hits.hits"}};
        in.update(more);
        return {{"lod", {{"type", "lod_select"}, {"set", {{"mode", "fixed"}}}}},
                {"hits", {{"type", "visibility"}, {"in", {{"world", "lod.world"}, {"worldPrev", "lod.world@prev"}}}, {"set", {{"film", "centre"}}}}},
                {"levels", {{"type", "level_colors"}, {"in", in}, {"set", {{"shading", false}}}}}};
    }
    static void expectColor(const ImageData& image, int x, glm::vec3 color) {
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(image.at(x, 8, c), color[c], 1e-3f) << "pixel " << x << ", channel " << c;
    }
    static constexpr int left = 5, between = 16, right = 26;  ///< columns of pixels
};

TEST_F(LevelColors, AreThoseOfTheTrianglesHit) {
    Frames frames(scene(), size, passes(), {"levels.color"});
    const std::array<glm::vec3, 4> colors{glm::vec3(1, 0, 0), {2 / 3.0f, 1, 0}, {0, 1, 2 / 3.0f}, {0, 0, 1}};
    for (int level = 0; level < 4; ++level) {
        SCOPED_TRACE(level);
        frames.set("lod.level", Json(level));
        frames.run();
        const ImageData image = frames.image("levels.color");
        expectColor(image, left, colors[std::size_t(level)]);
        expectColor(image, between, glm::vec3(0));
        expectColor(image, right, glm::vec3(0.5f));
    }
}

TEST_F(LevelColors, AreMultipliedWithLight) {
    Frames frames(scene(), size, passes({{"light", "hits.albedo"}}), {"levels.color"});
    frames.set("lod.level", Json(3));
    frames.run();
    const ImageData image = frames.image("levels.color");
    expectColor(image, left, {0, 0, 0.5f});
    expectColor(image, right, {0.35f, 0.3f, 0.25f});
}

TEST_F(LevelColors, AreDarkerWhereTheSurfaceTurnsAway) {
    scene();
    // From 60 degrees off the vertical.
    const Path slanted = write("slanted", {"fine", "plain"}, OrderedJson::array(),
                               {{"camera", {{"position", {0, 50, 100 * std::sqrt(0.75)}}, {"target", {0, 0, 0}}, {"up", {0, 1, 0}}, {"fovy", 1.7}}}});
    Frames frames(slanted, size, passes(), {"levels.color"});
    frames.set("levels.shading", Json(true));
    frames.run();
    const float expected = 0.25f + 0.75f * 0.5f;
    const ImageData image = frames.image("levels.color");
    EXPECT_NEAR(image.at(left, 8, 0), expected, 0.01f);
    EXPECT_NEAR(image.at(right, 8, 1), 0.5f * expected, 0.01f);
}

}  // namespace
}  // namespace lodestir::test
