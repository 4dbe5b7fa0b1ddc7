// SPDX-License-Identifier: MIT
// Impostors hold what was there: shapes whose every texel is known, and pyramids that can be counted by hand.
#include "body.h"
#include "../environment_variable.h"
#include "frames.h"
#include "program.h"

#include <framework/image/png.h>

#include <passes/impostor/impostor_view/shown_texel.h>

#include <functional>
#include <numbers>
#include <numeric>

namespace lodestir::test {
namespace {

constexpr std::uint32_t backSeen = 2;  // TEXEL_BACK

/// What the views of a set look at an object from and how their windows lie, found anew from the sentences that define them.
struct Window {
    glm::dvec3 x, y, d, center;
    double radius, side;  ///< side of a texel
    std::size_t resolution;

    glm::dvec3 pointAt(double column, double row, double depth) const {
        const double half = 0.5 * double(resolution);
        return center + (column - half) * side * x + (row - half) * side * y + radius * (1 - 2 * depth) * d;
    }
};

std::vector<glm::dvec3> directions(int views) {
    std::vector<glm::dvec3> all;
    const double ratio = views == 12 ? std::numbers::phi : 1;
    const auto axisFirst = [](int axis, const glm::dvec3& v) { return axis == 0 ? glm::dvec3(v.z, v.x, v.y) : axis == 1 ? glm::dvec3(v.y, v.z, v.x) : v; };
    for (int i = 0; views != 12 && i < 6; ++i) all.push_back(axisFirst(i / 2, {0, 0, i % 2 == 0 ? 1 : -1}));
    for (int i = 0; views != 6 && i < 12; ++i) all.push_back(glm::normalize(axisFirst(i / 4, {0, i % 2 == 0 ? 1 : -1, i / 2 % 2 == 0 ? ratio : -ratio})));
    return all;
}

Window windowOf(int views, int view, const glm::dvec3& center, double radius, int resolution) {
    Window w{.d = directions(views)[std::size_t(view)],
             .center = center,
             .radius = radius,
             .side = 2 * radius / (resolution - 2),
             .resolution = std::size_t(resolution)};
    w.x = glm::normalize(glm::cross(std::abs(w.d.y) > 0.99 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0), w.d));
    w.y = glm::cross(w.d, w.x);
    return w;
}

OrderedJson bakeAndView(const OrderedJson& bake) {
    return {{"bake", {{"type", "impostor_bake"}, {"set", bake}}}, {"view", {{"type", "impostor_view"}, {"in", {{"impostors", "bake"}}}}}};
}

/// Bakes anew at 64 texels, unless `set` says otherwise, and reads back texel by texel.
class Baked {
public:
    Baked(const Path& scene, int views, OrderedJson set = OrderedJson::object())
        : views_(views), frames_(scene, {64, 64}, graph(views, std::move(set)), {"view.texels", "bake.bytes", "bake.coverage", "bake.merged"}) {}

    /// Rows from the bottom.
    std::vector<ShownTexel> texels(int view, int level = 0) {
        frames_.set("view.view", Json(view));
        frames_.set("view.level", Json(level));
        frames_.run();
        const std::vector<ShownTexel> pixels = frames_.records<ShownTexel>("view.texels");
        const int n = 64 >> level, width = 64 / n;
        std::vector<ShownTexel> texels;
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) texels.push_back(pixels[std::size_t((63 - y * width) * 64 + x * width)]);
        for (const ShownTexel& t : texels) EXPECT_EQ(t.view, std::uint32_t(view));
        return texels;
    }
    /// Points tried and points seen.
    glm::dvec2 coverage() {
        frames_.run();
        const auto words = frames_.records<std::uint32_t>("bake.coverage");
        return {words.at(0), words.at(1)};
    }
    double share() { return coverage().y / coverage().x; }
    Frames& frames() { return frames_; }
    int views() const { return views_; }

private:
    static OrderedJson graph(int views, OrderedJson set) {
        set["views"] = views;
        set["resolution"] = 64;
        if (!set.contains("cache")) set["cache"] = false;
        return bakeAndView(set);
    }
    int views_;
    Frames frames_;
};

/// Rays of the last frame that looked at meshes: none where nothing was baked.
std::uint64_t raysOf(const Frames& frames) { return frames.rays("bake")[RAYS_PRIMARY]; }

/// Impostors in a cache folder.
std::vector<Path> keptFiles(const Path& cache) {
    std::vector<Path> files;
    std::error_code absent;
    for (const auto& entry : std::filesystem::directory_iterator(cache / "impostor_bake", absent)) files.push_back(entry.path());
    return files;
}

/// Of the records of tiles: 16 for each 8x8 texels of each level, the coarsest's 4x4 being one.
std::uint64_t tileBytes(std::uint64_t resolution, std::uint64_t views) {
    std::uint64_t tiles = 1;
    for (std::uint64_t n = resolution / 8; n > 0; n /= 2) tiles += n * n;
    return 16 * views * tiles;
}

class ImpostorBake : public testing::Test {
protected:
    TemporaryFolder folder;
};

