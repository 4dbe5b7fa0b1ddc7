// SPDX-License-Identifier: MIT
// Impostors that are drawn show what the geometry shows: shapes that are known, and the geometry itself as visibility sees it.
#include "body.h"
#include "frames.h"
#include "program.h"

#include <framework/shaders/impostor/surfel.h>

#include <algorithm>
#include <cstring>

namespace lodestir::test {
namespace {

constexpr std::uint32_t nothing = 0xffffffffu;

/// A scene file around a model, with a camera.
Path writeScene(const Path& folder, const Path& model, const OrderedJson& camera, OrderedJson more = OrderedJson::object()) {
    OrderedJson scene = {{"format", 1},
                         {"about", "made by a test"},
                         {"models", {{"model", {{"file", model.filename().string()}}}}},
                         {"environment", {{"type", "constant"}, {"color", {1, 1, 1}}, {"strength", 1}}},
                         {"camera", camera}};
    scene.update(more);
    writeFile(folder / "scene.json", scene.dump(2));
    return folder / "scene.json";
}

OrderedJson cameraAt(const glm::dvec3& position, const glm::dvec3& target = glm::dvec3(0)) {
    return {{"position", {position.x, position.y, position.z}}, {"target", {target.x, target.y, target.z}}, {"up", {0, 1, 0}}, {"fovy", 30}};
}
/// In frame i from direction i.
OrderedJson camerasAround(const std::vector<glm::dvec3>& ways, double distance, const glm::dvec3& target = glm::dvec3(0)) {
    OrderedJson frames = OrderedJson::array();
    for (std::size_t i = 0; i < ways.size(); ++i) {
        OrderedJson camera = cameraAt(target + distance * glm::normalize(ways[i]), target);
        camera["frame"] = i;
        frames.push_back(camera);
    }
    OrderedJson camera = frames[0];
    camera.erase("frame");
    camera["keyframes"] = frames;
    return camera;
}

/// Impostors and geometry, drawn side by side.
OrderedJson drawBoth(OrderedJson bake, OrderedJson draw = OrderedJson::object(), const std::string& world = "scene") {
    bake.update({{"points", 0}});
    return {{"bake", {{"type", "impostor_bake"}, {"set", bake}}},
            {"draw", {{"type", "impostor_forward_map"}, {"set", draw}}},
            {"fill", {{"type", "hole_fill"}, {"in", {{"surfels", "draw"}}}}},
            {"shade", {{"type", "reshade"}, {"in", {{"surfels", "fill"}, {"impostors", "bake"}}}}},
            {"hits", {{"type", "visibility"}, {"in", {{"world", "scene"}}}, {"set", {{"film", "centre"}}}}},
            {"truth", {{"type", "reshade"}, {"in", {{"world", world}, {"hits", "hits"}}}}}};
}
const std::vector<std::string> ports{"shade.color", "truth.color", "draw.surfels", "fill.surfels", "hits.depth", "hits.normal", "draw.texels"};

/// What an image of impostors lacks against the geometry's.
struct Difference {
    double missing = 0, added = 0;  ///< pixels of geometry without a surfel, and of surfels without geometry, as shares of the geometry's
    double depth = 0;               ///< mean of |depths' difference|, pixels' widths, where it is no more than 6
    double before = 0, behind = 0;  ///< shares of pixels whose surfel is before or behind all geometry within a pixel, by more than 6 widths
    double normal = 0;              ///< mean of the angle, degrees
};

Difference differenceOf(Frames& frames, const std::string& surfels, double pixelAngle) {
    const std::vector<Surfel> drawn = frames.records<Surfel>(surfels);
    const ImageData depth = frames.image("hits.depth"), normal = frames.image("hits.normal");
    Difference d;
    double seen = 0, both = 0, same = 0;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        const double z = depth.values[i];
        const bool isDrawn = drawn[i].instance != nothing;
        seen += z > 0;
        d.missing += z > 0 && !isDrawn;
        d.added += z == 0 && isDrawn;
        if (z == 0 || !isDrawn) continue;
        ++both;
        double nearest = z, farthest = z;
        const std::size_t x = i % std::size_t(depth.width), y = i / std::size_t(depth.width);
        for (std::size_t v = y - (y > 0); v <= std::min<std::size_t>(y + 1, std::size_t(depth.height) - 1); ++v) {
            for (std::size_t u = x - (x > 0); u <= std::min<std::size_t>(x + 1, std::size_t(depth.width) - 1); ++u) {
                const double other = depth.at(u, v, 0);
                nearest = other > 0 ? std::min(nearest, other) : nearest;
                farthest = other > 0 ? std::max(farthest, other) : farthest;
            }
        }
        const double width = z * pixelAngle, off = (drawn[i].depth - z) / width;
        d.before += drawn[i].depth < nearest - 6 * width;
        d.behind += drawn[i].depth > farthest + 6 * width;
        if (std::abs(off) > 6) continue;
        ++same;
        d.depth += std::abs(off);
        const auto component = [&](int shift) { return std::max(-1.0, double(std::int16_t(drawn[i].normal >> shift)) / 32767); };
        glm::dvec3 n(component(0), component(16), 0);
        n.z = 1 - std::abs(n.x) - std::abs(n.y);
        if (n.z < 0) n = {(1 - std::abs(n.y)) * (n.x < 0 ? -1 : 1), (1 - std::abs(n.x)) * (n.y < 0 ? -1 : 1), n.z};
        const glm::dvec3 m(normal.at(x, y, 0), normal.at(x, y, 1), normal.at(x, y, 2));
        d.normal += std::acos(std::clamp(glm::dot(glm::normalize(n), glm::normalize(m)), -1.0, 1.0)) * 180 / std::numbers::pi;
    }
    return {d.missing / seen, d.added / seen, d.depth / same, d.before / both, d.behind / both, d.normal / same};
}

void print(const char* what, const Difference& d) {
    std::printf("%s: missing %.4f, added %.4f, depth %.2f widths, before %.4f, behind %.4f, normals %.2f degrees\n", what, d.missing, d.added, d.depth,
                d.before, d.behind, d.normal);
}

/// Mean squared error of the pictures as displayed, over pixels that show both.
double errorOf(Frames& frames) {
    const ImageData a = frames.image("shade.color"), b = frames.image("truth.color");
    const auto encode = [](double x) {
        x = std::clamp(x, 0.0, 1.0);
        return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
    };
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < a.values.size(); i += 4) {
        if (a.values[i + 3] == 0 || b.values[i + 3] == 0) continue;
        for (std::size_t c = 0; c < 3; ++c) sum += std::pow(encode(a.values[i + c]) - encode(b.values[i + c]), 2) / 3;
        ++count;
    }
    return sum / count;
}

