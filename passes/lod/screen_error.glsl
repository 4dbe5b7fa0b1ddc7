// SPDX-License-Identifier: MIT
// Levels of detail by what they cost on the screen.
#include "world/triangle.glsl"

/// How far the camera is from the sphere around the instance's mesh, and how much its transform enlarges.
struct InstanceView {
    float distance;  // to the nearest point of the sphere, scene units; 0 inside
    float radius;    // of the sphere, scene units
    float scale;     // object to scene units, the largest over all directions that an axis is taken to
};

InstanceView instanceView(World w, uint instance) {
    uint mesh = w.instances.at[instance].mesh;
    Placement p = placementOf(w, instance);
    // Columns of the matrix: where the axes go.
    vec3 x = vec3(p.row0.x, p.row1.x, p.row2.x), y = vec3(p.row0.y, p.row1.y, p.row2.y), z = vec3(p.row0.z, p.row1.z, p.row2.z);
    float scale = sqrt(max(dot(x, x), max(dot(y, y), dot(z, z)))), radius = scale * w.meshes.at[mesh].radius;
    float away = length(placePoint(p, w.meshes.at[mesh].center) - w.camera.position);
    return InstanceView(max(away - radius, 0.0), radius, scale);
}

/// Error of a level on the screen, pixels, where it would be largest: at the point of the sphere nearest to the camera. To an
/// orthographic camera it is as large anywhere.
float screenError(World w, uint instance, InstanceView view, uint level) {
    float error = w.meshLevels.at[w.instances.at[instance].mesh * LEVELS + level].error * view.scale;
    float pixel = w.camera.orthographic != 0u ? w.camera.pixelAngle : max(view.distance, 1e-20) * w.camera.pixelAngle;
    return error > 0.0 ? error / pixel : 0.0;
}

/// The coarsest level whose error stays within `limit` pixels. A level coarser than last frame's has to stay within (1 - hysteresis) of it.
uint levelByError(World w, uint instance, float limit, bool known, uint last, float hysteresis) {
    InstanceView view = instanceView(w, instance);
    uint levels = w.meshes.at[w.instances.at[instance].mesh].levels, chosen = 0u;
    for (uint level = 1u; level < levels; ++level) {
        float allowed = known && level > last ? limit * (1.0 - hysteresis) : limit;
        if (screenError(w, instance, view, level) <= allowed) chosen = level;
    }
    return chosen;
}

/// Level 0 up to `near` radii away, then one more at each doubling. A level coarser than last frame's waits until the instance is
/// 1 / (1 - hysteresis) times as far.
uint levelByDistance(World w, uint instance, float near, bool known, uint last, float hysteresis) {
    InstanceView view = instanceView(w, instance);
    uint levels = w.meshes.at[w.instances.at[instance].mesh].levels, chosen = 0u;
    float bound = near * view.radius;
    for (uint level = 1u; level < levels; ++level, bound *= 2.0) {
        float wanted = known && level > last ? bound / (1.0 - hysteresis) : bound;
        if (view.distance >= wanted) chosen = level;
    }
    return chosen;
}
