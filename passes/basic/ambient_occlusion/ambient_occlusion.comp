// SPDX-License-Identifier: MIT
// Directions around the shading normal with density cos / PI, one item each: the mean of what is open is the cosine-weighted share (Zhukov et al. 1998,
// An Ambient Light Illumination Model, with a step at the radius). Directions beneath the triangle are closed without a ray.
#version 460
#include "pass.glsl"
#include "base/random.glsl"
#include "base/sampling.glsl"
#include "surface/surface.glsl"
#include "trace/trace.glsl"
#include "world/camera.glsl"
#include "world/exposure.glsl"

const uint RANDOM_OPENING = RANDOM_FREE;

struct Path {
    bool isSurface;
    vec3 origin;         // of all rays: off the triangle, on the viewer's side
    vec3 normal;         // of the triangle
    vec3 shadingNormal;
    vec3 direction;      // of the item's ray
    float count;         // of rays that met nothing
};

uint pathItems(World now) { return uint(params.rays); }

World pathWorld(World now, uint item) { return now; }

void pathStart(inout Path p, World now, ivec2 pixel) {
    PrimaryHit first = hits(pixelIndex(pixel));
    p.count = 0;
    p.isSurface = first.primitive != NONE;
    if (!p.isSurface) return;
    now = atTime(now, numberOfPixel(now, pixel));
    Surface s = surfaceAt(now, hitOf(first), cameraRay(now, filmOf(pixel, first.film, openSize()), first.lens).direction);
    p.origin = spawnOrigin(s, s.normal);
    p.normal = s.normal;
    p.shadingNormal = s.shadingNormal;
}

bool pathBegin(inout Path p, World w, ivec2 pixel, uint item) {
    if (!p.isSurface) return false;
    uvec2 seed = pathSeed(uvec2(pixel), frameIndex() * uint(params.rays) + item, runSeed());
    p.direction = basisAround(p.shadingNormal) * cosineHemisphere(random2(seed, 1, RANDOM_OPENING));
    return dot(p.direction, p.normal) > 0;
}

Ray pathRay(inout Path p, out bool anyHit, out uint purpose) {
    anyHit = true;
    purpose = RAYS_VISIBILITY;
    return Ray(p.origin, 0, p.direction, params.radius > 0 ? params.radius : FAR, 0);
}

bool pathStep(inout Path p, World w, Hit hit) {
    if (hit.primitive == NONE) ++p.count;
    return false;
}

void pathItemEnd(inout Path p, World w, ivec2 pixel, uint item) {}

void pathEnd(Path p, ivec2 pixel) { storeOpen(pixel, vec4(vec3(p.isSurface ? p.count / float(params.rays) : 1), 1)); }

#include "trace/driver.glsl"
