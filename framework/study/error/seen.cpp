// SPDX-License-Identifier: MIT
#include <framework/shaders/world/primary_hit.h>
#include <framework/shaders/world/world.h>
#include <framework/study/error/switched_masks.h>

#include <algorithm>
#include <cstring>

namespace lodestir {
namespace {

/// What tells which pixels see which object, and which objects changed their level when.
constexpr const char* levelsGraph = R"({ "format": 1,
  "passes": {
    "lod":  { "type": "lod_select" },
    "hits": { "type": "visibility", "set": { "pixelCentre": true, "lens": false } } },
  "show": "hits.depth" })";

template <class T> std::vector<T> valuesOf(const std::vector<std::byte>& bytes) {
    std::vector<T> values(bytes.size() / sizeof(T));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
    return values;
}

}  // namespace

std::vector<std::vector<bool>> switchedMasks(const MaskStage& stage) {
    const Study& study = stage.study;
    Graph graph = buildGraph(readDescription(Json::parse(levelsGraph, "levels of detail"), study.file,
                                             {.scene = std::filesystem::absolute(stage.file.file), .size = study.size}),
                             stage.libraries);
    const Source hits = findSource(graph, "hits.hits", {}), changed = findSource(graph, "lod.changed", {});
    Runner runner(stage.device, graph, stage.scene, RunnerOptions{.rays = stage.rays, .pinned = {hits, changed}});
    runner.setFrame(std::uint32_t(study.event - study.warmup));
    std::vector<std::vector<PrimaryHit>> seen;
    for (int offset = -study.warmup; offset <= study.measure.back(); ++offset) {
        runner.run();
        if (study.isMeasured(offset)) seen.push_back(valuesOf<PrimaryHit>(runner.readBytes(hits)));
    }
    const std::vector<std::uint32_t> changes = valuesOf<std::uint32_t>(runner.readBytes(changed));
    std::vector<std::vector<bool>> masks;
    for (const std::vector<PrimaryHit>& frame : seen) {
        std::vector<bool>& mask = masks.emplace_back();
        for (const PrimaryHit& hit : frame)
            mask.push_back(hit.primitive != NONE && hit.instance < changes.size() && changes[hit.instance] > std::uint32_t(study.event));
        if (std::ranges::find(mask, true) == mask.end())
            throw Error(stage.file.where, "no pixel sees an object that takes another level from the study's event on",
                        "check \"frames\" against the scene's schedule, or leave \"mask\" out");
    }
    return masks;
}

}  // namespace lodestir
