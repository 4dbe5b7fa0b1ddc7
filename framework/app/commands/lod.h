// SPDX-License-Identifier: MIT
// lodestir lod MODEL: builds levels of detail and writes them into a copy of the model.
#pragma once
#include <framework/core/api.h>

#include <functional>

namespace CLI {
class App;
}

namespace lodestir {

/// Adds the subcommand to `app`; when it is parsed, `run` becomes what does it. That returns the exit code and throws Error.
LODESTIR_API void addLod(CLI::App& app, std::function<int()>& run);

}  // namespace lodestir
