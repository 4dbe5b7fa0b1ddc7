// SPDX-License-Identifier: MIT
// What a switch of level does to images: reuse across it, on sheets that each have one trouble. vertex_mapping_test.cpp lists them.
#include "sheets.h"
#include "shift_session.h"

#include <passes/restir/sample_hit.h>
#include <framework/shaders/world/primary_hit.h>
#include <framework/study/ensemble/ensemble.h>

namespace lodestir::test {
namespace {

/// graphs/restir_lod.json without tone mapping, its temporal paths kept by themselves.
OrderedJson reuseNodes(OrderedJson temporal = OrderedJson::object()) {
    OrderedJson in = pathsOf("initial", "temporal");
    in.update(OrderedJson{{"worldPrev", "lod@prev"}, {"uv", "uv"}});
    OrderedJson hits = hitsNode();
    hits["in"]["worldPrev"] = "lod@prev";
    return {{"lod", {{"type", "lod_select"}}},
            {"uv", {{"type", "lod_uv_bvh_build"}}},
            {"hits", hits},
            {"initial", initialNode({{"bounces", 3}})},
            {"temporal", node("temporal_splat", in, std::move(temporal))},
            {"shade", shadeNode("temporal")}};
}

class Images : public Sheets {
protected:
    /// Level 0, 1, 0, 1, ... up to a frame.
    static OrderedJson flicker(int frames) {
        OrderedJson schedule = OrderedJson::array();
        for (int frame = 0; frame < frames; ++frame) schedule.push_back({{"frame", frame}, {"level", frame % 2}});
        return schedule;
    }
    static std::optional<glm::dvec2> unmapped(const SheetPoint&) { return std::nullopt; }
};

// The switch to the same surface cut otherwise changes nothing: all paths that land, land where they were, with the weights they had.
TEST_F(Images, Identity) {
    const std::vector<SheetLevel> levels{{.cells = 8, .place = flat}, {.cells = 8, .place = flat, .otherDiagonal = true}};
    const Path scene = write("identity", levels, switchAt(3));
    Frames frames(scene, {48, 32}, reuseNodes({{"suffix", "walked"}}), {"shade.color", "temporal.landed"});
    std::array<ImageData, 2> images, landed;
    for (const int switching : {0, 1}) {
        frames.set("lod.mode", Json(switching ? "scene" : "finest"));
        frames.restart(0, 7);
        frames.run(4);
        images[std::size_t(switching)] = frames.image("shade.color");
        landed[std::size_t(switching)] = frames.image("temporal.landed");
    }
    std::size_t different = 0, elsewhere = 0;
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 48; ++x) {
            elsewhere += landed[0].at(x, y, 0) != landed[1].at(x, y, 0);
            different += std::abs(images[0].at(x, y, 1) - images[1].at(x, y, 1)) > 1e-3f * images[0].at(x, y, 1);
        }
    }
    const double energy = sumOf(images[1]) / sumOf(images[0]), paths = sumOf(landed[1]) / sumOf(landed[0]);
    std::printf("identity: energy %.5f, landed %.5f of the run without a switch; %zu pixels differ, %zu land elsewhere, of 1536\n", energy, paths, different,
                elsewhere);
    EXPECT_LT(different, 16u);
    EXPECT_LT(elsewhere, 16u);
    EXPECT_NEAR(energy, 1, 1e-3);
    EXPECT_NEAR(paths, 1, 1e-3);
}

// A level that is forced between two frames is a switch as the schedule has it: the same bits, before and after, whatever else chooses the levels.
TEST_F(Images, ForcedIsAsScheduled) {
    const std::vector<SheetLevel> levels{{.cells = 8, .place = flat}, {.cells = 5, .place = flat}};
    Frames frames(write("forced", levels, switchAt(3)), {48, 32}, reuseNodes(), {"shade.color", "temporal.landed", "lod.chosen"});
    for (const char* mode : {"finest", "distance"}) {
        std::vector<ImageData> images[2];
        for (const bool forced : {false, true}) {
            frames.set("lod.mode", Json(forced ? mode : "schedule"));
            frames.set("lod.force", Json(""));
            frames.restart(0, 7);
            for (int frame = 0; frame < 6; ++frame) {
                if (forced && frame == 3) frames.set("lod.force", Json("*=1"));
                frames.run();
                images[forced].push_back(frames.image("shade.color"));
                images[forced].push_back(frames.image("temporal.landed"));
                EXPECT_EQ(frames.records<std::uint32_t>("lod.chosen").at(0), frame < 3 ? 0u : 1u);
            }
        }
        for (std::size_t i = 0; i < images[0].size(); ++i) EXPECT_TRUE(images[0][i].values == images[1][i].values) << mode << ", frame " << i / 2;
    }
}

