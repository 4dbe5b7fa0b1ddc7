// SPDX-License-Identifier: MIT
// Motion blur: what the shutter sees is the mean of what is there while it is open, whoever traces it, and reuse keeps that mean, also where objects take
// another level meanwhile.
#include "known_answer.h"
#include "planted_faults.h"
#include "program.h"
#include "render.h"
#include "sheets.h"
#include "shift_session.h"

namespace lodestir::test {
namespace {

class MotionBlur : public Sheets {
protected:
    static constexpr int parts = 32;  ///< of an exposure, where it is put together of stills

    /// A bowl that moves and turns under a sky and a sun, with levels; two frames a second, or so many times as many.
    Path turning(int slower, const OrderedJson& schedule = OrderedJson::array()) {
        writeLevels(folder.path, "bowl", {{.cells = 20, .place = bowl}, {.cells = 7, .place = bowl}}, {.moveTo = glm::dvec3(1.2, 0.5, -0.6)});
        return write("turning" + std::to_string(slower), {"bowl"}, schedule,
                     {{"animation", {{"framesPerSecond", 2 * slower}}},
                      {"models", {{"bowl", {{"file", "bowl.gltf"}}}, {"ground", {{"file", "ground.gltf"}}}}}});
    }
    void SetUp() override {
        writeLevels(folder.path, "ground", {{.cells = 2, .place = [](glm::dvec2 p) { return glm::dvec3(8 * p.x - 4, -0.6, 8 * p.y - 4); }}});
    }
    static OrderedJson sceneNode(double shutter) { return {{"type", "scene"}, {"set", {{"shutter", shutter}}}}; }
    static OrderedJson traceNode(int spp) { return node("path_tracer", OrderedJson::object(), {{"spp", spp}, {"bounces", 2}}); }
};

// A bright square goes by, or the camera does: a pixel gets the share of the exposure for which the square covers it.
TEST_F(MotionBlur, SharesOfTheExposure) {
    writeLevels(folder.path, "square", {{.cells = 1, .place = flat}}, {.emission = {1, 1, 1}, .unlit = true});
    constexpr double step = 1.5, shutter = 0.8, height = 6;  // units a frame; 30 pixels are 6 units
    const auto key = [](int frame) {
        return OrderedJson{{"frame", frame}, {"position", {-step * frame, 4, 0}}, {"target", {-step * frame, 0, 0}}};
    };
    OrderedJson camera = {{"position", {0, 4, 0}}, {"target", {0, 0, 0}}, {"up", {0, 0, -1}}, {"orthographic", height}};
    camera["keyframes"] = OrderedJson::array({key(0), key(4)});
    const Path scene = write("square", {"square"}, OrderedJson::array(),
                             {{"environment", {{"type", "constant"}, {"color", {0, 0, 0}}}}, {"lights", OrderedJson::array()}, {"camera", camera}});
    Frames frames(scene, {60, 30}, {{"scene", sceneNode(shutter)}, {"trace", traceNode(1024)}}, {"trace.color"});
    frames.restart(1);
    frames.run();
    const ImageData image = frames.image("trace.color");
    constexpr double pixel = height / 30, open = step, close = step * (1 + shutter);  // the square's middle, seen from the camera
    const auto covered = [&](double x) {  // of the times at which the square, from m - 1 to m + 1, covers x
        return std::clamp((std::min(x + 1, close) - std::max(x - 1, open)) / (close - open), 0.0, 1.0);
    };
    constexpr double white = 0.6;  // the square's green
    double full = 0, worst = 0;
    for (int x = 0; x < 60; ++x) {
        double share = 0;
        for (int i = 0; i < 64; ++i) share += covered((x + (i + 0.5) / 64 - 30) * pixel) / 64;
        full = std::max(full, share);
        worst = std::max(worst, std::abs(image.at(x, 15, 1) / white - share));
        EXPECT_NEAR(image.at(x, 15, 1) / white, share, 5 * std::sqrt(share * (1 - share) / 1024) + 2e-3) << "column " << x;
    }
    std::printf("a square goes by: covers a pixel for %.2f of the exposure at most, off by %.4f at most\n", full, worst);
    EXPECT_GT(full, 0.9);
}

// The bowl moves, turns, casts shadows: the picture of one exposure is the mean of the stills along it.
TEST_F(MotionBlur, IsTheMeanOfStills) {
    const glm::uvec2 size{48, 27};
    const auto at = [&](const Path& scene, double shutter, int frame, int count, int spp) {
        Frames frames(scene, size, {{"scene", sceneNode(shutter)}, {"trace", traceNode(spp)}}, {"trace.color"});
        std::vector<ImageData> images;
        for (int i = 0; i < count; ++i) {
            frames.restart(std::uint32_t(frame), std::uint32_t(17 + frame + i));
            frames.run();
            images.push_back(frames.image("trace.color"));
        }
        return images;
    };
    const auto meanOver = [](const std::vector<ImageData>& images) {
        ImageData mean = images[0];
        for (std::size_t v = 0; v < mean.values.size(); ++v) {
            mean.values[v] = 0;
            for (const ImageData& image : images) mean.values[v] += image.values[v] / float(images.size());
        }
        return mean;
    };
    // Half of a frame of two a second; stills at the middle of each part of it.
    std::vector<ImageData> stills;
    const Path fine = turning(4 * parts), coarse = turning(1);
    for (int i = 0; i < parts; ++i) stills.push_back(at(fine, 0, 2 * i + 1, 1, 64)[0]);
    const ImageData mean = meanOver(stills), blurred = meanOver(at(coarse, 0.5, 0, 32, 64)), frozen = meanOver(at(coarse, 0, 0, 8, 64));
    const auto distance = [&](const ImageData& image) {
        double sum = 0, all = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                sum += std::pow(image.at(x, y, 1) - mean.at(x, y, 1), 2);
                all += std::pow(mean.at(x, y, 1), 2);
            }
        return std::sqrt(sum / all);
    };
    std::printf("blurred: %.4f off the mean of %d stills, energy %.4f; a still is %.4f off\n", distance(blurred), parts, sumOf(blurred) / sumOf(mean),
                distance(frozen));
    EXPECT_NEAR(sumOf(blurred) / sumOf(mean), 1, 3e-3);
    EXPECT_LT(distance(blurred), 0.02);
    EXPECT_GT(distance(frozen), 4 * distance(blurred)) << "nothing moves, and the test asks nothing";
}

// Times belong to paths, not to those who trace them; the driver's structures stand still, and say so.
TEST_F(MotionBlur, BodiesAgree) {
    const OrderedJson graph = {{"format", 1},
                               {"scene", turning(1).string()},
                               {"frame", {{"size", {64, 36}}, {"seed", 1}}},
                               {"passes", {{"scene", sceneNode(0.9)}, {"trace", traceNode(4)}}},
                               {"show", "trace"}};
    writeFile(folder.path / "graph.json", graph.dump(2));
    const auto frames = [&](const char* body) { return render(folder.path / "graph.json", "trace", 2, {}, body); };
    const std::vector<ImageData> best = frames(""), other = frames("lane");
    std::size_t differ = 0;
    for (std::size_t i = 0; i < best[1].values.size(); ++i)
        differ += std::abs(best[1].values[i] - other[1].values[i]) > 1e-3f * (1 + std::abs(best[1].values[i]));
    EXPECT_LE(differ, best[1].values.size() / 200);
    const Output refused = lodestir({"run", (folder.path / "graph.json").string(), "--rays", "ray_query", "--out", (folder.path / "out").string()});
    EXPECT_EQ(refused.exitCode, 1);
    const std::string reason = sharedDevice()->facts().rayQuery ? "rays that the driver traces see nothing move" : "ray_query";
    EXPECT_NE(refused.err.find(reason), std::string::npos) << refused.err;
}

// All exposures are the same, but not their parts: what follows the reconnection vertex of a path is another thing at another time, and is walked anew.
TEST_F(MotionBlur, WalksOnBetweenParts) {
    Frames frames(turning(2), {32, 18},
                  {{"scene", {{"type", "scene"}, {"set", {{"shutter", 1}, {"animate", false}, {"pose", 1}}}}},
                   {"hits", hitsNode()},
                   {"initial", initialNode({{"bounces", 3}})},
                   {"temporal", node("temporal_splat", pathsOf("initial", "initial"), {{"backup", 0}})},
                   {"shade", shadeNode("temporal")}},
                  {"shade.color"});
    const auto rays = [&](int splats, const char* suffix) {
        frames.set("temporal.partitions", Json(splats));
        frames.set("temporal.suffix", Json(suffix));
        frames.restart(0);
        frames.run(2);
        return frames.rays("temporal");
    };
    EXPECT_EQ(rays(1, "automatic"), rays(1, "kept"));
    EXPECT_EQ(rays(3, "automatic"), rays(3, "walked"));
    EXPECT_NE(rays(3, "kept"), rays(3, "walked")) << "nothing follows, and the test asks nothing";
}

/// Reuse between exposures, one of which sees a bowl take another level.
class BlurredReuse : public MotionBlur {
protected:
    EnsembleJudge judge(int runs, std::vector<Path> libraries = {}) {
        return EnsembleJudge({.scene = turning(2, switchAt(2)),
                              .size = {32, 18},
                              .warmup = 2,
                              .frame = 2,
                              .runs = runs,
                              .reference = graph("path_tracer.json", "no accumulation", {{"scene.shutter", Json(1)}, {"trace.bounces", Json(3)}}),
                              .referenceSamples = 2048,
                              .renderer = {.passes = std::move(libraries), .device = {}, .rays = {}},
                              .device = sharedDevice()});
    }
    static std::vector<Setting> settings() { return {{"scene.shutter", Json(1)}, {"initial.bounces", Json(3)}, {"initial.candidates", Json(2)}}; }
    static std::vector<Setting> near() { return with(settings(), {{"spatial.radius", Json(4)}}); }
    static std::vector<Setting> with(std::vector<Setting> set, const std::vector<Setting>& more) {
        set.insert(set.end(), more.begin(), more.end());
        return set;
    }
    static StudyGraph graph(const char* file, const char* variant, std::vector<Setting> set) {
        return studyGraph(sourceFolder / "graphs" / file, variant, std::move(set));
    }
};

TEST_F(BlurredReuse, KeepsTheMean) {
    EnsembleJudge judged = judge(48);
    const auto keeps = [&](const char* what, const StudyGraph& technique) {
        const EnsembleResult result = judged.judge(technique);
        std::printf("%s: %+.2f %% +- %.2f %%\n", what, 100 * (result.energy[0] / result.referenceEnergy[0] - 1), 100 * result.halfWidth);
        EXPECT_EQ(result.verdict, Verdict::unbiased) << what << ": " << result.reason;
        EXPECT_LE(result.halfWidth, 0.012) << what;
    };
    for (const int splats : {1, 2, 4})
        keeps(("splatted " + std::to_string(splats)).c_str(), graph("restir_lod.json", nullptr, with(near(), {{"temporal.partitions", Json(splats)}})));
    keeps("times of pixels", graph("restir_lod.json", "frame jitter", near()));
    keeps("reprojected", graph("restir_pt.json", nullptr, near()));
}

// Paths of last frame land where their first hits are when the shutter opens.
TEST_F(BlurredReuse, FindsPathsThatLandEarly) {
    const std::vector<Fault> faults{{"splat_early", "temporal_splat", "shift_paths.comp",
                                    "    to = atTime(to, pathTime(rules(), to, there, hit.time));\n", ""}};
    plant(folder.path, faults);
    ASSERT_FALSE(HasFailure());
    StudyGraph technique = graph("restir_lod.json", "no spatial", settings());
    technique.patches = {Json::parse(R"({ "passes": { "temporal": { "type": "splat_early" } } })", "patch")};
    const EnsembleResult result = judge(48, {folder.path}).judge(technique);
    std::printf("landing early: %+.2f %% +- %.2f %%\n", 100 * (result.energy[0] / result.referenceEnergy[0] - 1), 100 * result.halfWidth);
    EXPECT_EQ(result.verdict, Verdict::biased) << result.reason;
}

/// A black square flies and turns over a bright floor while the camera flies after it and climbs: how bright each pixel is takes no light transport. A
/// point of the floor is hidden at some times only, so a path has to be weighed by the one time of last frame that it can come from.
class Flight : public Sheets {
protected:
    static constexpr int frame = 4, framesPerSecond = 16;
    static constexpr glm::ivec2 size{64, 32};
    static constexpr glm::dvec3 floorColor{0.7, 0.6, 0.5}, moveTo{12, 0, 5}, up{0, 0, -1};
    static constexpr double fovy = 40;

