// SPDX-License-Identifier: MIT
// `lodestir run`: renders a graph's frames without a display and writes images, dumps and run.json.
#pragma once
#include <framework/core/api.h>

#include <functional>

namespace CLI {
class App;
}

namespace lodestir {

/// Adds the subcommand; when it is chosen, `run` is what it does and returns the exit status.
LODESTIR_API void addRun(CLI::App& app, std::function<int()>& run);

}  // namespace lodestir
