// SPDX-License-Identifier: MIT
#include <framework/image/temporal.h>
#include <framework/study/error/seen.h>

#include <algorithm>
#include <cstring>

namespace lodestir {
namespace {

template <class T> std::vector<T> valuesOf(const std::vector<std::byte>& bytes) {
    std::vector<T> values(bytes.size() / sizeof(T));
    std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
    return values;
}

}  // namespace

bool needsSeen(const Study& study) {
    return std::ranges::any_of(study.masks, [](const Mask& mask) { return !mask.graph; }) || std::ranges::any_of(study.metrics, isTemporal);
}

Graph seenGraph(Renderer& renderer, const StudyScene& file) {
    return renderer.build(graphFolder() / "framework/seen.json", {.scene = std::filesystem::absolute(file.file), .size = file.size});
}

Seen seeFrames(Renderer& renderer, const Study& study, const StudyScene& file, const Scene& scene) {
    Graph graph = seenGraph(renderer, file);
    const Source hits = findSource(graph, "hits.hits"), motion = findSource(graph, "hits.motion"), changed = findSource(graph, "lod.changed");
    const std::unique_ptr<Runner> runner = renderer.bringUp(graph, scene, {.pinned = {hits, motion, changed}});
    runner->setFrame(std::uint32_t(study.event - study.warmup));
    Seen seen;
    for (int offset = -study.warmup; offset <= study.measure.back(); ++offset) {
        runner->run();
        if (!study.isMeasured(offset)) continue;
        seen.hits.push_back(valuesOf<PrimaryHit>(runner->readBytes(hits)));
        seen.motions.push_back(runner->readImage(motion));
    }
    seen.changed = valuesOf<std::uint32_t>(runner->readBytes(changed));
    return seen;
}

std::vector<std::vector<bool>> switchedMasks(const Seen& seen, const Study& study, const StudyScene& file, bool optional) {
    std::vector<std::vector<bool>> masks;
    const auto switches = [&](std::uint32_t changed) { return changed > std::uint32_t(study.event); };
    if (optional && std::ranges::none_of(seen.changed, switches)) return masks;
    for (const std::vector<PrimaryHit>& frame : seen.hits) {
        std::vector<bool>& mask = masks.emplace_back();
        for (const PrimaryHit& hit : frame)
            mask.push_back(hit.primitive != NONE && hit.instance < seen.changed.size() && switches(seen.changed[hit.instance]));
        if (std::ranges::find(mask, true) == mask.end())
            throw Error(file.where, "no pixel sees an object that takes another level from the study's event on",
                        "check \"frames\" against the scene's schedule, or leave \"mask\" out");
    }
    return masks;
}

}  // namespace lodestir
