// SPDX-License-Identifier: MIT
// What history may count for: the map of copies, caps made of it, the boiling filter, dual motion, and radiance by the weights of all candidates.
#include "planted_faults.h"
#include "shift_session.h"

#include <framework/image/image_file.h>
#include <framework/shaders/world/primary_hit.h>
#include <passes/restir/sample_hit.h>

#include <algorithm>
#include <map>

namespace lodestir::test {
namespace {

class HistoryTest : public testing::Test {
protected:
    TemporaryFolder folder;

    /// A scene of the tree with changes, in a file of its own.
    Path changed(const std::string& name, const OrderedJson& patch) {
        OrderedJson scene = OrderedJson::parse(readText(sceneFile(name)));
        for (auto& [model, value] : scene["models"].items()) value["file"] = (sceneFolder() / value["file"].get<std::string>()).string();
        scene.merge_patch(patch);
        writeFile(folder.path / "changed.json", scene.dump());
        return folder.path / "changed.json";
    }
    /// Nodes whose `error.error` is 1 in every other column: a map of copies that knows nothing of paths, so that it can't bias.
    OrderedJson columnsOf(glm::uvec2 size) {
        ImageData columns = makeImage(int(size.x), int(size.y), 3);
        writeImage(folder.path / "black.exr", columns);
        for (std::size_t i = 0; i < columns.values.size(); ++i) columns.values[i] = float(i / 3 % size.x % 2);
        writeImage(folder.path / "columns.exr", columns);
        const auto loader = [&](const char* file) { return node("image_loader", OrderedJson::object(), {{"file", (folder.path / file).string()}}); };
        return {{"columns", loader("columns.exr")},
                {"black", loader("black.exr")},
                {"error", node("image_error", {{"test", "columns"}, {"reference", "black"}}, {{"metric", "mse"}})}};
    }
};

// If this fails, the map counts what isn't a copy, or misses one: at borders, across groups, in frames of one row, for pixels without a path.
TEST_F(HistoryTest, DuplicationMapCountsCopies) {
    for (const glm::uvec2 size : {glm::uvec2(45, 19), glm::uvec2(150, 1)}) {
        const OrderedJson passes{{"hits", hitsNode()},
                                 {"initial", initialNode({{"bounces", 1}})},
                                 {"spatial", node("spatial_reuse", pathsOf("initial"), {{"rounds", 4}, {"radius", 4}})},
                                 {"map", node("duplication_map", {{"paths", "spatial"}})}};
        Frames frames(sceneFile("ensemble_glossy"), size, passes, {"map.duplication", "spatial.paths.reservoirs"});
        for (const int radius : {1, 8, 16}) {
            frames.set("map.radius", Json(radius));
            frames.run();
            const ImageData map = frames.image("map.duplication");
            const auto paths = frames.records<Reservoir>("spatial.paths.reservoirs");
            const int width = int(size.x), height = int(size.y), all = (2 * radius + 1) * (2 * radius + 1) - 1;
            int some = 0, none = 0, empty = 0;
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x) {
                    const Reservoir& own = paths[std::size_t(y * width + x)];
                    int copies = 0;
                    for (int v = std::max(y - radius, 0); v <= std::min(y + radius, height - 1); ++v)
                        for (int u = std::max(x - radius, 0); u <= std::min(x + radius, width - 1); ++u) {
                            const Reservoir& other = paths[std::size_t(v * width + u)];
                            copies += (u != x || v != y) && own.W > 0 && other.W > 0 && own.seed == other.seed;
                        }
                    ASSERT_FLOAT_EQ(map.at(x, y, 0), float(copies) / float(all)) << x << ", " << y << ", radius " << radius;
                    ++(own.W > 0 ? copies > 0 ? some : none : empty);
                }
            EXPECT_GT(some, 0);
            EXPECT_GT(none, 0);
            EXPECT_TRUE(empty > 0 || height == 1);
        }
    }
}

// Where paths of last frame are found again, and at which place of their pixel. If this fails, the fractional gather takes paths of elsewhere, or leaves them
// at the place inside the pixel that they had, like the nearest.
TEST_F(HistoryTest, PathsMoveByFractionsOfPixels) {
    constexpr glm::uvec2 size{48, 27};
    OrderedJson passes{{"hits", hitsNode()},
                       {"initial", initialNode({{"bounces", 1}})},
                       {"temporal", node("temporal_reprojection", pathsOf("initial", "temporal"))}};
    passes["hits"]["in"]["worldPrev"] = "scene@prev";
    Frames frames(sceneFile("moving_furnace"), size, passes, {"temporal.paths.reservoirs", "temporal.paths.samples", "hits.motion"});
    for (const char* gather : {"nearest", "fractional"}) {
        frames.set("temporal.gather", Json(gather));
        frames.restart(0);
        std::multimap<std::uint64_t, glm::dvec2> last;  // by a path's seed: its places on the film, pixels
        int found = 0, off = 0, between = 0;
        const auto differ = [](glm::dvec2 a, glm::dvec2 b) { return glm::any(glm::greaterThan(glm::abs(a - b), glm::dvec2(6e-4))); };
        for (int frame = 0; frame < 4; ++frame) {
            frames.run();
            const auto paths = frames.records<Reservoir>("temporal.paths.reservoirs");
            const auto samples = frames.records<SampleHit>("temporal.paths.samples");
            const ImageData motion = frames.image("hits.motion");
            std::multimap<std::uint64_t, glm::dvec2> now;
            for (std::uint32_t i = 0; i < paths.size(); ++i) {
                if (paths[i].W <= 0) continue;
                const glm::ivec2 pixel(i % size.x, i / size.x);
                const std::uint64_t seed = std::uint64_t(paths[i].seed.y) << 32 | paths[i].seed.x;
                const glm::dvec2 place = glm::dvec2(pixel) + glm::dvec2(samples[i].hit.film);
                now.emplace(seed, place);
                const auto [first, end] = last.equal_range(seed);
                if (first == end) continue;
                const glm::dvec2 asked = place + glm::dvec2(motion.at(pixel.x, pixel.y, 0), motion.at(pixel.x, pixel.y, 1));
                ++found;
                off += std::all_of(first, end, [&](const auto& path) { return differ(path.second, asked); });
                between += std::all_of(first, end, [&](const auto& path) { return differ(path.second - place, glm::round(path.second - place)); });
            }
            last = std::move(now);
        }
        EXPECT_GT(found, 500) << gather;
        if (gather == std::string("nearest")) {
            EXPECT_EQ(between, 0);
        } else {
            EXPECT_EQ(off, 0);
            EXPECT_GT(between, found / 2);
        }
    }
}

// If this fails, a picture that stands still has another history by fractions of pixels, which are whole there.
TEST_F(HistoryTest, WhatStandsStillIsGatheredAlike) {
    const OrderedJson passes{{"hits", hitsNode()},
                             {"initial", initialNode({{"bounces", 1}})},
                             {"temporal", node("temporal_reprojection", pathsOf("initial", "temporal"))},
                             {"shade", shadeNode("temporal")}};
    Frames frames(sceneFile("ensemble_glossy"), {24, 12}, passes, {"shade"});
    std::vector<float> images[2];
    for (const int i : {0, 1}) {
        frames.set("temporal.gather", Json(i == 0 ? "nearest" : "fractional"));
        frames.restart(0);
        for (int frame = 0; frame < 4; ++frame) frames.run();
        images[i] = frames.image("shade").values;
    }
    EXPECT_EQ(images[0], images[1]);
}

// If this fails, the cap isn't what copies ask for. Before a camera that stands still a pixel's history comes from the pixel itself.
TEST_F(HistoryTest, CapFollowsTheMap) {
    constexpr glm::uvec2 size{24, 12};
    for (const char* temporal : {"temporal_reprojection", "temporal_splat"}) {
        OrderedJson passes = columnsOf(size);
        passes["hits"] = hitsNode();
        passes["initial"] = initialNode({{"bounces", 1}});
        passes["temporal"] = node(temporal, pathsOf("initial", "temporal"), {{"cap", 6}, {"leastCap", 2}});
        passes["temporal"]["in"]["duplication"] = "error.error";
        Frames frames(sceneFile("ensemble_diffuse"), size, passes, {"temporal.paths.reservoirs"});
        frames.run(10);
        const auto paths = frames.records<Reservoir>("temporal.paths.reservoirs");
        for (std::size_t i = 0; i < paths.size(); ++i)
            ASSERT_EQ(confidenceOf(paths[i]), i % size.x % 2 ? 3 : 7) << temporal << ", pixel " << i;
        frames.set("temporal.cap", Json(1));
        frames.run(2);
        for (const Reservoir& r : frames.records<Reservoir>("temporal.paths.reservoirs")) ASSERT_EQ(confidenceOf(r), 2) << "leastCap is no more than cap";
    }
}

// Paths fly across columns whose caps differ. Where the map at the pixel's last place makes the cap 0, the own path has to count fully and what lands not at
// all, which is exact.
TEST_F(HistoryTest, CapsWeighAlikeOnBothSides) {
    plant(folder.path, {{"cap_of_the_landing", "temporal_splat", "shift_paths.comp", "historyCap(way == FORTH ? r.landing : pixel)",
                         "historyCap(r.landing)"},
                        {"cap_of_the_source", "temporal_splat", "shift_paths.comp", "historyCap(way == FORTH ? r.landing : pixel)",
                         "historyCap(pixel)"}});
    ASSERT_FALSE(HasFailure());
    constexpr glm::uvec2 size{32, 32};
    const Path scene = changed("furnace", {{"animation", {{"framesPerSecond", 30}}},
                                           {"camera", {{"keyframes", {{{"frame", 0}, {"position", {0, 1.0, 2.5}}, {"target", {0, 0.9, -0.3}}},
                                                                      {{"frame", 8}, {"position", {0.5, 1.2, 2.4}}, {"target", {0.15, 0.8, -0.3}}}}}}}});
    OrderedJson passes = columnsOf(size);
    passes["hits"] = hitsNode();
    passes["initial"] = initialNode({{"bounces", 2}, {"technique", "bsdf"}, {"roulette", false}});
    passes["first"] = shadeNode("initial");
    std::vector<std::string> images;
    for (const std::string type : {"temporal_splat", "temporal_reprojection", "cap_of_the_landing", "cap_of_the_source"}) {
        passes[type] = node(type, pathsOf("initial", type), {{"cap", 8}, {"leastCap", 0}});
        if (type != "temporal_reprojection") passes[type]["set"]["backup"] = 0;
        passes[type]["in"]["duplication"] = "error.error";
        passes[type + "_image"] = shadeNode(type);
        images.push_back(type + "_image");
    }
    for (std::string& image : images) image += ".color";
    std::vector<std::string> ports = images;
    ports.push_back("hits.motion");
    ports.push_back("first.color");
    Frames frames(scene, size, passes, ports, {folder.path});
    frames.restart(1);
    frames.run(6);
    const ImageData motion = frames.image("hits.motion"), own = frames.image("first.color");
    const auto isCapped = [&](int x, int y) {
        const int u = int(std::floor(float(x) + 0.5f + motion.at(x, y, 0))), v = int(std::floor(float(y) + 0.5f + motion.at(x, y, 1)));
        return u >= 0 && v >= 0 && u < motion.width && v < motion.height && u % 2 == 1;
    };
    for (const std::string& image : images) {
        const ImageData found = frames.image(image);
        float worst = 0;
        for (int y = 0; y < found.height; ++y)
            for (int x = 0; x < found.width; ++x)
                if (isCapped(x, y)) worst = std::max(worst, std::abs(found.at(x, y, 0) / own.at(x, y, 0) - 1));
        std::printf("%-28s off by %.3g\n", image.c_str(), double(worst));
        if (image.starts_with("temporal"))
            EXPECT_LE(worst, 1e-6f) << image;
        else
            EXPECT_GT(worst, 1e-2f) << image << " isn't found";
    }
}

// If this fails, the filter clears what it should keep, or the other way round.
TEST_F(HistoryTest, BoilingFilterClearsWhatOutweighsItsGroup) {
    const OrderedJson passes{{"initial", initialNode({{"bounces", 3}})}, {"boiling", node("boiling_filter", {{"paths", "initial"}})}};
    const auto weight = [](const Reservoir& r) {
        return r.W > 0 ? double(r.W) * (0.2126 * double(r.F.x) + 0.7152 * double(r.F.y) + 0.0722 * double(r.F.z)) : 0.0;
    };
    for (const auto& [width, height] : {std::pair(45, 37), std::pair(150, 2), std::pair(150, 1)}) {
        Frames frames(sceneFile("ensemble_glossy"), {width, height}, passes, {"boiling.paths.reservoirs", "initial.paths.reservoirs"});
        int all = 0;
        for (const double strength : {0.9, 0.7, 0.5}) {
            int cleared = 0;
            frames.set("boiling.strength", Json(strength));
            frames.run();
            const auto before = frames.records<Reservoir>("initial.paths.reservoirs"), after = frames.records<Reservoir>("boiling.paths.reservoirs");
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x) {
                    double sum = 0, count = 0;
                    for (int v = y / 16 * 16; v < std::min(y / 16 * 16 + 16, height); ++v)
                        for (int u = x / 16 * 16; u < std::min(x / 16 * 16 + 16, width); ++u) {
                            const double w = weight(before[std::size_t(v * width + u)]);
                            sum += w;
                            count += w > 0;
                        }
                    const std::size_t i = std::size_t(y * width + x);
                    const double most = (10 / strength - 9) * sum / std::max(count, 1.0), w = weight(before[i]);
                    if (std::abs(w - most) < 1e-4 * most) continue;  // rounding decides
                    const bool clears = w > most;
                    cleared += clears;
                    ASSERT_EQ(after[i].W, clears ? 0 : before[i].W) << x << ", " << y << " of " << width << "x" << height;
                    ASSERT_EQ(confidenceOf(after[i]), clears ? 0 : confidenceOf(before[i])) << x << ", " << y << " of " << width << "x" << height;
                }
            if (height > 2) {
                EXPECT_GT(cleared, 0) << "strength " << strength;
            }
            all += cleared;
        }
        EXPECT_GT(all, 0) << width << "x" << height;
    }
}

