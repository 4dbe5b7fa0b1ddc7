// SPDX-License-Identifier: MIT
// The tree that is tested, for tests of the whole program and for those of graphs in their own process.
#pragma once
#include <framework/core/files.h>

#include <nlohmann/json.hpp>

namespace lodestir::test {

using OrderedJson = nlohmann::ordered_json;

inline const Path sourceFolder = LODESTIR_SOURCE_DIR;

}  // namespace lodestir::test
