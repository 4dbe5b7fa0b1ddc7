// SPDX-License-Identifier: MIT
// Two round trips a pixel: the partner's path here and back, the own path there and back.
#version 460
#include "pass.glsl"
#include "restir/mis.glsl"
#include "restir/ris.glsl"
#include "restir/shift.glsl"
#include "restir/neighbours.glsl"
#include "restir/similar_pixels.glsl"
#include "restir/suffix.glsl"

struct Reuse {
    Reservoir path;     // before the round trip
    SampleHit hit;
    Reservoir shifted;  // on its way back
    SampleHit shiftedHit;
    ivec2 partner;
    bool paired, refresh;
    float jacobian;     // of the way there
    float confidence;   // of the other pixel's reservoir
    ShiftCheck checks[2];
};

uint place(ivec2 p) { return pixelIndex(p); }

#if HAS_history
const bool BETWEEN_FRAMES = true;
Reservoir partnerReservoir(ivec2 p) { return historyReservoirs(place(p)); }
SampleHit partnerSample(ivec2 p) { return historySamples(place(p)); }
PrimaryHit partnerCentre(ivec2 p) { return hitsPrev(place(p)); }
bool mayPair() { return historyValid(); }
World partnerWorld() { return worldPrev(); }
ivec2 choosePartner(ivec2 pixel) { return pixelBefore(pixel, motion(pixel)); }
bool alike(World w, ivec2 pixel, ivec2 q) { return true; }
#else
const bool BETWEEN_FRAMES = false;
Reservoir partnerReservoir(ivec2 p) { return pathsReservoirs(place(p)); }
SampleHit partnerSample(ivec2 p) { return pathsSamples(place(p)); }
PrimaryHit partnerCentre(ivec2 p) { return hits(place(p)); }
bool mayPair() { return true; }
World partnerWorld() { return world(); }
ivec2 choosePartner(ivec2 pixel) {
    return pixelInDisk(pixel, params.radius, random2(resamplingSeed(uvec2(pixel), frameIndex(), runSeed(), passSalt()), 0, RANDOM_FREE));
}
bool alike(World w, ivec2 pixel, ivec2 q) {
    return q != pixel && similarPixels(pixelView(w, hits(place(pixel))), pixelView(w, hits(place(q))));
}
#endif

// Whose path makes the round trip.
const uint OF_PARTNER = 0;
const uint OF_PIXEL = 1;

bool leadsHere(uint trip, uint way) { return (trip == OF_PARTNER) == (way == FORTH); }

uint reusePartners() { return 2; }
World reuseWorld(World now, uint trip, uint way) {
    if (leadsHere(trip, way)) return now;
    return partnerWorld();
}

void reuseStart(inout Reuse r, World w, ivec2 pixel) {
    r.checks[0] = r.checks[1] = ShiftCheck(0, 0, 0, 0, 0, 0, 0, 0, 1);
    r.paired = false;
    if (!mayPair()) return;
    r.partner = choosePartner(pixel);
    if (!inside(r.partner) || !alike(w, pixel, r.partner)) return;
    r.paired = true;
    r.refresh = walksSuffix(w, partnerWorld());
}

// Is it the path that set out? F and G are compared elsewhere.
bool samePath(Reuse r, Shift returned) {
    Reservoir a = r.path, b = returned.path;
    PrimaryHit x = r.hit.hit, y = returned.hit.hit;
    bool connected = unpackShape(a.shape).k > 0;
    bool target = !connected || (a.rcInstance == b.rcInstance && a.rcPrimitive == b.rcPrimitive && r.hit.rc.barycentrics == returned.hit.rc.barycentrics);
    return a.seed == b.seed && a.shape == b.shape && target && x.instance == y.instance && x.primitive == y.primitive &&
           x.film == y.film && x.lens == y.lens;
}

// Both resampling MIS weights of one path, in two pixels that see it: the canonical pixel's and its neighbour's must sum to 1.
// confidences: canonical, neighbour's; pHat: canonical target. fromReverse is what the canonical pixel knows of the neighbour's target (0: no
// preimage), fromForward what the neighbour knows; they should be the same number.
float misError(vec2 confidences, float pHat, float fromReverse, float fromForward) {
    float worst = 0;
    PairwiseMis forms[2] = PairwiseMis[](defensivePairwiseMis(confidences.x, confidences.y), pairwiseMis(confidences.x, confidences.y));
    for (int i = 0; i < 2; ++i) {
        float own = forms[i].start + canonicalMis(forms[i], confidences.y, pHat, fromReverse);
        float other = fromForward > 0 ? neighbourMis(forms[i], confidences.y, pHat, fromForward) : 0;
        worst = max(worst, abs(own + other - 1));
    }
    float own = balanceMis(confidences.x * pHat, confidences.y * fromReverse);
    float other = fromForward > 0 ? balanceMis(confidences.y * fromForward, confidences.x * pHat) : 0;
    return max(worst, abs(own + other - 1));
}

