// SPDX-License-Identifier: MIT
// Atlases of colours show what they baked where it was, from where it was seen exactly; from elsewhere what geometry says of cards.
#include "../cpu/gltf_model.h"
#include "frames.h"
#include "model.h"
#include "program.h"

#include <framework/shaders/world/primary_hit.h>
#include <passes/impostor/baked_surface.h>

#include <glm/gtc/packing.hpp>
#include <glm/gtc/quaternion.hpp>

#include <numbers>
#include <numeric>

namespace lodestir::test {
namespace {

constexpr std::uint32_t nothing = 0xffffffff;

/// What a pixel shows, its bits undone.
struct Seen {
    std::uint32_t instance;
    double depth, alpha, roughness, metallic;
    Point normal, color, emission;
};

Point fromOctahedral(glm::dvec2 p) {
    Point n(p, 1 - std::abs(p.x) - std::abs(p.y));
    const double fold = std::max(-n.z, 0.0);
    n.x += n.x >= 0 ? -fold : fold;
    n.y += n.y >= 0 ? -fold : fold;
    return glm::normalize(n);
}

Seen seenOf(const BakedSurface& s) {
    const glm::dvec2 normal(double(std::int16_t(s.normal & 0xffff)) / 32767, double(std::int16_t(s.normal >> 16)) / 32767);
    const glm::vec2 color = glm::unpackHalf2x16(s.color.x), colorAndRoughness = glm::unpackHalf2x16(s.color.y);
    const glm::vec2 emission = glm::unpackHalf2x16(s.more.x), emissionAndMetallic = glm::unpackHalf2x16(s.more.y);
    return {.instance = s.instance,
            .depth = s.depth,
            .alpha = s.alpha,
            .roughness = colorAndRoughness.y,
            .metallic = emissionAndMetallic.y,
            .normal = fromOctahedral(normal),
            .color = Point(color, colorAndRoughness.x),
            .emission = Point(emission, emissionAndMetallic.x)};
}

/// Where view (x, y) of a grid looks from, by the map's sentences: the sphere unfolded from above, or its upper half turned by 45 degrees.
Point gridDirection(bool hemi, int across, glm::ivec2 view) {
    const glm::dvec2 g = 2.0 * glm::dvec2(view) / double(across - 1) - 1.0;
    if (hemi) {
        const glm::dvec2 q(0.5 * (g.x + g.y), 0.5 * (g.x - g.y));
        return glm::normalize(Point(q.x, 1 - std::abs(q.x) - std::abs(q.y), q.y));
    }
    const Point d = fromOctahedral(g);
    return {d.x, d.z, d.y};
}

/// Nodes that show the mesh of a model that was written, by their matrices.
void placeModel(const Path& file, const std::vector<glm::dmat4>& placements) {
    OrderedJson gltf = OrderedJson::parse(readText(file));
    gltf["nodes"] = OrderedJson::array();
    gltf["scenes"][0]["nodes"] = OrderedJson::array();
    for (std::size_t i = 0; i < placements.size(); ++i) {
        OrderedJson matrix = OrderedJson::array();
        for (int c = 0; c < 4; ++c)
            for (int r = 0; r < 4; ++r) matrix.push_back(placements[i][c][r]);
        gltf["nodes"].push_back({{"mesh", 0}, {"matrix", matrix}});
        gltf["scenes"][0]["nodes"].push_back(i);
    }
    writeFile(file, gltf.dump());
}

void writeSphere(const Path& file, int columns, int rows) {
    std::vector<float> positions, normals;
    const auto corner = [&](int x, int y) {
        const double turn = 2 * std::numbers::pi * x / columns, rise = std::numbers::pi * (double(y) / rows - 0.5);
        for (const double v : {std::cos(rise) * std::sin(turn), std::sin(rise), std::cos(rise) * std::cos(turn)}) {
            positions.push_back(float(v));
            normals.push_back(float(v));
        }
    };
    for (int y = 0; y < rows; ++y) {
        for (int x = 0; x < columns; ++x) {
            if (y > 0) corner(x, y), corner(x + 1, y), corner(x + 1, y + 1);
            if (y + 1 < rows) corner(x, y), corner(x + 1, y + 1), corner(x, y + 1);
        }
    }
    GltfModel model;
    model.addMesh({{"attributes", {{"POSITION", model.positions(positions)}, {"NORMAL", model.accessor(normals, 5126, "VEC3", 3)}}}});
    model.write(file);
}

OrderedJson lookAlong(const Point& from, const Point& target, double height) {
    const Point towards = glm::normalize(from - target);
    const Point up = std::abs(towards.y) > 0.9 ? Point(0, 0, 1) : Point(0, 1, 0);
    return {{"position", toJson(from)}, {"target", toJson(target)}, {"up", toJson(up)}, {"orthographic", height}};
}

class ImpostorAtlas : public testing::Test {
protected:
    Path scene(const std::string& model, const OrderedJson& camera) {
        const Path file = folder.path / (model + ".json");
        writeFile(
            file,
            OrderedJson{{"format", 1}, {"models", {{model, {{"file", model + ".gltf"}}}}}, {"environment", constantEnvironment(Point(1))}, {"camera", camera}}
                .dump());
        return file;
    }
    /// `draw`: the type that draws, and what is set of it.
    static OrderedJson graph(const OrderedJson& atlas, const std::string& draw, OrderedJson set = OrderedJson::object()) {
        set["film"] = "centre";
        set["lens"] = false;
        return {{"atlas", {{"type", "impostor_atlas"}, {"set", atlas}}},
                {"draw", {{"type", draw}, {"set", set}}},
                {"hits", {{"type", "visibility"}, {"set", {{"film", "centre"}, {"lens", false}}}}}};
    }
    static const std::vector<std::string>& ports() {
        static const std::vector<std::string> all{"hits.depth", "hits.normal", "hits.albedo", "hits.hits", "draw.surfaces", "atlas.bytes"};
        return all;
    }
    static std::vector<Seen> seenIn(Frames& frames) {
        std::vector<Seen> seen;
        for (const BakedSurface& s : frames.records<BakedSurface>("draw.surfaces")) seen.push_back(seenOf(s));
        return seen;
    }
    /// Pixels that show something: of the atlas, and of the geometry.
    static glm::dvec2 shownIn(Frames& frames) {
        glm::dvec2 shown(0);
        for (const Seen& s : seenIn(frames)) shown.x += s.instance != nothing;
        for (const PrimaryHit& h : frames.records<PrimaryHit>("hits.hits")) shown.y += h.primitive != nothing;
        return shown;
    }
    TemporaryFolder folder;
};

/// Boxes that stand before one another, each side in another paint.
std::vector<Quad> bench() {
    std::vector<Quad> quads;
    int number = 0;
    for (const auto& [low, high] : {std::pair(Point(-1, -0.6, -0.5), Point(1, -0.2, 0.5)), std::pair(Point(-1, -0.2, -0.5), Point(-0.5, 0.8, 0.1)),
                                    std::pair(Point(0.2, -0.2, -0.2), Point(0.9, 0.3, 0.5))}) {
        for (Quad& q : box(low, high, {})) {
            const double n = number++ / 18.0;
            q.paint = {.color = {0.2 + 0.7 * n, 0.9 - 0.8 * n, 0.5}, .metallic = n, .roughness = 1 - n};
            if (number % 3 == 0) q.paint.emission = Point(3, 2, 1) * n;
            quads.push_back(q);
        }
    }
    return quads;
}

const glm::dmat4 turned = [] {
    glm::dmat4 m = glm::translate(glm::dmat4(1), Point(3, -2, 5)) * glm::mat4_cast(glm::angleAxis(0.8, glm::normalize(Point(1, 2, -0.5))));
    return glm::scale(m, Point(-1.3, 0.7, 1.1));  // mirrored and drawn out
}();

// From where a view stood an orthographic camera sees what it saw: to a texel's width at edges, exactly elsewhere.
TEST_F(ImpostorAtlas, ViewsShowWhatTheySaw) {
    constexpr int across = 5, size = 128, width = 2;  // pixels a texel
    writeModel(folder.path, "bench", bench());
    for (const glm::dmat4& placement : {glm::dmat4(1), turned}) {
        placeModel(folder.path / "bench.gltf", {placement});
        for (const bool hemi : {false, true}) {
            for (const glm::ivec2 view : {glm::ivec2(0, 0), glm::ivec2(2, 2), glm::ivec2(3, 1), glm::ivec2(4, 2), glm::ivec2(1, 4), glm::ivec2(4, 4)}) {
                const Point middle(placement * glm::dvec4(0, 0.1, 0, 1)), d(placement * glm::dvec4(gridDirection(hemi, across, view), 0));
                const double radius = glm::length(Point(1, 0.7, 0.5)), height = 2 * radius * 64 / 62;
                const Path file = scene("bench", lookAlong(middle + 10.0 * d, middle, height));
                Frames frames(file, {size, size},
                              graph({{"arrangement", hemi ? "hemi" : "full"}, {"across", across}, {"resolution", 64}}, "impostor_octahedral", {{"bias", -4}}),
                              ports());
                for (const char* parallax : {"off", "step", "relief"}) {
                    frames.set("draw.parallax", Json(parallax));
                    frames.run();
                    const ImageData depth = frames.image("hits.depth"), normal = frames.image("hits.normal"), albedo = frames.image("hits.albedo");
                    const std::vector<Seen> seen = seenIn(frames);
                    std::size_t inner = 0, wrong = 0;
                    double worstDepth = 0, worstNormal = 0, worstColor = 0;
                    // Pixels around which for a texel and a half all sides are one, or nothing is.
                    const int reach = int(std::ceil(1.5 * width * (placement == turned ? 1.5 : 1)));
                    for (int y = reach; y < size - reach; ++y) {
                        for (int x = reach; x < size - reach; ++x) {
                            bool isInner = true;
                            for (int j = -reach; j <= reach; ++j)
                                for (int i = -reach; i <= reach; ++i)
                                    for (int c = 0; c < 3; ++c) isInner &= albedo.at(x + i, y + j, c) == albedo.at(x, y, c);
                            if (!isInner) continue;
                            const Seen& s = seen[std::size_t(y * size + x)];
                            const bool isShown = depth.at(x, y, 0) > 0;
                            if (isShown != (s.instance != nothing)) ++wrong;
                            if (!isShown || s.instance == nothing) continue;
                            ++inner;
                            const auto at = [&](const ImageData& image) { return Point(image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)); };
                            worstDepth = std::max(worstDepth, std::abs(s.depth - depth.at(x, y, 0)));
                            worstNormal = std::max(worstNormal, glm::distance(s.normal, at(normal)));
                            worstColor = std::max(worstColor, glm::distance(s.color, at(albedo)));
                        }
                    }
                    std::printf("%s (%d, %d) %s: %zu inner pixels, %zu wrongly covered; off by depth %.1e, normal %.1e, colour %.1e\n", hemi ? "hemi" : "full",
                                view.x, view.y, parallax, inner, wrong, worstDepth, worstNormal, worstColor);
                    EXPECT_GT(inner, 200u);
                    EXPECT_EQ(wrong, 0u);
                    EXPECT_LT(worstDepth, 2e-3);
                    EXPECT_LT(worstNormal, 1e-3);
                    EXPECT_LT(worstColor, 6e-3);
                }
            }
        }
    }
}

/// A cube with a colour for each side: -x, +x, -y, +y, -z, +z.
constexpr std::array<Point, 6> sides{Point(0.8, 0.1, 0.1), Point(0.1, 0.8, 0.1), Point(0.1, 0.1, 0.8),
                                     Point(0.8, 0.8, 0.1), Point(0.1, 0.8, 0.8), Point(0.8, 0.1, 0.8)};

std::vector<Quad> colouredCube() {
    std::vector<Quad> quads = box(Point(-1), Point(1), {});
    for (std::size_t i = 0; i < 6; ++i) quads[i].paint.color = sides[i];
    return quads;
}

/// How many pixels show each side; fails where one shows anything else.
std::array<std::size_t, 6> sidesIn(Frames& frames) {
    std::array<std::size_t, 6> counts{};
    for (const BakedSurface& bits : frames.records<BakedSurface>("draw.surfaces")) {
        if (bits.instance == nothing) continue;
        const Seen s = seenOf(bits);
        const auto like = std::ranges::find_if(sides, [&](const Point& c) { return glm::distance(c, s.color) < 6e-3; });
        EXPECT_NE(like, sides.end()) << s.color.x << " " << s.color.y << " " << s.color.z;
        if (like != sides.end()) ++counts[std::size_t(like - sides.begin())];
    }
    return counts;
}

// Nothing of a neighbouring view shines in, on any level: not at borders, not where a view counts nothing.
TEST_F(ImpostorAtlas, NoViewBleedsIntoAnother) {
    writeModel(folder.path, "cube", colouredCube());
    const OrderedJson eye = {{"position", {7, 0, 0}}, {"target", {0, 0, 0}}, {"fovy", 32}};
    for (const OrderedJson& camera : {lookAlong({7, 0, 0}, {0, 0, 0}, 4), eye}) {
        for (const int bias : {-4, 0, 2}) {
            // Of 3 x 3 views, those in the middle of the map's sides look along the axes; a card of three looks along x, and the others stand edge-on.
            const Path file = scene("cube", camera);
            const OrderedJson plain = {{"parallax", "off"}, {"bias", bias}};
            Frames grid(file, {64, 64}, graph({{"across", 3}, {"resolution", 32}}, "impostor_octahedral", plain), ports());
            Frames cards(file, {64, 64}, graph({{"arrangement", "cross"}, {"resolution", 32}}, "impostor_billboard", {{"bias", bias}}), ports());
            for (Frames* frames : {&grid, &cards}) {
                frames->run();
                const std::array<std::size_t, 6> counts = sidesIn(*frames);
                EXPECT_GT(counts[1], 600u);
                EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), std::size_t(0)), counts[1]) << bias;
            }
        }
    }
    const Path file = scene("cube", lookAlong({5, 0, 5}, {0, 0, 0}, 4));
    Frames between(file, {64, 64}, graph({{"arrangement", "cross"}, {"resolution", 32}}, "impostor_billboard"), ports());
    between.run();
    const std::array<std::size_t, 6> counts = sidesIn(between);
    EXPECT_GT(counts[1], 200u);
    EXPECT_NEAR(double(counts[1]), double(counts[5]), 0.05 * double(counts[1]));
    EXPECT_EQ(counts[0] + counts[2] + counts[3] + counts[4], 0u);
}

