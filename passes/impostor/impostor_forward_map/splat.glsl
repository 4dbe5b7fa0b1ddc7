// SPDX-License-Identifier: MIT
// A texel of an impostor on the film: a parallelogram of the plane that it is part of. After pass.glsl.
#include "base/jitter.glsl"
#include "impostor/texel_plane.glsl"
#include "numbering.glsl"
#include "world/camera.glsl"

const float BACK_SLACK = 0.05;  // cosine by which a mean normal may lean away and still be of what is seen

struct Splat {
    vec2 center;    // in pixels: whole numbers are the places that decide what pixels show
    vec2 a, b;      // half sides
    float depth;    // at the centre
    vec2 slope;     // depth gained along a and b
    bool turned;    // it has two sides and is seen from the other one
    float frontal;  // cosine between the surface and the view that saw it
    float side;     // of the texel, world units
};

vec2 pixelPlace() { return params.film == film_frame ? frameJitter(frameIndex(), runSeed()) : vec2(0.5); }

/// False where nothing of it is seen.
bool splatOf(World w, Impostors made, DrawnTexel x, ImpostorTexel t, out Splat s) {
    if (!isSeen(t)) return false;
    uint mesh = w.instances.at[x.instance].mesh;
    ImpostorRecord object = made.objects.at[mesh];
    ImpostorView v = impostorView(made.views, x.place.view);
    Placement placement = placementOf(w, x.instance);
    TexelPlane plane = texelPlane(made, mesh, x.place, t);
    vec3 position = placePoint(placement, plane.middle), along = placeVector(placement, plane.along), across = placeVector(placement, plane.across);
    vec3 view = w.camera.orthographic != 0u ? -w.camera.forward : normalize(w.camera.position - position);

    vec3 geometric = normalOutOfView(placement, v, plane.normal, view);
    s.turned = (t.flags & TEXEL_TWO_SIDED) != 0u && dot(geometric, view) < 0.0;
    if (params.backFaces && !s.turned && length(t.normal) >= NORMAL_MEANS && dot(geometric, view) < -BACK_SLACK) return false;

    s.side = texelSide(made, object.radius, x.place.level) * placementScale(placement);
    s.frontal = plane.normal.z;
    vec2 size = vec2(frameSize()), place = pixelPlace();
    vec3 center = cameraProject(w, position, LENS_CENTRE);
    vec3 a = cameraProject(w, position + along, LENS_CENTRE), b = cameraProject(w, position + across, LENS_CENTRE);
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

/// `part`: of the texel that the object covers (outline.glsl).
bool covers(Splat s, ivec2 pixel, vec3 part) {
    vec2 at = inSplat(s, pixel);
    return all(lessThanEqual(abs(at), vec2(OVERLAP))) && dot(part.xy, at) <= part.z;
}

ivec2 centerPixel(Splat s) { return ivec2(floor(s.center + 0.5)); }

/// Depth of the texel's plane in a pixel, within the texel.
float depthIn(Splat s, ivec2 pixel) {
    vec2 at = inSplat(s, pixel);
    return s.depth + (all(lessThan(abs(at), vec2(1e3))) ? dot(clamp(at, -1.0, 1.0), s.slope) : 0.0);
}
