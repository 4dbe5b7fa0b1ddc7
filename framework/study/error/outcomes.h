// SPDX-License-Identifier: MIT
// Which techniques hold in which failure cases: a study's rules, and the matrix that they make of what was measured.
#pragma once
#include <framework/core/json.h>
#include <framework/study/error/stability.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace lodestir {

struct Cell;
struct Study;

/// See stability.h.
enum class StabilityQuantity { spike, recovery, popping, energy, baseline };

/// A row of the matrix: one number of one scene, and what it may be.
struct FailureCase {
    std::string name;
    std::size_t scene = 0;
    std::string measure;  ///< Measure::name()
    StabilityQuantity quantity = StabilityQuantity::spike;
    std::array<double, 2> limits{};  ///< a technique holds up to the first, is strained up to the second, and fails above; of energy, its size
    Where where;
};

struct OutcomeRules {
    std::optional<std::size_t> baseline;  ///< the technique that "baseline" divides by, at equal rays where one of its knobs varies
    std::vector<FailureCase> cases;
};

/// Reads a study's "outcomes"; all else of the study has been read.
OutcomeRules readOutcomes(const Json& json, const Study& study, Problems& problems);

enum class Outcome { holds, strained, fails };
std::string_view nameOf(StabilityQuantity quantity);
std::string_view nameOf(Outcome outcome);

struct OutcomeCell {
    StabilityNumber number;
    Outcome outcome = Outcome::fails;
    bool certain = false;  ///< all of the interval has this outcome
};

/// A technique with values of its knobs is a column, a case a row; a cell is absent where nothing was measured yet, where the baseline would be held
/// against itself, and where it has no error at as many rays.
struct OutcomeMatrix {
    std::vector<std::string> columns;
    std::vector<std::vector<std::optional<OutcomeCell>>> rows;  ///< parallel to OutcomeRules::cases
};

/// The rule: the outcome follows from the number alone, and is uncertain where its interval isn't all on one side of the limits. NaN fails.
OutcomeCell judge(const FailureCase& rule, const StabilityNumber& number);

/// Of the cells of a summary.
OutcomeMatrix judgeOutcomes(const Study& study, const std::vector<Cell>& cells);

/// "1.32 +- 0.2", "8 frames (4 to 16)", as a row's quantity is written.
std::string numberText(const FailureCase& rule, const StabilityNumber& number);

/// A table for terminals; "?" stands behind what is uncertain.
std::string outcomesText(const Study& study, const OutcomeMatrix& matrix);

}  // namespace lodestir
