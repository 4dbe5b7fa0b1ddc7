// SPDX-License-Identifier: MIT
// What a frame cost, without what is made once.
#pragma once
#include <framework/graph/runner.h>
#include <framework/study/results.h>

#include <vector>

namespace lodestir {

/// By pass: milliseconds, and rays by purpose.
std::vector<PassCost> costsOf(const FrameReport& report);
/// All rays of it.
double raysOf(const FrameReport& report);
/// Nodes that they visited, where the runner counts them.
double stepsOf(const FrameReport& report);

}  // namespace lodestir
