// SPDX-License-Identifier: MIT
#version 460
#include "pass.glsl"

// How a vertex draws the lights that it chooses from.
#if HAS_tiles
#include "restir/light_tiles.glsl"
LightDraw drawLights(uvec2 seed, uint vertex, uint candidates) {
    return drawFromTile(seed, seedPixel(seed, runSeed()), frameIndex(), runSeed(), vertex, candidates);
}
LightPoint drawnLight(World w, LightDraw d, uint candidate) { return lightOf(tiles(tileEntry(d, candidate))); }
uint drawnNumber(LightDraw d, uint candidate) { return tileNumber(tileEntry(d, candidate), frameIndex(), runSeed()); }
#else
#include "restir/light_number.glsl"
struct LightDraw {
    uvec2 seed;
    uint vertex;
};
LightDraw drawLights(uvec2 seed, uint vertex, uint candidates) { return LightDraw(seed, vertex); }
uint drawnNumber(LightDraw d, uint candidate) { return lightNumber(d.seed, d.vertex, candidate); }
LightPoint drawnLight(World w, LightDraw d, uint candidate) { return lightPoint(w, drawnNumber(d, candidate)); }
#endif

#include "rate/walk.glsl"
#include "restir/path_tree.glsl"
#include "trace/known_ray.glsl"
#include "world/exposure.glsl"

struct Path {
    PathTree tree;
    uvec2 decisions;    // seed of the resampling
    bool known;         // the camera hit is
    PrimaryHit centre;  // of `hits`
    uint trees;         // 0: the pixel is skipped
    float chance;       // that it wasn't
};

#if HAS_hits && HAS_worldPrev
bool switchesLevels(World w) { return historyValid() && w.levelsChanged.at[0] != 0; }
bool switched(World w, PrimaryHit h) { return h.primitive != NONE && w.levels.at[h.instance] != worldPrev().levels.at[h.instance]; }
uint mostTrees() { return max(uint(params.candidates), uint(params.switchCandidates)); }
#else
bool switchesLevels(World w) { return false; }
bool switched(World w, PrimaryHit h) { return false; }
uint mostTrees() { return uint(params.candidates); }
#endif

uint pathItems(World now) { return switchesLevels(now) ? mostTrees() : uint(params.candidates); }

World pathWorld(World now, uint item) { return now; }

void pathStart(inout Path p, World now, ivec2 pixel) {
    treesStart(p.tree);
    p.trees = uint(params.candidates);
    p.chance = 1;
#if HAS_hits
    p.centre = hits(pixelIndex(pixel));
    if (switchesLevels(now) && switched(now, p.centre)) p.trees = mostTrees();
#endif
#if HAS_rates
    if (params.skipped == skipped_roulette) p.chance = ratesPixels(pixelIndex(pixel)).chance;
    if (isSkipped(pixel)) p.trees = 0;
#endif
}

bool pathBegin(inout Path p, World w, ivec2 pixel, uint item) {
    if (item >= p.trees) return false;
    p.decisions = resamplingSeed(uvec2(pixel), frameIndex(), runSeed(), passSalt());
    uvec2 seed = pathSeed(uvec2(pixel), frameIndex() * mostTrees() + item, runSeed());
    vec2 film = random2(seed, 0, RANDOM_FILM), lens = random2(seed, 0, RANDOM_LENS);
    p.known = params.camera == camera_hits;
    if (p.known) {
        film = p.centre.film;
        lens = p.centre.lens;
    }
    PROBE_OPEN(trees);
    PROBE(seed, seed);
    PROBE(film, film);
    PROBE(lens, lens);
    World then = atTime(w, pathNumber(rules(), w, pixel, seed));
    treeStart(p.tree, seed, film, lens, then.time, cameraRay(then, filmOf(pixel, film, frameSize()), lens));
    return true;
}

Ray pathRay(inout Path p, out bool anyHit, out uint purpose) {
    if (p.known && p.tree.vertex == 0) {
        anyHit = false;
        return knownRay(purpose);
    }
    return treeRay(p.tree, anyHit, purpose);
}

bool pathStep(inout Path p, World w, Hit hit) {
    if (p.known && p.tree.vertex == 0) hit = hitOf(p.centre);
    TreeLimits limits = TreeLimits(uint(params.segmentsMin), uint(params.bounces) + 1, params.roulette);
    return treeStep(p.tree, w, rules(), limits, hit, p.decisions);
}

#define PATH_NUMBER
uint pathNumber(Path p, World w, ivec2 pixel) { return pathNumber(rules(), w, pixel, p.tree.seed); }

void pathItemEnd(inout Path p, World w, ivec2 pixel, uint item) {}

// What a pixel holds that has no tree. Whether it was skipped is no sample's doing: without roulette it has no confidence.
void storeSkipped(Path p, ivec2 pixel) {
    SampleHit start = SampleHit(PrimaryHit(NONE, NONE, vec2(0), vec2(0.5), vec2(0.5)), 0, vec2(0), TrianglePlace(vec2(0), vec2(0)), 0);
#if HAS_hits
    start.hit = p.centre;
#endif
    storePathsReservoirs(pixelIndex(pixel), emptyReservoir(params.skipped == skipped_roulette ? 1 : 0));
    storePathsSamples(pixelIndex(pixel), start);
}

void pathEnd(Path p, ivec2 pixel) {
    if (p.trees == 0) {
        storeSkipped(p, pixel);
        return;
    }
    Reservoir r = treesReservoir(p.tree, p.trees);
    r.W /= p.chance;
    setConfidence(r, float(p.trees) / float(params.candidates));
    PROBE_RESERVOIR(kept, r);
    storePathsReservoirs(pixelIndex(pixel), r);
    if (holdsPath(r)) storePathsSamples(pixelIndex(pixel), p.tree.keptHit);
    else storePathsSamples(pixelIndex(pixel), p.tree.first);
}

#include "trace/driver.glsl"
