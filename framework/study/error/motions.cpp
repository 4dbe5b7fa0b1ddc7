// SPDX-License-Identifier: MIT
#include <framework/study/error/motions.h>

namespace lodestir {
namespace {

constexpr const char* motionGraph = R"({ "format": 1,
  "passes": {
    "lod":  { "type": "lod_select" },
    "hits": { "type": "visibility", "in": { "worldPrev": "lod.world@prev" }, "set": { "pixelCentre": true, "lens": false } } },
  "show": "hits.motion" })";

}  // namespace

std::vector<ImageData> measuredMotions(const MaskStage& stage) {
    const Study& study = stage.study;
    Graph graph = buildGraph(readDescription(Json::parse(motionGraph, "motion"), study.file,
                                             {.scene = std::filesystem::absolute(stage.file.file), .size = study.size}),
                             stage.libraries);
    Runner runner(stage.device, graph, stage.scene, RunnerOptions{.rays = stage.rays});
    runner.setFrame(std::uint32_t(study.event - study.warmup));
    std::vector<ImageData> motions;
    for (int offset = -study.warmup; offset <= study.measure.back(); ++offset) {
        runner.run();
        if (study.isMeasured(offset)) motions.push_back(runner.readImage(graph.show));
    }
    return motions;
}

}  // namespace lodestir
