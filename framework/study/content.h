// SPDX-License-Identifier: MIT
// Hashes of what an image is made of, so that a result is used again only where it would come out the same.
#pragma once
#include <framework/core/files.h>
#include <framework/graph/graph.h>
#include <framework/scene/scene.h>

namespace lodestir {

/// Of a graph: its text with all defaults (without the scene's path), the code of the framework and of its passes as they were built, and the shaders
/// of its passes with all that they include.
Hash contentOf(const Graph& graph);
/// Of all that a loaded scene holds but texts.
Hash contentOf(const Scene& scene);

}  // namespace lodestir
