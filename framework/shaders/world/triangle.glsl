// SPDX-License-Identifier: MIT
// Triangles as the World stores them: corners, attributes between corners, and the way from object to world space.
#include "world/scene_facts.glsl"
#include "world/world.h"

vec3 interpolate(vec3 a, vec3 b, vec3 c, vec2 barycentrics) {
    return a + barycentrics.x * (b - a) + barycentrics.y * (c - a);
}

uvec3 cornersOf(World w, uint primitive) {
    return uvec3(w.primitives.at[primitive].v0, w.primitives.at[primitive].v1, w.primitives.at[primitive].v2);
}

/// A point of a triangle, in object space, with the triangle's edges.
struct TrianglePoint {
    vec3 position;
    vec3 corner;  // the first
    vec3 edge1, edge2;
};

TrianglePoint pointOn(World w, uvec3 corners, vec2 barycentrics) {
    vec3 a = w.positions.at[corners.x].xyz;
    vec3 edge1 = w.positions.at[corners.y].xyz - a, edge2 = w.positions.at[corners.z].xyz - a;
    precise vec3 position = a + barycentrics.x * edge1 + barycentrics.y * edge2;  // kernels that make a path and that shift it find one point
    return TrianglePoint(position, a, edge1, edge2);
}

/// Texture coordinates of set 0 or 1.
vec2 uvOn(World w, uvec3 corners, vec2 barycentrics, uint set) {
    vec2 uv[3];
    for (int i = 0; i < 3; ++i) {
        if (set == 0u) uv[i] = w.vertices.at[corners[i]].uv0;
        else uv[i] = w.vertices.at[corners[i]].uv1;
    }
    return uv[0] + barycentrics.x * (uv[1] - uv[0]) + barycentrics.y * (uv[2] - uv[0]);
}

/// Linear part and translation of an instance's transform, by rows, at the time of `w`.
struct Placement {
    vec3 row0, row1, row2;
    vec3 translation;
    float winding;  // -1 where triangles are turned inside out on their way into the world: glTF then turns the winding round, so that fronts stay fronts
};

Placement placementOf(World w, uint instance) {
    vec4 x = w.instances.at[instance].toWorld[0], y = w.instances.at[instance].toWorld[1], z = w.instances.at[instance].toWorld[2];
    uint flags = w.instances.at[instance].flags;
    if (MOTION_BLUR != 0 && (flags & INSTANCE_MOVES) != 0u) {
        x = mix(x, w.closing.at[3u * instance], w.time);
        y = mix(y, w.closing.at[3u * instance + 1u], w.time);
        z = mix(z, w.closing.at[3u * instance + 2u], w.time);
    }
    float winding = (flags & INSTANCE_MIRRORED) != 0u ? -1.0 : 1.0;
    return Placement(x.xyz, y.xyz, z.xyz, vec3(x.w, y.w, z.w), winding);
}

vec3 placeVector(Placement p, vec3 v) { return vec3(dot(p.row0, v), dot(p.row1, v), dot(p.row2, v)); }
vec3 placePoint(Placement p, vec3 v) { return placeVector(p, v) + p.translation; }

/// A normal (or a cross product of edges) taken to world space by the cofactor matrix, which is the inverse transpose times the
/// determinant and needs no second matrix. cross(edge1, edge2) becomes the cross product of the transformed edges. Where the transform mirrors,
/// a normal comes out the other way round.
vec3 placeNormal(Placement p, vec3 n) {
    return vec3(dot(cross(p.row1, p.row2), n), dot(cross(p.row2, p.row0), n), dot(cross(p.row0, p.row1), n));
}

/// How much the transform enlarges volumes; negative where it mirrors.
float placementDeterminant(Placement p) { return dot(p.row0, cross(p.row1, p.row2)); }

/// How much it enlarges lengths, in the mean.
float placementScale(Placement p) { return pow(abs(placementDeterminant(p)), 1.0 / 3.0); }