class ImpostorDraw : public testing::Test {
protected:
    TemporaryFolder folder;
};

constexpr double angle128 = 2 * 0.2679491924 / 128;  // of a pixel: 30 degrees over 128 of them

// Along a view, at the worst angle to all of 18 (a cube's corner), and in between.
const std::vector<glm::dvec3> ways{{1, 0, 0}, {1, 1, 1}, {-0.3, 0.5, 0.9}};

// If this fails, texels land elsewhere than the surface they saw, or face another way.
TEST_F(ImpostorDraw, ASphereIsWhereItIsFromAnySide) {
    Body body(1);
    body.sphere(1);
    const glm::dvec3 place(3, 1, -2);
    const Path model = body.write(folder.path, "ball", {glm::vec3(place)});
    Frames frames(writeScene(folder.path, model, camerasAround(ways, 4.6, place)), {128, 128}, drawBoth({{"resolution", 128}}), ports);
    for (std::size_t i = 0; i < ways.size(); ++i) {
        frames.restart(std::uint32_t(i));
        frames.run();
        const Difference drawn = differenceOf(frames, "draw.surfels", angle128), filled = differenceOf(frames, "fill.surfels", angle128);
        print("drawn", drawn);
        print("filled", filled);
        EXPECT_LT(drawn.missing, 0.002);
        EXPECT_LT(drawn.added, 0.01);
        EXPECT_LT(drawn.depth, 0.1);
        EXPECT_EQ(drawn.before + drawn.behind, 0);
        EXPECT_LT(drawn.normal, 0.1);
        EXPECT_LE(filled.missing, drawn.missing);
        EXPECT_LT(filled.added, 0.01);
        EXPECT_LT(errorOf(frames), 1e-4);
    }
}