/// Share of a ball's disk that cards cover: discs, of which those that lean more than 72.5 degrees (the middle of the fade) are gone.
double cardCoverage(const std::vector<Point>& normals, const Point& view) {
    const Point x = glm::normalize(glm::cross(Point(0.1, 1, 0.2), view)), y = glm::cross(view, x);
    std::size_t covered = 0, all = 0;
    for (int j = -200; j <= 200; ++j) {
        for (int i = -200; i <= 200; ++i) {
            const Point p = i / 200.0 * x + j / 200.0 * y;
            if (glm::length(p) > 1) continue;
            ++all;
            covered += std::ranges::any_of(normals, [&](const Point& n) {
                const double cosine = glm::dot(n, view);
                return std::abs(cosine) > 0.3 && glm::length(p - glm::dot(n, p) / cosine * view) < 1;
            });
        }
    }
    return double(covered) / double(all);
}

TEST_F(ImpostorAtlas, CardsCoverWhatTheyCan) {
    writeSphere(folder.path / "ball.gltf", 96, 48);
    const double third = std::numbers::pi / 3;
    const auto upright = [&](double turn) { return Point(std::sin(turn), 0, std::cos(turn)); };
    const std::vector<Point> cross{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, star{upright(0), upright(third), upright(2 * third), {0, 1, 0}};
    for (const auto& [name, normals] : {std::pair("cross", cross), std::pair("star", star)}) {
        for (const Point& direction : {Point(1, 0, 0), Point(1, 0, 1), Point(1, 1, 1), Point(0.5, 0, std::sqrt(0.75)), Point(0.2, 0.9, 0.3)}) {
            const Point view = glm::normalize(direction);
            const Path file = scene("ball", lookAlong(10.0 * view, Point(0), 2.4));
            Frames frames(file, {192, 192}, graph({{"arrangement", name}, {"resolution", 256}}, "impostor_billboard"), ports());
            frames.run();
            const glm::dvec2 shown = shownIn(frames);
            const double expected = cardCoverage(normals, view);
            std::printf("%s from (%.1f, %.1f, %.1f): %.3f of the ball covered, %.3f expected\n", name, direction.x, direction.y, direction.z, shown.x / shown.y,
                        expected);
            EXPECT_NEAR(shown.x / shown.y, expected, 0.015);
        }
    }
}

TEST_F(ImpostorAtlas, PaperKeepsLessAndMatchedAll) {
    writeModel(folder.path, "bench", bench());
    const Path file = scene("bench", lookAlong({0, 0.1, 6}, {0, 0.1, 0}, 2.5));
    Frames paper(file, {96, 96}, graph({{"arrangement", "cross"}, {"resolution", 64}, {"attributes", "paper"}}, "impostor_billboard"), ports()),
        matched(file, {96, 96}, graph({{"arrangement", "cross"}, {"resolution", 64}}, "impostor_billboard"), ports());
    paper.run();
    matched.run();
    std::set<double> depths;
    std::size_t emitting = 0, shown = 0;
    for (const Seen& s : seenIn(paper)) {
        if (s.instance == nothing) continue;
        EXPECT_NEAR(s.roughness, 0.7, 1e-3);
        EXPECT_EQ(s.metallic, 0);
        EXPECT_EQ(s.emission, Point(0));
        EXPECT_NEAR(s.depth, 6, 1e-4);
    }
    const std::vector<Quad> quads = bench();
    for (const Seen& s : seenIn(matched)) {
        if (s.instance == nothing) continue;
        // Of the sides that face +z, the last of each box.
        std::size_t like = 5;
        for (const std::size_t i : {11u, 17u})
            if (glm::distance(s.color, quads[i].paint.color) < glm::distance(s.color, quads[like].paint.color)) like = i;
        const Paint& paint = quads[like].paint;
        if (glm::distance(s.color, paint.color) > 6e-3) continue;  // between two
        EXPECT_NEAR(s.roughness, paint.roughness, 3e-3);
        EXPECT_NEAR(s.metallic, paint.metallic, 3e-3);
        EXPECT_LT(glm::distance(s.emission, paint.emission), 0.02);
        EXPECT_NEAR(s.depth, 6 - (quads[like].corner.z), 1e-3);
        emitting += paint.emission != Point(0);
        ++shown;
        depths.insert(std::round(10 * s.depth));
    }
    EXPECT_EQ(depths.size(), 2u);
    EXPECT_GT(shown, 1500u);
    EXPECT_EQ(emitting, shown);
    const std::uint32_t texels = 6 * (64 * 64 + 32 * 32 + 16 * 16 + 8 * 8);
    EXPECT_EQ(paper.records<std::uint32_t>("atlas.bytes"), (std::vector<std::uint32_t>{8 * texels, 0}));
    EXPECT_EQ(matched.records<std::uint32_t>("atlas.bytes"), (std::vector<std::uint32_t>{16 * texels, 0}));
}

// Thin bars, a third of a texel wide at the coarser levels: as many texels show them as at the finest, for their size, or more by those that are alike.
TEST_F(ImpostorAtlas, ThinThingsDontVanishInTheDistance) {
    std::vector<Quad> bars;
    for (int i = -3; i <= 3; ++i)
        for (const Quad& q : box(Point(0.3 * i - 0.03, -1, -0.03), Point(0.3 * i + 0.03, 1, 0.03), {})) bars.push_back(q);
    writeModel(folder.path, "bars", bars);
    const double radius = glm::length(Point(0.93, 1, 0.03));
    const Path file = scene("bars", lookAlong({0, 0, 6}, {0, 0, 0}, 2 * radius * 128 / 126));
    double finest = 0;
    for (const int level : {0, 1, 2, 3, 4}) {
        const std::uint32_t size = 128u >> level;  // pixels lie on texels
        Frames frames(file, {size, size}, graph({{"arrangement", "cross"}, {"resolution", 128}}, "impostor_billboard"), ports());
        frames.run();
        const double share = shownIn(frames).x / (size * size);
        std::printf("level %d: %.4f of the texels\n", level, share);
        if (level == 0) finest = share;
        EXPECT_GE(share, finest);
        EXPECT_LT(share, 2 * finest);
    }
    EXPECT_NEAR(finest, 7 * 0.06 * 2 / std::pow(2 * radius * 128 / 126, 2), 0.02);
}

// Ten thousand balls, of which each pixel shows the nearest: the one that rays find, but for silhouettes.
TEST_F(ImpostorAtlas, TheNearestOfManyIsShown) {
    writeSphere(folder.path / "balls.gltf", 16, 8);
    std::vector<glm::dmat4> placements;
    for (int z = 0; z < 100; ++z) {
        for (int x = 0; x < 100; ++x) {
            const Point at(x - 49.5, 0.3 * std::sin(1.0 * x) * std::cos(0.7 * z), -z);
            placements.push_back(glm::scale(glm::translate(glm::dmat4(1), at), Point(0.4 + 0.1 * ((x + z) % 2))));
        }
    }
    placeModel(folder.path / "balls.gltf", placements);
    const Path file = scene("balls", {{"position", {0, 6, 10}}, {"target", {0, 0, -12}}, {"fovy", 50}});
    for (const bool isGrid : {true, false}) {
        Frames frames(file, {240, 136},
                      isGrid ? graph({{"across", 12}, {"resolution", 64}}, "impostor_octahedral", {{"parallax", "relief"}})
                             : graph({{"arrangement", "cross"}, {"resolution", 64}}, "impostor_billboard"),
                      ports());
        frames.run();
        const std::vector<BakedSurface> first = frames.records<BakedSurface>("draw.surfaces");
        const std::vector<PrimaryHit> hits = frames.records<PrimaryHit>("hits.hits");
        const ImageData depth = frames.image("hits.depth");
        std::size_t both = 0, same = 0, geometry = 0, shown = 0;
        std::set<std::uint32_t> instances;
        double offDepth = 0;
        for (std::size_t i = 0; i < hits.size(); ++i) {
            geometry += hits[i].primitive != nothing;
            shown += first[i].instance != nothing;
            if (hits[i].primitive == nothing || first[i].instance == nothing) continue;
            ++both;
            if (hits[i].instance != first[i].instance) continue;
            ++same;
            instances.insert(first[i].instance);
            offDepth += std::abs(double(first[i].depth) - depth.values[i]);
        }
        std::printf("%s: %zu instances shown, %zu pixels of %zu, %zu of the same instance; depth off by %.1e in the mean\n", isGrid ? "octahedral" : "cards",
                    instances.size(), shown, geometry, same, offDepth / double(same));
        EXPECT_GT(instances.size(), 1500u);
        EXPECT_GT(double(same), (isGrid ? 0.9 : 0.7) * double(both));
        if (isGrid) {
            EXPECT_NEAR(double(shown), double(geometry), 0.03 * double(geometry));
            EXPECT_LT(offDepth / double(same), 0.05);
        }
        // The same frame again: the same bits, and nothing baked.
        const std::size_t baked = frames.rays("atlas")[RAYS_PRIMARY];
        EXPECT_EQ(baked, (isGrid ? 144u : 6u) * 64u * 64u * 4u);
        frames.run(2);
        EXPECT_EQ(frames.rays("atlas")[RAYS_PRIMARY], 0u);
        const std::vector<BakedSurface> again = frames.records<BakedSurface>("draw.surfaces");
        EXPECT_EQ(std::memcmp(first.data(), again.data(), first.size() * sizeof first[0]), 0);
    }
}

// From between views: a step of parallax brings what three of them show nearer to where it is, and relief nearer still.
TEST_F(ImpostorAtlas, ParallaxMovesThingsToWhereTheyAre) {
    writeModel(folder.path, "bench", bench());
    std::array<double, 3> apart{}, uncovered{}, shown{};
    for (int i = 0; i < 6; ++i) {
        const double height = 1 - (2 * i + 1) / 6.0, turn = 2.39996323 * i, side = std::sqrt(1 - height * height);
        const Point view(side * std::cos(turn), height, side * std::sin(turn)), middle(0, 0.1, 0);
        Frames frames(scene("bench", lookAlong(middle + 10.0 * view, middle, 2.8)), {96, 96},
                      graph({{"across", 8}, {"resolution", 128}}, "impostor_octahedral"), ports());
        for (const std::size_t kind : {0, 1, 2}) {
            frames.set("draw.parallax", Json(std::array{"off", "step", "relief"}[kind]));
            frames.run();
            const ImageData depth = frames.image("hits.depth");
            const std::vector<Seen> seen = seenIn(frames);
            for (std::size_t p = 0; p < seen.size(); ++p) {
                const bool isThere = depth.values[p] > 0, isShown = seen[p].instance != nothing;
                uncovered[kind] += isThere != isShown;
                if (!isThere || !isShown) continue;
                apart[kind] += std::abs(seen[p].depth - depth.values[p]);
                ++shown[kind];
            }
        }
    }
    for (std::size_t kind = 0; kind < 3; ++kind) {
        apart[kind] /= shown[kind];
        uncovered[kind] /= shown[kind];
        std::printf("%s: depths %.4f apart in the mean, %.4f of the pixels wrongly covered\n", std::array{"off", "step", "relief"}[kind], apart[kind],
                    uncovered[kind]);
    }
    EXPECT_LT(apart[1], 0.7 * apart[0]);
    EXPECT_LT(apart[2], 0.5 * apart[1]);
    EXPECT_LT(uncovered[1], 0.7 * uncovered[0]);
    EXPECT_LT(uncovered[2], 0.7 * uncovered[1]);
}

// Each pixel is asked along its own ray, wherever that crosses pixel and lens: the one of visibility.
TEST_F(ImpostorAtlas, RaysAreThoseOfVisibility) {
    writeSphere(folder.path / "ball.gltf", 96, 48);
    const Path file = scene("ball", {{"position", {0, 0, 12}}, {"target", {0, 0, 0}}, {"fovy", 18}, {"aperture", 1}, {"focus", 6}});
    Frames frames(file, {64, 64}, graph({{"across", 12}, {"resolution", 128}}, "impostor_octahedral", {{"parallax", "relief"}, {"steps", 64}}), ports());
    for (const char* pass : {"draw", "hits"}) {
        frames.set(pass + std::string(".film"), Json("random"));
        frames.set(pass + std::string(".lens"), Json(true));
    }
    std::vector<std::vector<bool>> drawn, traced;
    for (int frame = 0; frame < 2; ++frame) {
        frames.run();
        drawn.emplace_back();
        traced.emplace_back();
        for (const Seen& s : seenIn(frames)) drawn.back().push_back(s.instance != nothing);
        for (const PrimaryHit& h : frames.records<PrimaryHit>("hits.hits")) traced.back().push_back(h.primitive != nothing);
    }
    const auto differences = [&](const std::vector<bool>& a, const std::vector<bool>& b) {
        std::size_t count = 0;
        for (std::size_t i = 0; i < a.size(); ++i) count += a[i] != b[i];
        return count;
    };
    const std::size_t same = differences(drawn[0], traced[0]) + differences(drawn[1], traced[1]),
                      other = differences(drawn[0], traced[1]) + differences(drawn[1], traced[0]);
    std::printf("pixels that differ: %zu by the same rays, %zu by others\n", same, other);
    EXPECT_GT(other, 500u);
    EXPECT_LT(same, other / 20);
}

TEST_F(ImpostorAtlas, WhatDoesNotFitIsSaid) {
    writeModel(folder.path, "cube", colouredCube());
    const Path file = scene("cube", lookAlong({7, 0, 0}, {0, 0, 0}, 4));
    const std::string grid = "impostor_octahedral", cards = "impostor_billboard";
    const auto message = [&](const OrderedJson& atlas, const std::string& draw, const OrderedJson& set = OrderedJson::object()) {
        try {
            Frames frames(file, {16, 16}, graph(atlas, draw, set), ports());
            frames.run();
        } catch (const std::exception& e) {
            return std::string(e.what());
        }
        return std::string();
    };
    EXPECT_NE(message({{"resolution", 100}}, grid).find("no power of 2; set \"resolution\" to 64"), std::string::npos);
    EXPECT_NE(message({{"resolution", 1024}, {"across", 64}}, grid).find("lower \"across\" or \"resolution\""), std::string::npos);
    EXPECT_NE(message({{"resolution", 16}, {"mesh", "cup"}}, grid).find("no instance shows a mesh \"cup\" for an impostor_atlas"), std::string::npos);
    EXPECT_NE(message({{"resolution", 16}, {"arrangement", "star"}}, grid).find("to full or hemi"), std::string::npos);
    EXPECT_NE(message({{"resolution", 16}}, cards).find("to cross or star"), std::string::npos);
    EXPECT_NE(message({{"resolution", 16}, {"attributes", "paper"}}, grid).find("set its \"parallax\" to off"), std::string::npos);
    EXPECT_EQ(message({{"resolution", 16}, {"attributes", "paper"}}, grid, {{"parallax", "off"}}), "");
}

}  // namespace
}  // namespace lodestir::test
