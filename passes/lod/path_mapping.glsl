// SPDX-License-Identifier: MIT
// tau for paths: what a path is kept by, taken to a World in which instances may show other levels (Real-Time Level-of-Detail Rendering with ReSTIR,
// section 4).
#include "lod/vertex_mapping.glsl"
#include "restir/reservoir.glsl"
#include "restir/sample_hit.h"
#include "surface/surface_point.glsl"
#include "world/ray_levels.glsl"

/// Which points pass from level to level, and how; the others are lost where the level has changed.
struct LevelMapping {
    bool primary;       // first hits
    bool reconnection;  // x_k
    bool matching;      // points of one texture coordinate are paired by distance; otherwise only one that alone has its coordinate has a partner
    bool worldSpace;    // those distances are as `now` places the mesh, not as it was made
};

/// Numbers by which rays choose levels (world/ray_levels.glsl) where a path comes from and where it goes.
struct RayNumbers {
    uint from, to;
};

/// Takes a point of texture coordinate `uv` from one World to another. False: it can't be found there. `jacobian`: barycentric area there per area here.
/// `now`: one of the two Worlds, the same there and back, so that tau can be undone: a mesh that deforms has another shape in each.
bool mapSurfacePoint(World from, World to, World now, RayNumbers numbers, UvIndex index, bool mapped, LevelMapping mapping, inout SurfacePoint p, vec2 uv,
                     out float jacobian) {
    jacobian = 1.0;
    uint before = levelSeen(from, p.instance, numbers.from), after = levelSeen(to, p.instance, numbers.to);
    if (before == after || isShown(to, p, numbers.to)) return true;
    if (!mapped || max(before, after) >= LEVELS) return false;  // hidden in one of them
    Placement placed = placementOf(now, p.instance);
    mat3 space = mapping.worldSpace ? transpose(mat3(placed.row0, placed.row1, placed.row2)) : mat3(1.0);
    MappedPoint found = mapPoint(now, index, now.instances.at[p.instance].mesh, p.primitive, uv, before, after, mapping.matching, space);
    p.primitive = found.primitive;
    p.barycentrics = found.barycentrics;
    jacobian = found.jacobian;
    return jacobian > 0.0;
}

/// What is taken along: what a pixel's centre sees, which is no part of the path; the path's first hit; x_k.
const uint MAP_CENTRE = 1u;
const uint MAP_FIRST = 2u;
const uint MAP_CONNECTED = 4u;

struct MappedPath {
    Reservoir path;
    SampleHit hit;
    bool centreIsThere;  // whether the centre's point is found; true where it isn't asked
    bool isThere;        // whether the whole path is
    float jacobian;      // of all barycentric areas
};

/// Takes all that `wanted` (MAP_*) says from one World to the other, at one place in the code: a map is many reads, and is compiled wherever it is called.
MappedPath mapPath(World from, World to, World now, RayNumbers numbers, UvIndex index, LevelMapping mapping, uint wanted, PrimaryHit centre, Reservoir path,
                   SampleHit hit) {
    PathShape shape = unpackShape(path.shape);
    uint kind = reconnectionKind(shape);
    bool connects = kind != RC_NONE && kind != RC_ENVIRONMENT && (kind != RC_LIGHT || (SCENE_LIGHT_LEVELS != 0 && shape.light == PATH_LIGHT_TRIANGLE));
    MappedPath m = MappedPath(path, hit, true, holdsPath(path), 1.0);
    for (uint part = MAP_CENTRE; part <= MAP_CONNECTED; part <<= 1) {
        if ((wanted & part) == 0u || (part != MAP_CENTRE && !m.isThere)) continue;
        SurfacePoint p = part == MAP_CENTRE ? pointOf(centre) : pointOf(hit.hit);
        vec2 uv = hit.uv;
        if (part == MAP_CENTRE) {
            if (p.primitive != NONE) uv = uvAt(from, p);
        } else if (part == MAP_CONNECTED) {
            p = SurfacePoint(path.rcInstance, connects ? path.rcPrimitive : NONE, hit.rc.barycentrics);
            uv = hit.rc.uv;
        }
        float stretch = 1.0;
        bool mapped = part == MAP_CONNECTED ? mapping.reconnection : mapping.primary;
        bool there = p.primitive == NONE || mapSurfacePoint(from, to, now, numbers, index, mapped, mapping, p, uv, stretch);
        if (part == MAP_CENTRE) {
            m.centreIsThere = there;
            continue;
        }
        m.isThere = there;
        m.jacobian *= stretch;
        if (part == MAP_FIRST) {
            m.hit.hit.primitive = p.primitive;
            m.hit.hit.barycentrics = p.barycentrics;
        } else if (connects) {
            m.path.rcPrimitive = p.primitive;
            m.hit.rc.barycentrics = p.barycentrics;
        }
    }
    return m;
}