// Two instances of one model, of which the left one switches: each path stays on its instance, with its coordinate; the right one keeps its
// triangles.
TEST_F(Images, OneOfTwoInstances) {
    writeLevels(folder.path, "bowl", {{.cells = 20, .place = bowl}, {.cells = 6, .place = bowl}});
    const Path scene =
        write("two", {"bowl"}, OrderedJson::array({OrderedJson{{"frame", 3}, {"level", 1}, {"instance", "left"}}}),
              {{"instances", OrderedJson::array({OrderedJson{{"model", "bowl"}, {"name", "left"}, {"translation", {-0.9, 0, 0}}, {"scale", 0.8}},
                                                 OrderedJson{{"model", "bowl"}, {"name", "right"}, {"translation", {0.9, 0, 0}}, {"scale", 0.8}}})}});
    Frames frames(scene, {64, 36}, reuseNodes({{"backup", 0}}), {"shade.color", "temporal.paths.samples", "initial.paths.samples", "temporal.landed"});
    frames.run(3);
    // A coordinate is carried along; where x1 is found by tracing again it is that of the same point, but for rounding.
    std::vector<SampleHit> before = frames.records<SampleHit>("temporal.paths.samples");
    frames.run();
    const std::vector<SampleHit> now = frames.records<SampleHit>("temporal.paths.samples"), fresh = frames.records<SampleHit>("initial.paths.samples");
    const std::uint32_t left = 0, fine = 20 * 20 * 2;
    std::array<std::size_t, 2> kept{};
    for (std::size_t i = 0; i < now.size(); ++i) {
        const PrimaryHit& hit = now[i].hit;
        if (hit.primitive == NONE || (hit.instance == fresh[i].hit.instance && now[i].uv == fresh[i].uv)) continue;
        ++kept[hit.instance];
        const bool known = std::ranges::any_of(before, [&](const SampleHit& s) {
            const bool same = s.hit.primitive != NONE && s.hit.instance == hit.instance && glm::distance(s.uv, now[i].uv) < 1e-5f;
            return same && (hit.instance == left || s.hit.primitive == hit.primitive);
        });
        EXPECT_TRUE(known) << "pixel " << i << ": a path from another instance, coordinate, or (on the right) triangle";
        EXPECT_EQ(hit.primitive >= fine, hit.instance == left);
    }
    std::printf("two instances: %zu paths of last frame on the one that switched, %zu on the other\n", kept[0], kept[1]);
    EXPECT_GT(kept[0], 100u);
    EXPECT_GT(kept[1], 100u);
    sumOf(frames.image("shade.color"));
    sumOf(frames.image("temporal.landed"));
}

// Confidence is lost with what it was about; as published it stays.
TEST_F(Images, ConfidenceStaysWhereTheCentreIsFound) {
    const std::vector<SheetLevel> levels{{.cells = 20, .place = bowl}, {.cells = 6, .place = bowl}};
    const Path scene = write("confidence", levels, switchAt(3));
    Frames frames(scene, {48, 32}, reuseNodes({{"backup", 0}}), {"hits.hits", "temporal.paths.reservoirs"});
    for (const char* mapping : {"uv", "triangle"}) {
        for (const char* inherits : {"where_found", "always"}) {
            frames.set("temporal.vertexMapping", Json(mapping));
            frames.set("temporal.inherits", Json(inherits));
            frames.restart(0, 7);
            frames.run(4);
            const auto paths = frames.records<Reservoir>("temporal.paths.reservoirs");
            const auto hits = frames.records<PrimaryHit>("hits.hits");
            const bool lost = mapping == std::string("triangle") && inherits == std::string("where_found");
            std::size_t onSheet = 0, unlike = 0;
            for (std::size_t i = 0; i < paths.size(); ++i) {
                const bool sheet = hits[i].primitive != NONE;
                onSheet += sheet;
                unlike += confidenceOf(paths[i]) != (sheet && lost ? 1 : 4);
            }
            EXPECT_GT(onSheet, 200u);
            EXPECT_EQ(unlike, 0u) << mapping << ", " << inherits;
            std::printf("confidence: %s, %s: %zu of %zu on the sheet, %zu unlike\n", mapping, inherits, onSheet, paths.size(), unlike);
        }
    }
}

