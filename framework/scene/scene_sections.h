// SPDX-License-Identifier: MIT
// Sections of a scene file that are read without its models.
#pragma once
#include <framework/core/json.h>
#include <framework/scene/scene.h>

namespace lodestir {

/// {"type": "constant" | "sky" | "map", "color", "strength", "rotationDegrees", ...}; the map's file is relative to `folder`.
/// Nothing is computed when there are problems already.
void readEnvironment(const Json& value, const Path& folder, Scene& scene, Problems& problems);

/// [{"type": "point" | "spot" | "directional", "color", "intensity", "position", "direction", "range", cones in degrees}]:
/// each light gets a node of its own.
void readLights(const Json& value, Scene& scene, Problems& problems);

/// {"position", "target", "up", "fovy" (degrees) or "orthographic" (height of the view, scene units), "aperture", "focus",
/// "keyframes": [{"frame", the same again}]}. What a keyframe leaves out is taken from the camera itself; a focus that nobody gives is the
/// distance of the target.
void readCamera(const Json& value, Scene& scene, Problems& problems);

}  // namespace lodestir