// Four rays a texel meet a sphere where geometry says, and are reduced by hand.
TEST_F(ImpostorBake, SphereIsWhereItIs) {
    Body body(1);
    body.sphere(1.5);
    const Path model = body.write(folder.path, "ball", {glm::vec3(40, -7, 3)});
    const double sagitta = 1.5 * (1 - std::cos(std::numbers::pi / 96)) * 1.01;
    for (const int views : {6, 12, 18}) {
        Baked baked(model, views);
        std::size_t compared = 0, empty = 0, partial = 0;
        double worstNormal = 0, worstDepth = 0;
        for (int view = 0; view < views; ++view) {
            const Window w = windowOf(views, view, glm::dvec3(0), 1.5, 64);
            const std::vector<ShownTexel> texels = baked.texels(view);
            for (int y = 0; y < 64; ++y) {
                for (int x = 0; x < 64; ++x) {
                    const ShownTexel& t = texels[std::size_t(y * 64 + x)];
                    int hits = 0;
                    bool unclear = false;
                    double nearest = 1;
                    std::vector<std::pair<double, glm::dvec3>> samples;
                    for (int i = 0; i < 4; ++i) {
                        const glm::dvec3 p = w.pointAt(x + 0.25 + 0.5 * (i & 1), y + 0.25 + 0.5 * (i >> 1), 0.5);
                        const double squared = glm::dot(p, p), height = std::sqrt(std::max(0.0, 1.5 * 1.5 - squared));
                        unclear |= std::abs(std::sqrt(squared) - 1.5) < 2 * sagitta;
                        if (squared >= 1.5 * 1.5) continue;
                        ++hits;
                        samples.push_back({0.5 - 0.5 * height / 1.5, glm::normalize(p + height * w.d)});
                        nearest = std::min(nearest, samples.back().first);
                    }
                    if (unclear) continue;
                    ASSERT_EQ(t.alpha, float(hits) / 4) << views << " " << view << " " << x << " " << y;
                    empty += hits == 0;
                    partial += hits > 0 && hits < 4;
                    if (hits == 0) continue;
                    ASSERT_LT(std::abs(glm::length(glm::dvec3(t.position)) - 1.5), 0.5 * w.side + sagitta);
                    glm::dvec3 normal(0);
                    double kept = 0;
                    for (const auto& [depth, n] : samples) {
                        unclear |= std::abs(depth - nearest - 4.0 / 128) < 1e-3;
                        if (depth - nearest > 4.0 / 128) continue;
                        normal += n;
                        ++kept;
                    }
                    if (unclear) continue;
                    normal /= kept;
                    // Smooth normals of a faceted sphere; at the rim its height moves by more than the sagitta.
                    const double slope = std::max(0.1, glm::dot(glm::normalize(normal), w.d));
                    worstNormal = std::max(worstNormal, glm::distance(glm::dvec3(t.normal), normal) * slope);
                    worstDepth = std::max(worstDepth, std::abs(t.depth - nearest) * slope);
                    ++compared;
                }
            }
        }
        std::printf("%d views: %zu texels, %zu partly covered, %zu empty; normals off by %.1e at most, depths by %.1e, both over the slope\n", views, compared,
                    partial, empty, worstNormal, worstDepth);
        EXPECT_GT(compared, std::size_t(views) * 2000);
        EXPECT_GT(partial, std::size_t(views) * 40);
        EXPECT_GT(empty, std::size_t(views) * 500);
        EXPECT_LT(worstNormal, 1e-3);
        EXPECT_LT(worstDepth, 1e-3);
    }
}

// Alpha of a level is the mean of the finest one's, to the last bit.
TEST_F(ImpostorBake, AlphaAveragesExactly) {
    Body body(1);
    body.sphere(1);
    Baked baked(body.write(folder.path, "ball"), 12);
    const std::vector<ShownTexel> finest = baked.texels(7);
    double sum = 0;
    for (const ShownTexel& t : finest) sum += t.alpha;
    EXPECT_NEAR(sum / (64 * 64), std::numbers::pi / 4 * std::pow(62.0 / 64, 2), 2e-3);
    for (int level = 1; level <= 3; ++level) {
        const std::vector<ShownTexel> texels = baked.texels(7, level);
        const std::size_t n = std::size_t(64 >> level), width = std::size_t(1) << level;
        for (std::size_t y = 0; y < n; ++y) {
            for (std::size_t x = 0; x < n; ++x) {
                double mean = 0;
                for (std::size_t j = 0; j < width; ++j)
                    for (std::size_t i = 0; i < width; ++i) mean += finest[(y * width + j) * 64 + x * width + i].alpha;
                ASSERT_EQ(texels[y * n + x].alpha, float(mean / double(width * width))) << level << " " << x << " " << y;
            }
        }
    }
}

/// A square of cells of 2 x 2 texels of the view from +Z, from texel 16 to 48: three materials in turn, normals that lean left and right by turns of
/// columns, texture coordinates that run with x and y. Two slivers, between the rays, make the sphere's radius 1.
struct Checker {
    static constexpr double lean = 0.5, uvScale = 0.6;
    static constexpr int materials = 3;
    Window window = windowOf(6, 4, glm::dvec3(0), 1, 64);

    static std::size_t materialOf(int i, int j) { return std::size_t((i + 2 * j) % materials); }
    static glm::dvec3 normalOf(int i) { return {i % 2 == 0 ? std::sin(lean) : -std::sin(lean), 0, std::cos(lean)}; }
    static glm::dvec2 uvOf(const glm::dvec3& p) { return uvScale * glm::dvec2(p) + glm::dvec2(3.3, 0.1); }

