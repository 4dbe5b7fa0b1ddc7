// SPDX-License-Identifier: MIT
// summary.json: all that a study found, for scripts and for scripts/report. docs/studies.md lists its members.
#pragma once
#include <framework/study/ensemble/results.h>
#include <framework/study/error/summary.h>

#include <nlohmann/json_fwd.hpp>

namespace lodestir {

nlohmann::ordered_json summaryJson(const Study& study, const Summary& summary);
nlohmann::ordered_json summaryJson(const Study& study, const EnsembleSummary& summary);

}  // namespace lodestir