// What is shown is counted: triangles over all instances, the bytes of a level once however many show it.
TEST_F(Images, CountsWhatIsShown) {
    const std::vector<SheetLevel> levels{{.cells = 20, .place = bowl}, {.cells = 6, .place = bowl}};
    writeLevels(folder.path, "bowl", levels);
    writeLevels(folder.path, "lamp", levels, {.emission = {5, 4, 3}});
    const auto at = [](const char* model, const char* name, double x) {
        return OrderedJson{{"model", model}, {"name", name}, {"translation", {x, 0, 0}}, {"scale", 0.5}};
    };
    const Path scene = write("counted", {"bowl", "lamp"}, OrderedJson::array({OrderedJson{{"frame", 0}, {"level", 1}, {"instance", "left"}}}),
                             {{"instances", OrderedJson::array({at("bowl", "left", -1), at("bowl", "right", 1), at("lamp", "lamp", 0)})}});
    Frames frames(scene, {64, 36}, {{"lod", {{"type", "lod_select"}}}, {"hits", hitsNode()}}, {"hits.hits", "lod.triangles", "lod.bytes"});
    const auto counted = [&](const char* mode, int level = 0) {
        frames.set("lod.mode", Json(mode));
        frames.set("lod.level", Json(level));
        frames.run();
        const auto number = [&](const char* port) {
            const std::vector<std::uint32_t> words = frames.records<std::uint32_t>(port);
            return words.at(0) + (std::uint64_t(words.at(1)) << 32);
        };
        return std::pair(number("lod.triangles"), number("lod.bytes"));
    };
    constexpr std::uint64_t fine = 20 * 20 * 2, coarse = 6 * 6 * 2;
    const auto [allFine, fineBytes] = counted("finest");
    EXPECT_EQ(allFine, 3 * fine);
    const auto [allCoarse, coarseBytes] = counted("fixed", 7);
    EXPECT_EQ(allCoarse, 3 * coarse);
    const auto [one, bothBytes] = counted("schedule");
    EXPECT_EQ(one, coarse + 2 * fine);
    // A lamp of the same 800 triangles takes what a bowl takes: 68 bytes a triangle, 48 a vertex, and 64 for each node, fewer of them than triangles.
    const std::uint64_t bowl = fineBytes / 2, coarseBowl = coarseBytes / 2;
    EXPECT_EQ(bothBytes, coarseBowl + fineBytes);
    const auto expectBytes = [&](std::uint64_t bytes, std::size_t level, std::uint64_t triangles) {
        const std::uint64_t least = 68 * triangles + 48 * frames.scene().meshes[0].levels[level].positions.size();
        EXPECT_GT(bytes, least);
        EXPECT_LT(bytes, least + 64 * triangles);
    };
    expectBytes(bowl, 0, fine);
    expectBytes(coarseBowl, 1, coarse);
}

// A mesh that glows switches like any other.
TEST_F(Images, EmitterSwitches) {
    const std::vector<SheetLevel> levels{{.cells = 8, .place = bowl}, {.cells = 4, .place = bowl}};
    writeLevels(folder.path, "lamp", levels, {.emission = {5, 4, 3}});
    const Path scene = write("lit", {"lamp"}, switchAt(2));
    Frames frames(scene, {64, 36}, reuseNodes(), {"shade.color", "hits.hits"});
    for (int frame = 0; frame < 4; ++frame) {
        frames.run();
        std::size_t seen = 0;
        for (const PrimaryHit& hit : frames.records<PrimaryHit>("hits.hits")) {
            if (hit.primitive == NONE) continue;
            ++seen;
            EXPECT_EQ(hit.primitive >= 128, frame >= 2) << "frame " << frame;
        }
        EXPECT_GT(seen, 100u);
        sumOf(frames.image("shade.color"));
    }
}

// An unlit mesh emits, but is no light: it switches like any other, at every level what it emits is seen, and paths that end on it are reused
// across the switch without a gain or a loss.
TEST_F(Images, UnlitMeshSwitches) {
    const std::vector<SheetLevel> levels{{.cells = 8, .place = flat}, {.cells = 4, .place = flat}};
    writeLevels(folder.path, "scan", levels, {.unlit = true});
    const Path scene = write("unlit", {"scan"}, switchAt(3), {{"instances", OrderedJson::array({OrderedJson{{"model", "scan"}}})}});
    Frames frames(scene, {64, 36}, reuseNodes(), {"shade.color", "hits.hits"});
    for (int frame = 0; frame < 5; ++frame) {
        frames.run();
        std::size_t seen = 0;
        const ImageData image = frames.image("shade.color");
        const std::vector<PrimaryHit> hits = frames.records<PrimaryHit>("hits.hits");
        for (std::size_t i = 0; i < hits.size(); ++i) {
            if (hits[i].primitive == NONE) continue;
            ++seen;
            EXPECT_EQ(hits[i].primitive >= 128, frame >= 3) << "frame " << frame;
            const bool isInside = std::ranges::all_of(std::array<std::size_t, 4>{i - 64, i - 1, i + 1, i + 64}, [&](std::size_t next) {
                return next < hits.size() && hits[next].primitive != NONE;
            });
            if (!isInside) continue;  // a path of the pixel may pass beside the edge
            EXPECT_NEAR(image.values[i * std::size_t(image.channels)], 0.7f, 1e-3f) << "frame " << frame << ", pixel " << i;
        }
        EXPECT_GT(seen, 100u);
    }
}

