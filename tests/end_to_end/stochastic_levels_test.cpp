// SPDX-License-Identifier: MIT
// Levels that are chosen ray by ray: how many rays see which, that all of a path see the same, whoever traces them, and that reuse keeps the mean.
#include "planted_faults.h"
#include "render.h"
#include "sheets.h"
#include "shift_session.h"

#include <framework/graph/runner.h>
#include <framework/shaders/world/primary_hit.h>
#include <framework/study/ensemble/ensemble.h>

#include <array>
#include <cmath>
#include <map>
#include <optional>

namespace lodestir::test {
namespace {

/// Settings of lod_select by which every instance of two levels is at l of them, whatever its depth.
OrderedJson atLevel(double l) {
    // Far before depthNear l is -2, and the bias is the rest.
    return {{"mode", "stochastic"}, {"curve", "linear"}, {"depthNear", 1e5}, {"depthFar", 2e5}, {"transition", 1}, {"bias", l + 2}};
}
OrderedJson lodNode(double l) { return node("lod_select", OrderedJson::object(), atLevel(l)); }

class StochasticLevels : public Sheets {
protected:
    /// The same plane cut in two ways, into 128 and into 32 triangles.
    Path twoCuts() { return write("cuts", {{.cells = 8, .place = flat}, {.cells = 4, .place = flat}}, OrderedJson::array()); }
    /// A plane whose coarser level lies under the finer one, and a sky of radiance 1.
    Path twoPlanes() {
        const auto plane = [](double y) { return [y](glm::dvec2 p) { return glm::dvec3(400 * p.x - 200, y, 400 * p.y - 200); }; };
        writeLevels(folder.path, "plane", {{.cells = 4, .place = plane(0)}, {.cells = 2, .place = plane(-0.05)}});
        return write("plane", {"plane"}, OrderedJson::array(),
                     {{"environment", {{"type", "constant"}, {"color", {1, 1, 1}}}},
                      {"lights", OrderedJson::array()},
                      {"camera", {{"position", {0, 3, 0.01}}, {"target", {0, 0, 0}}, {"fovy", 20}}}});
    }
    static bool isCoarse(const PrimaryHit& hit) { return hit.primitive != NONE && hit.primitive >= 128; }
};

// Eight steps: of the rays that meet the instance so many eighths see the coarser level, none outside a transition, and each frame others.
TEST_F(StochasticLevels, ShareOfRays) {
    Frames frames(twoCuts(), {64, 36}, {{"lod", lodNode(0)}, {"hits", hitsNode()}}, {"hits.hits"});
    for (const char* numbers : {"shared", "each"}) {
        frames.set("lod.numbers", Json(numbers));
        for (const auto& [l, eighths] : std::vector<std::pair<double, int>>{{0.05, 0}, {0.2, 1}, {0.5, 4}, {0.8, 7}, {0.95, 8}}) {
            frames.set("lod.bias", Json(l + 2));
            std::size_t coarse = 0, all = 0, changed = 0;
            std::vector<PrimaryHit> last;
            for (int frame = 0; frame < 4; ++frame) {
                frames.run();
                const std::vector<PrimaryHit> hits = frames.records<PrimaryHit>("hits.hits");
                for (std::size_t i = 0; i < hits.size(); ++i) {
                    all += hits[i].primitive != NONE;
                    coarse += isCoarse(hits[i]);
                    changed += frame > 0 && isCoarse(hits[i]) != isCoarse(last[i]);
                }
                last = hits;
            }
            ASSERT_GT(all, 1000u);
            const auto expectShare = [&](std::size_t count, double of, double share, const char* what) {
                EXPECT_NEAR(double(count) / of, share, 4 * std::sqrt(share * (1 - share) / of)) << what << ", " << numbers << ", l = " << l;
            };
            const double share = eighths / 8.0;
            expectShare(coarse, double(all), share, "rays that see the coarser level");
            expectShare(changed, 0.75 * double(all), 2 * share * (1 - share), "pixels that see another level than a frame ago");
        }
    }
}

// Numbers belong to rays, not to those who trace them: every body finds the same hits, in steps that masks can hold and in others.
TEST_F(StochasticLevels, BodiesAgree) {
    const Path scene = write("bowls", {{.cells = 20, .place = bowl}, {.cells = 6, .place = bowl}}, OrderedJson::array());
    for (const auto& [numbers, steps] : std::vector<std::pair<const char*, int>>{{"shared", 8}, {"shared", 5}, {"each", 8}}) {
        OrderedJson lod = lodNode(0.5);
        lod["set"].update(OrderedJson{{"numbers", numbers}, {"steps", steps}, {"bias", 2.3}});
        const OrderedJson graph = {{"format", 1},
                                   {"scene", scene.string()},
                                   {"frame", {{"size", {64, 36}}, {"seed", 1}}},
                                   {"passes", {{"lod", lod}, {"trace", node("path_tracer", OrderedJson::object(), {{"spp", 4}, {"bounces", 2}})}}},
                                   {"show", "trace"}};
        writeFile(folder.path / "graph.json", graph.dump(2));
        const auto frames = [&](const std::string& body) { return render(folder.path / "graph.json", "trace", 2, {}, body); };
        const std::vector<ImageData> best = frames("");
        for (const char* body : {"lane", "ray_query"}) {
            if (body == std::string("ray_query") && !sharedDevice()->facts().rayQuery) continue;
            const std::vector<ImageData> other = frames(body);
            std::size_t differ = 0;
            for (std::size_t i = 0; i < best[1].values.size(); ++i)
                differ += std::abs(best[1].values[i] - other[1].values[i]) > 1e-3f * (1 + std::abs(best[1].values[i]));
            EXPECT_LE(differ, best[1].values.size() / 200) << body << ", " << numbers << ", " << steps << " steps";
        }
    }
}

// A plane whose two levels lie one over the other, under a sky of radiance 1: neither shadows itself, so the picture is that of either. Where each ray has a
// number of its own, the share b of the camera rays meets the lower, coarser level, and of the rays from there 1 - b end under the upper one.
TEST_F(StochasticLevels, NoFalseShadows) {
    Frames frames(twoPlanes(), {64, 64}, {{"lod", lodNode(0)}, {"trace", node("path_tracer", OrderedJson::object(), {{"spp", 16}, {"bounces", 1}})}},
                  {"trace.color"});
    const auto mean = [&](double l) {
        frames.set("lod.bias", Json(l + 2));
        frames.restart(0, 1);
        frames.run();
        const ImageData image = frames.image("trace.color");
        double sum = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) sum += image.at(x, y, 1);
        return sum / (image.width * image.height);
    };
    for (const char* technique : {"both", "light", "bsdf"}) {
        frames.set("trace.technique", Json(technique));
        frames.set("trace.numbers", Json("path"));
        const double settled = mean(0);
        for (const auto& [l, share] : std::vector<std::pair<double, double>>{{0.2, 0.125}, {0.5, 0.5}, {0.8, 0.875}}) {
            frames.set("trace.numbers", Json("path"));
            EXPECT_NEAR(mean(l) / settled, 1, 1e-3) << technique << ", l = " << l;
            frames.set("trace.numbers", Json("ray"));
            EXPECT_NEAR(mean(l) / settled, 1 - share * (1 - share), 0.01) << technique << ", l = " << l;
            // Rays that see the upper level first and the lower one farther on: those from the lower one end. Not where the former is nothing.
            frames.set("trace.fineReach", Json(1e5));
            EXPECT_NEAR(mean(l) / settled, 1 - share, 0.01) << technique << ", l = " << l;
            frames.set("trace.fineReach", Json(1e-6));
            EXPECT_NEAR(mean(l) / settled, 1, 1e-3) << technique << ", l = " << l;
            frames.set("trace.fineReach", Json(0));
        }
    }
}

// Paths see one of two scenes, so that pictures blend: that of b is (1 - b) times the finer level's and b times the coarser one's.
TEST_F(StochasticLevels, PicturesBlend) {
    const auto floating = [](glm::dvec2 p) { return glm::dvec3(0.5, 1, 0.5) * bowl(p) + glm::dvec3(0, 0.5, 0); };
    writeLevels(folder.path, "bowl", {{.cells = 20, .place = bowl}, {.cells = 5, .place = floating}});
    Frames frames(write("blend", {"bowl"}, OrderedJson::array()), {64, 36},
                  {{"lod", lodNode(0)}, {"trace", node("path_tracer", OrderedJson::object(), {{"spp", 256}})}}, {"trace.color"});
    std::map<int, ImageData> images;
    for (const int eighths : {0, 3, 8}) {
        frames.set("lod.bias", Json(2 + (eighths + 0.5) / 9));
        frames.run();
        images[eighths] = frames.image("trace.color");
    }
    double difference = 0, apart = 0;
    std::size_t values = 0;
    for (std::size_t i = 0; i < images[0].values.size(); ++i) {
        const double fine = images[0].values[i], coarse = images[8].values[i], between = coarse - fine;
        if (std::abs(between) < 0.1) continue;  // where both show the same, but for noise
        ++values;
        apart += std::abs(between);
        difference += (images[3].values[i] - (fine + 0.375 * between)) * (between > 0 ? 1 : -1);
    }
    std::printf("%zu values that differ, the blend off by %.4f of what they differ by\n", values, difference / apart);
    EXPECT_GT(values, 500u);
    EXPECT_NEAR(difference / apart, 0, 0.02);
}

// Reuse sees no shadows either: with any number all pixels of the two planes see the whole sky, so that the picture is that of one plane. Where paths keep
// the number they were made by in pixels that have another, it isn't.
TEST_F(StochasticLevels, NoFalseShadowsInReuse) {
    plant(folder.path, {{"other_number", "spatial_reuse", "restir/path_vertex.glsl", "rules.pixelCamera != 0u ? numberOfPixel(w, p) : numberOfPath(seed)",
                         "numberOfPath(seed)"}});
    const Path scene = twoPlanes();
    const auto differing = [&](const char* camera, const char* spatial) {
        OrderedJson hits = hitsNode(), temporal = pathsOf("initial", "spatial");
        hits["in"]["worldPrev"] = temporal["worldPrev"] = "lod@prev";
        Frames frames(scene, {64, 36},
                      {{"lod", lodNode(0)},
                       {"hits", hits},
                       {"initial", node("initial_sampling", {{"hits", "hits"}}, {{"bounces", 1}, {"camera", camera}})},
                       {"temporal", node("temporal_reprojection", temporal)},
                       {"spatial", node(spatial, pathsOf("temporal"), {{"radius", 5}})},
                       {"shade", shadeNode("spatial")}},
                      {"shade.color"}, {folder.path});
        std::array<ImageData, 2> images;
        for (int between = 0; between < 2; ++between) {
            frames.set("lod.bias", Json(2 + 0.5 * between));
            frames.restart(0, 1);
            frames.run(3);
            images[std::size_t(between)] = frames.image("shade.color");
        }
        std::size_t differ = 0;
        for (int y = 0; y < 36; ++y)
            for (int x = 0; x < 64; ++x) differ += std::abs(images[0].at(x, y, 1) - images[1].at(x, y, 1)) > 1e-3f * images[0].at(x, y, 1);
        return double(differ) / (64 * 36);
    };
    // Reuse spreads a path that rounding lets choose otherwise over some pixels.
    EXPECT_LT(differing("path", "spatial_reuse"), 0.05);
    EXPECT_LT(differing("hits", "spatial_reuse"), 0.05);
    EXPECT_GT(differing("hits", "other_number"), 0.2);
}

/// Reuse of paths while an instance dissolves, against path tracing: a bowl in a corner, whose coarser level floats above the finer one, with other
/// normals. Walls see it shadow the sun, and it them, so that what follows x_k depends on its level as well.
class DissolvingReuse : public StochasticLevels {
protected:
    /// A graph like graphs/stochastic_lod.json whose spatial reuse is of another type.
    Path graphWith(const std::string& type) {
        OrderedJson graph = OrderedJson::parse(readText(sourceFolder / "graphs/stochastic_lod.json"));
        graph["scene"] = scene_.string();
        graph["passes"]["spatial"]["type"] = type;
        writeFile(folder.path / (type + ".json"), graph.dump(2));
        return folder.path / (type + ".json");
    }
    StudyGraph variant(const Path& graph, const std::string& name, std::vector<Setting> set = {}) {
        for (const auto& [parameter, value] : levels_.items())
            set.push_back({"lod." + parameter, value.is_string() ? Json(value.get<std::string>()) : Json(value.get<double>())});
        return {.graph = graph, .variant = name, .set = std::move(set), .port = {}, .where = {}};
    }
    EnsembleResult judge(const std::string& name, const std::string& type) {
        if (!judge_) {
            judge_.emplace(EnsembleSetup{.scene = scene_,
                                         .size = {32, 18},
                                         .warmup = 3,
                                         .frame = 3,
                                         .runs = 64,
                                         .reference = variant(graphWith("spatial_reuse"), "path tracing"),
                                         .referenceSamples = 1024,
                                         .renderer = {.passes = {folder.path}, .device = {}, .rays = {}},
                                         .device = sharedDevice()});
        }
        const EnsembleResult result = judge_->judge(variant(graphWith(type), name, {{"initial.candidates", Json(2)}, {"spatial.radius", Json(5)}}));
        std::printf("%s, %s: %+.2f %% +- %.2f %%: %s\n", name.c_str(), type.c_str(), 100 * (result.energy[0] / result.referenceEnergy[0] - 1),
                    100 * result.halfWidth, result.reason.c_str());
        return result;
    }
    void SetUp() override {
        const auto floating = [](glm::dvec2 p) { return bowl(p) + glm::dvec3(0, 0.2, 0); };
        writeLevels(folder.path, "bowl", {{.cells = 20, .place = bowl}, {.cells = 5, .place = floating, .normal = glm::normalize(glm::dvec3(0.25, 1, 0.1))}});
        writeLevels(folder.path, "wall", {{.cells = 2, .place = flat}});
        const auto wall = [](OrderedJson place, OrderedJson turn) {
            return OrderedJson{{"model", "wall"}, {"translation", std::move(place)}, {"rotationDegrees", std::move(turn)}, {"scale", 1.4}};
        };
        corner_ = {{"instances", OrderedJson::array({OrderedJson{{"model", "bowl"}}, wall({0, -0.3, 0}, {0, 0, 0}), wall({1.2, 0.8, 0}, {0, 0, 90}),
                                                     wall({0, 0.8, -1.2}, {90, 0, 0})})},
                   {"environment", {{"type", "constant"}, {"color", {0.2, 0.2, 0.2}}}}};
        scene_ = write("dissolving", {"bowl", "wall"}, OrderedJson::array(), corner_);
    }
    /// From here on the camera goes away from the bowl, of which each frame shows more of the coarser level.
    void goAway() {
        const auto key = [](int frame, double way) {
            return OrderedJson{{"frame", frame}, {"position", {0.4 * way, 0.1 + 2.5 * way, 2.6 * way}}, {"target", {0, 0.1, 0}}};
        };
        OrderedJson camera = key(0, 0.85);
        camera.erase("frame");
        camera["fovy"] = 44;
        camera["keyframes"] = OrderedJson::array({key(0, 0.85), key(3, 1.15)});
        corner_["camera"] = camera;
        scene_ = write("going_away", {"bowl", "wall"}, OrderedJson::array(), corner_);
        levels_ = {{"mode", "stochastic"}, {"curve", "linear"}, {"depthNear", 1}, {"depthFar", 3}, {"transition", 1}, {"bias", 0}};
    }