// Normals lean sixty degrees to one side, and the one light stands on that side but below the plane: where they say light is, none arrives.
TEST_F(ImpostorDraw, NoLightComesFromBelowTheSurface) {
    Body body(1);
    body.sheet({8, 8}, [](glm::dvec2 p) {
        return Corner{{2 * p.x - 1, 2 * p.y - 1, 0}, glm::normalize(glm::dvec3(std::sqrt(3.0), 0, 1)), p};
    });
    const Path model = body.write(folder.path, "sheet");
    const OrderedJson dark = {{"type", "constant"}, {"color", {1, 1, 1}}, {"strength", 0}};
    const auto lightAt = [&](double height) {
        const OrderedJson lights = {{{"type", "point"}, {"color", {1, 1, 1}}, {"intensity", 100}, {"position", {6, 0, height}}}};
        const Path scene = writeScene(folder.path, model, cameraAt({0.4, 0.3, 4.6}), {{"environment", dark}, {"lights", lights}});
        Frames frames(scene, {64, 64}, drawBoth({{"resolution", 128}}), ports);
        frames.run();
        return std::pair(sumOf(frames.image("shade.color")), sumOf(frames.image("truth.color")));
    };
    const auto [below, black] = lightAt(-1);
    const auto [above, lit] = lightAt(1);
    std::printf("light from below: %.2f, geometry %.2f; from above: %.2f, geometry %.2f\n", below, black, above, lit);
    EXPECT_NEAR(below / black, 1, 0.01);
    EXPECT_NEAR(above / lit, 1, 0.02);
    EXPECT_GT(above, 1.2 * below);  // which is alpha alone
}

// If this fails, one of the two ways to find the nearest texel has lost a race, or an image depends on how threads ran.
TEST_F(ImpostorDraw, SameBitsByEitherKindOfAtomicsAndInEachFrame) {
    Body body(1);
    body.torus(0.7, 0.3, {0, 1, 0});
    body.torus(0.7, 0.3, {1, 0, 0}, {0.7, 0, 0});
    const Path model = body.write(folder.path, "rings", {glm::vec3(0), glm::vec3(0.4f, 0.5f, -1)});
    for (const double tolerance : {0.0, 1.5}) {
        Frames frames(writeScene(folder.path, model, cameraAt({2.5, 2, 3.5})), {96, 96},
                      drawBoth({{"resolution", 128}}, {{"tolerance", tolerance}}), ports);
        frames.run();
        const std::vector<std::byte> first = frames.records<std::byte>("draw.surfels");
        for (int i = tolerance > 0 ? 0 : 98; i < 99; ++i) {
            frames.run();
            ASSERT_EQ(frames.records<std::byte>("draw.surfels"), first) << "frame " << i + 1;
        }
        frames.set("draw.atomics", Json("pair"));
        frames.run(2);
        EXPECT_EQ(frames.records<std::byte>("draw.surfels"), first);
    }
}

// If this fails, placements are taken for rotations: normals under uneven scales, mirrored ones, sides of texels, tiles passed over that are seen.
TEST_F(ImpostorDraw, UnevenAndMirroredPlacements) {
    Body body(1);
    body.torus(0.7, 0.25, glm::normalize(glm::dvec3(0.3, 1, 0.2)));
    const Path model = body.write(folder.path, "ring", {glm::vec3(0), glm::vec3(2.2f, 0, 0)});
    OrderedJson json = OrderedJson::parse(readText(model));
    json["nodes"][0]["scale"] = {1.6, 0.7, 1.0};
    json["nodes"][0]["rotation"] = {0.1830127, 0.6830127, 0.1830127, 0.6830127};
    json["nodes"][1]["scale"] = {-0.8, 1.1, 1.3};
    writeFile(model, json.dump());
    Frames frames(writeScene(folder.path, model, cameraAt({1.1, 2.4, 6}, {1.1, 0, 0})), {128, 128}, drawBoth({{"resolution", 256}}), ports);
    frames.run();
    const Difference filled = differenceOf(frames, "fill.surfels", angle128);
    print("uneven, mirrored", filled);
    EXPECT_LT(filled.missing, 0.01);
    EXPECT_LT(filled.added, 0.02);
    EXPECT_LT(filled.before + filled.behind, 0.005);
    EXPECT_LT(filled.normal, 3);
    EXPECT_LT(errorOf(frames), 1e-3);
}