/// The coarse level is a ridge that hides much of what the camera saw.
glm::dvec3 ridge(glm::dvec2 p) {
    const glm::dvec3 b = bowl(p);
    return {b.x, b.y + 0.9 * std::exp(-20 * (p.y - 0.75) * (p.y - 0.75)), b.z};
}

TEST_F(Images, SelfOccluding) {
    const Path scene = write("hidden", {{.cells = 20, .place = bowl}, {.cells = 10, .place = ridge}}, switchAt(3));
    Frames frames(scene, {64, 36}, reuseNodes({{"backup", 0}}), {"shade.color", "temporal.landed"});
    frames.run(3);
    const double before = sumOf(frames.image("temporal.landed"));
    frames.run();
    const double at = sumOf(frames.image("temporal.landed"));
    sumOf(frames.image("shade.color"));
    frames.run();
    const double after = sumOf(frames.image("temporal.landed"));
    std::printf("self-occluding: %.0f paths landed in the frame before the switch, %.0f in its own, %.0f in the next\n", before, at, after);
    EXPECT_LT(at, 0.9 * before);
    EXPECT_GT(at, 0.1 * before);
    EXPECT_GT(after, at);
}

/// Mean squared error of two images of a frame, over runs: with reuse across the switch and by spatial reuse alone.
struct Errors {
    double mapped = 0, spatial = 0;
};

// At every frame another level, with normals that differ: reuse is worth its while all the same.
TEST_F(Images, ReusePays) {
    const glm::dvec3 tilted = glm::normalize(glm::dvec3(0.25, 1, 0.1));
    const std::vector<SheetLevel> same{{.cells = 20, .place = bowl}, {.cells = 16, .place = bowl}};
    std::vector<SheetLevel> different = same;
    different[0].normal = glm::dvec3(0, 1, 0);
    different[1].normal = tilted;
    const glm::uvec2 size{32, 18};
    const int last = 4;
    for (const auto& [name, levels] : {std::pair<const char*, const std::vector<SheetLevel>&>{"flicker", same}, {"normals", different}}) {
        const Path scene = write(name, levels, flicker(last + 2));
        Frames reference(scene, size, {{"trace", node("path_tracer", OrderedJson::object(), {{"spp", 1024}, {"bounces", 3}})}}, {"trace.color"});
        reference.restart(last, 1);
        reference.run();
        const ImageData right = reference.image("trace.color");

        OrderedJson nodes = reuseNodes();
        nodes["temporal"]["in"]["history"] = "spatial@prev";
        nodes["spatial"] = node("spatial_reuse", pathsOf("temporal"), {{"radius", 5}});
        nodes["alone"] = node("spatial_reuse", pathsOf("initial"), {{"radius", 5}});
        nodes["both"] = shadeNode("spatial");
        nodes["near"] = shadeNode("alone");
        Frames frames(scene, size, nodes, {"both.color", "near.color"});
        Errors errors;
        const auto error = [&](const ImageData& image) {
            double sum = 0;
            for (int y = 0; y < right.height; ++y)
                for (int x = 0; x < right.width; ++x) sum += std::pow(image.at(x, y, 1) - right.at(x, y, 1), 2);
            return sum / (right.width * right.height);
        };
        for (std::uint32_t run = 0; run < 8; ++run) {
            frames.restart(0, 100 + run);
            frames.run(last + 1);
            errors.mapped += error(frames.image("both.color"));
            errors.spatial += error(frames.image("near.color"));
        }
        std::printf("%s: squared error %.3f of what spatial reuse alone has\n", name, errors.mapped / errors.spatial);
        EXPECT_LT(errors.mapped, 0.8 * errors.spatial) << name;
    }
}

