// SPDX-License-Identifier: MIT
// Impostors as surfaces that paths begin on: where their points are and move to, what light finds on them, and whether reuse keeps its mean there.
#include "body.h"
#include "frames.h"
#include "program.h"

#include <framework/image/metrics.h>
#include <framework/shaders/impostor/surfel.h>
#include <framework/shaders/world/primary_hit.h>
#include <framework/study/ensemble/ensemble.h>

#include <algorithm>
#include <cmath>

namespace lodestir::test {
namespace {

constexpr std::uint32_t nothing = 0xffffffffu;
constexpr std::uint32_t texel = 0x80000000u;

/// A scene file around a model: a sky of radiance 1, and a camera that goes sideways by `step` a frame.
Path writeScene(const Path& folder, const Path& model, const glm::dvec3& from, double step = 0) {
    const auto camera = [&](int frame) {
        const double x = from.x + step * frame;
        return OrderedJson{{"position", {x, from.y, from.z}}, {"target", {x, 0, 0}}, {"up", {0, 1, 0}}, {"fovy", 30}};
    };
    OrderedJson moving = camera(0), last = camera(8);
    last["frame"] = 8;
    moving["keyframes"] = {last};
    if (step != 0) {
        OrderedJson first = camera(0);
        first["frame"] = 0;
        moving["keyframes"] = {first, last};
    } else {
        moving.erase("keyframes");
    }
    writeFile(folder / "scene.json", OrderedJson{{"format", 1},
                                                 {"about", "made by a test"},
                                                 {"models", {{"model", {{"file", model.filename().string()}}}}},
                                                 {"environment", {{"type", "constant"}, {"color", {1, 1, 1}}, {"strength", 1}}},
                                                 {"camera", moving}}
                                         .dump(2));
    return folder / "scene.json";
}

/// Camera hits that are texels where impostors are drawn, and those of the geometry.
OrderedJson hitsOfBoth(OrderedJson bake = {{"resolution", 128}}, OrderedJson draw = OrderedJson::object()) {
    bake.update({{"points", 0}});
    return {{"bake", {{"type", "impostor_bake"}, {"set", bake}}},
            {"draw", {{"type", "impostor_forward_map"}, {"in", {{"world", "scene"}}}, {"set", draw}}},
            {"fill", {{"type", "hole_fill"}, {"in", {{"surfels", "draw"}}}}},
            {"hits",
             {{"type", "visibility"},
              {"in", {{"world", "draw.world"}, {"worldPrev", "draw.world@prev"}, {"surfels", "fill"}, {"rest", "draw.rest"}}},
              {"set", {{"film", "centre"}, {"lens", false}}}}},
            {"truth", {{"type", "visibility"}, {"in", {{"world", "scene"}, {"worldPrev", "scene@prev"}}}, {"set", {{"film", "centre"}, {"lens", false}}}}}};
}

class ImpostorPaths : public testing::Test {
protected:
    TemporaryFolder folder;
};

// If this fails, a point of a texel isn't where the pixel shows it, was elsewhere in the last frame, or is of another surface.
TEST_F(ImpostorPaths, PointsAreWhereTheGeometryIsAndMoveAsItDoes) {
    Body body(1);
    body.sphere(1);
    const Path model = body.write(folder.path, "balls", {{-1.1f, 0, 0}, {1.1f, 0, 0}});
    Frames frames(writeScene(folder.path, model, {0, 0.5, 8}, 0.05), {128, 128}, hitsOfBoth(),
                  {"hits.hits", "hits.depth", "hits.motion", "hits.normal", "hits.albedo", "truth.depth", "truth.motion", "truth.normal", "truth.albedo"});
    frames.run(3);
    const std::vector<PrimaryHit> hits = frames.records<PrimaryHit>("hits.hits");
    const ImageData depth = frames.image("hits.depth"), trueDepth = frames.image("truth.depth"), motion = frames.image("hits.motion");
    const ImageData trueMotion = frames.image("truth.motion"), normal = frames.image("hits.normal"), trueNormal = frames.image("truth.normal");
    const ImageData albedo = frames.image("hits.albedo"), trueAlbedo = frames.image("truth.albedo");
    double both = 0, apart = 0, moved = 0, turned = 0, worst = 0, one = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        if (hits[i].primitive == nothing) continue;
        EXPECT_GE(hits[i].primitive, texel) << "geometry shows at pixel " << i;
        if (trueDepth.values[i] == 0) continue;
        ++both;
        apart += std::abs(depth.values[i] - trueDepth.values[i]);
        const double away = std::hypot(motion.values[2 * i] - trueMotion.values[2 * i], motion.values[2 * i + 1] - trueMotion.values[2 * i + 1]);
        moved += away;
        worst = std::max(worst, away);
        double cosine = 0;
        for (std::size_t c = 0; c < 3; ++c) cosine += double(normal.values[4 * i + c]) * trueNormal.values[4 * i + c];
        turned += std::acos(std::min(cosine, 1.0)) * 180 / 3.14159265;
        one += albedo.values[4 * i] == trueAlbedo.values[4 * i];
    }
    const double width = 8 * 2 * 0.2679491924 / 128;
    std::printf("depth %.3f pixels' widths off, motion %.4f pixels (at most %.3f), normals %.2f degrees\n", apart / both / width, moved / both, worst,
                turned / both);
    EXPECT_GT(both, 4000);
    EXPECT_LT(apart / both, 0.25 * width);
    EXPECT_LT(moved / both, 0.002);
    EXPECT_LT(worst, 0.05);
    EXPECT_LT(turned / both, 1);
    EXPECT_EQ(one, both);
}

// A white ball under a sky of radiance 1 shows what its geometry does: if it is darker, rays that leave a texel meet the mesh that stands for the object,
// which is coarse, so that its corners reach out of the texels.
TEST_F(ImpostorPaths, TheMeshThatStandsForItThrowsNoShadowOnIt) {
    Body body(1);
    body.sphere(1);
    body.material(0)["pbrMetallicRoughness"] = {{"baseColorFactor", {1, 1, 1, 1}}, {"roughnessFactor", 1}, {"metallicFactor", 0}};
    const Path model = folder.path / "levels.glb";
    ASSERT_EQ(lodestir({"lod", body.write(folder.path, "ball").string(), "--levels", "6", "--out", model.string()}).exitCode, 0);
    OrderedJson passes = hitsOfBoth();
    passes["lod"] = {{"type", "lod_select"}, {"in", {{"world", "scene"}, {"worldPrev", "lod.world@prev"}}}, {"set", {{"mode", "fixed"}, {"level", 5}}}};
    passes["draw"]["in"]["world"] = "lod.world";
    passes["trace"] = {{"type", "path_tracer"}, {"in", {{"world", "draw.world"}, {"hits", "hits"}}}, {"set", {{"bounces", 1}, {"spp", 64}}}};
    passes["direct"] = {{"type", "path_tracer"},
                        {"in", {{"world", "scene"}, {"hits", "truth"}}},
                        {"set", {{"bounces", 1}, {"spp", 64}}}};
    for (const double distance : {6.0, 24.0}) {
        Frames frames(writeScene(folder.path, model, {0.3, 0.5, distance}), {96, 96}, passes, {"trace.color", "direct.color", "hits.hits", "truth.hits"});
        frames.run();
        const ImageData color = frames.image("trace.color"), direct = frames.image("direct.color");
        const std::vector<PrimaryHit> hits = frames.records<PrimaryHit>("hits.hits"), truth = frames.records<PrimaryHit>("truth.hits");
        double sum = 0, count = 0, least = 1, trueSum = 0;
        for (std::size_t i = 0; i < hits.size(); ++i) {
            if (hits[i].primitive == nothing || truth[i].primitive == nothing) continue;
            ++count;
            sum += color.values[4 * i];
            trueSum += direct.values[4 * i];
            least = std::min(least, double(color.values[4 * i]));
        }
        std::printf("from %g: %.4f, geometry %.4f, darkest pixel %.3f\n", distance, sum / count, trueSum / count, least);
        EXPECT_GT(count, 100);
        EXPECT_NEAR(sum / count, trueSum / count, 0.01);
    }
}

// If this fails, reuse shifts paths to or from texels with a wrong Jacobian, or sees through them where path tracing doesn't.
/// Judges ReSTIR PT on a scene's impostors by path tracing of the same.
void expectReuseUnbiased(const Path& scene) {
    const std::vector<Setting> set{{"draw.film", Json("centre")}, {"hits.film", Json("centre")}, {"bake.views", Json(6)},
                                   {"draw.pixelError", Json(0.0)}, {"draw.hysteresis", Json(0.0)}};
    const Path graph = sourceFolder / "graphs/impostor_restir.json";
    EnsembleJudge judge({.scene = scene,
                         .size = {32, 32},
                         .warmup = 3,
                         .frame = 3,
                         .runs = 64,
                         .reference = {.graph = graph, .variant = "path traced", .set = set, .port = {}, .where = {}},
                         .referenceSamples = 2048,
                         .device = sharedDevice()});
    std::vector<Setting> reuse = set;
    reuse.push_back({"spatial.radius", Json(5)});
    const EnsembleResult result = judge.judge({.graph = graph, .variant = {}, .set = reuse, .port = {}, .where = {}});
    std::printf("%+.2f %% +- %.2f %%\n", 100 * (result.energy[0] / result.referenceEnergy[0] - 1), 100 * result.halfWidth);
    EXPECT_EQ(result.verdict, Verdict::unbiased) << result.reason;
    EXPECT_LE(result.halfWidth, 0.01);
}

TEST(ImpostorPathsUnbiased, ReuseHasTheMeanOfPathTracing) { expectReuseUnbiased(sceneFile("deer")); }

// The camera goes away: history saw other texels, of finer levels with fewer materials each.
TEST_F(ImpostorPaths, ReuseHasTheMeanOfPathTracingWhereLevelsChange) {
    OrderedJson scene = OrderedJson::parse(readText(sourceFolder / "scenes/deer.json"));
    OrderedJson& camera = scene["camera"];
    const auto key = [&](int frame, double away) {
        OrderedJson position = camera["target"];
        for (std::size_t i = 0; i < 3; ++i) {
            const double target = camera["target"][i].get<double>();
            position[i] = target + away * (camera["position"][i].get<double>() - target);
        }
        return OrderedJson{{"frame", frame}, {"position", position}, {"target", camera["target"]}};
    };
    camera["keyframes"] = OrderedJson::array({key(0, 0.6), key(3, 1.3)});
    const Path file = folder.path / "away.json";
    writeFile(file, scene.dump());

    Frames frames(file, {32, 32},
                  {{"bake", {{"type", "impostor_bake"}, {"set", {{"views", 6}, {"points", 0}}}}},
                   {"draw", {{"type", "impostor_forward_map"}, {"set", {{"hysteresis", 0}}}}}},
                  {"draw.levels"});
    std::set<std::uint32_t> levels;  // of any instance
    for (int frame = 0; frame < 4; ++frame) {
        frames.run();
        const auto drawn = frames.records<std::uint32_t>("draw.levels");
        for (std::size_t i = 0; i < frames.scene().instances.size(); ++i) levels.insert(std::uint32_t(i) << 4 | (drawn[i] & 15u));
    }
    EXPECT_GT(levels.size(), frames.scene().instances.size());
    expectReuseUnbiased(file);
}

// If this fails, geometry and impostor don't take over from each other: both are gone for a frame, holes are filled where the geometry still shows, or it pops.
TEST_F(ImpostorPaths, GeometryFadesIntoTheImpostorAndBack) {
    OrderedJson passes = hitsOfBoth({{"resolution", 128}, {"mesh", "bunny"}}, {{"hysteresis", 0}});
    passes["hits"]["in"].erase("worldPrev");
    passes["shade"] = {{"type", "reshade"}, {"in", {{"world", "draw.world"}, {"hits", "hits"}}}};
    passes.erase("truth");
    Frames frames(sceneFile("bunny"), {128, 128}, passes, {"shade.color", "hits.hits"});
    const auto picture = [&] {
        ImageData color = firstChannels(frames.image("shade.color"), 3);
        for (float& value : color.values) value *= float(std::exp2(frames.scene().exposure));
        return color;
    };
    const auto texels = [&] {
        const std::vector<PrimaryHit> hits = frames.records<PrimaryHit>("hits.hits");
        return std::ranges::count_if(hits, [](const PrimaryHit& h) { return h.primitive >= texel && h.primitive != nothing; });
    };
    const auto hard = [&](double pixelError) {
        frames.set("draw.pixelError", Json(pixelError));
        frames.restart(0);
        frames.run();
        return picture();
    };
    const ImageData impostor = hard(0);
    const auto all = texels();
    const ImageData geometry = hard(0.001);  // texels are nowhere so small
    EXPECT_EQ(texels(), 0);
    EXPECT_GT(all, 2000);
    const double flip = evaluate("flip_ldr", impostor, geometry, {});
    frames.set("draw.transition", Json(7));
    ImageData last = geometry;
    for (const bool toImpostor : {true, false}) {
        frames.set("draw.pixelError", Json(toImpostor ? 0.0 : 0.001));
        double most = 0;
        for (int frame = 0; frame < 8; ++frame) {
            frames.run();
            const ImageData now = picture();
            most = std::max(most, evaluate("flip_ldr", now, last, {}));
            last = now;
            const double share = double(texels()) / double(all), wanted = (frame + 1) / 8.0;
            EXPECT_NEAR(share, toImpostor ? wanted : 1 - wanted, 0.05) << frame;
        }
        std::printf("FLIP of the switch %.4f, of eight steps at most %.4f\n", flip, most);
        EXPECT_LT(most, 0.5 * flip);
        EXPECT_EQ(last.values, (toImpostor ? impostor : geometry).values);
    }
}

// A graph that draws impostors over the geometry that they stand for is told so.
TEST_F(ImpostorPaths, TheRestIsAskedFor) {
    Body body(1);
    body.sphere(1);
    OrderedJson passes = hitsOfBoth();
    passes["hits"]["in"].erase("rest");
    Frames frames(writeScene(folder.path, body.write(folder.path, "ball"), {0, 0, 6}), {32, 32}, passes, {"hits.depth"});
    try {
        frames.run();
        FAIL() << "surfels without rest are taken";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("rest"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace lodestir::test
