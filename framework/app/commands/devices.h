// SPDX-License-Identifier: MIT
// `lodestir devices`: what the machine's Vulkan devices have, and what is done without the rest.
#pragma once
#include <framework/core/api.h>

#include <functional>

namespace CLI {
class App;
}

namespace lodestir {

/// Adds the subcommand; when it is chosen, `run` is what it does and returns the exit status: 0 when there is a usable device
/// (with --test: when it works), else 1.
LODESTIR_API void addDevices(CLI::App& app, std::function<int()>& run);

}  // namespace lodestir
