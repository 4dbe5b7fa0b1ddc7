// SPDX-License-Identifier: MIT
// lodestir study STUDY: runs a study and reports on it.
#include <framework/app/commands/commands.h>

#include <framework/app/command_line.h>
#include <framework/app/interrupt.h>
#include <framework/app/run_report.h>
#include <framework/app/session.h>
#include <framework/app/validators.h>
#include <framework/core/log.h>
#include <framework/image/temporal.h>
#include <framework/study/ensemble/report.h>
#include <framework/study/ensemble/study.h>
#include <framework/study/report/report.h>
#include <framework/study/stage.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

namespace lodestir {
namespace {

struct StudyOptions {
    Path study, out;
    RendererOptions renderer;
    std::string shard;
    bool resume = false;
};

/// The references of one scene, and the exposures at which all its errors are measured.
struct SceneReferences {
    std::size_t scene = 0;
    double exposure = 1;
    FlipExposures flipExposures;
    std::vector<Halves> frames, finest;    ///< parallel to Study::measure; the second where the study asks for it
    std::vector<std::vector<bool>> masks;  ///< likewise; none where nothing switches
    std::vector<ImageData> motions;        ///< likewise
};

SceneReferences makeReferences(Stage& stage, const Study& study, std::size_t scene, const Path& folder) {
    SceneReferences references{.scene = scene};
    if (needsSeen(study)) {
        Seen seen = stage.see(scene);
        if (study.maskSwitched) references.masks = switchedMasks(seen, study, study.scenes[scene]);
        references.motions = std::move(seen.motions);
    }
    for (const int offset : study.measure) {
        references.frames.push_back(stage.reference(scene, offset, folder));
        if (study.referenceFinest) references.finest.push_back(stage.reference(scene, offset, folder, true));
    }
    references.exposure = exposureOf(references.frames.front().mean);
    references.flipExposures = flipExposures(references.frames.front().mean);
    for (const auto* list : {&references.frames, &references.finest})
        for (const Halves& halves : *list)
            for (const float value : halves.mean.values)
                if (!std::isfinite(value))
                    throw Error("the reference of scene " + study.scenes[scene].name + " holds values that are not finite");
    return references;
}

std::vector<PassCost> costsOf(const FrameReport& report) {
    std::vector<PassCost> costs;
    for (const PassReport& pass : report.passes) {
        if (pass.setup) continue;
        PassCost cost{.name = pass.name, .milliseconds = pass.milliseconds};
        for (std::size_t i = 0; i < rayPurposes.size(); ++i)
            if (i != RAYS_STEPS) cost.rays[std::string(rayPurposes[i])] = pass.rays[i];
        costs.push_back(std::move(cost));
    }
    return costs;
}

std::vector<ResultRow> measure(Stage& stage, const Study& study, const StudyRun& run, const std::string& name,
                               const SceneReferences& references) {
    std::vector<ResultRow> rows;
    const std::vector<StagedFrame> frames = stage.render(run);
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
                      .exposure = references.exposure};
        for (const Measure& measure : measuresOf(study)) {
            const std::vector<Halves>& halves = measure.finest ? references.finest : references.frames;
            const Halves& reference = halves[i];
            MetricOptions how{.exposure = references.exposure, .flip = {.exposures = references.flipExposures}};
            if (measure.switched) {
                if (references.masks.empty()) continue;
                how.mask = references.masks[i];
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
            if (isNoiseFree(measure.metric)) row.noise[measure.name()] = referenceNoise(measure.metric, reference, how);
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

/// What is left to say when rows and report are written.
void noteRest(std::size_t foreign, std::size_t missing, const char* what, const Path& out) {
    if (foreign > 0)
        log::note("{} rows in {} belong to other versions of the study or of what it runs, and are left out", foreign, out.string());
    if (missing > 0) log::note("{} {} are still missing", missing, what);
    log::note("{}", (out / "report.html").string());
}

/// Rows and report of what was done are there; the rest is not.
void endInterrupted(const InterruptWatch& interrupt) {
    if (interrupt.signal() != 0) throw Error(std::string("interrupted by ") + interrupt.name(), "go on with --resume");
}

int runEnsembleStudy(Stage& stage, const Study& study, const Path& out, const Path& file, const Shard& shard,
                     const InterruptWatch& interrupt) {
    const EnsembleSummary summary = runEnsemble(stage, study, out, file, shard, [&] { return interrupt.signal() != 0; });
    std::printf("%s", ensembleText(study, summary).c_str());
    for (const EnsembleCell& cell : summary.cells)
        if (cell.complete && study.techniques[cell.technique].planted && cell.result.verdict != Verdict::biased)
            log::warn("{}: the planted fault \"{}\" goes unnoticed", study.scenes[cell.scene].name, labelOf(study, cell));
    noteRest(summary.foreign, summary.missing, "chunks of runs", out);
    endInterrupted(interrupt);
    return summary.failed(study) ? 1 : 0;
}

int runStudy(const StudyOptions& options) {
    const Study study = loadStudy(options.study);
    const Path out = options.out.empty() ? Path("out") / study.file.stem() : options.out;
    const Shard shard = options.shard.empty() ? Shard{} : readShard(options.shard);
    const Path file = out / (shard.count == 1 ? "results.jsonl" : fmt::format("results.{}-of-{}.jsonl", shard.index, shard.count));
    if (!options.resume && std::filesystem::exists(file))
        throw Error({file.string(), 0, 0}, "there are results already", "go on with --resume, or name another folder with --out");
    Stage stage(study, options.renderer);
    stage.check();
    const InterruptWatch interrupt;
    if (study.kind == StudyKind::ensemble) return runEnsembleStudy(stage, study, out, file, shard, interrupt);

    const std::vector<StudyRun> runs = expandRuns(study);
    std::vector<std::string> names;
    for (const StudyRun& run : runs) names.push_back(stage.nameOf(run));
    const std::set<std::string> finished = finishedRuns(study, readResults(out));
    std::vector<std::size_t> todo;
    for (std::size_t i = 0; i < runs.size(); ++i)
        if (shard.holds(i) && !finished.contains(names[i])) todo.push_back(i);

    if (!todo.empty()) {
        log::note("{} of {} runs to make on {}", todo.size(), runs.size(), stage.device().name);
        ResultFile results(file);
        std::unique_ptr<SceneReferences> references;
        log::Progress progress("runs", todo.size());
        for (const std::size_t i : todo) {
            if (interrupt.signal() != 0) break;
            if (!references || references->scene != runs[i].scene)
                references = std::make_unique<SceneReferences>(makeReferences(stage, study, runs[i].scene, out / "references"));
            results.add(measure(stage, study, runs[i], names[i], *references));
            progress.advance();
        }
    }
    const Summary summary = summarize(study, runs, names, readResults(out));
    writeFile(out / "report.html", reportHtml(study, summary));
    std::printf("%s%s", summaryText(study, summary).c_str(), outcomesText(study, summary.outcomes).c_str());
    noteRest(summary.foreign, summary.missing, "runs", out);
    endInterrupted(interrupt);
    return 0;
}

}  // namespace

void addStudy(CLI::App& app, std::function<int()>& run) {
    auto options = std::make_shared<StudyOptions>();
    Command command(app, "study", "Measures techniques against each other and writes results.jsonl and report.html.");
    command.option("STUDY", options->study, "study file").required();
    command.option("--out", options->out, "folder for what is written (out/<name of the study>)").check(checkNotEmpty);
    command.flag("--resume", options->resume, "keep the results that are there, make what is missing");
    command.option("--shard", options->shard, "make one part of the runs: I/N, with I from 1 to N")
        .check([](const std::string& text) {
            try {
                readShard(text);
                return std::string();
            } catch (const Error& error) {
                return std::string(error.what());
            }
        });
    addRendererOptions(command, options->renderer);
    command.does(run, [options] { return runStudy(*options); });
}

}  // namespace lodestir
