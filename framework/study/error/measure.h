// SPDX-License-Identifier: MIT
// The rows of one run: what its measured frames cost, and how far they are from their references.
#pragma once
#include <framework/study/error/references.h>
#include <framework/study/results.h>

#include <string>
#include <vector>

namespace lodestir {

/// Renders a run and measures it. `name`: the hash that its rows are named by. `images`: a folder that its images are kept in; empty: none is. In `out` the
/// one that the report shows is kept, if it is of this run.
std::vector<ResultRow> measureRun(Stage& stage, const Study& study, const StudyRun& run, const std::string& name, const SceneReferences& references,
                                  const Path& images, const Path& out);

/// The kept image of a run's measured frame.
Path imageFile(const Path& images, const std::string& name, int offset);

}  // namespace lodestir
