// SPDX-License-Identifier: MIT
// Stage 1: what surfaces go through on both sides is filled by them, by weights of screen distance, distance, normal and depth (RiLoD, section 3.4: joint
// bilateral filter whose neighbourhood is the pixel's block). Pixels that show something stay as they are, unless a nearer surface is all around.
#version 460
#include "pass.glsl"
#include "neighbour.glsl"

const int BLOCK = 8;
const int REACH = 3;             // pixels to each side that a hole's rims are looked for in
const uint ENCLOSED = 3u;        // of four lines through the pixel that have the same surface at both ends: a crack has three, a bay one
const float LEAST_WEIGHT = 0.25;
const uint LEAST_TAPS = 3u;
const float LEAST_ALPHA_MEAN = 0.5;  // of what it is filled with: less is a lattice that one sees through

Surfel surfelAt(ivec2 p) {
    Surfel f = NOTHING;
    if (inside(p)) f = surfels(pixelIndex(p));
    return f;
}
Neighbour at(World w, ivec2 p) { return neighbourOf(w, p, surfelAt(p)); }

/// Pixels to the first surfel on the way that is before what the pixel itself shows; 0: there is none within reach.
int rim(World w, ivec2 p, ivec2 way, Neighbour own) {
    for (int i = 1; i <= REACH; ++i) {
        Surfel f = surfelAt(p + i * way);
        if (f.instance == NONE || (own.isThere && own.f.depth - f.depth <= SAME_SURFACE * own.width)) continue;
        if (!own.isThere || !isSame(own, neighbourOf(w, p + i * way, f))) return i;
    }
    return 0;
}

/// Is the pixel inside a surface that doesn't show in it? `reference`: a rim of it, the nearest to the camera.
bool isHole(World w, ivec2 p, Neighbour own, out Neighbour reference) {
    const ivec2 ways[4] = ivec2[](ivec2(1, 0), ivec2(0, 1), ivec2(1, 1), ivec2(1, -1));
    uint enclosed = 0u;
    reference.isThere = false;
    for (uint i = 0u; i < 4u && enclosed + 4u - i >= ENCLOSED; ++i) {
        int to = rim(w, p, ways[i], own), from = to == 0 ? 0 : rim(w, p, -ways[i], own);
        if (from == 0) continue;
        Neighbour a = at(w, p + to * ways[i]), b = at(w, p - from * ways[i]);
        if (!isSame(a, b)) continue;
        ++enclosed;
        if (!reference.isThere || a.f.depth < reference.f.depth) reference = a;
    }
    return enclosed >= ENCLOSED;
}

void main() {
    if (skip()) return;
    ivec2 p = pixel();
    World w = world();
    Neighbour own = at(w, p), reference;
    Surfel made = own.f;
    bool isFilled = false;
    if (params.stage1 && !fades(own.f) && isHole(w, p, own, reference)) {
        Ray ray = pixelRay(w, p);
        float depth = planeDepth(w, reference, ray, float(REACH) * 4.0);
        vec3 center = ray.origin + depth / dot(ray.direction, w.camera.forward) * ray.direction, normal = vec3(0.0);
        float slant = max(0.3, dot(reference.normal, -ray.direction)), sum = 0.0, depths = 0.0, alphas = 0.0, heaviest = 0.0;
        ivec2 low = p / BLOCK * BLOCK - params.apron, high = p / BLOCK * BLOCK + BLOCK + params.apron;
        uint taps = 0u;
        for (int y = low.y; y < high.y; ++y) {
            for (int x = low.x; x < high.x; ++x) {
                Neighbour n = at(w, ivec2(x, y));
                if (!n.isThere || n.f.instance != reference.f.instance) continue;
                vec2 apart = vec2(ivec2(x, y) - p);
                vec3 away = n.position - center;
                float weight = exp(-dot(apart, apart) / (2.0 * params.sigma * params.sigma)) *
                               exp(-dot(away, away) * slant * slant / (2.0 * params.sigmaSurface * params.sigmaSurface * n.width * n.width)) *
                               pow(max(dot(n.normal, reference.normal), 0.0), params.sharpness) * exp(-offPlane(reference, n.position) / params.sigmaDepth);
                if (weight < 1e-4) continue;
                ++taps;
                sum += weight;
                depths += weight * planeDepth(w, n, ray, 4.0 * length(apart));
                normal += weight * n.normal;
                alphas += weight * n.f.alpha;
                if (weight <= heaviest) continue;
                heaviest = weight;
                made = n.f;  // its material and texture coordinates
            }
        }
        isFilled = taps >= LEAST_TAPS && sum >= LEAST_WEIGHT && alphas >= LEAST_ALPHA_MEAN * sum;
        if (isFilled) {
            made.depth = depths / sum;
            made.normal = packNormal(normalize(normal));
            made.alpha = alphas / sum;
        } else {
            made = own.f;
        }
    }
    storeBlocks(pixelIndex(p), made);
    storeFilled(p, isFilled ? 1.0 : 0.0);
}
