// SPDX-License-Identifier: MIT
#include <framework/image/exr.h>
#include <framework/image/png.h>
#include <framework/study/ensemble/images.h>
#include <framework/study/ensemble/study.h>
#include <framework/study/report/images.h>
#include <framework/study/results.h>

#include <fmt/format.h>

#include <algorithm>

namespace lodestir {
namespace {

std::vector<EnsembleRow> measure(EnsembleStage& runs, Stage& stage, const Study& study, const EnsembleChunk& chunk, const std::string& name,
                                 const Path& images) {
    std::vector<EnsembleRow> rows;
    std::vector<ChunkFrame> frames = runs.render(chunk);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        keepChunkImage(images, name, study.measure[i], frames[i].image, chunk.count);
        rows.push_back({.run = name,
                        .scene = study.scenes[chunk.scene].name,
                        .technique = chunk.technique ? study.techniques[*chunk.technique].name : "",
                        .knobs = knobJson(chunk.knobs),
                        .offset = study.measure[i],
                        .first = chunk.first,
                        .means = std::move(frames[i].means),
                        .milliseconds = frames[i].milliseconds,
                        .rays = frames[i].rays,
                        .device = stage.device().name + ", " + std::string(nameOf(stage.rays()))});
    }
    return rows;
}

/// How the images of chunks converge. Writes the mean of the runs, and a map of where it isn't the reference's; the reference's own mean beside them.
Convergence judgeImages(const Study& study, const EnsembleCell& cell, const Path& out) {
    constexpr double top = 5;  // sigmas of full colour
    const std::vector<EnsembleImage> parts = readChunkImages(out / "chunks", cell.chunks, cell.offset);
    const EnsembleImage runs = joinImages(parts), reference = joinImages(readChunkImages(out / "chunks", cell.referenceChunks, cell.offset));
    const Path file = out / ensembleImageFile(study, cell);
    writeExr(file, firstChannels(runs.image, 3));
    writeExr(out / ensembleReferenceFile(study, cell.scene, cell.offset), firstChannels(reference.image, 3));
    writePng(Path(file).replace_extension(".sigmas.png"), divergingMap(sigmaMap(runs, reference), top));
    return convergenceOf(parts, reference);
}

}  // namespace

EnsembleSummary runEnsemble(Stage& stage, const Study& study, StudyPlace& place) {
    EnsembleStage runs(stage, study);
    const Path& out = place.out;
    const std::vector<EnsembleChunk> chunks = expandChunks(study);
    std::vector<std::string> names;
    for (const EnsembleChunk& chunk : chunks) names.push_back(runs.nameOf(chunk));
    const std::set<std::string> finished = finishedChunks(study, readEnsembleRows(out));
    std::vector<std::size_t> todo;
    Work work{.what = "chunks of runs"};
    std::size_t series = 0;
    for (std::size_t i = 0; i < chunks.size(); ++i) {
        if (i > 0 && !chunks[i].isSeriesOf(chunks[i - 1])) ++series;
        if (!place.shard.holds(i) || finished.contains(names[i])) continue;
        todo.push_back(i);
        work.items.push_back({.group = series});  // one runner serves all of it
    }

    if (!todo.empty()) {
        ResultFile results(place.file);
        work.count = fmt::format("{} of {} chunks of runs", todo.size(), chunks.size());
        work.open = [&] { return stage.workDevice(); };
        work.make = [&](std::size_t item) {
            std::string lines;
            const std::size_t i = todo[item];
            for (const EnsembleRow& row : measure(runs, stage, study, chunks[i], names[i], out / "chunks")) lines += toJson(row).dump() + "\n";
            return lines;
        };
        work.take = [&](std::size_t, const std::string& lines) { results.add(lines); };
        work.stops = place.stops;
        place.problem = doWork(work, place.jobs);
    }
    EnsembleSummary summary = summarizeEnsemble(study, chunks, names, readEnsembleRows(out));
    for (EnsembleCell& cell : summary.cells)
        if (cell.complete) cell.convergence = judgeImages(study, cell, out);
    return summary;
}

}  // namespace lodestir