// If this fails, more than the budget's tiles are drawn, or what is drawn with fewer isn't the object any more.
TEST_F(ImpostorDraw, ABudgetMakesLevelsCoarser) {
    Body body(1);
    body.sphere(0.5);
    std::vector<glm::vec3> places;
    for (int i = 0; i < 100; ++i) places.push_back({1.5f * float(i % 10) - 6.75f, 1.5f * float(i / 10) - 6.75f, 0});
    const Path model = body.write(folder.path, "balls", places);
    Frames frames(writeScene(folder.path, model, cameraAt({0, 0, 30})), {256, 256}, drawBoth({{"resolution", 256}}), ports);
    frames.run();
    const auto texelsOf = [&] { return frames.records<std::uint32_t>("draw.texels").at(0); };
    const std::uint32_t free = texelsOf();
    const Difference before = differenceOf(frames, "fill.surfels", angle128 / 2);
    print("free", before);
    EXPECT_LT(before.missing + before.added, 0.05);
    frames.set("draw.tiles", Json(1 << 10));
    frames.run();
    const Difference after = differenceOf(frames, "fill.surfels", angle128 / 2);
    print("1024 tiles", after);
    EXPECT_LT(texelsOf(), (1u << 10) * 64);
    EXPECT_LT(texelsOf(), free / 2);
    EXPECT_LT(after.missing, 0.05);
    EXPECT_LT(after.before + after.behind, 0.01);
}

// Bowls in each other: what the inner sides saw from behind must not come through.
TEST_F(ImpostorDraw, BackSurfacesDoNotLeak) {
    Body body(1);
    for (const double radius : {0.55, 0.75, 0.95}) {
        for (const double side : {1.0, -1.0}) {
            body.sheet({96, 48}, [&](glm::dvec2 p) {
                const double turn = 2 * std::numbers::pi * p.x, rise = -0.5 * std::numbers::pi * (side > 0 ? 1 - p.y : p.y);
                const glm::dvec3 n(std::cos(rise) * std::sin(turn), std::sin(rise), std::cos(rise) * std::cos(turn));
                return Corner{(radius + (side > 0 ? 0.03 : 0)) * n, side * n, p};
            });
        }
        body.sheet({96, 1}, [&](glm::dvec2 p) {  // the rim
            const double turn = 2 * std::numbers::pi * p.x;
            return Corner{(radius + 0.03 * (1 - p.y)) * glm::dvec3(std::sin(turn), 0, std::cos(turn)), {0, 1, 0}, p};
        });
    }
    const std::vector<glm::dvec3> around{{1, 1, 1}, {0.2, 0.4, 1}, {0.6, -0.5, -0.3}};
    Frames frames(writeScene(folder.path, body.write(folder.path, "bowls"), camerasAround(around, 4.6)), {128, 128}, drawBoth({{"resolution", 128}}), ports);
    for (std::size_t i = 0; i < around.size(); ++i) {
        frames.restart(std::uint32_t(i));
        frames.set("draw.backFaces", Json(true));
        frames.run();
        const Difference filled = differenceOf(frames, "fill.surfels", angle128);
        print("bowls", filled);
        frames.set("draw.backFaces", Json(false));
        frames.restart(std::uint32_t(i));
        frames.run();
        const Difference leaking = differenceOf(frames, "fill.surfels", angle128);
        print("  with back faces", leaking);
        EXPECT_LT(filled.before, 0.005);
        EXPECT_LT(filled.behind, 0.02);
    }
}

