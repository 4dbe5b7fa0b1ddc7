// SPDX-License-Identifier: MIT
// Ensembles held against an answer that is known without rendering.
#pragma once
#include <framework/study/ensemble/ensemble.h>

#include <cstdio>
#include <optional>
#include <string>
#include <vector>

namespace lodestir::test {

/// What is shown of a graph file with a variant (null: as it is) and settings.
inline StudyGraph studyGraph(const Path& file, const char* variant, std::vector<Setting> set) {
    return {.graph = file, .variant = variant ? std::optional<std::string>(variant) : std::nullopt, .set = std::move(set), .port = {}, .where = {}};
}

/// The answer as an ensemble without variance.
inline BlockMeans known(const ImageData& answer) {
    BlockMeans means;
    for (int run = 0; run < 2; ++run) means.add(answer);
    return means;
}

/// Judges runs by the answer, and prints what was found.
inline EnsembleResult judgeByAnswer(const char* name, const BlockMeans& runs, const BlockMeans& answer, double halfWidth) {
    const EnsembleResult result = judgeEnsemble(runs, answer, {.halfWidth = halfWidth});
    std::printf("%-24s %+.3f %% +- %.3f %%\n", name, 100 * (result.energy[0] / result.referenceEnergy[0] - 1), 100 * result.halfWidth);
    return result;
}

}  // namespace lodestir::test
