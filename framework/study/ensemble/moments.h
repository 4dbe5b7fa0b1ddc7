// SPDX-License-Identifier: MIT
// Central moments of independent values, and what they say of the difference of two means when the values are skewed.
#pragma once
#include <span>

namespace lodestir {

/// Number, mean and central sums of values that came one by one or in chunks. Chunks merge to what the whole would have given.
struct Moments {
    double count = 0, mean = 0;
    double squares = 0, cubes = 0;  ///< sums of (x - mean)^2 and (x - mean)^3

    void add(double value);
    /// Pébay 2008, "Formulas for robust, one-pass parallel computation of covariances and arbitrary-order statistical moments", eq. 2.1 and
    /// 2.2.
    void merge(const Moments& other);
    double variance() const { return squares / (count - 1); }  ///< of one value
};

Moments momentsOf(std::span<const double> values);

/// P(|T| >= |t|) for Student's distribution with `freedom` > 0 degrees of freedom, which need not be whole.
double studentTail(double t, double freedom);

/// The test of whether two means are equal.
struct MeanTest {
    double difference = 0;  ///< mean(x) - mean(y)
    double error = 0;       ///< its standard deviation
    double t = 0;           ///< difference / error, corrected for skewness
    double freedom = 1;     ///< of Student's distribution that t is held against
    double p = 1;           ///< two-sided

    double halfWidth() const;  ///< of the 95 % interval of the difference
};

/// Welch's t-test with the correction for skewness of Johnson 1978 ("Modified t tests and confidence intervals for asymmetrical
/// populations"), t + a/6 + a t^2/3 where a is the skewness of the difference. That form turns back where a t < -1.5, which would pardon
/// large differences, so it has the cubic term a^2 t^3/27 of Hall 1992 ("On the removal of skewness by transformation"), with which it
/// rises all the way. `resolution`: a standard deviation that the difference has at least, for what storage and sums round. Values that
/// aren't finite give p = 0.
MeanTest compareMeans(const Moments& x, const Moments& y, double resolution);

}  // namespace lodestir
