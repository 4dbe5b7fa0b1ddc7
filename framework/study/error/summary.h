// SPDX-License-Identifier: MIT
// What the runs of a study add up to: for each scene, technique, knob values and frame, means over seeds with intervals.
#pragma once
#include <framework/study/results.h>
#include <framework/study/run_list.h>
#include <framework/study/error/statistics.h>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace lodestir {

struct PassSummary {
    std::string name;
    double milliseconds = 0, rays = 0;  ///< means over seeds
};

struct Cell {
    std::size_t scene = 0, technique = 0;
    std::vector<Setting> knobs;
    int offset = 0;                                     ///< frames after the event
    int seeds = 0;                                      ///< measured so far
    double milliseconds = 0, fastest = 0, slowest = 0;  ///< median and extremes over seeds: a busy machine makes outliers
    Estimate rays;                                      ///< of the whole frame
    std::vector<PassSummary> passes;
    std::map<std::string, Estimate> metrics;
    std::map<std::string, std::vector<double>> values;  ///< of the metrics, seed by seed
    std::map<std::string, double> noise;                ///< of the reference
    std::map<std::string, double> deviation;            ///< standard deviation that the reference gives all seeds' metrics alike
};

struct Summary {
    std::vector<Cell> cells;  ///< in the study's order; frames of one configuration stand together
    OutcomeMatrix outcomes;   ///< empty where the study has no rules
    std::set<std::string> devices;
    std::size_t missing = 0;  ///< runs not made yet
    std::size_t foreign = 0;  ///< rows of other versions of the study, its graphs or scenes: left out
};

/// Hashes of the runs that all measured frames are there of.
std::set<std::string> finishedRuns(const Study& study, const std::vector<ResultRow>& rows);

/// `names[i]` is the hash of `runs[i]`.
Summary summarize(const Study& study, const std::vector<StudyRun>& runs, const std::vector<std::string>& names,
                  const std::vector<ResultRow>& rows);

/// The technique of a cell, with the values of its knobs.
std::string labelOf(const Study& study, const Cell& cell);

/// "spp 4, mode fast": the knobs without their passes; empty where there are none. `count`: only the first so many.
std::string knobText(const std::vector<Setting>& knobs, std::size_t count);

/// A table for terminals.
std::string summaryText(const Study& study, const Summary& summary);

}  // namespace lodestir
