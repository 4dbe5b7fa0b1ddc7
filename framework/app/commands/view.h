// SPDX-License-Identifier: MIT
// `lodestir view`: renders a graph into a window, with panels made from its declarations.
#pragma once
#include <framework/core/api.h>

#include <functional>

namespace CLI {
class App;
}

namespace lodestir {

/// Adds the subcommand; when it is chosen, `run` is what it does and returns the exit status.
LODESTIR_API void addView(CLI::App& app, std::function<int()>& run);

}  // namespace lodestir
