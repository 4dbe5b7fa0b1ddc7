// SPDX-License-Identifier: MIT
// All that traces rays: the path that last frame held in this pixel goes to where its first hit is now, once for each part of the exposure; this frame's
// path goes back to last frame, to know who could have made it. With a backup both happen once more by reprojection.
#version 460
#include "pass.glsl"
#include "backup.glsl"
#include "film_projection.glsl"
#include "splats.glsl"
#include "lod/path_mapping.glsl"
#include "restir/mis.glsl"
#include "restir/history.glsl"
#include "restir/ris.glsl"
#include "restir/shift.glsl"
#include "restir/suffix.glsl"
#include "world/exposure.glsl"

// How a pixel and its partner in last frame find each other: by where the first hit is, once for each part of the exposure, then by motion.
bool isSplat(uint partner) { return partner < splatsOfPath(); }

struct Reuse {
    Reservoir own;
    SampleHit ownHit;
    bool refresh;
    ivec2 before;        // where the pixel was
    ivec2 landing;       // pixel that the present shift leads to
    float confidence;    // of the pixel of last frame that the present shift is about, 0: there is none
    float pHat, W;       // of last frame's path before it was shifted
    Origins origins;
};

// Does what follows the reconnection vertex change on the way? Between parts of an exposure it does wherever something moves, were it the same each frame.
bool walks(World now, World last) {
    bool moves = params.suffix == suffix_automatic && splatsOfPath() > 1 && uint64_t(now.closing) != 0;
    return moves || walksSuffix(now, last);
}

uint place(ivec2 p) { return pixelIndex(p); }

uint reusePartners() { return !historyValid() || params.cap == 0 ? 0 : splatsOfPath() + (backupShare() > 0 ? 1 : 0); }
World reuseWorld(World now, uint partner, uint way) {
    if (way == FORTH) return now;
    return worldPrev();
}

LevelMapping levelMapping() {
    bool maps = HAS_uv != 0 && params.vertexMapping != vertexMapping_triangle;
    return LevelMapping(maps && params.vertexMapping != vertexMapping_reconnection_only, maps && params.vertexMapping != vertexMapping_primary_only,
                        params.vertexMapping != vertexMapping_uv_no_matching, params.matching == matching_world);
}

void reuseStart(inout Reuse r, World w, ivec2 pixel) {
    r.origins = Origins(0, 0, 0);
    if (reusePartners() == 0) return;
    r.own = pathsReservoirs(place(pixel));
    r.ownHit = pathsSamples(place(pixel));
    r.before = pixelBefore(pixel, motion(pixel));
    r.refresh = walks(w, worldPrev());
}

