// SPDX-License-Identifier: MIT
// One configuration of a study and one of its measured frames, over the seeds.
#pragma once
#include <framework/study/error/statistics.h>
#include <framework/study/results.h>
#include <framework/study/study_file.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace lodestir {

struct PassSummary {
    std::string name;
    double milliseconds = 0, rays = 0;       ///< means over seeds
    std::map<std::string, double> purposes{};  ///< of the rays
};

struct Cell {
    std::size_t scene = 0, technique = 0;
    std::vector<Setting> knobs;                         ///< what is varied, and behind it what was solved for
    int offset = 0;                                     ///< frames after the event
    int seeds = 0;                                      ///< measured so far
    double milliseconds = 0, fastest = 0, slowest = 0;  ///< median and extremes over seeds: a busy machine makes outliers
    Estimate rays;                                      ///< of the whole frame
    std::vector<PassSummary> passes;
    std::map<std::string, Estimate> counts;
    std::map<std::string, Estimate> metrics;
    std::map<std::string, double> noise;      ///< of the reference
    std::map<std::string, double> deviation;  ///< standard deviation that the reference gives all seeds' metrics alike
    double exposure = 1;                  ///< that the metrics were measured at
    std::optional<BudgetMet> budget;

    // Seed by seed, parallel.
    std::vector<std::string> runs;     ///< hashes
    std::vector<std::uint32_t> drawn;  ///< the seeds themselves
    std::vector<double> times, rayCounts;
    std::map<std::string, std::vector<double>> countValues;
    std::map<std::string, std::vector<double>> values;  ///< of the metrics
};

}  // namespace lodestir