    Body body() const {
        Body body(materials);
        for (int j = 0; j < 16; ++j) {
            for (int i = 0; i < 16; ++i) {
                const auto corner = [&](int x, int y) {
                    const glm::dvec3 p = window.pointAt(16 + 2 * (i + x), 16 + 2 * (j + y), 0.5);
                    return Corner{p, normalOf(i), uvOf(p)};
                };
                body.quad(materialOf(i, j), corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1));
            }
        }
        for (const double end : {-1.0, 1.0}) {
            const auto corner = [&](double x, double y) { return Corner{{x, y, 0}, {0, 0, 1}, {0, 0}}; };
            body.triangle(0, corner(end, 0), corner(0.999 * end, 1e-4), corner(0.999 * end, -1e-4));
        }
        return body;
    }
};

TEST_F(ImpostorBake, PyramidOfACheckerIsCounted) {
    const Checker checker;
    Body body = checker.body();
    Baked baked(body.write(folder.path, "checker"), 6);
    // The palette has the largest first; slivers make material 0 larger than it would be. Its places are found by looking at level 1.
    const auto seenAt = [](const std::vector<ShownTexel>& texels, int n, int x, int y) { return texels[std::size_t(y * n + x)]; };
    const auto finest = baked.texels(4), first = baked.texels(4, 1);
    std::array<std::uint32_t, 3> place{};
    for (int j = 0; j < 16; ++j) {
        for (int i = 0; i < 16; ++i) {
            for (int k = 0; k < 4; ++k) {
                const ShownTexel t = seenAt(finest, 64, 16 + 2 * i + (k & 1), 16 + 2 * j + (k >> 1));
                ASSERT_EQ(t.alpha, 1);
                ASSERT_EQ(t.material, Checker::materialOf(i, j));
                ASSERT_LT(glm::distance(glm::dvec3(t.normal), Checker::normalOf(i)), 1e-4);
                ASSERT_NEAR(t.depth, 0.5, 1e-6);
                const glm::dvec2 uv = glm::fract(Checker::uvOf(t.position));
                ASSERT_LT(glm::distance(glm::dvec2(t.uv), uv), 2e-5);
                ASSERT_NEAR(t.density, std::log2(Checker::uvScale * checker.window.side), 0.13);  // two roundings to 1/8: none is below a half of it
            }
            const ShownTexel t = seenAt(first, 32, 8 + i, 8 + j);
            std::uint32_t p = 0;
            while (p < 8 && (t.counts >> (4 * p) & 15) != 15) ++p;
            ASSERT_LT(p, 3u) << std::hex << t.counts;
            if (i < 3 && j == 0) place[Checker::materialOf(i, j)] = p;
            ASSERT_EQ(t.counts, 15u << (4 * place[Checker::materialOf(i, j)]));
            ASSERT_LT(glm::distance(glm::dvec3(t.normal), Checker::normalOf(i)), 1e-4);
            ASSERT_LT(glm::distance(glm::dvec2(t.uv), glm::fract(Checker::uvOf(t.position))), 2e-5);
            ASSERT_NEAR(t.density, std::log2(Checker::uvScale * checker.window.side) + 1, 0.2);
        }
    }
    EXPECT_EQ(place[0] + place[1] + place[2], 3u);
    EXPECT_NE(place[0], place[1]);

    // Each texel of level 2 has four cells, of which two are of one material: 1/4, 1/2 and 1/4, which round to 4, 7 and 4.
    const auto second = baked.texels(4, 2);
    for (int j = 0; j < 8; ++j) {
        for (int i = 0; i < 8; ++i) {
            std::array<int, 3> cells{};
            for (int k = 0; k < 4; ++k) ++cells[Checker::materialOf(2 * i + (k & 1), 2 * j + (k >> 1))];
            std::uint32_t expected = 0;
            for (std::size_t m = 0; m < 3; ++m) expected |= std::uint32_t(cells[m] == 2 ? 7 : cells[m] == 1 ? 4 : 0) << (4 * place[m]);
            const ShownTexel t = seenAt(second, 16, 4 + i, 4 + j);
            ASSERT_EQ(t.counts, expected);
            // Half of the normals lean left, half right.
            ASSERT_LT(glm::distance(glm::dvec3(t.normal), glm::dvec3(0, 0, std::cos(Checker::lean))), 1e-4);
        }
    }
    // Above, shares are right to what was rounded: at most half a 15th of each child, and of the texel itself.
    for (const int level : {3, 4}) {
        const int n = 64 >> level, cells = 1 << (level - 1);
        const auto texels = baked.texels(4, level);
        for (int j = 0; j < n / 2; ++j) {
            for (int i = 0; i < n / 2; ++i) {
                std::array<double, 3> share{};
                for (int y = 0; y < cells; ++y)
                    for (int x = 0; x < cells; ++x) share[Checker::materialOf(i * cells + x, j * cells + y)] += 15.0 / (cells * cells);
                const ShownTexel t = seenAt(texels, n, n / 4 + i, n / 4 + j);
                std::uint32_t sum = 0;
                for (std::uint32_t p = 0; p < 8; ++p) sum += t.counts >> (4 * p) & 15;
                ASSERT_EQ(sum, 15u);
                for (std::size_t m = 0; m < 3; ++m) ASSERT_NEAR(t.counts >> (4 * place[m]) & 15, share[m], 1.5);
                ASSERT_NEAR(glm::length(t.normal), std::cos(Checker::lean), 1e-4);
                ASSERT_EQ(t.alpha, 1);
            }
        }
    }
    // From behind, the same square turned: normals face the camera, and the flag tells.
    std::size_t seen = 0;
    for (const ShownTexel& t : baked.texels(5)) {
        if (t.alpha == 0) continue;
        ASSERT_TRUE(t.flags & backSeen);
        ASSERT_NEAR(t.normal.z, -std::cos(Checker::lean), 1e-4);
        ++seen;
    }
    EXPECT_EQ(seen, 32u * 32);
    for (const ShownTexel& t : finest) ASSERT_FALSE(t.flags & backSeen);
    EXPECT_EQ(baked.frames().records<std::uint32_t>("bake.merged").at(0), 0u);
    const std::uint64_t texels = 6 * (64 * 64 + 32 * 32 + 16 * 16 + 8 * 8 + 4 * 4);
    EXPECT_EQ(baked.frames().records<std::uint32_t>("bake.bytes"), (std::vector<std::uint32_t>{std::uint32_t(24 * texels + tileBytes(64, 6)), 0}));
}