// The way there has ended.
void arrive(inout Reuse r, inout ShiftCheck check, Shift there) {
    r.jacobian = there.jacobian;
    r.shifted = there.path;
    r.shifted.W = r.path.W;
    r.shiftedHit = there.hit;
    check.outcome = CHECK_TRIED;
    check.shape = r.path.shape;
    if (r.jacobian > 0) {
        check.outcome |= CHECK_THERE;
        check.energy = target(r.path) * r.path.W;
        check.energyShifted = target(r.shifted) * r.jacobian * r.path.W;
        check.stretch = r.shifted.G / r.path.G;
        if (r.path.lightPdf > 0 && reconnectionKind(there.shape) == RC_TO_LIGHT) check.stretch *= r.path.lightPdf / r.shifted.lightPdf;
    } else {
        // What the neighbour has no part in is the canonical pixel's alone.
        check.errorMis = misError(vec2(confidence(r.path), r.confidence), target(r.path), 0, 0);
    }
}

// So has the way back.
void comeBack(Reuse r, inout ShiftCheck check, Shift returned) {
    if ((check.outcome & CHECK_THERE) == 0) return;
    float back = returned.jacobian, pHat = target(r.path), pHatThere = target(r.shifted), pHatBack = target(returned.path), mine = confidence(r.path);
    if (back > 0) {
        check.outcome |= CHECK_BACK | (samePath(r, returned) ? CHECK_SAME : 0);
        vec3 change = abs(returned.path.F - r.path.F);
        check.errorF = maxComponent(change) / maxComponent(r.path.F);
        check.errorJacobian = abs(r.jacobian * back - 1);
        check.targetError = abs(pHatBack * r.jacobian * back / pHat - 1);
    }
    // The path where it went, as a neighbour's sample; and where it came from, as the canonical one.
    float returnedHere = pHatFromReverse(pHatBack, back), shiftedBack = pHatFromForward(pHatThere, back);
    float there = misError(vec2(r.confidence, mine), pHatThere, returnedHere, pHatFromForward(pHat, r.jacobian));
    float here = misError(vec2(mine, r.confidence), pHat, pHatFromReverse(pHatThere, r.jacobian), shiftedBack);
    check.errorMis = max(there, here);
}

ShiftTask reuseTask(inout Reuse r, World w, ivec2 pixel, uint trip, uint way) {
    if (!r.paired) return shiftOfNothing();
    if (way == FORTH) {
        bool own = trip == OF_PIXEL;
        r.path = own ? pathsReservoirs(place(pixel)) : partnerReservoir(r.partner);
        r.hit = own ? pathsSamples(place(pixel)) : partnerSample(r.partner);
        r.confidence = own ? confidence(partnerReservoir(r.partner)) : confidence(pathsReservoirs(place(pixel)));
        r.jacobian = 0;
    }
    if (!holdsPath(r.path) || (way == BACK && r.jacobian == 0)) return shiftOfNothing();
    Reservoir path = r.path;
    SampleHit hit = r.hit;
    if (way == BACK) {
        path = r.shifted;
        hit = r.shiftedHit;
    }
    bool here = leadsHere(trip, way);
    ivec2 to = here ? pixel : r.partner;
    PrimaryHit centre;
    if (here) centre = hits(place(to));
    else centre = partnerCentre(to);
    PROBE_SHIFT(way, here ? r.partner : pixel, to);
    ShiftTask task = shiftTo(to, centre, path, hit);
    task.refresh = r.refresh;
    return task;
}

void reuseResult(inout Reuse r, ivec2 pixel, uint trip, uint way, Shift result) {
    if (!r.paired || !holdsPath(r.path)) return;
    if (way == FORTH) arrive(r, r.checks[trip], result);
    else comeBack(r, r.checks[trip], result);
}

vec3 colorOf(ShiftCheck a) {
    if ((a.outcome & CHECK_TRIED) == 0) return vec3(0);
    if ((a.outcome & CHECK_THERE) == 0) return a.errorMis > params.tolerance ? vec3(0, 1, 1) : vec3(0.2);
    if ((a.outcome & CHECK_BACK) == 0) return vec3(1, 0, 0);
    if ((a.outcome & CHECK_SAME) == 0) return vec3(1, 0, 1);
    if (a.errorF > params.tolerance) return vec3(1, 0.4, 0);
    if (a.errorJacobian > params.tolerance) return vec3(1, 1, 0);
    return a.errorMis > params.tolerance ? vec3(0, 1, 1) : vec3(0, 0.25, 0);
}

void reuseEnd(Reuse r, ivec2 pixel) {
    vec3 shown = vec3(0);
    for (uint i = 0; i < 2; ++i) {
        storeChecks(2 * place(pixel) + i, r.checks[i]);
        vec3 c = colorOf(r.checks[i]);
        shown = c.r > 0.2 || c.b > 0.2 || shown.r > 0.2 || shown.b > 0.2 ? max(shown, c) : shown + c;
    }
    storeColor(pixel, vec4(shown, 1));
}

#include "restir/reuse_driver.glsl"
