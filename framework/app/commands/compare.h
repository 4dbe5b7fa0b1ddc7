// SPDX-License-Identifier: MIT
// lodestir compare TEST REFERENCE: error metrics of two images.
#pragma once
#include <framework/core/api.h>

#include <functional>

namespace CLI {
class App;
}

namespace lodestir {

/// Adds the subcommand to `app`; when it is parsed, `run` becomes what does it. That returns the exit code and throws Error.
LODESTIR_API void addCompare(CLI::App& app, std::function<int()>& run);

}  // namespace lodestir
