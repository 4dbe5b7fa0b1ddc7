// SPDX-License-Identifier: MIT
// Bias and variance apart: the error of the mean over seeds against the mean of the errors.
#pragma once
#include <framework/study/error/cell.h>
#include <framework/study/error/halves.h>

#include <string>
#include <vector>

namespace lodestir {

struct Decomposition {
    std::size_t cell = 0;  ///< Summary::cells
    std::string metric;    ///< its error is the sum of both
    Estimate bias;         ///< squared, of the mean of all runs there could be; may come out negative where it is nothing
    Estimate variance;     ///< of one run
};

/// Is it a mean square over the same pixels whatever the image, "mse" or "relmse", so that it can be told apart?
bool isDecomposed(std::string_view metric);

/// Of images of independent runs (at least two) against a reference. With the errors e_i of n runs and E of their mean image, the variance is
/// (mean(e) - E) n / (n - 1), and the squared bias what is left of mean(e): both free of bias, as the errors are. The intervals are the jackknife's, which
/// leaves out a run at a time; the noise of the reference, which all runs share, is not in them.
Decomposition decompose(std::string_view metric, const std::vector<ImageData>& runs, const Halves& reference, const MetricOptions& options);

}  // namespace lodestir
