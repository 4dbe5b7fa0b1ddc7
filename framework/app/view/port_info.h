// SPDX-License-Identifier: MIT
// What a viewer can tell and show of a port.
#pragma once
#include <framework/app/view/view_state.h>

namespace lodestir {

PortInfo describePort(const Graph& graph, const Runner& runner, const Source& source);

}  // namespace lodestir
