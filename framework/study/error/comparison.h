// SPDX-License-Identifier: MIT
// Two configurations of a study held against each other: by how much one's errors, time and rays are more or less than the other's, and how sure that is.
#pragma once
#include <framework/study/error/cell.h>

#include <map>
#include <string>
#include <vector>

namespace lodestir {

/// Of one number, of `cell` against `baseline`.
struct Difference {
    bool ratio = true;    ///< the estimate is of ln(value / baseline), as errors and costs scale; else of value - baseline, where some values aren't positive
    bool paired = false;  ///< seed by seed, because both drew the same
    Estimate estimate;

    /// The ratio itself and the ends of its interval; of a difference, the same of that.
    double middle() const;
    double low() const;
    double high() const;
};

struct Comparison {
    std::size_t cell = 0, baseline = 0;  ///< Summary::cells
    std::map<std::string, Difference> metrics;
    Difference milliseconds, rays;
};

/// Of `values` and `baseline`, parallel to the seeds that they were drawn with.
Difference compareValues(const std::vector<double>& values, const std::vector<std::uint32_t>& seeds, const std::vector<double>& baseline,
                         const std::vector<std::uint32_t>& baselineSeeds);

/// Each cell against that of the technique that it is an ablation of, else of the study's baseline: of the same scene, frame and values of what is varied, or
/// the only one where the baseline varies nothing. Cells without such a one are left out.
std::vector<Comparison> compareCells(const Study& study, const std::vector<Cell>& cells);

}  // namespace lodestir
