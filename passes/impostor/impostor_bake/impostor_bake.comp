// SPDX-License-Identifier: MIT
// The finest level of a mesh's views, side by side: four rays a texel, whose hits are reduced as four texels of the pyramid are.
#version 460
#include "pass.glsl"
#include "impostor/reduce.glsl"
#include "impostor/seen_normal.glsl"
#include "base/random.glsl"
#include "store_texel.glsl"
#include "trace/reference.glsl"
#include "trace/trace.glsl"

struct Path {
    uint view;
    uvec2 texel;
    uint item;  // of the next ray
    Hit hits[4];
};

World world() { return onlyInstance(objects(), job().mesh); }
uint pathItems(World now) { return 4; }
World pathWorld(World now, uint item) { return now; }

void pathStart(inout Path p, World now, ivec2 pixel) {
    uint n = job().texels.resolution;
    p.view = uint(pixel.x) / n;
    p.texel = uvec2(uint(pixel.x) % n, pixel.y);
}

bool pathBegin(inout Path p, World w, ivec2 pixel, uint item) {
    p.item = item;
    return true;
}

Ray pathRay(inout Path p, out bool anyHit, out uint purpose) {
    anyHit = false;
    purpose = RAYS_PRIMARY;
    BakeJob work = job();
    Impostors made = work.texels;
    ImpostorRecord object = made.objects.at[work.mesh];
    ImpostorView v = impostorView(made.views, p.view);
    vec2 window = (vec2(p.texel) + 0.25 + 0.5 * vec2(p.item & 1u, p.item >> 1)) / float(made.resolution);
    return Ray(windowPoint(made, object.center, object.radius, v, window, -0.5), 0.0, -v.d, 4.0 * object.radius, 0u);
}

bool pathStep(inout Path p, World w, Hit hit) {
    p.hits[p.item] = hit;
    return false;
}

void pathItemEnd(inout Path p, World w, ivec2 pixel, uint item) {}

// log2 of texture coordinates per side of a sample, which is half a texel wide.
float densityOf(World w, Surface s, float side) {
    uvec3 corners = cornersOf(w, s.primitive);
    vec2 a = w.vertices.at[corners.x].uv0, b = w.vertices.at[corners.y].uv0 - a, c = w.vertices.at[corners.z].uv0 - a;
    float area = abs(b.x * c.y - b.y * c.x);
    return area > 0.0 && s.twiceArea > 0.0 ? 0.5 * log2(area / s.twiceArea) + log2(0.5 * side) : DENSITY_NONE;
}

// Its material is the number among the mesh's.
ImpostorTexel sampleOf(World w, BakeJob work, ImpostorRecord object, ImpostorView v, Hit hit) {
    ImpostorTexel t = emptyTexel();
    if (hit.primitive == NONE) return t;
    Surface s = surfaceAt(w, hit, -v.d);
    uint flags = w.materials.at[s.material].flags;
    vec3 n = seenNormal(w, s);
    t.flags = ((flags & MATERIAL_DOUBLE_SIDED) != 0u ? TEXEL_TWO_SIDED : 0u) | (s.frontFace ? 0u : TEXEL_BACK) |
              (dot(n, s.normal) < 0.95 ? TEXEL_BUMPED : 0u);
    n = intoView(v, n);
    t.normal = safeNormalize(vec3(n.xy, max(n.z, 0.0)), vec3(0.0, 0.0, 1.0));
    t.depth = windowOf(work.texels, object.center, object.radius, v, s.position).z;
    t.alpha = 1.0;
    t.density = densityOf(w, s, texelSide(work.texels, object.radius, 0u));
    t.uv = s.uv;
    t.material = UintArray(work.numbers).at[s.material];
    t.counts = 15u << (4u * UintArray(object.names).at[2u * t.material + 1u]);
    return t;
}

void pathEnd(Path p, ivec2 pixel) {
    World w = world();
    BakeJob work = job();
    ImpostorRecord object = work.texels.objects.at[work.mesh];
    ImpostorView v = impostorView(work.texels.views, p.view);
    ImpostorTexel samples[4];
    for (int i = 0; i < 4; ++i) samples[i] = sampleOf(w, work, object, v, p.hits[i]);
    ImpostorTexel t = reduceTexels(samples, 2u * work.texels.resolution, pcg4d(uvec4(p.texel, p.view, 0u)).x);
    storeTexel(work, 0u, p.view, p.texel, t, t.material);
}

#include "trace/driver.glsl"
