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
#include "restir/suffix.glsl"
#include "lod/vertex_mapping.glsl"

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

// What is mapped for an item: what the pixel's centre sees, for SCATTER_BACK alone; the first hit of the path, where it is kept; x_k.
const uint MAP_CENTRE = 0, MAP_PRIMARY = 1, MAP_RECONNECTION = 2, MAPS = 3;

// Takes all that belongs to an item from the World `from` to the World `to`, at one place in the code: a map is many reads, and is compiled
// wherever it is called. False: the path can't be found there. `jacobian` becomes that of both barycentric areas.
bool mapPath(inout Path p, World from, World to, uint item, PrimaryHit centre, inout PrimaryHit first, inout Reservoir path, inout SampleHit hit, out float jacobian) {
    bool keepsFirst = item == SCATTER || item == SCATTER_BACK;
    uint kind = reconnectionKind(unpackShape(path.shape));
    bool connects = kind != RC_NONE && kind != RC_ENVIRONMENT && kind != RC_LIGHT;
    jacobian = 1;
    for (uint k = item == SCATTER_BACK ? MAP_CENTRE : MAP_PRIMARY; k < MAPS; ++k) {
        PrimaryHit at = k == MAP_CENTRE ? centre : first;
        vec2 coordinates = hit.uv;
        if (k == MAP_CENTRE) {
            if (at.primitive != NONE) coordinates = uvOn(from, cornersOf(from, at.primitive), at.barycentrics, 0);
        } else if (k == MAP_RECONNECTION) {
            at.instance = path.rcInstance;
            at.primitive = connects ? path.rcPrimitive : NONE;
            at.barycentrics = hit.rc.barycentrics;
            coordinates = hit.rc.uv;
        } else if (!keepsFirst) {
            continue;
        }
        float stretch = 1;
        bool there = at.primitive == NONE ||
                     mapVertex(from, to, k == MAP_RECONNECTION ? mapsReconnection() : mapsPrimary(), at.instance, at.primitive, at.barycentrics, coordinates, stretch);
        if (k == MAP_CENTRE) {
            // Tells how much of the confidence of last frame is left to the pixel, and asks nothing of the samples, as confidence must not.
            p.origins.kept = there ? 1 : 0;
            if (!holdsPath(path)) return false;
            continue;
        }
        if (!there) return false;
        jacobian *= stretch;
        if (k == MAP_PRIMARY) {
            first = at;
        } else if (connects) {
            path.rcPrimitive = at.primitive;
            hit.rc.barycentrics = at.barycentrics;
        }
    }
    return true;
}

void begin(inout Path p, ivec2 pixel) {
    p.own = pathsReservoirs(place(pixel));
    p.ownHit = pathsSamples(place(pixel));
    p.before = pixelBefore(pixel, motion(pixel));
    p.hasBefore = inside(p.before);
    p.refresh = walksSuffix(scene, worldPrev());
    p.origins = Origins(0, 0, 0, 0);
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
            storeShiftedReservoirs(place(pixel), path);
            storeShiftedSamples(place(pixel), p.shift.hit);
        } else if (good) {
            landing.target = place(pixel);
            storeGatheredReservoirs(place(pixel), path);
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

// Starts the shift of an item, to World `to`.
bool start(inout Path p, World to, ivec2 pixel, uint item) {
    bool back = item == SCATTER_BACK || item == GATHER_BACK, splats = item == SCATTER || item == SCATTER_BACK;
    World from = scene;
    if (!back) from = worldPrev();
    if (!splats && !p.hasBefore) return false;
    ivec2 past = splats ? pixel : p.before;  // whose confidence counts; of SCATTER_BACK that is not known yet
    Reservoir path = p.own;
    SampleHit hit = p.ownHit;
    if (item != SCATTER_BACK) {
        Reservoir old = historyReservoirs(place(past));
        p.confidence = capped(old);
        if (p.confidence == 0) return false;
        if (!back) {
            path = old;
            hit = historySamples(place(past));
            p.pHat = target(path);
            p.W = path.W;
        }
    }
    if (item == SCATTER && !holdsPath(path)) return false;
    PrimaryHit first = hit.hit;
    float jacobian;
    if (!mapPath(p, from, to, item, hits(place(pixel)), first, path, hit, jacobian)) return false;
    if (!splats) {
        ivec2 there = back ? p.before : pixel;
        PrimaryHit centre = hits(place(pixel));
        if (back) centre = hitsPrev(place(p.before));
        return shiftStart(p.shift, to, path, hit, there, frameSize(), centre, jacobian, p.refresh);
    }
    ivec2 landing;
    if (!project(to, pixel, frameSize(), first, cameraRay(from, filmOf(pixel, hit.hit.film, frameSize()), hit.hit.lens).direction, landing)) return false;
    if (back) {
        p.confidence = capped(historyReservoirs(place(landing)));
        if (p.confidence == 0) return false;
    }
    p.target = place(landing);
    jacobian *= jacobianRatio(filmTerm(to, landing, frameSize(), first), filmTerm(from, pixel, frameSize(), hit.hit));
    return shiftStartAt(p.shift, to, path, hit, first, landing, frameSize(), jacobian, p.refresh);
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
