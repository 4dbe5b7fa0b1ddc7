// SPDX-License-Identifier: MIT
// Scene files (.json): models, instances, environment, lights, camera, animation, cuts, levels of detail, exposure.
#pragma once
#include <framework/scene/scene.h>

namespace lodestir {

/// Reads a scene file and the models it names. Model and map files are looked up beside the scene file, models also in sceneFolder().
/// Unknown keys are errors. Error with everything that is wrong in the file and its models.
/// `hasEnvironment` is set when the file describes one, be it black.
Scene loadSceneFile(const Path& path, bool& hasEnvironment);

}  // namespace lodestir
