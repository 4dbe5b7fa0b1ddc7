// SPDX-License-Identifier: MIT
// How the mean over runs converges: what a run's noise is, and what error no number of runs takes away. In luminance, pixel by pixel.
#pragma once
#include <framework/study/ensemble/images.h>

#include <span>
#include <vector>

namespace lodestir {

struct Convergence {
    double noise = 0;              ///< RelMSE of one run by its spread over the runs alone
    double bias = 0;               ///< RelMSE of the mean over endlessly many runs; unbiased itself, so that it may be below 0 where there is none
    double biasDeviation = 0;      ///< its standard deviation over the runs; NaN for fewer than four chunks
    double difference = 0;         ///< mean over pixels of |mean - reference| / reference
    double differenceOfNoise = 0;  ///< what noise makes of it where there is no bias, if the means are normal
    struct Point {
        double runs = 0, error = 0;
    };
    std::vector<Point> points;  ///< RelMSE of the mean over the first run, chunk, 2, 4, 8 ... chunks and all; the first is noise + bias
};

/// `chunks` of one configuration, at least one, none empty. The reference's noise is taken out of all but `difference`. RelMSE is that of the metric
/// "relmse", of luminance.
Convergence convergenceOf(std::span<const EnsembleImage> chunks, const EnsembleImage& reference);

}  // namespace lodestir
