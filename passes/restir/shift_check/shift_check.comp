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

struct Path {
    Shift shift;
    Reservoir path;     // before the round trip
    SampleHit hit;
    ivec2 partner;
    bool paired, refresh;
    float jacobian;     // of the way there
    float shifted;      // p^ there
    float confidence;   // of the other pixel's reservoir
    ShiftCheck checks[2];
};

World scene = world();
uint place(ivec2 p) { return pixelIndex(p); }

#if HAS_history
const bool BETWEEN_FRAMES = true;
Reservoir partnerReservoir(ivec2 p) { return historyReservoirs(place(p)); }
SampleHit partnerSample(ivec2 p) { return historySamples(place(p)); }
PrimaryHit partnerCentre(ivec2 p) { return hitsPrev(place(p)); }
bool mayPair() { return historyValid(); }
World partnerWorld() { return worldPrev(); }
ivec2 choosePartner(ivec2 pixel) { return pixelBefore(pixel, motion(pixel)); }
bool alike(ivec2 pixel, ivec2 q) { return true; }
#else
const bool BETWEEN_FRAMES = false;
Reservoir partnerReservoir(ivec2 p) { return pathsReservoirs(place(p)); }
SampleHit partnerSample(ivec2 p) { return pathsSamples(place(p)); }
PrimaryHit partnerCentre(ivec2 p) { return hits(place(p)); }
bool mayPair() { return true; }
World partnerWorld() { return scene; }
ivec2 choosePartner(ivec2 pixel) {
    return pixelInDisk(pixel, params.radius, random2(resamplingSeed(uvec2(pixel), frameIndex(), runSeed(), passSalt()), 0, RANDOM_FREE));
}
bool alike(ivec2 pixel, ivec2 q) {
    return q != pixel && similarPixels(pixelView(scene, hits(place(pixel))), pixelView(scene, hits(place(q))));
}
#endif

bool isHere(uint item) { return item == 0 || item == 3; }  // the shift leads to this pixel

uint pathItems() { return 4; }
World pathWorld(uint item) {
    if (isHere(item)) return scene;
    return partnerWorld();
}

void begin(inout Path p, ivec2 pixel) {
    p.checks[0] = p.checks[1] = ShiftCheck(0, 0, 0, 0, 0, 0, 0, 0, 1);
    p.paired = false;
    if (!mayPair()) return;
    p.partner = choosePartner(pixel);
    if (!inside(p.partner) || !alike(pixel, p.partner)) return;
    p.paired = true;
    p.refresh = walksSuffix(scene, partnerWorld());
}

