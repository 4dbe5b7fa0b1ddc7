// SPDX-License-Identifier: MIT
// `lodestir scene`: what a scene or a model holds once it is loaded.
#pragma once
#include <framework/core/api.h>

#include <functional>

namespace CLI {
class App;
}

namespace lodestir {

/// Adds the subcommand; when it is chosen, `run` is what it does and returns the exit status.
LODESTIR_API void addScene(CLI::App& app, std::function<int()>& run);

}  // namespace lodestir
