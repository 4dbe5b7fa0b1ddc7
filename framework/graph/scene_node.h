// SPDX-License-Identifier: MIT
// The built-in pass "scene", which every graph starts from.
#pragma once
#include <framework/pass/pass.h>

namespace lodestir {

/// Outputs the World of each frame. Constructed like any pass; touches the GPU at its first execute.
LODESTIR_API const Plugin& scenePlugin();

}  // namespace lodestir
