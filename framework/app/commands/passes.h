// SPDX-License-Identifier: MIT
// `lodestir passes`: what passes exist and what each declares.
#pragma once
#include <framework/core/api.h>

#include <functional>

namespace CLI {
class App;
}

namespace lodestir {

/// Adds the subcommand; when it is chosen, `run` is what it does and returns the exit status.
LODESTIR_API void addPasses(CLI::App& app, std::function<int()>& run);

}  // namespace lodestir