// Far balls are drawn as impostors, near ones left to geometry; together they are all of them, and each is there once.
TEST_F(ImpostorDraw, GeometryHandsOver) {
    Body body(1);
    body.sphere(0.5);
    std::vector<glm::vec3> places;
    for (int i = 0; i < 12; ++i) places.push_back({1.3f * float(i % 2) - 0.65f, 0, -3.0f * float(i / 2)});
    const Path model = body.write(folder.path, "balls", places);
    OrderedJson passes = {{"all", {{"type", "visibility"}, {"in", {{"world", "scene"}}}, {"set", {{"film", "centre"}}}}},
                          {"bake", {{"type", "impostor_bake"}, {"set", {{"resolution", 64}, {"points", 0}}}}},
                          {"draw", {{"type", "impostor_forward_map"}, {"in", {{"world", "scene"}}}, {"set", {{"pixelError", 1}}}}},
                          {"rest", {{"type", "visibility"}, {"in", {{"world", "draw.rest"}}}, {"set", {{"film", "centre"}}}}}};
    Frames frames(writeScene(folder.path, model, cameraAt({0, 0.4, 3.2}, {0, 0, -8})), {128, 128}, passes, {"all.depth", "rest.depth", "draw.surfels"});
    for (int frame = 0; frame < 2; ++frame) {  // with history, too
        frames.run();
        const ImageData all = frames.image("all.depth"), rest = frames.image("rest.depth");
        const std::vector<Surfel> surfels = frames.records<Surfel>("draw.surfels");
        std::set<std::uint32_t> drawn;
        double wrong = 0, near = 0;
        for (std::size_t i = 0; i < surfels.size(); ++i) {
            const bool isDrawn = surfels[i].instance != nothing;
            if (isDrawn) drawn.insert(surfels[i].instance);
            const float behind = rest.values[i] > 0 ? rest.values[i] : 1e30f, depth = std::min(behind, isDrawn ? surfels[i].depth : 1e30f);
            near += rest.values[i] > 0;
            wrong += std::abs((depth < 1e30f ? depth : 0) - all.values[i]) > 0.1f;
        }
        std::printf("%zu of 12 are impostors; %g pixels show another surface\n", drawn.size(), wrong);
        EXPECT_GT(near, 500);
        EXPECT_GE(drawn.size(), 4u);
        EXPECT_LE(drawn.size(), 10u);
        EXPECT_LT(wrong, 60);  // outlines of the far ones
    }
    frames.set("draw.pixelError", Json(0.0));
    frames.run();
    EXPECT_EQ(sumOf(frames.image("rest.depth")), 0);
}

// Materials are asked when light falls, not when the impostor is made.
TEST_F(ImpostorDraw, MaterialsAreEditedWithoutAnotherBake) {
    Body body(1);
    body.sphere(1);
    body.material(0)["pbrMetallicRoughness"] = {{"baseColorFactor", {0.7, 0.6, 0.5, 1}}, {"roughnessFactor", 0.6}, {"metallicFactor", 0}};
    const Path model = body.write(folder.path, "ball");
    OrderedJson passes = {{"bake", {{"type", "impostor_bake"}, {"set", {{"resolution", 128}, {"points", 0}}}}},
                          {"edit", {{"type", "material_edit"}}}};
    passes.update(drawBoth({{"resolution", 128}}, OrderedJson::object(), "edit"));
    passes["edit"]["set"] = {{"material", "material 0"}};
    Frames frames(writeScene(folder.path, model, cameraAt({2, 2, 3.6}),
                             {{"environment", {{"type", "sky"}, {"sunDirection", {0.5, 0.7, 0.5}}, {"sunAngle", 5}, {"sunStrength", 1}, {"turbidity", 3}}},
                              {"exposure", -2}}),
                  {128, 128}, passes, ports);
    frames.run();
    const double before = errorOf(frames);
    const double truth = sumOf(frames.image("truth.color"));
    frames.set("edit.red", Json(0.2));
    frames.set("edit.roughness", Json(0.25));
    frames.set("edit.metallic", Json(1.0));
    frames.run();
    const double after = errorOf(frames);
    std::printf("error before %.6f, after the edit %.6f\n", before, after);
    EXPECT_GT(std::abs(sumOf(frames.image("truth.color")) / truth - 1), 0.05) << "the edit changes nothing";
    EXPECT_LT(before, 1e-4);
    EXPECT_LT(after, 1e-4);
}

}  // namespace
}  // namespace lodestir::test
