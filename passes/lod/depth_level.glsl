// SPDX-License-Identifier: MIT
// Levels of detail by depth along the view, and what lies between two of them ("Implementing Stochastic Levels of Detail with Microsoft DirectX
// Raytracing", NVIDIA 2020).
#include "world/ray_levels.glsl"
#include "world/triangle.glsl"

/// How levels follow depth: 0 up to `from`, as many as a mesh has at `to`, both in scene units.
struct DepthCurve {
    bool isLog;  // each level as long as the one before times a factor; otherwise all as long
    float from, to;
    float bias;  // levels
};

/// l, in levels; below 0 it is the finest.
float levelByDepth(World w, uint instance, DepthCurve c) {
    uint mesh = w.instances.at[instance].mesh;
    float z = dot(placePoint(placementOf(w, instance), w.meshes.at[mesh].center) - w.camera.position, w.camera.forward);
    float way = c.isLog ? log(max(z, 1e-20) / c.from) / log(c.to / c.from) : (z - c.from) / (c.to - c.from);
    return float(w.meshes.at[mesh].levels) * way + c.bias;
}

/// A level, and in how many of so many steps the next coarser one has taken over.
struct LevelShare {
    uint level;
    uint coarser;  // below the number of steps
};

/// The post's k_a, k_b and f', f' in steps. `levels`: of the mesh. `transition`: t, the share of the way between two levels in which both are seen.
LevelShare levelShare(float l, uint levels, float transition, uint steps) {
    l = clamp(l, 0.0, float(levels - 1u));
    uint level = min(uint(l), levels - 1u);
    float f = l - float(level);
    // Of the steps + 1 states each lasts as long.
    float share = transition > 0.0 ? clamp((f - 0.5) / transition + 0.5, 0.0, 1.0) : f < 0.5 ? 0.0 : 1.0;
    uint coarser = min(uint(share * float(steps + 1u)), steps);
    return coarser == steps ? LevelShare(min(level + 1u, levels - 1u), 0u) : LevelShare(level, coarser);
}

/// As World.dissolves holds it.
uint dissolveOf(LevelShare s, uint steps, bool each) {
    return s.coarser == 0u ? 0u : uint(float(s.coarser) / float(steps) * 16777216.0) << 8 | (each ? DISSOLVE_EACH : 0u);
}
