// SPDX-License-Identifier: MIT
// Hashes of what an image is made of, so that a result is used again only where it would come out the same.
#pragma once
#include <framework/core/files.h>
#include <framework/graph/graph.h>
#include <framework/scene/scene.h>

namespace lodestir {

/// Of a graph: its text with all defaults (without the scene's path), and the sources of its passes with all that their shaders include.
Hash contentOf(const Graph& graph);
/// Of all that a loaded scene holds but names and places of files.
Hash contentOf(const Scene& scene);

}  // namespace lodestir
