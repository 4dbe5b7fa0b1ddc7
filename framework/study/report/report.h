// SPDX-License-Identifier: MIT
// A study's report: summary.json from here, and what scripts/report draws of it.
#pragma once
#include <framework/core/files.h>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace lodestir {

/// The charts that a study may ask for. scripts/report/charts.py lists the functions that draw them.
std::vector<std::string> chartNames();

/// Writes summary.json into a folder of results, and has scripts/report draw report.html and figures/ beside it. Results are complete without
/// pictures: where Python or one of its packages isn't there, a warning says what is missing.
void writeReport(const Path& out, const nlohmann::ordered_json& summary);

}  // namespace lodestir
