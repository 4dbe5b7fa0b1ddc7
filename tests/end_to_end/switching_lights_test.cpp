// SPDX-License-Identifier: MIT
// Reuse across a switch of level where what glows is what switches, and where the mesh that switches deforms: against path tracing, with faults that have to
// be found. The study of these scenes, studies/lod_restir/ensemble_emitter.json, goes to 0.3 %.
#include "known_answer.h"
#include "planted_faults.h"
#include "sheets.h"

namespace lodestir::test {
namespace {

const Path graphs = sourceFolder / "graphs";

/// As many path trees and lights as bring the half-width below one percent, and near neighbours, for the frame is small.
const std::vector<Setting> settings{{"initial.candidates", Json(4)}, {"initial.lightCandidates", Json(4)}, {"spatial.radius", Json(5)}};

EnsembleSetup setup(const Path& scene, int frame, int runs) {
    return {.scene = scene,
            .size = {32, 18},
            .warmup = 3,
            .frame = frame,
            .runs = runs,
            .reference = studyGraph(graphs / "path_tracer.json", "no accumulation", {}),
            .referenceSamples = 1024,
            .device = sharedDevice()};
}

EnsembleResult judge(EnsembleJudge& judged, const char* name, const StudyGraph& technique) {
    return judgeByAnswer(name, judged.measure(technique), judged.reference(), 0.01);
}

struct Case {
    const char* scene;
    int frame;  ///< 40: of the switch
    int runs;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.scene << " at frame " << c.frame; }

class SwitchingLights : public testing::TestWithParam<Case> {};

// If this fails, light of the old level stays, or is weighed by chances and areas of the other level.
TEST_P(SwitchingLights, HaveTheMeanOfPathTracing) {
    const Case& c = GetParam();
    EnsembleJudge judged(setup(sceneFile(c.scene), c.frame, c.runs));
    const EnsembleResult result = judge(judged, c.scene, studyGraph(graphs / "restir_lod.json", nullptr, settings));
    EXPECT_EQ(result.verdict, Verdict::unbiased) << result.reason;
}

// Lights at their switch are judged below, beside a fault.
INSTANTIATE_TEST_SUITE_P(Long, SwitchingLights,
                         testing::Values(Case{"ensemble_emitter", 41, 112}, Case{"ensemble_bending", 40, 64}, Case{"ensemble_bending", 41, 64},
                                         Case{"ensemble_skinned", 40, 64}, Case{"ensemble_skinned", 41, 64}),
                         [](const auto& test) { return std::string(test.param.scene) + "_" + std::to_string(test.param.frame); });

class SwitchingFaults : public Sheets {
protected:
    /// A fault in splatting, in a graph of a scene.
    StudyGraph faulty(const Path& scene, const Fault& fault) {
        plant(folder.path, {fault});
        OrderedJson json = OrderedJson::parse(readText(graphs / "restir_lod.json"));
        json["scene"] = scene.string();
        json["passes"]["temporal"]["type"] = fault.type;
        const Path file = folder.path / (fault.type + ".graph.json");
        writeFile(file, json.dump());
        return studyGraph(file, nullptr, settings);
    }

    /// The right graph is found unbiased, the faulty one biased.
    void expectFound(const Path& scene, int frame, int runs, const Fault& fault) {
        const StudyGraph wrong = faulty(scene, fault);
        ASSERT_FALSE(HasFailure());
        EnsembleSetup with = setup(scene, frame, runs);
        with.renderer.passes = {folder.path};
        EnsembleJudge judged(with);
        const EnsembleResult right = judge(judged, "right", studyGraph(graphs / "restir_lod.json", nullptr, settings));
        EXPECT_EQ(right.verdict, Verdict::unbiased) << right.reason;
        const EnsembleResult biased = judge(judged, fault.type.c_str(), wrong);
        EXPECT_EQ(biased.verdict, Verdict::biased) << biased.reason;
    }
};

// A point of a light that passes to a triangle of another area stands for more of it, or less.
TEST_F(SwitchingFaults, AreasOfLights) {
    expectFound(sceneFile("ensemble_emitter"), 40, 160,
                {"areas_forgotten", "temporal_splat", "lod/path_mapping.glsl", "m.jacobian *= stretch;",
                 "m.jacobian *= part == MAP_CONNECTED && kind == RC_LIGHT ? 1.0 : stretch;"});
}

// Two halves wear one chart, and one glides over the other: in last frame's pose the nearest point of the coarse level is another than in this frame's. A map
// that asks the pose of the frame it leads to isn't undone by the way back.
TEST_F(SwitchingFaults, PosesOfMatchedPoints) {
    const auto isOver = [](glm::dvec2 p) { return p.x > 0.5; };
    const auto halves = [=](double offset) {
        return [=](glm::dvec2 p) { return flat(p) + glm::dvec3(offset, 0, 0) + (isOver(p) ? glm::dvec3(0.2, 0.25, 0) : glm::dvec3(0)); };
    };
    const auto doubled = [](const SheetPoint& p) { return std::optional(glm::dvec2(p.at.x - (p.cell.x > 0.5 ? 0.5 : 0), p.at.y)); };
    writeLevels(folder.path, "gliding", {{.cells = 20, .place = halves(0), .uv = doubled}, {.cells = 8, .place = halves(0.4), .uv = doubled}},
                {.shift = [=](glm::dvec2 p) { return isOver(p) ? glm::dvec3(-0.8, 0, 0) : glm::dvec3(0); }});
    const Path scene = write("gliding", {"gliding"}, switchAt(3), {{"animation", {{"framesPerSecond", 4}}}});
    expectFound(scene, 3, 48,
                {"pose_of_the_way", "temporal_splat", "lod/path_mapping.glsl", "mapPoint(now, index, now.instances", "mapPoint(to, index, to.instances"});
}

}  // namespace
}  // namespace lodestir::test
