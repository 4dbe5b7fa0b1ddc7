// SPDX-License-Identifier: MIT
// A study of errors from its runs to its summary: measures what is missing, writes rows and references.
#pragma once
#include <framework/study/error/summary.h>
#include <framework/study/place.h>
#include <framework/study/stage.h>

namespace lodestir {

/// What all runs that are there add up to, after those that are missing were made.
Summary runErrors(Stage& stage, const Study& study, StudyPlace& place);

}  // namespace lodestir
