// SPDX-License-Identifier: MIT
// The finest level of a mesh's views, side by side: the mean of four rays a texel.
#version 460
#include "pass.glsl"
#include "bsdf/material.glsl"
#include "impostor/seen_normal.glsl"
#include "light/emission.glsl"
#include "made_texel.glsl"
#include "trace/reference.glsl"
#include "trace/trace.glsl"

const uint RAYS = 4u;

struct Path {
    uint view;
    uvec2 texel;
    Ray ray;
    AtlasTexel sum;
};

World world() { return onlyInstance(objects(), bakedMesh()); }
uint pathItems(World now) { return RAYS; }
World pathWorld(World now, uint item) { return now; }

void pathStart(inout Path p, World now, ivec2 pixel) {
    uint n = atlases().resolution;
    p.view = uint(pixel.x) / n;
    p.texel = uvec2(uint(pixel.x) % n, pixel.y);
    p.sum = emptyAtlasTexel();
}

bool pathBegin(inout Path p, World w, ivec2 pixel, uint item) {
    Atlases made = atlases();
    AtlasRecord object = made.objects.at[bakedMesh()];
    ImpostorView v = atlasView(made, p.view);
    vec2 window = (vec2(p.texel) + 0.25 + 0.5 * vec2(item & 1u, item >> 1)) / float(made.resolution), place = planeOfWindow(made, window);
    p.ray = Ray(object.center + object.radius * (place.x * v.x + place.y * v.y + 2.0 * v.d), 0.0, -v.d, 4.0 * object.radius, 0u);
    return true;
}

Ray pathRay(inout Path p, out bool anyHit, out uint purpose) {
    anyHit = false;
    purpose = RAYS_PRIMARY;
    return p.ray;
}

bool pathStep(inout Path p, World w, Hit hit) {
    if (hit.primitive == NONE) return false;
    Surface s = surfaceAt(w, hit, p.ray.direction);
    Bsdf b = bsdfAt(w, s);
    AtlasRecord object = atlases().objects.at[bakedMesh()];
    float depth = 0.5 + 0.5 * dot(s.position - object.center, p.ray.direction) / object.radius;
    addTexel(p.sum, AtlasTexel(1.0, b.base, seenNormal(w, s), depth, sqrt(b.alpha), b.metallic, emittedRadiance(w, s)), 1.0 / float(RAYS));
    return false;
}

void pathItemEnd(inout Path p, World w, ivec2 pixel, uint item) {}

void pathEnd(Path p, ivec2 pixel) { storeTexel(atlases(), 0u, p.view, p.texel, p.sum); }

#include "trace/driver.glsl"
