// SPDX-License-Identifier: MIT
// Scenes of failure cases are what they are named for: wires as thin as is said, charts that overlap, seams that move with the level, a step that
// shows what was hidden. What techniques are judged by in studies/stability.json rests on it.
#include "frames.h"

#include <framework/image/metrics.h>
#include <framework/scene/level_policy.h>
#include <framework/shaders/world/primary_hit.h>

#include <algorithm>
#include <array>
#include <iostream>
#include <map>
#include <set>

namespace lodestir::test {
namespace {

constexpr int switchFrame = 40;  // of all schedules here, and the event of the study

OrderedJson graphPasses(const char* graph) { return OrderedJson::parse(readText(sourceFolder / "graphs" / (std::string(graph) + ".json")))["passes"]; }

/// What pixels' centres see, and where it was a frame ago.
const OrderedJson seen = {{"lod", {{"type", "lod_select"}}},
                          {"hits", {{"type", "visibility"}, {"in", {{"worldPrev", "lod.world@prev"}}}, {"set", {{"film", "centre"}, {"lens", false}}}}}};

std::size_t instanceNamed(const Scene& scene, const std::string& name) {
    const auto found = std::ranges::find(scene.instances, name, &Instance::name);
    if (found == scene.instances.end()) throw Error("no instance " + name);
    return std::size_t(found - scene.instances.begin());
}

const MeshLevel& levelOf(const Scene& scene, const std::string& instance, std::size_t level) {
    return scene.meshes[scene.instances[instanceNamed(scene, instance)].mesh].levels.at(level);
}

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    std::ranges::nth_element(values, values.begin() + std::ptrdiff_t(values.size() / 2));
    return values[values.size() / 2];
}

class FailureScene : public testing::TestWithParam<const char*> {};

// If this fails, a cell of the matrix stands for values that are not finite, or for nothing at all.
TEST_P(FailureScene, IsRenderedByEveryReuse) {
    for (const char* graph : {"restir_pt_2022", "restir_pt_enhanced", "restir_lod"}) {
        SCOPED_TRACE(graph);
        Frames frames(sceneFile(GetParam()), {96, 54}, graphPasses(graph), {"shade"});
        frames.restart(switchFrame - 2);
        frames.run(4);
        EXPECT_GT(sumOf(frames.image("shade")), 0);
    }
}

INSTANTIATE_TEST_SUITE_P(Scenes, FailureScene, testing::Values("wires", "stove", "globe", "colonnade"), [](const auto& scene) { return scene.param; });

/// Lengths of rows (or columns) of pixels that see one object between others, in pixels of an image `finer` times as large as 480x270.
std::vector<double> runsOf(const std::vector<PrimaryHit>& hits, glm::ivec2 size, std::size_t instance, bool downwards) {
    std::vector<double> lengths;
    const int lines = downwards ? size.x : size.y, length = downwards ? size.y : size.x;
    for (int line = 0; line < lines; ++line) {
        int start = -1;  // at or before the border: a run that may go on outside says nothing
        for (int i = 0; i < length; ++i) {
            const std::size_t pixel =
                downwards ? std::size_t(i) * std::size_t(size.x) + std::size_t(line) : std::size_t(line) * std::size_t(size.x) + std::size_t(i);
            const bool here = hits[pixel].primitive != NONE && hits[pixel].instance == instance;
            if (here && start < 0) start = i;
            if (!here && start > 0) lengths.push_back(i - start);
            if (!here) start = -1;
        }
    }
    return lengths;
}

// If this fails, what is said of thin geometry is said of bars of some other width.
TEST(Wires, AreAsWideAsTheirNames) {
    struct Thin {
        const char* name;
        double pixels;
        bool lies;
        std::uint32_t frame;  // at which the camera stands before it
    };
    const Thin all[] = {{"bars_4_pixels", 4, false, 0},        {"wires_2_pixels", 2, true, 40}, {"wires_1_pixel", 1, true, 40},
                        {"wires_half_a_pixel", 0.5, true, 40}, {"net_1_pixel", 1, false, 120},  {"bars_2_pixels", 2, false, 160}};
    constexpr int finer = 8;  // half a pixel is four
    const glm::uvec2 size = glm::uvec2(480, 270) * std::uint32_t(finer);
    Frames frames(sceneFile("wires"), size, seen, {"hits.hits"});
    std::uint32_t at = ~0u;
    std::vector<PrimaryHit> hits;
    for (const Thin& thin : all) {
        if (thin.frame != at) {
            frames.restart(at = thin.frame);
            frames.run();
            hits = frames.records<PrimaryHit>("hits.hits");
        }
        const std::vector<double> runs = runsOf(hits, size, instanceNamed(frames.scene(), thin.name), thin.lies);
        EXPECT_GT(runs.size(), 500u) << thin.name << " is hardly in view";
        EXPECT_NEAR(median(runs) / finer, thin.pixels, 0.15 * thin.pixels + 0.5 / finer) << thin.name;
    }
    const Scene& scene = frames.scene();
    for (float frame = 0; frame < 160; ++frame) {
        const float step = scene.cameraAt(frame + 1).position.x - scene.cameraAt(frame).position.x, pixel = 2 * 2.2f * std::tan(glm::radians(20.0f)) / 270;
        EXPECT_GT(step / pixel, 2) << "pixels of the fence a frame";
        EXPECT_LT(step / pixel, 3);
    }
}

/// How many triangles lie over each of a square of texels in the plane of coordinates, which are taken modulo 1 as the pictures repeat.
std::vector<int> layersOf(const MeshLevel& level, int texels) {
    std::vector<int> layers(std::size_t(texels) * std::size_t(texels));
    for (const glm::uvec3& triangle : level.triangles) {
        const std::array<glm::vec2, 3> p{level.uv0[triangle.x] * float(texels), level.uv0[triangle.y] * float(texels), level.uv0[triangle.z] * float(texels)};
        const auto twice = [](const glm::vec2& a, const glm::vec2& b, const glm::vec2& c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); };
        const float area = twice(p[0], p[1], p[2]);
        if (area == 0) continue;
        const glm::vec2 low = glm::min(glm::min(p[0], p[1]), p[2]), high = glm::max(glm::max(p[0], p[1]), p[2]);
        for (int y = int(std::floor(low.y)); y <= int(high.y); ++y)
            for (int x = int(std::floor(low.x)); x <= int(high.x); ++x) {
                const glm::vec2 centre(float(x) + 0.5f, float(y) + 0.5f);
                const float a = twice(p[0], p[1], centre) / area, b = twice(p[1], p[2], centre) / area, c = twice(p[2], p[0], centre) / area;
                const auto wrapped = [&](int i) { return std::size_t((i % texels + texels) % texels); };
                if (a >= 0 && b >= 0 && c >= 0) ++layers[wrapped(y) * std::size_t(texels) + wrapped(x)];
            }
    }
    return layers;
}