// If this fails, radiance by all weights has another mean than the kept path's, or another luminance.
TEST_F(HistoryTest, AllWeightsHaveTheMeanOfTheKeptPath) {
    OrderedJson passes{{"hits", hitsNode()}, {"initial", initialNode({{"bounces", 3}})}};
    std::vector<std::string> images;
    for (const std::string type : {"temporal_reprojection", "temporal_splat"}) {
        passes[type] = node(type, pathsOf("initial", type), {{"cap", 2}});
        passes[type + "_image"] = shadeNode(type);
        images.push_back(type);
        images.push_back(type + "_image");
    }
    std::vector<std::string> ports;
    for (const std::string& image : images) ports.push_back(image + ".color");
    Frames frames(sceneFile("ensemble_moving"), {48, 32}, passes, ports);
    std::map<std::string, std::vector<double>> reds;
    for (std::uint32_t chain = 0; chain < 24; ++chain) {
        frames.restart(4, chain);
        frames.run(4);
        for (std::size_t i = 0; i < ports.size(); i += 2) {
            const ImageData all = frames.image(ports[i]), kept = frames.image(ports[i + 1]);
            reds[images[i]].push_back(sumOf(firstChannels(all, 1)));
            reds[images[i + 1]].push_back(sumOf(firstChannels(kept, 1)));
            for (int y = 0; y < all.height; ++y)
                for (int x = 0; x < all.width; ++x) {
                    const auto luminance = [&](const ImageData& image) {
                        return 0.2126 * double(image.at(x, y, 0)) + 0.7152 * double(image.at(x, y, 1)) + 0.0722 * double(image.at(x, y, 2));
                    };
                    ASSERT_NEAR(luminance(all), luminance(kept), 1e-5 * (luminance(kept) + 1e-3)) << "weights are made of luminance: only colours differ";
                }
        }
    }
    for (const char* type : {"temporal_reprojection", "temporal_splat"}) {
        const auto& kept = reds.at(std::string(type) + "_image");
        const Ratio ratio = ratioOf(reds.at(type), kept);
        std::printf("%-28s %.5f +- %.5f\n", type, ratio.value, ratio.halfWidth);
        EXPECT_TRUE(ratio.isOne()) << type << ": " << ratio.value << " +- " << ratio.halfWidth;
        EXPECT_GT(ratio.halfWidth, 0) << "they differ";
    }
}

