# SPDX-License-Identifier: MIT
"""What a few independent runs say of two techniques: framework/study/error/statistics.cpp and comparison.cpp, from values that were kept seed by seed."""
import math
from dataclasses import dataclass

import numpy


def student_quantile(probability, freedom):
    """x with P(T <= x) = probability; `freedom` whole. P(|T| <= t) is a finite series (Abramowitz and Stegun, 26.7.3 and 26.7.4)."""
    def centre(t):
        angle = math.atan(t / math.sqrt(freedom))
        sine, cosine, odd = math.sin(angle), math.cos(angle), freedom % 2
        term, total = (cosine if odd else 1.0), 0.0
        for i in range(odd, freedom - 1, 2):
            total += term
            term *= cosine**2 * (i + 1) / (i + 2)
        return 2 / math.pi * (angle + sine * total) if odd else sine * total

    wanted = abs(2 * probability - 1)
    low, high = 0.0, 1.0
    while centre(high) < wanted:
        high *= 2
    while high - low > 1e-14 * high:
        middle = (low + high) / 2
        low, high = (middle, high) if centre(middle) < wanted else (low, middle)
    return math.copysign(high, probability - 0.5)


def estimate(values):
    """Mean and half of its 95 % interval; NaN where one value says nothing of its spread."""
    values = numpy.asarray(values, float)
    if len(values) < 2:
        return (float(values.mean()) if len(values) else math.nan), math.nan
    return float(values.mean()), student_quantile(0.975, len(values) - 1) * float(values.std(ddof=1)) / math.sqrt(len(values))


def estimate_difference(values, baseline):
    """mean(values) - mean(baseline) of independent values: Welch's interval."""
    sides = [numpy.asarray(side, float) for side in (values, baseline)]
    middle = float(sides[0].mean() - sides[1].mean())
    if min(len(side) for side in sides) < 2:
        return middle, math.nan
    variances = [float(side.var(ddof=1)) / len(side) for side in sides]
    if sum(variances) == 0:
        return middle, 0.0
    freedom = sum(variances)**2 / sum(variance**2 / (len(side) - 1) for variance, side in zip(variances, sides))
    return middle, student_quantile(0.975, max(1, int(freedom))) * math.sqrt(sum(variances))


@dataclass(frozen=True)
class Difference:
    """Of one number, of something against a baseline, and the ends of its 95 % interval."""
    ratio: bool  # a geometric mean of ratios, as errors and costs scale; else, where some values aren't positive, a difference
    paired: bool  # seed by seed
    middle: float
    low: float
    high: float


def compare_values(values, seeds, baseline, baseline_seeds):
    """Seed by seed where both drew the same ones, else as independent."""
    of_seed = dict(zip(baseline_seeds, baseline))
    pairs = [(value, of_seed[seed]) for value, seed in zip(values, seeds) if seed in of_seed]
    mine, other = (numpy.array(side, float) for side in (zip(*pairs) if pairs else (values, baseline)))
    ratio = min(*values, *baseline) > 0
    if ratio:
        mine, other = numpy.log(mine), numpy.log(other)
    middle, half = estimate(mine - other) if pairs else estimate_difference(mine, other)
    ends = middle, middle - half, middle + half
    return Difference(ratio, bool(pairs), *(math.exp(end) for end in ends) if ratio else ends)
