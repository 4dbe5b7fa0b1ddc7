// SPDX-License-Identifier: MIT
// One camera ray a pixel, and what is known of its hit without shading.
#version 460
#include "pass.glsl"
#include "base/random.glsl"
#include "basic/film.glsl"
#include "bsdf/material.glsl"
#include "surface/surfel_point.glsl"
#include "trace/trace.glsl"
#include "world/camera.glsl"
#include "world/exposure.glsl"

struct Path {
    vec2 place, lens;  // inside the pixel, on the lens
    vec2 film;
    Ray ray;
    Hit hit;
};

uint pathItems(World now) { return 1; }

#if HAS_surfels
World pathWorld(World now, uint item) { return rest(); }
World shownWorld(World traced) { return world(); }

/// What the pixel shows of impostors, where that is nearer.
void meetSurfel(inout Path p, World w, ivec2 pixel) {
    Surfel f = surfels(pixelIndex(pixel));
    float forward = dot(p.ray.direction, w.camera.forward);
    bool isHidden = p.hit.primitive != NONE && p.hit.instance != f.instance && p.hit.t * forward < f.depth;  // its own geometry makes way where it fades
    if (f.instance == NONE || isHidden) return;
    SurfacePoint found = surfelPoint(w, f, p.ray.origin + f.depth / forward * p.ray.direction);
    p.hit = Hit(f.depth / forward, found.barycentrics, found.primitive, found.instance);
}
#else
World pathWorld(World now, uint item) { return now; }
World shownWorld(World traced) { return traced; }

void meetSurfel(inout Path p, World w, ivec2 pixel) {}
#endif

void pathStart(inout Path p, World now, ivec2 pixel) {}

bool pathBegin(inout Path p, World w, ivec2 pixel, uint item) {
    uvec2 seed = pathSeed(uvec2(pixel), frameIndex(), runSeed());
    p.place = filmPlace(seed);
    p.film = filmOf(pixel, p.place, frameSize());
    p.lens = lensPlace(seed);
    p.ray = cameraRay(atTime(w, numberOfPixel(w, pixel)), p.film, p.lens);
    return true;
}

Ray pathRay(inout Path p, out bool anyHit, out uint purpose) {
    anyHit = false;
    purpose = RAYS_PRIMARY;
    return p.ray;
}

bool pathStep(inout Path p, World w, Hit hit) {
    p.hit = hit;
    return false;
}

// Where last frame's image showed what the pixel's ray hit, relative to where this one does, in pixels. Without a hit: the point at infinity. Both by
// projection: what rounding moves the point by, which barycentrics of ground seen from close by make pixels of, is in both.
vec2 motionOf(Path p, World w, ivec2 pixel) {
#if HAS_worldPrev
    if (!historyValid()) return vec2(0);
    World before = atTime(worldPrev(), numberOfPixel(w, pixel));
    vec3 was, is = vec3(p.film, 1);
    if (p.hit.primitive == NONE) {
        was = cameraProjectSky(before, p.ray.direction, p.film, p.lens);
    } else {
        was = cameraProject(before, positionAt(before, pointOf(p.hit)), p.lens);
        is = cameraProject(w, positionAt(w, pointOf(p.hit)), p.lens);
    }
    return was.z > 0 && is.z > 0 ? (was.xy - is.xy) * vec2(frameSize()) : vec2(0);
#else
    return vec2(0);
#endif
}

void pathItemEnd(inout Path p, World traced, ivec2 pixel, uint item) {
    World w = shownWorld(traced);
    meetSurfel(p, w, pixel);
    PrimaryHit found;
    found.instance = p.hit.instance;
    found.primitive = p.hit.primitive;
    found.barycentrics = p.hit.barycentrics;
    found.film = p.place;
    found.lens = p.lens;
    storeHits(pixelIndex(pixel), found);
    storeMotion(pixel, motionOf(p, w, pixel));
    if (p.hit.primitive == NONE) {
        storeDepth(pixel, 0);
        storeNormal(pixel, vec4(0));
        storeAlbedo(pixel, vec4(0));
        return;
    }
    Surface s = surfaceAt(w, p.hit, p.ray.direction);
    storeDepth(pixel, dot(s.position - w.camera.position, w.camera.forward));
    storeNormal(pixel, vec4(s.shadingNormal, 0));
    storeAlbedo(pixel, vec4(bsdfAt(w, s).base, 1));
}

void pathEnd(Path p, ivec2 pixel) {}

#include "trace/driver.glsl"