ShiftTask reuseTask(inout Reuse r, World to, ivec2 pixel, uint partner, uint way) {
    bool splats = isSplat(partner);
    PROBE_CHOICE(technique, splats ? 0 : 1, "splatting|reprojection");
    // This frame's path is a copy of one path of last frame, whatever the part that it lies in.
    if (splats && way == BACK && partner > 0) return shiftOfNothing();
    World from, now = to;  // of the frames: at no time of a path, so that there and back it is the same
    if (way == BACK) from = now = world();
    else from = worldPrev();
    Reservoir path = r.own;
    SampleHit hit = r.ownHit;
    r.confidence = 0;
    if (!splats && !inside(r.before)) return shiftOfNothing();
    // Whose confidence counts is not known yet where this frame's path is splatted back: it depends on where it lands.
    if (!splats || way == FORTH) {
        ivec2 past = splats ? pixel : r.before;
        Reservoir old = historyReservoirs(place(past));
        r.confidence = confidence(old);
        if (r.confidence == 0 || (splats && !holdsPath(old))) return shiftOfNothing();
        if (way == FORTH) {
            path = old;
            hit = historySamples(place(past));
            r.pHat = target(path);
            r.W = path.W;
        }
    }
    PrimaryHit centre = hits(place(pixel)), start = hit.hit;
    uint wanted = !splats ? MAP_CONNECTED : MAP_CONNECTED | MAP_FIRST;
    if (splats && way == BACK && params.inherits == inherits_where_found) wanted |= MAP_CENTRE;
    ivec2 here = pixel, there = r.before;  // the pixels by which levels are chosen, if they are chosen by pixels: then nothing is splatted
    if (way == FORTH) here = r.before, there = pixel;
    RayNumbers numbers = RayNumbers(pathNumber(rules(), from, here, path.seed), pathNumber(rules(), to, there, path.seed));
    from = atTime(from, pathTime(rules(), from, here, hit.time));
    if (splats) hit.time = way == FORTH ? timeInPart(hit.time, partner, splatsOfPath()) : timeOfOriginal(hit.time, splatsOfPath());
    to = atTime(to, pathTime(rules(), to, there, hit.time));
    MappedPath mapped = mapPath(from, to, now, numbers, uv(), levelMapping(), wanted, centre, path, hit);
    // How much confidence of last frame is left to the pixel asks nothing of the samples, as confidence must not. All of it is where that isn't asked.
    if (splats && way == BACK) r.origins.kept = mapped.centreIsThere ? 1 : 0;
    PROBE_TEXT_IF(none, "a vertex has no counterpart on the level that is shown there", !mapped.isThere);
    if (!mapped.isThere) return shiftOfNothing();
    PrimaryHit first = mapped.hit.hit;
    hit.rc = mapped.hit.rc;
    r.landing = pixel;
    float jacobian = mapped.jacobian;
    if (splats) {
        vec3 seen = cameraRay(from, filmOf(pixel, start.film, frameSize()), start.lens).direction;
        if (!project(to, pixel, frameSize(), first, seen, r.landing)) return shiftOfNothing();
        if (way == BACK) r.confidence = confidence(historyReservoirs(place(r.landing)));
        jacobian *= jacobianRatio(filmTerm(to, r.landing, frameSize(), first), filmTerm(from, pixel, frameSize(), start));
    } else if (way == BACK) {
        r.landing = r.before;
        first = hitsPrev(place(r.before));
    } else {
        first = centre;
    }
    r.confidence = cappedConfidence(r.confidence, historyCap(way == FORTH ? r.landing : pixel));
    if (r.confidence == 0) return shiftOfNothing();
    // The copies of a path share its confidence: where nothing moves they are worth no more than it, and counted in full they outweigh what is new.
    if (splats) r.confidence /= float(splatsOfPath());
    PROBE_SHIFT(way, splats || way == BACK ? pixel : r.before, r.landing);
    PROBE(jacobianOfMap, mapped.jacobian);
    PROBE(jacobianOnFilm, jacobian / mapped.jacobian);
    if (splats) jacobian *= way == FORTH ? 1 / float(splatsOfPath()) : float(splatsOfPath());  // of the time
    return ShiftTask(mapped.path, hit, r.landing, first, splats, jacobian, r.refresh);
}

// Last frame's path has arrived, or not.
void arrive(inout Reuse r, ivec2 pixel, uint partner, Shift result) {
    bool good = result.jacobian > 0;
    Landing landing = Landing(NONE, result.jacobian, r.pHat, r.confidence);
    result.path.W = r.W;
    if (good) landing.target = place(r.landing);
    if (good && isSplat(partner)) {
        addCounts(landing.target, 1);
        storeShiftedReservoirs(splatOf(place(pixel), partner), result.path);
        storeShiftedSamples(splatOf(place(pixel), partner), result.hit);
    } else if (good) {
        storeGatheredReservoirs(place(pixel), result.path);
        storeGatheredSamples(place(pixel), result.hit);
    }
    if (isSplat(partner)) storeLandings(splatOf(place(pixel), partner), landing);
    else storeGatherings(place(pixel), landing);
}

void reuseResult(inout Reuse r, ivec2 pixel, uint partner, uint way, Shift result) {
    if (way == FORTH) {
        arrive(r, pixel, partner, result);
        return;
    }
    PROBE(confidence, r.confidence);
    PROBE(targetFrom, pHatFromReverse(target(result.path), result.jacobian));
    float from = r.confidence * pHatFromReverse(target(result.path), result.jacobian);
    if (!isSplat(partner)) r.origins.gathered = from;
    else if (partner == 0) r.origins.scattered = from;
}

void reuseEnd(Reuse r, ivec2 pixel) {
    Landing nowhere = Landing(NONE, 0, 0, 0);
    if (reusePartners() == 0) {
        for (uint i = 0; i < splatsOfPath(); ++i) storeLandings(splatOf(place(pixel), i), nowhere);
        if (backupShare() > 0) storeGatherings(place(pixel), nowhere);
    }
    storeOrigins(place(pixel), r.origins);
}

#include "restir/reuse_driver.glsl"
