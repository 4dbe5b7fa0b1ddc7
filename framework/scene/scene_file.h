// SPDX-License-Identifier: MIT
// Scene files (.json): models, instances, environment, lights, camera, animation, cuts, levels of detail, exposure.
#pragma once
#include <framework/scene/scene.h>

namespace lodestir {

/// What a scene file has decided, so that no default goes over it.
struct SceneFileSays {
    bool environment = false;  ///< there is one, be it black
    bool exposure = false;
};

/// Reads a scene file and the models it names. Model and map files are looked up beside the scene file, models also in sceneFolder().
/// Unknown keys are errors. Error with everything that is wrong in the file and its models.
Scene loadSceneFile(const Path& path, SceneFileSays& says);

}  // namespace lodestir
