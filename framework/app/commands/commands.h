// SPDX-License-Identifier: MIT
// The program's commands. A new one is a file of its own here, and two words below.
#pragma once
#include <framework/core/api.h>

#include <functional>

namespace CLI {
class App;
}

namespace lodestir {

/// Adds a subcommand; when it is chosen, `run` becomes what it does, which returns the exit status and throws Error.
using AddCommand = void(CLI::App& app, std::function<int()>& run);

LODESTIR_API AddCommand addRun, addView, addCompare, addPasses, addCheck, addScene, addDevices, addLod, addStudy, addProbe;
/// In the order of the help.
inline constexpr AddCommand* allCommands[] = {addRun, addView, addProbe, addCompare, addPasses, addCheck, addScene, addDevices, addLod, addStudy};

}  // namespace lodestir
