// SPDX-License-Identifier: MIT
// An ensemble study from its chunks to its verdicts: measures what is missing, writes rows, images and the report.
#pragma once
#include <framework/study/ensemble/results.h>

#include <functional>

namespace lodestir {

/// Measures the chunks of a shard that `out` doesn't hold yet, adding rows to `file`, and judges all that is there. Beside the results it
/// writes chunks/ (images of chunks, for what comes later), images/ (means and maps of sigmas) and the report. Asked before each chunk,
/// `stops` tells whether the rest is left for another time.
EnsembleSummary runEnsemble(Stage& stage, const Study& study, const Path& out, const Path& file, const Shard& shard,
                            const std::function<bool()>& stops);

}  // namespace lodestir