// If these fail, pixels that come into sight look for their history at what hid them, or others lose theirs.
class DualMotionTest : public HistoryTest {
protected:
    static constexpr int width = 160, height = 90;
    struct Pixel {
        glm::vec2 centre, motion, dual;
        float depth;
        PrimaryHit hit;
        glm::ivec2 before() const { return glm::ivec2(glm::floor(centre + motion)); }
        glm::ivec2 served() const { return glm::ivec2(glm::floor(centre + dual)); }
    };
    using Picture = std::vector<Pixel>;

    static bool isInside(glm::ivec2 p) { return p.x >= 0 && p.y >= 0 && p.x < width && p.y < height; }
    static const Pixel& at(const Picture& picture, glm::ivec2 p) { return picture[std::size_t(p.y * width + p.x)]; }

    /// Frames of ensemble_moving with changes.
    std::vector<Picture> pictures(const OrderedJson& patch, int count) {
        const OrderedJson passes{{"hits", hitsNode()},
                                 {"dual", node("dual_motion", {{"hits", "hits"}, {"hitsPrev", "hits@prev"}, {"motion", "hits.motion"}})}};
        Frames frames(changed("ensemble_moving", patch), {width, height}, passes, {"dual.motion", "hits.motion", "hits.depth", "hits.hits"});
        std::vector<Picture> pictures;
        for (int frame = 0; frame < count; ++frame) {
            frames.run();
            const ImageData motion = frames.image("hits.motion"), dual = frames.image("dual.motion"), depth = frames.image("hits.depth");
            const auto hits = frames.records<PrimaryHit>("hits.hits");
            Picture& picture = pictures.emplace_back();
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x)
                    picture.push_back({{float(x) + 0.5f, float(y) + 0.5f}, {motion.at(x, y, 0), motion.at(x, y, 1)}, {dual.at(x, y, 0), dual.at(x, y, 1)},
                                       depth.at(x, y, 0), hits[std::size_t(y * width + x)]});
        }
        return pictures;
    }
};