    Path scene_;
    OrderedJson levels_ = atLevel(0.5);

private:
    OrderedJson corner_;
    std::optional<EnsembleJudge> judge_;
};

TEST_F(DissolvingReuse, KeepsTheMean) {
    for (const char* form : {"number per path", "number per pixel", "number per pixel, mapped"}) {
        const EnsembleResult result = judge(form, "spatial_reuse");
        EXPECT_EQ(result.verdict, Verdict::unbiased) << form << ": " << result.reason;
        EXPECT_LE(result.halfWidth, 0.01) << form;
    }
}

// History was made where other rays saw the coarser level: with the shares of its own frame it would be somebody else's light.
TEST_F(DissolvingReuse, KeepsTheMeanWhereSharesChange) {
    goAway();
    Frames frames(scene_, {64, 36}, {{"lod", node("lod_select", OrderedJson::object(), levels_)}, {"hits", hitsNode()}}, {"hits.hits"});
    double last = -1;
    for (int frame = 0; frame < 4; ++frame) {
        frames.run();
        const auto hits = frames.records<PrimaryHit>("hits.hits");
        const auto onBowl = [](const PrimaryHit& hit) { return hit.primitive != NONE && hit.instance == 0; };
        const auto coarse = std::ranges::count_if(hits, [&](const PrimaryHit& hit) { return onBowl(hit) && hit.primitive >= 800; });
        const double share = double(coarse) / double(std::ranges::count_if(hits, onBowl));
        EXPECT_GT(share, last + 0.08) << "frame " << frame;
        last = share;
    }
    EXPECT_LT(last, 0.95);
    for (const char* form : {"number per path", "number per pixel"}) {
        const EnsembleResult result = judge(form, "spatial_reuse");
        EXPECT_EQ(result.verdict, Verdict::unbiased) << form << ": " << result.reason;
        EXPECT_LE(result.halfWidth, 0.01) << form;
    }
}

}  // namespace
}  // namespace lodestir::test
