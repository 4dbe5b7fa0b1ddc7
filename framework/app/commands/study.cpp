// SPDX-License-Identifier: MIT
// lodestir study STUDY: runs a study and reports on it.
#include <framework/app/commands/commands.h>

#include <framework/app/command_line.h>
#include <framework/app/interrupt.h>
#include <framework/app/session.h>
#include <framework/app/validators.h>
#include <framework/core/log.h>
#include <framework/study/ablation.h>
#include <framework/study/ensemble/report.h>
#include <framework/study/ensemble/study.h>
#include <framework/study/report/report.h>
#include <framework/study/report/summary_json.h>
#include <framework/study/error/study.h>

#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>

namespace lodestir {
namespace {

struct StudyOptions {
    Path study, out;
    RendererOptions renderer;
    std::string shard;
    int jobs = 0;
    bool resume = false;
};

/// What is left to say when rows are written.
void noteRest(const Study& study, const StudyPlace& place, std::size_t foreign, std::size_t missing, const char* what) {
    const std::string out = place.out.string();
    if (foreign > 0) log::note("{} rows in {} belong to other versions of the study or of what it runs, and are left out", foreign, out);
    if (missing == 0) return;
    const std::string rest = fmt::format("; once all shards are done, `lodestir study {} --out {} --resume` makes what is left, merges and reports",
                                         study.file.string(), out);
    log::note("{} {} are still missing{}", missing, what, place.shard.count > 1 ? rest : "");
}

/// Shards don't report on what others are still at: only the run that finds nothing missing does.
bool reports(const StudyPlace& place, std::size_t missing) { return place.shard.count == 1 || missing == 0; }

/// What was done is there; the rest is not.
void endEarly(const StudyPlace& place, const InterruptWatch& interrupt) {
    if (!place.problem.empty()) throw Error(place.problem, "what was measured is kept; go on with --resume");
    if (interrupt.signal() != 0) throw Error(std::string("interrupted by ") + interrupt.name(), "go on with --resume");
}

int runEnsembleStudy(Stage& stage, const Study& study, StudyPlace& place, const InterruptWatch& interrupt) {
    const EnsembleSummary summary = runEnsemble(stage, study, place);
    const bool reported = reports(place, summary.missing);
    if (reported) {
        writeReport(place.out, summaryJson(study, summary));
        std::printf("%s", ensembleText(study, summary).c_str());
        for (const EnsembleCell& cell : summary.cells)
            if (cell.complete && study.techniques[cell.technique].planted && cell.result.verdict != Verdict::biased)
                log::warn("{}: the planted fault \"{}\" goes unnoticed", study.scenes[cell.scene].name, labelOf(study, cell));
    }
    noteRest(study, place, summary.foreign, summary.missing, "chunks of runs");
    endEarly(place, interrupt);
    return reported && summary.failed(study) ? 1 : 0;
}

int runErrorStudy(Stage& stage, const Study& study, StudyPlace& place, const InterruptWatch& interrupt) {
    const Summary summary = runErrors(stage, study, place);
    if (reports(place, summary.missing)) {
        writeReport(place.out, summaryJson(study, summary));
        std::printf("%s%s", summaryText(study, summary).c_str(), outcomesText(study, summary.outcomes).c_str());
    }
    noteRest(study, place, summary.foreign, summary.missing, "runs");
    endEarly(place, interrupt);
    return 0;
}

/// Two processes slow each other: where times are judged, one measures them unless more were asked for.
Jobs jobsOf(const Study& study, int asked) {
    if (asked == 0 && study.judgesTime()) return {1, "times are judged, and several would slow each other"};
    return {asked, {}};
}

int runStudy(const StudyOptions& options) {
    Study study = loadStudy(options.study);
    Renderer renderer(options.renderer);
    expandAblations(study, renderer);
    const Path out = options.out.empty() ? Path("out") / study.file.stem() : options.out;
    const Shard shard = options.shard.empty() ? Shard{} : readShard(options.shard);
    const Path file = out / (shard.count == 1 ? "results.jsonl" : fmt::format("results.{}-of-{}.jsonl", shard.index, shard.count));
    if (!options.resume && std::filesystem::exists(file))
        throw Error({file.string(), 0, 0}, "there are results already", "go on with --resume, or name another folder with --out");
    Stage stage(study, options.renderer);
    stage.check();
    const InterruptWatch interrupt;
    StudyPlace place{.out = out, .file = file, .shard = shard, .jobs = jobsOf(study, options.jobs), .stops = [&] { return interrupt.signal() != 0; }};
    return study.kind == StudyKind::ensemble ? runEnsembleStudy(stage, study, place, interrupt) : runErrorStudy(stage, study, place, interrupt);
}

}  // namespace

void addStudy(CLI::App& app, std::function<int()>& run) {
    auto options = std::make_shared<StudyOptions>();
    Command command(app, "study", "Measures techniques against each other and writes results.jsonl, summary.json and report.html.");
    command.option("STUDY", options->study, "study file").required();
    command.option("--out", options->out, "folder for what is written (out/<name of the study>)").check(checkNotEmpty);
    command.flag("--resume", options->resume, "keep the results that are there, make what is missing");
    command.option("--shard", options->shard, "make one part of the runs: I/N, with I from 1 to N; the one that finds nothing missing reports")
        .check([](const std::string& text) {
            try {
                readShard(text);
                return std::string();
            } catch (const Error& error) {
                return std::string(error.what());
            }
        });
    command.option("--jobs", options->jobs, "processes that share the work; unasked: as many as cores on a CPU device, but one where times are judged")
        .within(1, 1024);
    addRendererOptions(command, options->renderer);
    command.does(run, [options] { return runStudy(*options); });
}

}  // namespace lodestir