    static glm::dvec3 eye(double frames) { return {2.6 + 0.2 * frames, 6 + 0.125 * frames, 0.6 + 0.18 * frames}; }
    static glm::dmat3x4 squareToWorld(int frames) {  // rows
        const double seconds = double(frames) / framesPerSecond, turn = glm::radians(40.0) * seconds;
        return {std::cos(turn), 0, std::sin(turn), moveTo.x * seconds, 0, 1, 0, 0, -std::sin(turn), 0, std::cos(turn), moveTo.z * seconds};
    }
    static bool hides(const glm::dmat3x4& toWorld, const glm::dvec3& from, const glm::dvec3& direction) {
        const glm::dvec3 at = from + direction * ((1 - from.y) / direction.y);
        const glm::dmat2 turn(toWorld[0][0], toWorld[2][0], toWorld[0][2], toWorld[2][2]);
        const glm::dvec2 local = glm::inverse(turn) * (glm::dvec2(at.x, at.z) - glm::dvec2(toWorld[0][3], toWorld[2][3]));
        return std::max(std::abs(local.x), std::abs(local.y)) < 1;
    }
    static BlockMeans answer() {
        constexpr int film = 4, places = film * film, times = 48;
        ImageData image = makeImage(size.x, size.y, 3);
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                int seen = 0;
                for (int i = 0; i < places * times; ++i) {
                    const double time = (i + 0.5) / (places * times), half = std::tan(glm::radians(fovy) / 2);
                    const glm::dvec2 place((i % film + 0.5) / film, (i / film % film + 0.5) / film);
                    const double u = 2 * (x + place.x) / size.x - 1, v = 1 - 2 * (y + place.y) / size.y;
                    const glm::dvec3 direction = glm::dvec3(0, -1, 0) + u * half * size.x / size.y * glm::dvec3(1, 0, 0) + v * half * up;
                    seen += hides(squareToWorld(frame) * (1 - time) + squareToWorld(frame + 1) * time, eye(frame + time), direction) ? 0 : 1;
                }
                for (int c = 0; c < 3; ++c) image.at(x, y, c) = float(floorColor[c] * seen / (places * times));
            }
        return known(image);
    }

