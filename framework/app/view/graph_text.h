// SPDX-License-Identifier: MIT
// A graph's own file with what was changed by hand written into it, its other lines as they were. No window, no GPU.
#pragma once
#include <framework/graph/description.h>

#include <string>

namespace lodestir {

/// `text` of the graph `file`, so that it (with the variant of `changes`) describes what it describes now with all patches and settings of `changes`; scene,
/// frame and "show" are left alone. They go into the variant where there is one. Error where several variants are joined, or a variant can't say it.
LODESTIR_API std::string textWithChanges(const std::string& text, const Path& file, const GraphOptions& changes);

}  // namespace lodestir
