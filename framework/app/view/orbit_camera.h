// SPDX-License-Identifier: MIT
// A camera moved by hand: each function takes the camera as it is and gives it as it becomes. No window, no GPU.
#pragma once
#include <framework/core/json.h>
#include <framework/scene/scene.h>

#include <optional>

namespace lodestir {

/// Around the target, radians to the right and upwards; stops just short of looking along `up`.
LODESTIR_API CameraKey orbited(const CameraKey& camera, float right, float up);
/// Around where it stands, radians to the right and upwards; stops just short of looking along `up`.
LODESTIR_API CameraKey turned(const CameraKey& camera, float right, float up);
/// With its target, to the right, along `up` and forward, in distances to the target, which stay as they are.
LODESTIR_API CameraKey flown(const CameraKey& camera, const glm::vec3& way);
/// Sideways and upwards with its target, in heights of the picture at the target's distance: what is there follows the pointer.
LODESTIR_API CameraKey panned(const CameraKey& camera, float right, float up);
/// Towards the target or away from it: the distance times `factor`. The plane in focus moves along. Orthographic: the height times `factor`.
LODESTIR_API CameraKey dollied(const CameraKey& camera, float factor);
/// Looks the same way at the middle of `bounds` from where all of it is seen. `aspect`: width over height.
LODESTIR_API CameraKey framed(const CameraKey& camera, const std::array<glm::vec3, 2>& bounds, float aspect);
/// Of what a camera without a lens sees at a place of its picture, 0..1 to the right and downwards. Direction: any length. `aspect`: width over height.
struct ViewRay {
    glm::vec3 origin, direction;
};
LODESTIR_API ViewRay viewRay(const CameraKey& camera, glm::vec2 place, float aspect);
/// Where its picture has a point of the world, homogeneous; z <= 0: it lies behind the camera.
LODESTIR_API glm::vec3 placeInPicture(const CameraKey& camera, const glm::vec3& point, float aspect);
/// Where its picture has a point, 0..1 to the right and downwards; nothing for what lies behind it.
LODESTIR_API std::optional<glm::vec2> placeOf(const CameraKey& camera, const glm::vec3& point, float aspect);
/// As a scene file has it, with as many digits as give the same camera back: {"position": ..., "target": ..., "up": ..., "fovy": degrees, "aperture": ...,
/// "focus": ...}, or with "orthographic": height in place of angle and aperture.
LODESTIR_API Json cameraJson(const CameraKey& camera);

/// From places in the picture of camera `to` to places in that of camera `from`, both 0..1 to the right and downwards, homogeneous; exact for what
/// lies in the plane through `from`'s target that faces `from`. Shows an older picture as the newer camera would roughly see it.
LODESTIR_API glm::mat3 warpBetween(const CameraKey& from, const CameraKey& to, float aspect);

}  // namespace lodestir