TEST_F(DualMotionTest, LooksBesideWhatHidIt) {
    const std::vector<Picture> frames =
        pictures({{"animation", {{"speed", 4}}}, {"camera", {{"keyframes", nullptr}}}}, 8);
    for (const Pixel& p : frames[0]) ASSERT_EQ(p.dual, p.motion) << "without history";
    int kept = 0, shown = 0, same = 0, seen = 0, alike = 0;
    for (std::size_t frame = 1; frame < frames.size(); ++frame)
        for (const Pixel& p : frames[frame]) {
            if (p.motion == p.dual) {
                ++kept;
                continue;
            }
            ASSERT_TRUE(isInside(p.served()));
            if (!isInside(p.before())) continue;
            ++shown;
            const Pixel &was = at(frames[frame - 1], p.before()), &serves = at(frames[frame - 1], p.served());
            if (p.motion == glm::vec2(0)) {  // it stands still, so its depth last frame is what it is now
                EXPECT_LT(was.depth, 0.901f * p.depth) << "something was before it";
                EXPECT_GT(serves.depth, 0.899f * p.depth) << "nothing is before it there";
            }
            same += serves.hit.instance == p.hit.instance;
            // Where the thing that hid it is now, it has moved by as much, but for its turning.
            const glm::ivec2 thing(glm::floor(glm::vec2(p.before()) + 0.5f - p.dual));
            if (!isInside(thing) || at(frames[frame], thing).hit.instance != was.hit.instance) continue;
            ++seen;
            alike += glm::length(at(frames[frame], thing).motion - p.dual) < 1.5f;
        }
    std::printf("%d as they were, %d came into sight: %d find their own surface; the motion of what hid them: %d of %d\n", kept, shown, same, alike, seen);
    EXPECT_GT(kept, 20 * shown);
    EXPECT_GT(shown, 100);
    EXPECT_GT(same, shown / 2);
    EXPECT_GT(seen, shown / 4);
    EXPECT_GT(alike, seen * 3 / 4);
}

TEST_F(DualMotionTest, LooksBackAtTheBorder) {
    const std::vector<Picture> frames =
        pictures({{"camera", {{"keyframes", {{{"frame", 0}, {"position", {-0.5, 1.0, 2.6}}, {"target", {-0.1, 0.75, -0.3}}},
                                             {{"frame", 8}, {"position", {-0.5, 1.0, 2.6}}, {"target", {0.6, 0.75, -0.3}}}}}}}},
                 4);
    int off = 0;
    for (std::size_t frame = 1; frame < frames.size(); ++frame)
        for (const Pixel& p : frames[frame]) {
            if (isInside(p.before()) || p.dual == p.motion) continue;
            ++off;
            ASSERT_EQ(p.dual, -p.motion);
        }
    EXPECT_GT(off, height);
}

}  // namespace
}  // namespace lodestir::test
