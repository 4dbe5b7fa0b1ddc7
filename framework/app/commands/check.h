// SPDX-License-Identifier: MIT
// `lodestir check`: validates a graph and prints its plan.
#pragma once
#include <framework/core/api.h>

#include <functional>

namespace CLI {
class App;
}

namespace lodestir {

/// Adds the subcommand; when it is chosen, `run` is what it does and returns the exit status.
LODESTIR_API void addCheck(CLI::App& app, std::function<int()>& run);

}  // namespace lodestir
