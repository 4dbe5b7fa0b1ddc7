// SPDX-License-Identifier: MIT
// What a few independent runs say of the mean they are drawn from.
#pragma once
#include <span>
#include <vector>

namespace lodestir {

/// x with P(T <= x) = `probability` (between 0 and 1) of Student's distribution with `freedom` >= 1 degrees of freedom.
double studentQuantile(double probability, int freedom);

/// A mean and its 95 % confidence interval, mean +- halfWidth, by Student's t over independent values.
struct Estimate {
    double mean = 0;
    double halfWidth = 0;  ///< NaN for fewer than two values: one run says nothing of its spread
    int count = 0;
};

/// NaN mean where there are no values.
Estimate estimateMean(std::span<const double> values);
/// The same where all values share an error of known standard deviation: it widens the interval, by Welch's and Satterthwaite's degrees of
/// freedom.
Estimate withSharedError(Estimate estimate, double deviation);
/// mean(numerators) / mean(denominators) of paired values; the interval is that of the linearised ratio (delta method).
Estimate estimateRatio(std::span<const double> numerators, std::span<const double> denominators);
/// Of the middle two where the number is even; NaN where there are none.
double medianOf(std::vector<double> values);

}  // namespace lodestir