/// Of the texels that any triangle covers, the share that at least `count` cover.
double shareOfLayers(const std::vector<int>& layers, int count) {
    return double(std::ranges::count_if(layers, [&](int n) { return n >= count; })) / double(std::ranges::count_if(layers, [](int n) { return n > 0; }));
}

// If this fails, overlapping charts are judged on a model whose charts don't overlap, or on one that never switches.
TEST(OverlappingCharts, Overlap) {
    struct Overlapping {
        const char* scene;
        int layers;  // by at least so many triangles
        bool overlaps = true;
    };
    // The map between levels looks through eight points of one coordinate (passes/lod/README.md): the stove has more.
    for (const Overlapping& model : {Overlapping{"plane", 2}, Overlapping{"cube", 6}, Overlapping{"stove", 9}, Overlapping{"rock", 2, false}}) {
        const Scene scene = loadScene(sceneFile(model.scene));
        const std::size_t instance = instanceNamed(scene, model.scene);
        EXPECT_EQ(scheduledLevels(scene, switchFrame - 1)[instance], 0u) << model.scene;
        EXPECT_EQ(scheduledLevels(scene, switchFrame)[instance], 1u) << model.scene;
        for (const std::size_t level : {0u, 1u}) {
            const double share = shareOfLayers(layersOf(levelOf(scene, model.scene, level), 256), model.layers);
            std::cout << model.scene << ", level " << level << ": " << model.layers << " triangles or more over " << 100 * share
                      << " % of the coordinates in use\n";
            if (model.overlaps)
                EXPECT_GT(share, 0.9) << model.scene;
            else
                EXPECT_LT(share, 0.05) << model.scene;
        }
    }
}

