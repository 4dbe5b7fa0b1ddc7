// SPDX-License-Identifier: MIT
// report.html: a study's tables and charts in one file that needs nothing else.
#pragma once
#include <framework/study/error/summary.h>

#include <string>
#include <vector>

namespace lodestir {

/// The charts that a study may ask for.
std::vector<std::string> chartNames();

/// The page.
std::string reportHtml(const Study& study, const Summary& summary);

}  // namespace lodestir
