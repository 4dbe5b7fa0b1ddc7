// SPDX-License-Identifier: MIT
// An ensemble study from its chunks to its verdicts: measures what is missing, writes rows, images and the report.
#pragma once
#include <framework/study/ensemble/results.h>
#include <framework/study/place.h>

namespace lodestir {

/// Measures the chunks of a shard that aren't there yet, and judges all that are. Beside the results it writes chunks/ (images of chunks, for what comes
/// later), images/ (means and maps of sigmas) and the report.
EnsembleSummary runEnsemble(Stage& stage, const Study& study, StudyPlace& place);

}  // namespace lodestir
