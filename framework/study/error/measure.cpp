// SPDX-License-Identifier: MIT
#include <framework/image/exr.h>
#include <framework/image/metrics.h>
#include <framework/image/temporal.h>
#include <framework/study/error/measure.h>
#include <framework/study/frame_cost.h>
#include <framework/study/report/images.h>

#include <fmt/format.h>

namespace lodestir {

std::vector<ResultRow> measureRun(Stage& stage, const Study& study, const StudyRun& run, const std::string& name, const SceneReferences& references,
                                  const Path& images, const Path& out) {
    std::vector<ResultRow> rows;
    const std::vector<StagedFrame> frames = stage.render(run);
    keepShownImage(out, study, run, name, frames.back().image);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        ResultRow row{.run = name,
                      .scene = study.scenes[run.scene].name,
                      .technique = study.techniques[run.technique].name,
                      .knobs = knobJson(run.knobs),
                      .seed = run.seed,
                      .offset = study.measure[i],
                      .device = stage.device().name + ", " + std::string(nameOf(stage.rays())),
                      .milliseconds = frames[i].report.milliseconds,
                      .passes = costsOf(frames[i].report),
                      .counts = frames[i].counts,
                      .exposure = references.exposure};
        for (const Measure& measure : measuresOf(study)) {
            const std::vector<Halves>& halves = measure.finest ? references.finest : references.frames;
            const Halves& reference = halves[i];
            MetricOptions how{.exposure = references.exposure, .flip = {.exposures = references.flipExposures}};
            if (!measure.mask.empty()) {
                const auto masks = references.masks.find(measure.mask);
                if (masks == references.masks.end()) continue;  // an optional one, in a scene where nothing switches
                how.mask = masks->second[i];
            }
            if (isTemporal(measure.metric)) {
                if (i == 0 || study.measure[i - 1] + 1 != study.measure[i]) continue;  // nothing to compare the frame with
                row.metrics[measure.name()] = evaluateStep(
                    measure.metric, {frames[i].image, frames[i - 1].image, reference.mean, halves[i - 1].mean, &references.motions[i]}, how);
                continue;
            }
            row.metrics[measure.name()] = measureError(measure.metric, frames[i].image, reference, how);
            if (const double deviation = referenceDeviation(measure.metric, reference, how); deviation > 0)
                row.deviation[measure.name()] = deviation;
            if (isNoiseFree(measure.metric)) row.noise[measure.name()] = referenceNoise(measure.metric, frames[i].image, reference, how);
        }
        if (!images.empty()) writeExr(imageFile(images, name, study.measure[i]), frames[i].image);
        rows.push_back(std::move(row));
    }
    return rows;
}

Path imageFile(const Path& images, const std::string& name, int offset) { return images / fmt::format("{}.{}.exr", name, offset); }

}  // namespace lodestir
