// SPDX-License-Identifier: MIT
// What an event does to a technique: numbers of a whole sequence of errors, the event being its frame 0.
#pragma once
#include <framework/study/error/statistics.h>

#include <optional>
#include <vector>

namespace lodestir {

/// The errors of a technique in a scene: of each measured frame, which rise, one value a run. A run has the same place in all frames.
struct Course {
    std::vector<int> offsets;                 ///< frames after the event; negative: before it
    std::vector<std::vector<double>> values;  ///< parallel to `offsets`
    std::vector<double> deviations;           ///< likewise: standard deviation that the reference's noise gives all runs alike; empty: none
    std::vector<double> rays{};               ///< likewise: mean over runs, a pixel

    std::size_t runs() const { return values.empty() ? 0 : values.front().size(); }
    /// Without one of its runs.
    Course without(std::size_t run) const;
};

/// A number and the ends of its interval; NaN ends where one run is all there is.
struct StabilityNumber {
    double value, low, high;
};

/// How much a technique suffers: its largest mean error at the event or later over its mean error before it, a ratio; 1: the event is not felt. The
/// frame is chosen by the means over runs, so that noise raises it a little; the interval is that of the ratio of this frame's (delta method).
StabilityNumber spikeHeight(const Course& errors);

/// How long it suffers, in frames: the first measured frame, from the event on, from which on all mean errors stay within `factor` of the mean error before
/// the event, the level that spikeHeight() divides by. Infinite where the last measured frame doesn't: it hasn't settled, wherever it will. It is as fine as
/// the frames measured. The interval spans what it is without any one of the runs. (1.1: studies/lod_restir, after Fig. 7 of the LoD paper.)
StabilityNumber recoveryTime(const Course& errors, double factor = 1.1);

/// How visible the switch itself is, with a camera that stands: the step_flip of the frame of the event less its mean over the steps before, which is
/// what noise does without a switch; a FLIP, -1 to 1.
StabilityNumber poppingIndex(const Course& stepFlip);

/// How much light is lost (below 0) or made up (above): the mean bias over the measured frames from the event on, a share of the energy. Its interval holds
/// the reference's noise, of which each frame has its own.
StabilityNumber energyError(const Course& bias);

/// How much worse a technique is than a baseline: its mean error over the measured frames from the event on over the baseline's, whose runs are independent; a
/// ratio. One baseline is taken at whatever rays it is; of several, as one at rising numbers of samples, the error at the technique's own rays (over the same
/// frames) is looked up between the two nearest, on the straight line through the logarithms of both, as errors fall by powers. Nothing where it takes fewer
/// rays than all of them, or more.
std::optional<StabilityNumber> errorAgainst(const Course& errors, const std::vector<Course>& baselines);

}  // namespace lodestir