TEST_F(ImpostorBake, MoreMaterialsThanThePaletteHasAreMerged) {
    // Ten stripes, the later the narrower; the last two are coloured like the first and the third.
    Body body(10);
    double x = -1;
    for (std::size_t m = 0; m < 10; ++m) {
        const double width = 0.3 - 0.02 * double(m), red = m == 8 ? 0.01 : m == 9 ? 0.21 : 0.1 * double(m);
        addSquare(body, m, {x, -1}, {x + width, 1}, 0);
        body.material(m)["pbrMetallicRoughness"] = {{"baseColorFactor", {red, 0.5, 0.5, 1}}};
        x += width;
    }
    Baked baked(body.write(folder.path, "stripes"), 6);
    const auto finest = baked.texels(4), coarse = baked.texels(4, 1);
    EXPECT_EQ(baked.frames().records<std::uint32_t>("bake.merged").at(0), 2u);
    std::set<std::uint32_t> ids;
    std::array<std::set<std::uint32_t>, 10> places;
    for (std::size_t i = 0; i < finest.size(); ++i) {
        const ShownTexel& t = finest[i];
        if (t.alpha == 0) continue;
        ids.insert(t.material);
        std::uint32_t p = 0;
        while ((t.counts >> (4 * p) & 15) == 0) ++p;
        places.at(t.material).insert(p);
    }
    EXPECT_EQ(ids.size(), 10u);  // the finest level knows them all
    for (std::uint32_t m = 0; m < 8; ++m) EXPECT_EQ(places[m], std::set<std::uint32_t>{m}) << m;
    EXPECT_EQ(places[8], std::set<std::uint32_t>{0});
    EXPECT_EQ(places[9], std::set<std::uint32_t>{2});
    for (const ShownTexel& t : coarse) EXPECT_EQ(t.counts == 0, t.alpha == 0);
}

TEST_F(ImpostorBake, MasksLetRaysThroughAndNormalMapsCount) {
    // In front a square that its mask takes away whole, behind it one whose map leans all normals towards +x.
    Body body(2);
    addSquare(body, 0, {-0.5, -0.5}, {0.5, 0.5}, 0.5);
    addSquare(body, 1, {-0.5, -0.5}, {0.5, 0.5}, -0.5);
    body.material(0).update({{"alphaMode", "MASK"}, {"alphaCutoff", 0.5}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0.4}}}}});
    body.material(1)["normalTexture"] = {{"index", 0}};
    const std::array<double, 3> stored{204, 128, 230};  // of 255: 0.6, 0.004 and 0.804
    ImageData map{.width = 2, .height = 2, .channels = 3, .values = std::vector<float>(12)};
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 2; ++x)
            for (int c = 0; c < 3; ++c) map.at(x, y, c) = float(std::pow((stored[std::size_t(c)] / 255 + 0.055) / 1.055, 2.4));
    writePng(folder.path / "lean.png", map);
    body.model.json["images"] = {{{"uri", "lean.png"}}};
    body.model.json["textures"] = {{{"source", 0}}};
    Baked baked(body.write(folder.path, "pane"), 6);
    glm::dvec3 expected(2 * stored[0] / 255 - 1, 2 * stored[1] / 255 - 1, 2 * stored[2] / 255 - 1);
    expected.y = 0;  // v runs down in textures: which way is not this test's question
    std::size_t seen = 0;
    for (const ShownTexel& t : baked.texels(4)) {
        if (t.alpha == 0) continue;
        ASSERT_EQ(t.material, 1u);
        ASSERT_NEAR(t.position.z, -0.5, 1e-5);
        ASSERT_LT(glm::distance(glm::normalize(expected), glm::dvec3(t.normal)), 6e-3);
        ASSERT_TRUE(t.flags & 4u);  // TEXEL_BUMPED: the map leans by 37 degrees
        ++seen;
    }
    EXPECT_GT(seen, 300u);
}

TEST_F(ImpostorBake, EachMeshOnceAndAgainOnlyWhenAsked) {
    Body one(1), three(1);
    for (Body* body : {&one, &three}) body->torus(1, 0.4, {0, 1, 0});
    // Three of one mesh, two of them in one another.
    Baked alone(one.write(folder.path, "one"), 6), placed(three.write(folder.path, "three", {{0, 0, 0}, {0.3f, 0, 0}, {5, 5, 5}}), 6);
    const std::uint64_t once = 6 * 64 * 64 * 4;
    for (int view = 0; view < 6; ++view) {
        const auto a = alone.texels(view), b = placed.texels(view);
        EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]), 0) << view;
        // Looking at another view bakes nothing.
        EXPECT_EQ(raysOf(alone.frames()), view == 0 ? once : 0);
        EXPECT_EQ(raysOf(placed.frames()), view == 0 ? once : 0);
    }
    Frames& frames = placed.frames();
    frames.set("bake.views", Json(12));
    frames.run();
    EXPECT_EQ(raysOf(frames), 2 * once);
    frames.run(3);
    EXPECT_EQ(raysOf(frames), 0u);
    frames.set("bake.resolution", Json(128));
    frames.run();
    EXPECT_EQ(raysOf(frames), 8 * once);
}

