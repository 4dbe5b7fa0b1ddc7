// SPDX-License-Identifier: MIT
// What an ensemble has measured: a line of results.jsonl for each chunk of runs and measured frame, and what all chunks together say.
#pragma once
#include <framework/study/ensemble/convergence.h>
#include <framework/study/ensemble/runs.h>
#include <framework/study/ensemble/verdict.h>

#include <nlohmann/json.hpp>

#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace lodestir {

struct EnsembleRow {
    std::string run;               ///< hash of all that the chunk depends on but the device
    std::string scene, technique;  ///< technique is empty for the reference
    nlohmann::ordered_json knobs = nlohmann::ordered_json::object();
    int offset = 0;  ///< frames after the event
    int first = 0;   ///< run of the configuration
    BlockMeans means;
    double milliseconds = 0, rays = 0;  ///< of the frame, means over runs
    std::string device;
};

/// One line's value; block means keep the nine digits that give a 32-bit number back.
nlohmann::ordered_json toJson(const EnsembleRow& row);
/// nlohmann's exceptions where a member is missing or of another kind.
EnsembleRow ensembleRowOf(const nlohmann::ordered_json& json);
/// Of all results*.jsonl files of a folder. Error with file and line where a whole line is no row of an ensemble.
std::vector<EnsembleRow> readEnsembleRows(const Path& folder);

/// One configuration and measured frame.
struct EnsembleCell {
    std::size_t scene = 0, technique = 0;
    std::vector<Setting> knobs;
    int offset = 0;
    std::vector<std::string> chunks;           ///< names of its chunks
    std::vector<std::string> referenceChunks;  ///< of its reference's
    bool complete = false;                     ///< nothing of it or its reference is missing: the result holds
    double milliseconds = 0, rays = 0;
    double halvesSigmas = 0;  ///< by which the reference's two halves differ in luminance
    EnsembleResult result;
    std::optional<Convergence> convergence;  ///< where it is complete and images of its chunks were read
};

struct EnsembleSummary {
    std::vector<EnsembleCell> cells;  ///< in the study's order; frames of one configuration stand together
    std::set<std::string> devices;
    std::size_t missing = 0;  ///< chunks not made yet
    std::size_t foreign = 0;  ///< rows of other versions of the study, its graphs or scenes: left out

    /// A technique that isn't planted has another verdict than unbiased.
    bool failed(const Study& study) const;
};

/// Names of the chunks that all measured frames are there of.
std::set<std::string> finishedChunks(const Study& study, const std::vector<EnsembleRow>& rows);

/// Judges every configuration that is there. `names[i]` is the hash of `chunks[i]`.
EnsembleSummary summarizeEnsemble(const Study& study, const std::vector<EnsembleChunk>& chunks, const std::vector<std::string>& names,
                                  const std::vector<EnsembleRow>& rows);

}  // namespace lodestir