    EnsembleJudge judge(std::vector<Path> libraries = {}) {
        writeLevels(folder.path, "floor", {{.cells = 1, .place = [](glm::dvec2 p) { return glm::dvec3(40 * p.x - 20, 0, 40 * p.y - 20); }}}, {.unlit = true});
        writeLevels(folder.path, "square", {{.cells = 1, .place = [](glm::dvec2 p) { return flat(p) + glm::dvec3(0, 1, 0); }}}, {.moveTo = moveTo});
        const auto key = [](int at) {
            const glm::dvec3 from = eye(at);
            return OrderedJson{{"frame", at}, {"position", {from.x, from.y, from.z}}, {"target", {from.x, 0, from.z}}};
        };
        OrderedJson camera = key(0);
        camera.erase("frame");
        camera.update({{"up", {0, 0, -1}}, {"fovy", fovy}, {"keyframes", {key(0), key(8)}}});
        const Path scene = write("flight", {"floor", "square"}, OrderedJson::array(),
                                 {{"environment", {{"type", "constant"}, {"color", {0, 0, 0}}}},
                                  {"lights", OrderedJson::array()},
                                  {"animation", {{"framesPerSecond", framesPerSecond}}},
                                  {"camera", camera}});
        return EnsembleJudge({.scene = scene,
                              .size = size,
                              .warmup = frame,
                              .frame = frame,
                              .runs = 64,
                              .reference = studyGraph(graphs / "path_tracer.json", "no accumulation", {{"scene.shutter", Json(1)}, {"trace.bounces", Json(0)}}),
                              .referenceSamples = 256,
                              .renderer = {.passes = std::move(libraries), .device = {}, .rays = {}},
                              .device = sharedDevice()});
    }
    static StudyGraph splatted(int parts, double backup) {
        return studyGraph(graphs / "restir_lod.json", "no spatial",
                          {{"scene.shutter", Json(1)}, {"initial.bounces", Json(0)}, {"temporal.partitions", Json(parts)}, {"temporal.backup", Json(backup)}});
    }
    static EnsembleResult judgeFlight(const std::string& name, const BlockMeans& runs) {
        static const BlockMeans expected = answer();
        return judgeByAnswer(name.c_str(), runs, expected, 0.005);
    }

