// SPDX-License-Identifier: MIT
// A texel of an impostor on the film: a parallelogram of the plane that it is part of. After pass.glsl.
#include "base/jitter.glsl"
#include "impostor/texel_surface.glsl"
#include "numbering.glsl"
#include "world/camera.glsl"

const float BACK_SLACK = 0.05;      // cosine by which a mean normal may lean away and still be of what is seen
const float STEEPEST = 0.2;         // cosine to the view beyond which texels are drawn out no further

struct Splat {
    vec2 center;    // in pixels: whole numbers are the places that decide what pixels show
    vec2 a, b;      // half sides
    float depth;    // at the centre
    vec2 slope;     // depth gained along a and b
    vec3 normal;    // unit, world space, of what the texel shows: towards the camera where it has two sides
    float frontal;  // cosine between the surface and the view that saw it
    float side;     // of the texel, world units
};

vec2 pixelPlace() { return params.film == film_frame ? frameJitter(frameIndex(), runSeed()) : vec2(0.5); }

/// Heights above a texel of its neighbours on both sides of it, the smaller: what lies farther off is another surface.
float heightStep(Impostors made, uint mesh, DrawnTexel x, ivec2 along, float depth) {
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
vec3 depthNormal(Impostors made, uint mesh, DrawnTexel x, float depth) {
    float side = texelSide(made, 1.0, x.level);
    return normalize(vec3(-heightStep(made, mesh, x, ivec2(1, 0), depth), -heightStep(made, mesh, x, ivec2(0, 1), depth), side));
}

/// Depth of the texel's plane at its middle, in the view. What a texel keeps is the nearest of the samples that it was made of: 2^(level + 1) a side, so that
/// the outermost lie a quarter of a finest texel from its border.
float middleDepth(Impostors made, uint level, float nearest, vec3 flatNormal) {
    float outermost = 0.5 - 0.25 / float(1u << level);
    return nearest + outermost * (abs(flatNormal.x) + abs(flatNormal.y)) / max(flatNormal.z, STEEPEST) * 0.5 * texelSide(made, 1.0, level);
}

/// False where nothing of it is seen.
bool splatOf(World w, Impostors made, DrawnTexel x, ImpostorTexel t, out Splat s) {
    if (t.alpha < (params.blend ? LEAST_ALPHA : params.cutoff)) return false;
    uint mesh = w.instances.at[x.instance].mesh;
    ImpostorRecord object = made.objects.at[mesh];
    ImpostorView v = impostorView(made.views, x.view);
    Placement placement = placementOf(w, x.instance);
    float mirror = placementDeterminant(placement) < 0.0 ? -1.0 : 1.0, n = float(levelResolution(made, x.level));
    vec3 seen = safeNormalize(t.normal, vec3(0.0, 0.0, 1.0)), flatNormal = seen;
    if ((t.flags & TEXEL_BUMPED) != 0u) flatNormal = depthNormal(made, mesh, x, t.depth);
    float depth = middleDepth(made, x.level, t.depth, flatNormal);
    vec3 position = placePoint(placement, windowPoint(made, object.center, object.radius, v, (vec2(x.texel) + 0.5) / n, depth));
    vec3 view = w.camera.orthographic != 0u ? -w.camera.forward : normalize(w.camera.position - position);

    s.normal = safeNormalize(placeNormal(placement, outOfView(v, seen)) * mirror, view);
    vec3 geometric = safeNormalize(placeNormal(placement, outOfView(v, flatNormal)) * mirror, view);
    bool turns = (t.flags & TEXEL_TWO_SIDED) != 0u && dot(geometric, view) < 0.0;
    if (turns) s.normal = -s.normal;
    if (params.backFaces && !turns && length(t.normal) >= NORMAL_MEANS && dot(geometric, view) < -BACK_SLACK) return false;

    float side = texelSide(made, object.radius, x.level), steep = max(flatNormal.z, STEEPEST);
    vec3 rise = 0.5 * side * v.d / steep;
    vec3 along = placeVector(placement, 0.5 * side * v.x - flatNormal.x * rise), across = placeVector(placement, 0.5 * side * v.y - flatNormal.y * rise);
    s.side = side * placementScale(placement);
    s.frontal = flatNormal.z;
    vec2 size = vec2(frameSize()), place = pixelPlace();
    vec3 center = cameraProject(w, position, vec2(0.5)), a = cameraProject(w, position + along, vec2(0.5)), b = cameraProject(w, position + across, vec2(0.5));
    s.center = center.xy * size - place;
    s.depth = center.z;
    s.a = a.xy * size - place - s.center;
    s.b = b.xy * size - place - s.center;
    s.slope = vec2(a.z, b.z) - center.z;
    return center.z > 0.0 && a.z > 0.0 && b.z > 0.0 && all(greaterThan(s.center, vec2(-3.0))) && all(lessThan(s.center, size + 2.0));
}

/// A pixel in units of the half sides. Far away where these lie along one line.
vec2 inSplat(Splat s, ivec2 pixel) {
    vec2 d = vec2(pixel) - s.center;
    float area = s.a.x * s.b.y - s.a.y * s.b.x;
    return abs(area) > 1e-6 ? vec2(d.x * s.b.y - d.y * s.b.x, s.a.x * d.y - s.a.y * d.x) / area : vec2(1e3);
}

/// How much larger than it is a texel is drawn, so that surfaces that bend have no cracks.
const float OVERLAP = 1.15;

bool covers(Splat s, ivec2 pixel) { return all(lessThanEqual(abs(inSplat(s, pixel)), vec2(OVERLAP))); }

ivec2 centerPixel(Splat s) { return ivec2(floor(s.center + 0.5)); }

/// Depth of the texel's plane in a pixel, within the texel.
float depthIn(Splat s, ivec2 pixel) {
    vec2 at = inSplat(s, pixel);
    return s.depth + (all(lessThan(abs(at), vec2(1e3))) ? dot(clamp(at, -1.0, 1.0), s.slope) : 0.0);
}
