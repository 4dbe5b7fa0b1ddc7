// SPDX-License-Identifier: MIT
// All that traces rays: the path that last frame held in this pixel goes to where its first hit is now; this frame's path goes back to last
// frame, to know who could have made it. With a backup both happen once more by reprojection.
#version 460
#include "pass.glsl"
#include "film_projection.glsl"
#include "restir/mis.glsl"
#include "restir/neighbours.glsl"
#include "restir/ris.glsl"
#include "restir/shift.glsl"
#include "lod/vertex_mapping.glsl"
#include "world/same_scene.glsl"

const uint SCATTER = 0, SCATTER_BACK = 1, GATHER = 2, GATHER_BACK = 3;

struct Path {
    Shift shift;
    bool refresh;
    bool running;        // the present item has begun a shift
    ivec2 before;        // where the pixel was
    bool hasBefore;
    Reservoir own;
    SampleHit ownHit;
    uint target;         // pixel that a scattered path goes to
    float confidence;    // of the pixel of last frame that the present item is about
    float pHat, W;       // of the path before it was shifted
    Origins origins;
};

World scene = world();
uint place(ivec2 p) { return pixelIndex(p); }
float capped(Reservoir r) { return cappedConfidence(confidence(r), params.cap); }

uint pathItems() { return !historyValid() || params.cap == 0 ? 0 : params.backup > 0 ? 4 : 2; }
World pathWorld(uint item) {
    if ((item & 1) == 0) return scene;
    return worldPrev();
}

// Takes a vertex from `from` to `to`. False: it can't be found there. `jacobian` becomes that of its barycentric area.
bool mapVertex(World from, World to, bool wanted, uint instance, inout uint primitive, inout vec2 barycentrics, vec2 coordinates, out float jacobian) {
    jacobian = 1;
    uint before = from.levels.at[instance], after = to.levels.at[instance];
    if (before == after || isShown(to, instance, primitive)) return true;
#if HAS_uv
    if (!wanted) return false;
    Placement placed = placementOf(scene, instance);  // the same there and back, so that tau can be undone
    mat3 space = params.matching == matching_world ? transpose(mat3(placed.row0, placed.row1, placed.row2)) : mat3(1);
    MappedPoint found = mapPoint(to, uv(), to.instances.at[instance].mesh, primitive, coordinates, before, after, params.vertexMapping != vertexMapping_uv_no_matching, space);
    primitive = found.primitive;
    barycentrics = found.barycentrics;
    jacobian = found.jacobian;
    return jacobian > 0;
#else
    return false;
#endif
}

bool mapsPrimary() { return params.vertexMapping != vertexMapping_triangle && params.vertexMapping != vertexMapping_reconnection_only; }
bool mapsReconnection() { return params.vertexMapping != vertexMapping_triangle && params.vertexMapping != vertexMapping_primary_only; }

// Whether what the pixel's centre sees could be found last frame. It tells how much of the confidence of last frame is left to a pixel, and asks
// nothing of the samples, as confidence must not.
bool keepsFirstHit(PrimaryHit centre) {
    if (centre.primitive == NONE) return true;
    float jacobian;
    return mapVertex(scene, worldPrev(), mapsPrimary(), centre.instance, centre.primitive, centre.barycentrics, uvOn(scene, cornersOf(scene, centre.primitive), centre.barycentrics, 0), jacobian);
}

// tau of x_k, where it is a surface.
bool mapReconnection(World from, World to, inout Reservoir path, SampleHit hit, out float jacobian) {
    jacobian = 1;
    uint kind = reconnectionKind(unpackShape(path.shape));
    if (kind == RC_NONE || kind == RC_ENVIRONMENT || kind == RC_LIGHT) return true;
    vec2 barycentrics = unpackBarycentrics(path.rcBarycentrics);
    if (!mapVertex(from, to, mapsReconnection(), path.rcInstance, path.rcPrimitive, barycentrics, hit.rcUv, jacobian)) return false;
    path.rcBarycentrics = packBarycentrics(barycentrics);
    return true;
}

// Starts a shift that keeps the first hit. `target`: the pixel it lands in.
bool scatter(inout Path p, World from, World to, Reservoir path, SampleHit hit, out ivec2 target) {
    target = ivec2(0);
    if (!holdsPath(path)) return false;
    PrimaryHit first = hit.hit;
    float ofPrimary = 1, ofReconnection;
    if (first.primitive != NONE && !mapVertex(from, to, mapsPrimary(), first.instance, first.primitive, first.barycentrics, hit.uv, ofPrimary)) return false;
    if (!mapReconnection(from, to, path, hit, ofReconnection)) return false;
    if (!project(to, first, cameraRay(from, hit.hit.film, hit.hit.lens).direction)) return false;
    target = min(ivec2(first.film * vec2(frameSize())), ivec2(frameSize()) - 1);
    float jacobian = ofPrimary * ofReconnection * jacobianRatio(filmTerm(to, first), filmTerm(from, hit.hit));
    return shiftStartAt(p.shift, to, path, hit, first, jacobian, p.refresh);
}