/// Directions of the middles of edges where the charts on both sides end: its ends are in one place, their coordinates not.
std::vector<glm::vec3> seamsOf(const MeshLevel& level) {
    using Place = std::array<long, 3>;
    const auto place = [](const glm::vec3& p) { return Place{std::lround(p.x * 1e4f), std::lround(p.y * 1e4f), std::lround(p.z * 1e4f)}; };
    std::map<std::pair<Place, Place>, std::set<std::array<float, 4>>> edges;
    std::map<std::pair<Place, Place>, glm::vec3> middles;
    for (const glm::uvec3& triangle : level.triangles)
        for (int k = 0; k < 3; ++k) {
            std::uint32_t a = triangle[k], b = triangle[(k + 1) % 3];
            if (place(level.positions[b]) < place(level.positions[a])) std::swap(a, b);
            const std::pair edge(place(level.positions[a]), place(level.positions[b]));
            if (edge.first == edge.second) continue;
            edges[edge].insert({level.uv0[a].x, level.uv0[a].y, level.uv0[b].x, level.uv0[b].y});
            middles[edge] = glm::normalize(level.positions[a] + level.positions[b]);
        }
    std::vector<glm::vec3> seams;
    for (const auto& [edge, uvs] : edges)
        if (uvs.size() > 1) seams.push_back(middles[edge]);
    return seams;
}

/// Of a point in a direction from the middle: the coordinate that a level has there, of its nearest vertex.
glm::vec2 coordinateAt(const MeshLevel& level, const glm::vec3& direction) {
    float best = -2;
    glm::vec2 uv(0);
    for (std::size_t i = 0; i < level.positions.size(); ++i)
        if (const float cosine = glm::dot(glm::normalize(level.positions[i]), direction); cosine > best) best = cosine, uv = level.uv0[i];
    return uv;
}

// If this fails, the globe's levels share their charts, and what is said of seams that move is said of a common switch.
TEST(Globe, SeamsMoveWithTheLevel) {
    const Scene scene = loadScene(sceneFile("globe"));
    const std::size_t globe = instanceNamed(scene, "globe");
    EXPECT_EQ(scheduledLevels(scene, switchFrame - 1)[globe], 0u);
    EXPECT_EQ(scheduledLevels(scene, switchFrame)[globe], 1u);
    const MeshLevel &fine = levelOf(scene, "globe", 0), &coarse = levelOf(scene, "globe", 1);
    EXPECT_GT(fine.triangles.size(), 4 * coarse.triangles.size());

    // One shape: every vertex of both lies on the ball, and the chords of the coarser one leave it no farther than it says.
    float deepest = 0;
    for (const glm::vec3& p : coarse.positions) EXPECT_NEAR(glm::length(p), 0.5f, 1e-4f);
    for (const glm::uvec3& t : coarse.triangles) {
        const glm::vec3 &a = coarse.positions[t.x], &b = coarse.positions[t.y], &c = coarse.positions[t.z];
        for (const glm::vec3& p : {(a + b) / 2.0f, (b + c) / 2.0f, (c + a) / 2.0f, (a + b + c) / 3.0f}) deepest = std::max(deepest, 0.5f - glm::length(p));
    }
    EXPECT_LE(deepest, coarse.error);
    EXPECT_GT(deepest, 0.3f * coarse.error) << "the error is no more than said, but not made up either";

    std::vector<double> apart;
    for (std::size_t i = 0; i < coarse.positions.size(); i += 7)
        apart.push_back(glm::distance(coordinateAt(fine, glm::normalize(coarse.positions[i])), coarse.uv0[i]));
    std::cout << "coordinates of one place differ by " << median(apart) << " (median)\n";
    EXPECT_GT(median(apart), 0.1);

    // The finest level has its one seam along a meridian, the other the twelve edges of a cube.
    const std::vector<glm::vec3> before = seamsOf(fine), after = seamsOf(coarse);
    ASSERT_GT(before.size(), 30u);
    ASSERT_GT(after.size(), 100u);
    const auto stays = std::ranges::count_if(after, [&](const glm::vec3& seam) {
        return std::ranges::any_of(before, [&](const glm::vec3& old) { return glm::dot(old, seam) > std::cos(glm::radians(3.0f)); });
    });
    EXPECT_LT(double(stays), 0.25 * double(after.size()));
}

