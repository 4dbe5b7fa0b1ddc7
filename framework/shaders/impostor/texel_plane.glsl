// SPDX-License-Identifier: MIT
// A texel of an impostor as a parallelogram of the plane that it is part of: a middle and two edges, as a triangle has a corner and two.
#include "impostor/texel.glsl"
#include "world/triangle.glsl"

const float STEEPEST = 0.2;  // cosine to the view beyond which texels are drawn out no further

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer ImpostorsMemoryOfWorld { Impostors value; };

/// Those that hits of this World may be texels of.
Impostors impostorsOf(World w) { return ImpostorsMemoryOfWorld(w.impostors).value; }

struct TexelPlane {
    vec3 normal;         // unit, in the view's axes
    vec3 middle;         // object space
    vec3 along, across;  // half its sides: from the middle to those of its right and its upper border
};

/// Heights above a texel of its neighbours on both sides of it, the smaller: what lies farther off is another surface.
float heightStep(Impostors made, uint mesh, TexelPlace x, ivec2 along, float depth) {
    float least = 1e30;
    for (int sign = -1; sign <= 1; sign += 2) {
        ivec2 beside = ivec2(x.texel) + sign * along;
        if (any(lessThan(beside, ivec2(0))) || any(greaterThanEqual(beside, ivec2(levelResolution(made, x.level))))) continue;
        ImpostorTexel t = shapeAt(made, mesh, x.level, x.view, uvec2(beside));
        float height = float(sign) * 2.0 * (depth - t.depth);
        if (isSeen(t) && abs(height) < abs(least)) least = height;
    }
    return least < 1e30 ? least : 0.0;
}

/// The triangle's normal as depths tell it, in the view's axes, unit.
vec3 depthNormal(Impostors made, uint mesh, TexelPlace x, float depth) {
    float side = texelSide(made, 1.0, x.level);
    return normalize(vec3(-heightStep(made, mesh, x, ivec2(1, 0), depth), -heightStep(made, mesh, x, ivec2(0, 1), depth), side));
}

/// The normal of the plane that a texel is part of, in the view's axes, unit.
vec3 planeNormal(Impostors made, uint mesh, TexelPlace x, ImpostorTexel t) {
    return (t.flags & TEXEL_BUMPED) != 0u ? depthNormal(made, mesh, x, t.depth) : safeNormalize(t.normal, vec3(0.0, 0.0, 1.0));
}

/// A direction in a view's axes as a normal in world space, unit; `otherwise` where it has no length.
vec3 normalOutOfView(Placement placement, ImpostorView v, vec3 seen, vec3 otherwise) {
    float mirror = placementDeterminant(placement) < 0.0 ? -1.0 : 1.0;
    return safeNormalize(mirror * placeNormal(placement, outOfView(v, seen)), otherwise);
}

/// Depth of the texel's plane at its middle, in the view. What a texel keeps is the nearest of the samples that it was made of: 2^(level + 1) a side, so that
/// the outermost lie a quarter of a finest texel from its border.
float middleDepth(Impostors made, uint level, float nearest, vec3 normal) {
    float outermost = 0.5 - 0.25 / float(1u << level);
    return nearest + outermost * (abs(normal.x) + abs(normal.y)) / max(normal.z, STEEPEST) * 0.5 * texelSide(made, 1.0, level);
}

/// `t`: of the place; its shape is enough.
TexelPlane texelPlane(Impostors made, uint mesh, TexelPlace x, ImpostorTexel t) {
    ImpostorRecord object = made.objects.at[mesh];
    ImpostorView v = impostorView(made.views, x.view);
    TexelPlane p;
    p.normal = planeNormal(made, mesh, x, t);
    vec2 window = (vec2(x.texel) + 0.5) / float(levelResolution(made, x.level));
    p.middle = windowPoint(made, object.center, object.radius, v, window, middleDepth(made, x.level, t.depth, p.normal));
    float halfSide = 0.5 * texelSide(made, object.radius, x.level);
    vec3 rise = halfSide * v.d / max(p.normal.z, STEEPEST);
    p.along = halfSide * v.x - p.normal.x * rise;
    p.across = halfSide * v.y - p.normal.y * rise;
    return p;
}

/// How far off a texel rays begin and end, world units, so that the mesh that stands for the object elsewhere doesn't hide it from itself: what that is
/// off, at the level that World shows, and what a texel is. `side`: of the texel.
float texelRounding(World w, uint instance, Placement placement, float side) {
    uint level = w.levels.at[instance];
    float error = level < LEVELS ? w.meshLevels.at[w.instances.at[instance].mesh * LEVELS + level].error : 0.0;
    return 2.0 * side + error * placementScale(placement);
}

/// In object space: `place` from the middle, in half sides.
vec3 pointOn(TexelPlane p, vec2 place) {
    precise vec3 position = p.middle + place.x * p.along + place.y * p.across;  // kernels that make a path and that shift it find one point
    return position;
}

/// The same of a texel of a mesh, with its edges.
TrianglePoint pointOn(Impostors made, uint mesh, uint index, vec2 place) {
    TexelPlace x = texelPlace(made, index);
    TexelPlane p = texelPlane(made, mesh, x, shapeAt(made, mesh, x.level, x.view, x.texel));
    return TrianglePoint(pointOn(p, place), p.middle, p.along, p.across);
}
