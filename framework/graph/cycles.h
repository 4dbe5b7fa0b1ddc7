// SPDX-License-Identifier: MIT
// Passes that would have to run before themselves.
#pragma once
#include <framework/graph/graph.h>

#include <vector>

namespace lodestir {

/// The cycles of one frame's order, each as the indices of its nodes in the direction of the data, the first in file order in front.
/// A node comes after the makers of its inputs, and after the readers of @prev of its State, which it changes in place.
std::vector<std::vector<int>> findCycles(const Graph& graph);

}  // namespace lodestir
