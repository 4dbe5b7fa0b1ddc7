// SPDX-License-Identifier: MIT
// What a few independent runs say of the mean they are drawn from.
#pragma once
#include <cstddef>
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
/// mean(values) - mean(baseline) of values that are independent of each other: Welch's interval.
Estimate estimateDifference(std::span<const double> values, std::span<const double> baseline);
/// The same of values that belong together one by one: the interval of the mean of their differences.
Estimate estimatePairedDifference(std::span<const double> values, std::span<const double> baseline);
/// The exponent p of y ~ x^p, the slope of the straight line through the logarithms: least squares for each run by itself, `runs[i][k]` being what
/// run i gave at x[k], and the interval over runs, because the values of one run may depend on each other. Values must be positive.
Estimate estimateExponent(std::span<const double> x, const std::vector<std::vector<double>>& runs);
/// What is told by all runs together and has no value of its own for each: `whole` of n runs, and `without[i]` of all but run i (jackknife).
Estimate estimateJackknife(double whole, std::span<const double> without);
/// Of the middle two where the number is even; NaN where there are none.
double medianOf(std::vector<double> values);

}  // namespace lodestir
