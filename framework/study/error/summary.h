// SPDX-License-Identifier: MIT
// What the runs of a study add up to: for each scene, technique, knob values and frame, means over seeds with intervals.
#pragma once
#include <framework/study/results.h>
#include <framework/study/run_list.h>
#include <framework/study/error/comparison.h>
#include <framework/study/error/decomposition.h>
#include <framework/study/error/exponent.h>

#include <set>
#include <string>
#include <vector>

namespace lodestir {

struct Summary {
    std::vector<Cell> cells;  ///< in the study's order; frames of one configuration stand together
    std::vector<Comparison> comparisons;
    std::vector<Exponent> exponents;
    std::vector<Decomposition> decompositions;  ///< where the study keeps images; runErrors() fills them in
    OutcomeMatrix outcomes;  ///< empty where the study has no rules
    std::set<std::string> devices;
    std::size_t missing = 0;  ///< runs not made yet
    std::size_t foreign = 0;  ///< rows of other versions of the study, its graphs or scenes: left out
};

/// Hashes of the runs that all measured frames are there of.
std::set<std::string> finishedRuns(const Study& study, const std::vector<ResultRow>& rows);

/// `names[i]` is the hash of `runs[i]`.
Summary summarize(const Study& study, const std::vector<StudyRun>& runs, const std::vector<std::string>& names,
                  const std::vector<ResultRow>& rows);

/// Tables for terminals.
std::string summaryText(const Study& study, const Summary& summary);

}  // namespace lodestir