TEST_F(ImpostorBake, CoverageIsWhatViewsSee) {
    Body ball(1), nested(1), rings(1), upright(1);
    ball.sphere(1);
    nested.sphere(1);
    nested.sphere(0.6);
    upright.torus(1, 0.85, {0, 1, 0});  // two of the axes look through its hole
    // Narrow ones that look everywhere, far from each other.
    for (int i = 0; i < 48; ++i) {
        const double z = 1 - (2 * i + 1) / 96.0, turn = 2.39996323 * i;
        rings.torus(1, 0.97, {std::sqrt(1 - z * z) * std::cos(turn), std::sqrt(1 - z * z) * std::sin(turn), z}, 6.0 * i * glm::dvec3(0.2, 0.5, 1));
    }
    const Path ballFile = ball.write(folder.path, "ball"), nestedFile = nested.write(folder.path, "nested"), ringsFile = rings.write(folder.path, "rings"),
               uprightFile = upright.write(folder.path, "upright");
    const OrderedJson points = {{"points", 4096}};
    double fewer = 0;
    for (const int views : {6, 12, 18}) {
        Baked convex(ballFile, views, points);
        EXPECT_EQ(convex.coverage(), glm::dvec2(4096, 4096)) << views;
        // Of the inner shell nothing is seen.
        Baked shell(nestedFile, views, points);
        const double outer = 1 / (1 + 0.36);
        EXPECT_NEAR(shell.share(), outer, 4 * std::sqrt(outer * (1 - outer) / 4096)) << views;
        Baked narrow(ringsFile, views, {{"points", 1 << 15}});
        std::printf("rings, %d views: %.4f seen\n", views, narrow.share());
        EXPECT_GT(narrow.share(), fewer);
        EXPECT_LT(narrow.share(), 1);
        fewer = narrow.share();
        if (views == 12) continue;
        Baked through(uprightFile, views, points);
        EXPECT_EQ(through.share(), 1);
    }
    EXPECT_GT(fewer, 0.8);
}

/// Squares of side 2 around the origin that stand still, and one that its target moves from z = 0 to z = 1 in the first second.
Path writeWaving(const Path& folder) {
    GltfModel model;
    const std::vector<float> corners{-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, -1, 0, 1, 1, 0, -1, 1, 0};
    nlohmann::json still = {{"attributes", {{"POSITION", model.positions(corners)}}}}, waving = still;
    waving["targets"] = {{{"POSITION", model.positions({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1})}}};
    model.addMesh(waving);
    model.addMesh(still);
    model.json["meshes"][0]["name"] = "waving";
    model.json["meshes"][1]["name"] = "still";
    const int times = model.accessor(std::vector<float>{0, 1}, 5126, "SCALAR", 1), weights = model.accessor(std::vector<float>{0, 1}, 5126, "SCALAR", 1);
    model.json["accessors"][std::size_t(times)].update({{"min", {0}}, {"max", {1}}});
    model.json["animations"] = {
        {{"samplers", {{{"input", times}, {"output", weights}}}}, {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}}};
    return model.write(folder / "waving.gltf");
}

void expectHeight(const std::vector<ShownTexel>& texels, double z) {
    std::size_t seen = 0;
    for (const ShownTexel& t : texels) {
        if (t.alpha == 0) continue;
        ++seen;
        ASSERT_NEAR(t.position.z, z, 3e-5);  // half a step of 16 bits over the diameter
    }
    EXPECT_GT(seen, 1500u);
}

// A mesh that deforms is baked as frame 0 has it, and the frame in which that happens shows what it would have shown.
TEST_F(ImpostorBake, DeformingMeshesAreBakedAtRest) {
    const Path file = writeWaving(folder.path);
    OrderedJson passes = bakeAndView({{"resolution", 64}, {"views", 6}, {"cache", false}});
    passes["view"]["set"] = {{"view", 4}, {"mesh", "waving"}};
    passes["hits"] = {{"type", "visibility"}};
    Frames baking(file, {64, 64}, passes, {"view.texels", "hits.depth"}), plain(file, {64, 64}, {{"hits", passes["hits"]}}, {"hits.depth"});
    for (Frames* frames : {&baking, &plain}) frames->restart(15);
    for (int frame = 0; frame < 2; ++frame) {
        baking.run();
        plain.run();
        EXPECT_EQ(baking.image("hits.depth").values, plain.image("hits.depth").values) << frame;
    }
    expectHeight(baking.records<ShownTexel>("view.texels"), 0);
}

