// SPDX-License-Identifier: MIT
// Cameras that are kept: named views, and keys of a path as a scene file has them. Plain data and JSON; no window, no GPU.
#pragma once
#include <framework/app/view/orbit_camera.h>

#include <string>
#include <vector>

namespace lodestir {

struct SavedView {
    std::string name;
    CameraKey camera;
};
LODESTIR_API Json viewsJson(const std::vector<SavedView>& views);
/// Error with all that is wrong.
LODESTIR_API std::vector<SavedView> readViews(const Json& json);

/// With a key at its frame, in place of one that was there; keys stay in the order of frames.
LODESTIR_API std::vector<CameraKey> withKey(std::vector<CameraKey> keys, const CameraKey& key);
/// A scene file that is `scene` (a scene file or a model) with another camera path, to stand in `folder`: files it names are named from there.
LODESTIR_API Json sceneWithPath(const Path& scene, const std::vector<CameraKey>& keys, const Path& folder);

}  // namespace lodestir
