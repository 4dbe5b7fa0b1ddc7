// SPDX-License-Identifier: MIT
#include <framework/core/is_file.h>
#include <framework/image/exr.h>
#include <framework/image/metrics.h>
#include <framework/study/error/equal.h>
#include <framework/study/error/measure.h>
#include <framework/study/error/study.h>
#include <framework/study/report/images.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>

namespace lodestir {
namespace {

/// A piece of a study's work: a reference that is missing, or one of the runs that need it.
struct Piece {
    std::size_t run = 0;
    std::optional<ReferenceHalf> half;
};

class ErrorStudy {
public:
    ErrorStudy(Stage& stage, const Study& study, StudyPlace& place)
        : stage_(stage), study_(study), place_(place), referenceFolder_(place.out / "references"), images_(study.decompose ? place.out / "runs" : Path()) {}

    Summary run() {
        equal_ = solveEqual(stage_, study_, place_);
        if (!place_.problem.empty() || place_.stops()) return {.missing = expandRuns(study_).size()};  // which those are isn't known yet
        runs_ = expandRuns(study_, equal_);
        for (const StudyRun& run : runs_) names_.push_back(stage_.nameOf(run));
        makeMissing();
        Summary summary = summarize(study_, runs_, names_, readResults(place_.out));
        if (study_.decompose) summary.decompositions = decompositions(summary);
        return summary;
    }

private:
    void makeMissing() {
        const std::vector<Piece> pieces = missingPieces();
        if (pieces.empty()) return;
        Work work{.what = "runs"};
        for (const Piece& piece : pieces) work.items.push_back(itemOf(piece));
        const auto left = std::ranges::count_if(pieces, [](const Piece& piece) { return !piece.half; });
        work.count = fmt::format("{} of {} runs", left, runs_.size());
        ResultFile results(place_.file);
        work.open = [&] { return stage_.workDevice(); };
        work.make = [&](std::size_t item) { return make(pieces[item]); };
        work.take = [&](std::size_t, const std::string& lines) { results.add(lines); };
        work.stops = place_.stops;
        place_.problem = doWork(work, place_.jobs);
    }

    std::vector<Piece> missingPieces() {
        const std::set<std::string> finished = finishedRuns(study_, readResults(place_.out));
        std::vector<Piece> pieces;
        std::optional<std::size_t> scene;
        for (std::size_t i = 0; i < runs_.size(); ++i) {
            if (!place_.shard.holds(i) || (finished.contains(names_[i]) && hasImages(names_[i]))) continue;
            if (scene != runs_[i].scene)
                for (const ReferenceHalf& half : missingHalves(stage_, study_, runs_[i].scene, referenceFolder_)) pieces.push_back({.half = half});
            scene = runs_[i].scene;
            pieces.push_back({.run = i, .half = {}});
        }
        return pieces;
    }
    bool hasImages(const std::string& name) const {
        return images_.empty() || std::ranges::all_of(study_.measure, [&](int offset) { return isFile(imageFile(images_, name, offset)); });
    }

    /// A runner serves all runs of a configuration, so they are one group; but where times are judged, techniques take turns, that what slows the machine
    /// for a while slows all alike.
    WorkItem itemOf(const Piece& piece) {
        if (piece.half) return {.group = groups_++, .scene = piece.half->scene, .opens = true};
        const StudyRun& run = runs_[piece.run];
        const std::string key = study_.judgesTime() ? std::to_string(run.scene) : configurationKey(run);
        const auto [place, isNew] = configurations_.emplace(key, groups_);
        groups_ += isNew;
        return {.group = place->second, .scene = run.scene};
    }

    std::string make(const Piece& piece) {
        if (piece.half) {
            stage_.makeHalf(*piece.half);
            return {};
        }
        const StudyRun& run = runs_[piece.run];
        if (!references_ || references_->scene != run.scene) {
            references_.reset();  // before the next ones are read
            references_ = std::make_unique<SceneReferences>(loadReferences(stage_, study_, run.scene, referenceFolder_));
            keepShownReference(place_.out, study_, run.scene, references_->frames.back().mean);
        }
        std::vector<ResultRow> rows = measureRun(stage_, study_, run, names_[piece.run], *references_, images_, place_.out);
        if (study_.techniques[run.technique].solve)
            for (ResultRow& row : rows) row.budget = equal_.met(run);
        return linesOf(rows);
    }

    /// Of what is measured at all pixels, because that needs no device.
    std::vector<Decomposition> decompositions(const Summary& summary) {
        std::vector<Decomposition> all;
        for (std::size_t i = 0; i < summary.cells.size(); ++i) {
            const Cell& cell = summary.cells[i];
            const auto isKept = [&](const std::string& run) { return isFile(imageFile(images_, run, cell.offset)); };
            if (cell.seeds < 2 || !std::ranges::all_of(cell.runs, isKept)) continue;
            std::vector<ImageData> images;
            for (const std::string& run : cell.runs) images.push_back(readExr(imageFile(images_, run, cell.offset)));
            const MetricOptions how{.exposure = exposureOf(reference(cell.scene, study_.measure.front(), false).mean)};
            for (const Measure& measure : measuresOf(study_)) {
                if (!isDecomposed(measure.metric) || !measure.mask.empty()) continue;
                Decomposition parts = decompose(measure.metric, images, reference(cell.scene, cell.offset, measure.finest), how);
                parts.cell = i;
                parts.metric = measure.name();
                all.push_back(std::move(parts));
            }
        }
        return all;
    }
    Halves reference(std::size_t scene, int offset, bool finest) {
        const std::array<ReferenceHalf, 2> halves = stage_.referenceHalves(scene, offset, referenceFolder_, finest);
        return {readExr(halves[0].file), readExr(halves[1].file)};
    }

    Stage& stage_;
    const Study& study_;
    StudyPlace& place_;
    Path referenceFolder_, images_;
    Equal equal_;
    std::vector<StudyRun> runs_;
    std::vector<std::string> names_;
    std::size_t groups_ = 0;                             ///< of work
    std::map<std::string, std::size_t> configurations_;  ///< their groups
    std::unique_ptr<SceneReferences> references_;  ///< of the scene of the last run
};

}  // namespace

Summary runErrors(Stage& stage, const Study& study, StudyPlace& place) { return ErrorStudy(stage, study, place).run(); }

}  // namespace lodestir