// With the scene wired, what deforms is baked anew in each new pose, and nothing else is.
TEST_F(ImpostorBake, DeformingMeshesFollowTheSceneThatIsWired) {
    OrderedJson passes = bakeAndView({{"resolution", 64}, {"views", 6}, {"compression", "bc"}});
    passes["scene"] = {{"type", "scene"}};
    passes["bake"]["in"] = {{"pose", "scene.world"}};
    passes["view"]["set"] = {{"view", 4}, {"mesh", "waving"}};
    const std::uint64_t once = 6 * 64 * 64 * 4;
    const EnvironmentVariable cache("LODESTIR_CACHE", (folder.path / "cache").c_str());
    Frames frames(writeWaving(folder.path), {64, 64}, passes, {"view.texels"});
    frames.restart(6);
    for (int frame = 6; frame < 9; ++frame) {
        frames.run();
        EXPECT_EQ(raysOf(frames), frame == 6 ? 2 * once : once) << frame;
        expectHeight(frames.records<ShownTexel>("view.texels"), frame / 30.0);
    }
    frames.set("scene.animate", Json(false));
    frames.set("scene.pose", Json(8));
    frames.run(2);
    EXPECT_EQ(raysOf(frames), 0u);
    frames.set("scene.pose", Json(15));
    frames.run();
    EXPECT_EQ(raysOf(frames), once);
    expectHeight(frames.records<ShownTexel>("view.texels"), 0.5);
    frames.set("view.mesh", Json("still"));
    frames.run();
    expectHeight(frames.records<ShownTexel>("view.texels"), 0);
    // Of the poses no files are left, of the mesh that stands still one.
    EXPECT_EQ(keptFiles(folder.path / "cache").size(), 1u);
}

// What may be lossy is off by little, all else by nothing.
TEST_F(ImpostorBake, CompressionKeepsWhatItMust) {
    Body ball(1);
    ball.sphere(1);
    const Checker checker;
    Body checkered = checker.body();
    for (const Path& model : {ball.write(folder.path, "ball"), checkered.write(folder.path, "checker")}) {
        const bool smooth = model.stem() == "ball";
        const glm::uvec2 size(smooth ? 256 : 64);
        const auto open = [&](const char* compression) {
            return std::make_unique<Frames>(
                model, size, bakeAndView({{"resolution", size.x}, {"views", 6}, {"compression", compression}, {"cache", false}}),
                std::vector<std::string>{"view.texels", "bake.bytes", "bake.rawBytes"});
        };
        const auto raw = open("none"), compressed = open("bc");
        std::vector<double> angles;
        double worstAlpha = 0, worstSpread = 0, worstDensity = 0, worstDepth = 0;
        for (int level = 0; level < (smooth ? 4 : 3); ++level) {
            for (const int view : {0, 3, 4}) {
                for (Frames* frames : {raw.get(), compressed.get()}) {
                    frames->set("view.view", Json(view));
                    frames->set("view.level", Json(level));
                    frames->run();
                }
                const auto was = raw->records<ShownTexel>("view.texels"), is = compressed->records<ShownTexel>("view.texels");
                for (std::size_t i = 0; i < was.size(); ++i) {
                    const ShownTexel &a = was[i], &b = is[i];
                    ASSERT_EQ(a.alpha >= 1 / 255.0f, b.alpha >= 1 / 255.0f);
                    worstAlpha = std::max(worstAlpha, double(std::abs(a.alpha - b.alpha)));
                    if (b.alpha == 0) {
                        ASSERT_EQ(b.depth, 1);
                        continue;
                    }
                    ASSERT_EQ(a.uv, b.uv);
                    ASSERT_EQ(a.material, b.material);
                    ASSERT_EQ(a.counts, b.counts);
                    ASSERT_EQ(a.flags, b.flags);
                    worstDepth = std::max(worstDepth, double(std::abs(a.depth - b.depth)));
                    worstDensity = std::max(worstDensity, double(std::abs(a.density - b.density)));
                    const double lengthA = glm::length(glm::dvec3(a.normal)), lengthB = glm::length(glm::dvec3(b.normal));
                    worstSpread = std::max(worstSpread, std::abs(std::sqrt(std::max(0.0, 1 - lengthA)) - std::sqrt(std::max(0.0, 1 - lengthB))));
                    const double cosine = glm::dot(glm::dvec3(a.normal), glm::dvec3(b.normal)) / (lengthA * lengthB);
                    if (level == 0) angles.push_back(glm::degrees(std::acos(std::min(1.0, cosine))));
                }
            }
        }
        std::ranges::sort(angles);
        const double mean = std::accumulate(angles.begin(), angles.end(), 0.0) / double(angles.size()), p99 = angles[angles.size() * 99 / 100];
        std::printf("%s: normals off by %.3f degrees in the mean, 99 %%: %.3f, at most %.3f; alpha %.4f, spread %.4f, density %.3f, depth %.1e at most\n",
                    model.stem().c_str(), mean, p99, angles.back(), worstAlpha, worstSpread, worstDensity, worstDepth);
        EXPECT_LT(mean, smooth ? 0.25 : 0.5);  // of two directions in a block each is as near as 8 bits are
        EXPECT_LT(p99, 1);
        EXPECT_LE(worstDepth, 0.5 / 65535 + 1e-7);
        EXPECT_LE(worstDensity, smooth ? 1 : 0);
        EXPECT_LE(worstAlpha, 0.1);
        EXPECT_LE(worstSpread, 0.1);
        std::uint64_t finest = 6 * size.x * size.x, all = 0;
        for (std::uint32_t n = size.x; n >= 4; n /= 2) all += 6 * n * n;
        EXPECT_EQ(compressed->records<std::uint32_t>("bake.bytes").at(0), 13 * all - 2 * finest + tileBytes(size.x, 6));
        EXPECT_EQ(compressed->records<std::uint32_t>("bake.rawBytes").at(0), 24 * all + tileBytes(size.x, 6));
        EXPECT_EQ(raw->records<std::uint32_t>("bake.bytes").at(0), 24 * all + tileBytes(size.x, 6));
    }
}

