// SPDX-License-Identifier: MIT
// What a JSON file is, told by its keys: people name a scene where a graph belongs.
#pragma once
#include <framework/core/json.h>

namespace lodestir {

enum class FileKind { graph, scene, study, run, model, unknown };

/// By the key that each kind must have: "passes", "models", "techniques", "frames" beside "graph", "asset"; unknown where none is there.
FileKind kindOf(const Json& file);

/// Error where a file is of another kind than the one that is read, with the option that it belongs to.
void expectKind(const Json& file, FileKind wanted);
/// The same by name, before anything is read: models may be no JSON.
void expectNoModel(const std::filesystem::path& file, FileKind wanted);

}  // namespace lodestir
