// SPDX-License-Identifier: MIT
// The scenes that generate_scenes can make. A source of a scene ends with the line that makes it known.
#pragma once

#include <filesystem>

namespace lodestir::generate {

struct Scene {
    using Write = void(const std::filesystem::path& folder);

    Scene(const char* its, Write* by) : name(its), write(by), next(first) { first = this; }

    const char* name;
    Write* write;  ///< writes its .glb files
    const Scene* next;
    static inline const Scene* first = nullptr;
};

}  // namespace lodestir::generate

/// The build looks for these lines, too, and has a target scene_NAME for each.
#define LODESTIR_SCENE(name, write) static const Scene name##Scene(#name, write);
