// SPDX-License-Identifier: MIT
// Equal footing: the value of a technique's knob that makes it cost what all others may cost.
#pragma once
#include <framework/study/error/cell.h>
#include <framework/study/place.h>
#include <framework/study/stage.h>

#include <functional>
#include <map>
#include <string>

namespace lodestir {

/// What was found for a knob.
struct Solution {
    int value = 0;
    double reached = 0;           ///< what it costs
    bool inRange = true;          ///< false: the least value costs more than the budget, or the most costs less
    std::map<int, double> tried;  ///< cost of each value that was looked at
};

/// The value from `low` to `high` whose cost is nearest to the budget, as a ratio; costs rise with values, and may be noisy. Doubles from the low end until
/// the budget is passed, so that nothing much dearer than the budget is ever run, then alternates the secant with halves of what is left.
Solution solveKnob(const std::function<double(int)>& cost, int low, int high, double budget);

/// What each configuration with a knob to solve for was given, by configurationKey().
struct Equal {
    struct Entry {
        double budget = 0;
        Solution solution;
    };
    std::map<std::string, Entry> entries;

    /// Of a configuration, without the knob that was solved for.
    const Entry* find(std::size_t scene, std::size_t technique, const std::vector<Setting>& knobs) const;
    /// What a run of expandRuns() was given, its solved knob being the last.
    BudgetMet met(const StudyRun& run) const;
};

/// Solves what isn't solved in the folder's equal.json, and writes it there, where it stays: a study that is resumed goes on with the same values. Warns
/// where a budget is out of a knob's range. Error where a shard would solve for time by itself.
Equal solveEqual(Stage& stage, const Study& study, StudyPlace& place);

/// The runs of a study, each solved knob behind the others.
std::vector<StudyRun> expandRuns(const Study& study, const Equal& equal);

}  // namespace lodestir