/// Reuse across a switch against path tracing.
class Switches : public Images, public testing::WithParamInterface<int> {
protected:
    /// Name, and scene that switches at frame 3.
    std::pair<std::string, Path> make() {
        const auto doubled = [](const SheetPoint& p) { return std::optional(glm::dvec2(p.at.x - (p.cell.x > 0.5 ? 0.5 : 0), p.at.y)); };
        const auto cut = [](double at) {
            return [at](const SheetPoint& p) { return std::optional(glm::dvec2(p.at.x + (p.cell.x > at ? 0.2 : 0), p.at.y)); };
        };
        switch (GetParam()) {
            case 0: return {"identity", write("identity", {{.cells = 8, .place = bowl}, {.cells = 8, .place = bowl}}, switchAt(3))};
            case 1: return {"flicker", write("flicker", {{.cells = 20, .place = bowl}, {.cells = 7, .place = bowl}}, flicker(6))};
            case 2:
                return {"without coordinates",
                        write("bare", {{.cells = 20, .place = bowl, .uv = unmapped}, {.cells = 7, .place = bowl, .uv = unmapped}}, switchAt(3))};
            case 3:
                return {"unequal counts",
                        write("unequal",
                              {{.cells = 20, .place = bowl, .uv = doubled},
                               {.cells = 8, .place = bowl, .uv = [=](const SheetPoint& p) { return p.cell.x > 0.5 ? doubled(p) : p.at + 3.0; }}},
                              switchAt(3))};
            case 4:
                return {"moved seam",
                        write("seam", {{.cells = 16, .place = bowl, .uv = cut(0.5)}, {.cells = 8, .place = bowl, .uv = cut(0.375)}}, switchAt(3))};
            case 5: return {"degenerate", write("pinched", {{.cells = 9, .place = bowl, .uv = pinched}, {.cells = 18, .place = bowl}}, switchAt(3))};
            case 6: return {"hidden", write("hidden", {{.cells = 20, .place = bowl}, {.cells = 10, .place = ridge}}, switchAt(3))};
            case 7:
                return {"moving",
                        write("moving", {{.cells = 20, .place = bowl}, {.cells = 7, .place = bowl}}, switchAt(3), {.moveTo = glm::dvec3(1.2, 0.5, -0.6)})};
            default: {
                writeLevels(folder.path, "lamp", {{.cells = 4, .place = flat}, {.cells = 2, .place = flat}}, {.emission = {6, 5, 4}});
                writeLevels(folder.path, "bowl", {{.cells = 20, .place = bowl}, {.cells = 7, .place = bowl}});
                return {"lamp", write("lit", {"lamp", "bowl"}, switchAt(3),
                                      {{"instances", OrderedJson::array({OrderedJson{{"model", "lamp"}, {"translation", {-0.2, 0.9, -0.3}}, {"scale", 0.3}},
                                                                         OrderedJson{{"model", "bowl"}}})}})};
            }
        }
    }
};

TEST_P(Switches, KeepTheEnergy) {
    const auto [name, scene] = make();
    const auto graph = [](const char* file, std::optional<std::string> variant, std::vector<Setting> set) {
        return StudyGraph{.graph = sourceFolder / "graphs" / file, .variant = variant, .set = std::move(set), .port = {}, .where = {}};
    };
    EnsembleJudge judge({.scene = scene,
                         .size = {32, 18},
                         .warmup = 3,
                         .frame = 3,
                         .runs = 32,
                         .reference = graph("path_tracer.json", "no accumulation", {}),
                         .referenceSamples = 1024,
                         .device = sharedDevice()});
    const auto keeps = [&](const StudyGraph& technique) {
        const EnsembleResult result = judge.judge(technique);
        std::printf("%s, %s: %+.2f %% +- %.2f %%\n", name.c_str(), technique.graph.stem().c_str(),
                    100 * (result.energy[0] / result.referenceEnergy[0] - 1), 100 * result.halfWidth);
        EXPECT_EQ(result.verdict, Verdict::unbiased) << name << ": " << result.reason;
        EXPECT_LE(result.halfWidth, 0.01) << name;
    };
    keeps(graph("restir_lod.json", {}, {{"initial.candidates", Json(2)}, {"spatial.radius", Json(5)}}));
    // With footprints and shared shifts where the surface stays, moves, and shines.
    if (name == "flicker" || name == "moving" || name == "lamp")
        keeps(graph("restir_lod_enhanced.json", {}, {{"initial.candidates", Json(2)}, {"initial.lightCandidates", Json(4)}, {"pairing.radius", Json(4)}}));
}

INSTANTIATE_TEST_SUITE_P(, Switches, testing::Range(0, 9));

}  // namespace
}  // namespace lodestir::test
