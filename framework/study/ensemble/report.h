// SPDX-License-Identifier: MIT
// What is said of an ensemble study: a table for terminals.
#pragma once
#include <framework/study/ensemble/results.h>

#include <string>

namespace lodestir {

std::string ensembleText(const Study& study, const EnsembleSummary& summary);

}  // namespace lodestir