// Is it the path that set out? F and G are compared elsewhere.
bool samePath(Path p) {
    Reservoir a = p.path, b = p.shift.path;
    PrimaryHit x = p.hit.hit, y = p.shift.hit.hit;
    bool connected = unpackShape(a.shape).k > 0;
    bool target = !connected || (a.rcInstance == b.rcInstance && a.rcPrimitive == b.rcPrimitive && p.hit.rc.barycentrics == p.shift.hit.rc.barycentrics);
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
void arrive(inout Path p, inout ShiftCheck check) {
    p.jacobian = p.shift.jacobian;
    p.shifted = target(p.shift.path);
    check.outcome = CHECK_TRIED;
    check.shape = p.path.shape;
    if (p.jacobian > 0) {
        check.outcome |= CHECK_THERE;
        check.energy = target(p.path) * p.path.W;
        check.energyShifted = p.shifted * p.jacobian * p.path.W;
        check.stretch = p.shift.path.G / p.path.G;
        if (p.path.lightPdf > 0 && reconnectionKind(p.shift.shape) == RC_TO_LIGHT) check.stretch *= p.path.lightPdf / p.shift.path.lightPdf;
    } else {
        // What the neighbour has no part in is the canonical pixel's alone.
        check.errorMis = misError(vec2(confidence(p.path), p.confidence), target(p.path), 0, 0);
    }
}

// So has the way back.
void comeBack(Path p, inout ShiftCheck check) {
    if ((check.outcome & CHECK_THERE) == 0) return;
    float back = p.shift.jacobian, pHat = target(p.path), returned = target(p.shift.path), mine = confidence(p.path);
    if (back > 0) {
        check.outcome |= CHECK_BACK | (samePath(p) ? CHECK_SAME : 0);
        vec3 change = abs(p.shift.path.F - p.path.F);
        check.errorF = maxComponent(change) / maxComponent(p.path.F);
        check.errorJacobian = abs(p.jacobian * back - 1);
        check.targetError = abs(returned * p.jacobian * back / pHat - 1);
    }
    // The path where it went, as a neighbour's sample; and where it came from, as the canonical one.
    float returnedHere = back > 0 ? pHatFromReverse(returned, back) : 0, shiftedBack = back > 0 ? pHatFromForward(p.shifted, back) : 0;
    float there = misError(vec2(p.confidence, mine), p.shifted, returnedHere, pHatFromForward(pHat, p.jacobian));
    float here = misError(vec2(mine, p.confidence), pHat, pHatFromReverse(p.shifted, p.jacobian), shiftedBack);
    check.errorMis = max(there, here);
}

bool pathBegin(inout Path p, World w, ivec2 pixel, uint item) {
    if (item == 0) begin(p, pixel);
    if (!p.paired) return false;
    if (item == 2) comeBack(p, p.checks[0]);
    Reservoir path;
    SampleHit hit;
    if (item == 0 || item == 2) {
        bool own = item == 2;
        p.path = own ? pathsReservoirs(place(pixel)) : partnerReservoir(p.partner);
        p.hit = own ? pathsSamples(place(pixel)) : partnerSample(p.partner);
        p.confidence = own ? confidence(partnerReservoir(p.partner)) : confidence(pathsReservoirs(place(pixel)));
        if (!holdsPath(p.path)) {
            p.shift.jacobian = 0;
            return false;
        }
        path = p.path;
        hit = p.hit;
    } else {
        if (!holdsPath(p.path)) return false;
        arrive(p, p.checks[item >> 1]);
        if (p.jacobian == 0) return false;
        path = p.shift.path;
        path.W = p.path.W;
        hit = p.shift.hit;
    }
    bool here = isHere(item);
    ivec2 to = here ? pixel : p.partner;
    PrimaryHit centre;
    if (here) centre = hits(place(to));
    else centre = partnerCentre(to);
    return shiftStart(p.shift, w, path, hit, to, frameSize(), centre, 1, p.refresh);
}

Ray pathRay(inout Path p, out bool anyHit, out uint purpose) { return shiftRay(p.shift, anyHit, purpose); }
bool pathStep(inout Path p, World w, Hit hit) { return shiftStep(p.shift, w, rules(), hit); }

vec3 colorOf(ShiftCheck a) {
    if ((a.outcome & CHECK_TRIED) == 0) return vec3(0);
    if ((a.outcome & CHECK_THERE) == 0) return a.errorMis > params.tolerance ? vec3(0, 1, 1) : vec3(0.2);
    if ((a.outcome & CHECK_BACK) == 0) return vec3(1, 0, 0);
    if ((a.outcome & CHECK_SAME) == 0) return vec3(1, 0, 1);
    if (a.errorF > params.tolerance) return vec3(1, 0.4, 0);
    if (a.errorJacobian > params.tolerance) return vec3(1, 1, 0);
    return a.errorMis > params.tolerance ? vec3(0, 1, 1) : vec3(0, 0.25, 0);
}

void pathEnd(Path p, World w, ivec2 pixel) {
    if (p.paired) comeBack(p, p.checks[1]);
    vec3 shown = vec3(0);
    for (uint i = 0; i < 2; ++i) {
        storeChecks(2 * place(pixel) + i, p.checks[i]);
        vec3 c = colorOf(p.checks[i]);
        shown = c.r > 0.2 || c.b > 0.2 || shown.r > 0.2 || shown.b > 0.2 ? max(shown, c) : shown + c;
    }
    storeColor(pixel, vec4(shown, 1));
}

#include "trace/driver.glsl"