// What was baked once is found again, wherever the mesh stands and whatever colours it has, and by nothing else.
TEST_F(ImpostorBake, SecondRunFindsWhatTheFirstBaked) {
    const EnvironmentVariable cache("LODESTIR_CACHE", (folder.path / "cache").c_str());
    const auto kept = [&] { return keptFiles(folder.path / "cache"); };
    const std::uint64_t once = 6 * 64 * 64 * 4;
    const auto body = [](double tube) {
        Body made(3);
        made.torus(1, tube, {0, 1, 0});
        addSquare(made, 2, {-0.3, -0.3}, {0.3, 0.3}, 0);
        return made;
    };
    const auto bake = [&](Body made, const std::string& name, OrderedJson set, std::uint64_t rays) {
        set["cache"] = true;
        Baked baked(made.write(folder.path, name), 6, set);
        auto texels = baked.texels(1, 0);
        EXPECT_EQ(raysOf(baked.frames()), rays) << name << " " << set;
        for (int level = 0; level < 3; ++level) {
            const auto more = baked.texels(4, level);
            texels.insert(texels.end(), more.begin(), more.end());
        }
        EXPECT_EQ(baked.coverage().x, 1024);
        return texels;
    };
    const auto same = [](const std::vector<ShownTexel>& a, const std::vector<ShownTexel>& b) {
        return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
    };
    const OrderedJson bc = {{"compression", "bc"}};
    const auto raw = bake(body(0.4), "ring", {}, once), compressed = bake(body(0.4), "ring", bc, once);
    ASSERT_EQ(kept().size(), 2u);
    EXPECT_TRUE(same(raw, bake(body(0.4), "ring", {}, 0)));
    EXPECT_TRUE(same(compressed, bake(body(0.4), "ring", bc, 0)));
    EXPECT_FALSE(same(raw, compressed));

    // Another name, another colour, another number of its materials in the scene.
    Body other = body(0.4);
    other.material(0)["pbrMetallicRoughness"] = {{"baseColorFactor", {1, 0, 0, 1}}, {"roughnessFactor", 0.3}};
    EXPECT_TRUE(same(raw, bake(other, "painted", {}, 0)));
    body(0.7).write(folder.path, "before");
    const OrderedJson models = {{"before", {{"file", "before.gltf"}}}, {"ring", {{"file", "ring.gltf"}}}};
    writeFile(folder.path / "two.json", OrderedJson{{"format", 1}, {"models", models}}.dump());
    Baked renumbered(folder.path / "two.json", 6, {{"mesh", "ring"}, {"cache", true}});
    std::vector<ShownTexel> found = renumbered.texels(1);
    EXPECT_EQ(raysOf(renumbered.frames()), 0u);
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (found[i].alpha == 0) continue;
        EXPECT_GT(found[i].material, raw[i].material);
        found[i].material = raw[i].material;
    }
    EXPECT_TRUE(same({raw.begin(), raw.begin() + 64 * 64}, found));

    // Another shape, another side that is seen, another resolution of the same.
    bake(body(0.41), "thicker", {}, once);
    Body open = body(0.4);
    open.material(2)["doubleSided"] = true;
    bake(open, "open", {}, once);
    ASSERT_EQ(kept().size(), 4u);

    // Files that are cut off, or hold one wrong bit, or nothing: baked anew, and right again for the next.
    for (const int damage : {0, 1, 2}) {
        for (const Path& file : kept()) {
            std::vector<std::byte> bytes = readBytes(file);
            if (damage == 0) bytes.resize(bytes.size() / 2);
            if (damage == 1) bytes[bytes.size() / 3] ^= std::byte(4);
            if (damage == 2) bytes.clear();
            writeFile(file, bytes);
        }
        EXPECT_TRUE(same(raw, bake(body(0.4), "ring", {}, once))) << damage;
        EXPECT_TRUE(same(raw, bake(body(0.4), "ring", {}, 0))) << damage;
    }
}

class ImpostorBodies : public ProgramTest {};

// Bodies that trace rays find the same texels, but where edges decide.
TEST_F(ImpostorBodies, Agree) {
    const auto devices = gpu::listDevices();
    const gpu::DeviceFacts& device = devices[gpu::chooseDevice(devices, "")];
    std::vector<std::string> bodies{std::string(nameOf(chooseRayBody(device, "")))};
    for (const char* name : {"lane", "ray_query"})
        if (name != bodies[0] && (device.rayQuery || name == std::string("lane"))) bodies.push_back(name);
    ASSERT_GT(bodies.size(), 1u);
    OrderedJson graph = {{"format", 1},
                         {"scene", (sourceFolder / "scenes/chessboard.json").string()},
                         {"passes", bakeAndView({{"mesh", "white_knight"}, {"resolution", 64}, {"views", 6}, {"cache", false}})},
                         {"show", "view.color"}};
    write("knight.json", graph);
    std::vector<ShownTexel> first;
    for (const std::string& body : bodies) {
        const Path out = run(body, folder / "knight.json", {"--size", "192x128", "--frames", "1", "--rays", body, "--dump", "view.texels", "--check-bounds"});
        ASSERT_FALSE(HasFailure());
        const std::vector<std::byte> npy = readBytes(out / "view.texels.0.npy");
        std::vector<ShownTexel> texels(192 * 128);
        const std::size_t bytes = texels.size() * sizeof(ShownTexel);
        ASSERT_GT(npy.size(), bytes);
        std::memcpy(texels.data(), npy.data() + npy.size() - bytes, bytes);
        if (first.empty()) first = texels;
        std::size_t seen = 0, different = 0;
        for (std::size_t i = 0; i < texels.size(); ++i) {
            seen += first[i].alpha > 0;
            different += first[i].alpha != texels[i].alpha || std::abs(first[i].depth - texels[i].depth) > 1e-4f ||
                         glm::distance(first[i].normal, texels[i].normal) > 1e-2f || first[i].material != texels[i].material;
        }
        std::printf("%s: %zu texels seen, %zu differ\n", body.c_str(), seen, different);
        EXPECT_GT(seen, 2000u);
        EXPECT_LE(different, seen / 500);
    }
}

