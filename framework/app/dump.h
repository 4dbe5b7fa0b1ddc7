// SPDX-License-Identifier: MIT
// Writes what a port holds: images as EXR, buffers and handles as structured .npy.
#pragma once
#include <framework/graph/runner.h>

namespace lodestir {

/// `path` without its ending, which depends on the port. Error when the port's struct cannot be read or the file not be written.
void dumpPort(const Graph& graph, const Runner& runner, const Source& source, const Path& path);

}  // namespace lodestir