    inline static const Path graphs = sourceFolder / "graphs";
};

TEST_F(Flight, SplatsFindTheAnswer) {
    EnsembleJudge judged = judge();
    const EnsembleResult traced = judgeFlight("path tracing", judged.reference());
    EXPECT_EQ(traced.verdict, Verdict::unbiased) << traced.reason;
    for (const double backup : {0.0, 0.5})
        for (const int parts : {1, 2, 3, 4}) {
            const std::string name = std::to_string(parts) + (parts == 1 ? " part" : " parts") + (backup > 0 ? ", backup" : "");
            const EnsembleResult result = judgeFlight(name, judged.measure(splatted(parts, backup)));
            EXPECT_EQ(result.verdict, Verdict::unbiased) << name << ": " << result.reason;
        }
}

using LongFlight = Flight;

// Each splat counts as a whole path; all paths are thought to be splats to the first part.
TEST_F(LongFlight, FindsFaultsOfParts) {
    const std::vector<Fault> faults{
        {"splat_whole", "temporal_splat", "shift_paths.comp", "way == FORTH ? 1 / float(splatsOfPath()) : float(splatsOfPath())", "1"},
        {"splat_first", "temporal_splat", "lod/partitions.glsl", "return min(uint(time * float(parts)), parts - 1u);", "return 0u;"}};
    plant(folder.path, faults);
    ASSERT_FALSE(HasFailure());
    EnsembleJudge judged = judge({folder.path});
    for (const Fault& fault : faults) {
        StudyGraph technique = splatted(2, 0);
        technique.patches = {Json::parse(R"({ "passes": { "temporal": { "type": ")" + fault.type + R"(" } } })", "patch")};
        const EnsembleResult result = judgeFlight(fault.type, judged.measure(technique));
        EXPECT_EQ(result.verdict, Verdict::biased) << fault.type << ": " << result.reason;
    }
}

}  // namespace
}  // namespace lodestir::test