TEST_F(ImpostorBodies, WrongParametersAreNamed) {
    write("wrong.json", {{"format", 1},
                         {"scene", (sourceFolder / "scenes/chessboard.json").string()},
                         {"passes", bakeAndView({{"mesh", "white_nkight"}})},
                         {"show", "view.color"}});
    const auto run = [&](const std::string& set) {
        Output output = lodestir({"run", (folder / "wrong.json").string(), "--size", "64x64", "--set", set, "--out", (folder / "out").string()});
        EXPECT_EQ(output.exitCode, 1) << output.err;
        return output;
    };
    EXPECT_NE(run("bake.views=9").err.find("set \"views\" to 6, 12 or 18"), std::string::npos);
    EXPECT_NE(run("bake.resolution=200").err.find("set \"resolution\" to 128"), std::string::npos);
    const Output output = run("bake.views=6");
    EXPECT_NE(output.err.find("chessboard.json: no instance shows a mesh \"white_nkight\""), std::string::npos) << output.err;
    EXPECT_NE(output.err.find("did you mean \"white_knight\""), std::string::npos) << output.err;
}

class ImpostorCommand : public ProgramTest {};

// What `lodestir lod --impostor` bakes is what graphs find, also in a copy of the model that has levels.
TEST_F(ImpostorCommand, FillsTheCacheThatGraphsLookInto) {
    const EnvironmentVariable cache("LODESTIR_CACHE", (folder / "cache").c_str());
    const std::string model = (sceneFolder() / "cube.glb").string();
    const auto bake = [&](Arguments more) {
        more.insert(more.begin(), {"lod", model, "--impostor", "--json", "--mesh", "cube"});
        const Output output = lodestir(more);
        EXPECT_EQ(output.exitCode, 0) << commandText(more) << "\n" << output.err;
        EXPECT_EQ(output.err.find("validation"), std::string::npos) << output.err;
        return OrderedJson::parse(output.out);
    };
    const Arguments small{"--views", "6", "--resolution", "64", "--compression", "bc"};
    const std::uint64_t finest = 6 * 64 * 64, all = finest + finest / 4 + finest / 16 + finest / 64 + finest / 256;
    for (const bool again : {false, true}) {
        const OrderedJson json = bake(small);
        ASSERT_EQ(json["impostors"].size(), 1u);
        const OrderedJson& cube = json["impostors"][0];
        EXPECT_EQ(cube["name"], "cube");
        EXPECT_EQ(cube["views"], 6);
        EXPECT_EQ(cube["resolution"], 64);
        EXPECT_EQ(cube["bytes"], 13 * all - 2 * finest + tileBytes(64, 6));
        EXPECT_EQ(cube["rawBytes"], 24 * all + tileBytes(64, 6));
        EXPECT_EQ(cube["coverage"], 1.0);
        EXPECT_EQ(cube["cached"], again);
    }
    Frames frames(model, {64, 64}, bakeAndView({{"mesh", "cube"}, {"views", 6}, {"resolution", 64}, {"compression", "bc"}}), {"view.texels"});
    frames.run();
    EXPECT_EQ(raysOf(frames), 0u);
    EXPECT_EQ(keptFiles(folder / "cache").size(), 1u);

    Arguments both = small;
    both.insert(both.end(), {"--out", (folder / "levels.glb").string(), "--levels", "2"});
    const OrderedJson json = bake(both);
    EXPECT_TRUE(json.contains("meshes"));  // none: the model brings its levels
    EXPECT_EQ(json["impostors"][0]["cached"], true);
    EXPECT_TRUE(std::filesystem::exists(folder / "levels.glb"));
    // What the pass declares holds where nothing is said.
    const OrderedJson plain = bake({});
    EXPECT_EQ(plain["impostors"][0]["views"], 18);
    EXPECT_EQ(plain["impostors"][0]["bytes"], plain["impostors"][0]["rawBytes"]);
    EXPECT_EQ(keptFiles(folder / "cache").size(), 2u);
}

TEST_F(ImpostorCommand, SaysWhatIsWrong) {
    const std::string model = (sceneFolder() / "cube.glb").string();
    const auto refuses = [&](const Arguments& arguments, int exitCode, const std::string& message) {
        const Output output = lodestir(arguments);
        EXPECT_EQ(output.exitCode, exitCode) << output.err;
        EXPECT_NE(output.err.find(message), std::string::npos) << output.err;
    };
    refuses({"lod", model}, 2, "--out: is required, unless --impostor is all that is asked for");
    refuses({"lod", model, "--out", (folder / "x.glb").string(), "--views", "6"}, 2, "--views requires --impostor");
    refuses({"lod", model, "--impostor", "--mesh", "cubs"}, 1, "cube.glb: no instance shows a mesh \"cubs\"; did you mean \"cube\"?");
    refuses({"lod", model, "--impostor", "--views", "9"}, 1, "set \"views\" to 6, 12 or 18");
    refuses({"lod", model, "--impostor", "--views", "24"}, 1, "bake.views");
    refuses({"lod", model, "--impostor", "--compression", "bc7"}, 1, "bake.compression");
}

}  // namespace
}  // namespace lodestir::test
