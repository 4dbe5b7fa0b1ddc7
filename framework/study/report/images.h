// SPDX-License-Identifier: MIT
// Images that a study keeps to be looked at: of each configuration's first seed the last measured frame, and the reference of that frame.
#pragma once
#include <framework/core/files.h>
#include <framework/image/image.h>
#include <framework/study/ensemble/results.h>
#include <framework/study/run_list.h>

#include <string>

namespace lodestir {

/// In the folder of results. It holds the start of the run's hash, so that it is never taken for that of another version of the study.
Path shownImageFile(const Study& study, const StudyRun& run, const std::string& hash);
Path shownReferenceFile(const Study& study, std::size_t scene);
/// Means over all runs of an ensemble.
Path ensembleImageFile(const Study& study, const EnsembleCell& cell);
Path ensembleReferenceFile(const Study& study, std::size_t scene, int offset);

/// Is it the run whose image is kept?
bool isShown(const Study& study, const StudyRun& run);
/// Keeps the last measured frame if it is.
void keepShownImage(const Path& out, const Study& study, const StudyRun& run, const std::string& hash, const ImageData& image);
void keepShownReference(const Path& out, const Study& study, std::size_t scene, const ImageData& image);

}  // namespace lodestir