void begin(inout Path p, ivec2 pixel) {
    p.own = reservoirs(place(pixel));
    p.ownHit = samples(place(pixel));
    p.before = pixelBefore(pixel, motion(pixel));
    p.hasBefore = inside(p.before);
    p.refresh = params.suffix == suffix_walked || (params.suffix == suffix_automatic && !sameScene(scene, worldPrev()));
    p.origins = Origins(0, 0, keepsFirstHit(hits(place(pixel))) ? 1 : 0, 0);
}

// Takes in what the item's shift has given.
void finish(inout Path p, ivec2 pixel, uint item) {
    bool good = p.running && p.shift.jacobian > 0;
    if (item == SCATTER || item == GATHER) {
        Landing landing = Landing(NONE, 0, p.shift.jacobian, p.pHat, p.confidence, uvec3(0));
        Reservoir path = p.shift.path;
        path.W = p.W;
        if (good && item == SCATTER) {
            landing.target = p.target;
            landing.order = atomicAdd(OutCounts(passBlock().counts.address).at[p.target], 1);
            storeShifted(place(pixel), path);
            storeShiftedSamples(place(pixel), p.shift.hit);
        } else if (good) {
            landing.target = place(pixel);
            storeGathered(place(pixel), path);
            storeGatheredSamples(place(pixel), p.shift.hit);
        }
        if (item == SCATTER) storeLandings(place(pixel), landing);
        else storeGatherings(place(pixel), landing);
        return;
    }
    float from = good ? p.confidence * pHatFromReverse(target(p.shift.path), p.shift.jacobian) : 0;
    if (item == SCATTER_BACK) p.origins.scattered = from;
    else p.origins.gathered = from;
}

bool start(inout Path p, World w, ivec2 pixel, uint item) {
    World last = worldPrev();
    Reservoir path = p.own;
    SampleHit hit = p.ownHit;
    ivec2 landing;
    if (item == SCATTER) {
        path = history(place(pixel));
        hit = historySamples(place(pixel));
        p.confidence = capped(path);
        p.pHat = target(path);
        p.W = path.W;
        bool begun = p.confidence > 0 && scatter(p, last, scene, path, hit, landing);
        p.target = place(landing);
        return begun;
    }
    if (item == SCATTER_BACK) {
        if (!scatter(p, scene, last, path, hit, landing)) return false;
        p.confidence = capped(history(place(landing)));
        return p.confidence > 0;
    }
    if (!p.hasBefore) return false;
    Reservoir past = history(place(p.before));
    p.confidence = capped(past);
    if (p.confidence == 0) return false;
    float jacobian;
    if (item == GATHER) {
        hit = historySamples(place(p.before));
        p.pHat = target(past);
        p.W = past.W;
        return mapReconnection(last, scene, past, hit, jacobian) &&
               shiftStart(p.shift, w, past, hit, p.before, pixel, frameSize(), hits(place(pixel)), jacobian, p.refresh);
    }
    return mapReconnection(scene, last, path, hit, jacobian) &&
           shiftStart(p.shift, w, path, hit, pixel, p.before, frameSize(), hitsPrev(place(p.before)), jacobian, p.refresh);
}

bool pathBegin(inout Path p, World w, ivec2 pixel, uint item) {
    if (item == 0) begin(p, pixel);
    else finish(p, pixel, item - 1);
    p.confidence = 0;
    p.running = start(p, w, pixel, item);
    return p.running;
}

Ray pathRay(inout Path p, out bool anyHit, out uint purpose) { return shiftRay(p.shift, anyHit, purpose); }
bool pathStep(inout Path p, World w, Hit hit) { return shiftStep(p.shift, w, rules(), hit); }

void pathEnd(Path p, World w, ivec2 pixel) {
    uint items = pathItems();
    Landing nowhere = Landing(NONE, 0, 0, 0, 0, uvec3(0));
    if (items == 0) {
        storeLandings(place(pixel), nowhere);
        p.origins = Origins(0, 0, 0, 0);
    } else {
        finish(p, pixel, items - 1);
    }
    if (items < 4) storeGatherings(place(pixel), nowhere);
    storeOrigins(place(pixel), p.origins);
}

#include "trace/driver.glsl"