// If this fails, the switch is seen, because the charts show another picture, and not only felt by what reuses paths.
TEST(Globe, LooksAlikeOnBothLevels) {
    const OrderedJson trace = {{"trace", {{"type", "path_tracer"}, {"set", {{"spp", 128}, {"bounces", 3}}}}}};
    Frames frames(sceneFile("globe"), {96, 54}, trace, {"trace"});
    const auto picture = [&](std::uint32_t frame, std::uint32_t seed) {
        frames.restart(frame, seed);
        frames.run();
        return frames.image("trace");
    };
    const ImageData fine = picture(switchFrame - 1, 1), again = picture(switchFrame - 1, 2), coarse = picture(switchFrame, 3);
    const double noise = evaluate("flip", again, fine), change = evaluate("flip", coarse, fine);
    std::cout << "FLIP of the switch " << change << ", of noise alone " << noise << "\n";
    EXPECT_LT(change, 1.25 * noise);
}

/// Share of the pixels of a frame that see an object where the frame before saw others, in the pixel and all around it.
double newlySeen(const char* name, std::uint32_t frame) {
    constexpr glm::ivec2 size(480, 270);
    Frames frames(sceneFile(name), size, seen, {"hits.hits", "hits.motion"});
    frames.restart(frame - 1);
    frames.run();
    const auto before = frames.records<PrimaryHit>("hits.hits");
    frames.run();
    const auto now = frames.records<PrimaryHit>("hits.hits");
    const ImageData motion = frames.image("hits.motion");
    int fresh = 0;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const PrimaryHit& hit = now[std::size_t(y) * std::size_t(size.x) + std::size_t(x)];
            if (hit.primitive == NONE) continue;
            const glm::ivec2 from(glm::floor(glm::vec2(x, y) + 0.5f + glm::vec2(motion.at(x, y, 0), motion.at(x, y, 1))));
            if (from.x < 0 || from.y < 0 || from.x >= size.x || from.y >= size.y) continue;  // it comes from outside, which is another matter
            bool known = false;
            for (int j = std::max(from.y - 1, 0); j <= std::min(from.y + 1, size.y - 1); ++j)
                for (int i = std::max(from.x - 1, 0); i <= std::min(from.x + 1, size.x - 1); ++i) {
                    const PrimaryHit& old = before[std::size_t(j) * std::size_t(size.x) + std::size_t(i)];
                    known |= old.primitive != NONE && old.instance == hit.instance;
                }
            fresh += !known;
        }
    const double share = double(fresh) / (size.x * size.y);
    std::cout << name << ", frame " << frame << ": " << 100 * share << " % newly seen\n";
    return share;
}

// If this fails, the step aside shows nothing new, or the frames before it are no rest to compare with.
TEST(Disocclusion, AStepAsideShowsWhatColumnsHid) {
    EXPECT_EQ(newlySeen("colonnade", switchFrame - 1), 0);
    EXPECT_GT(newlySeen("colonnade", switchFrame), 0.05);
    EXPECT_EQ(newlySeen("colonnade", switchFrame + 1), 0);
}

// If this fails, the watercolour's camera hides and shows nothing as it rises.
TEST(Disocclusion, TheWatercolourShowsAFewPixelsAFrame) { EXPECT_GT(newlySeen("watercolour", switchFrame), 0.002); }

}  // namespace
}  // namespace lodestir::test
