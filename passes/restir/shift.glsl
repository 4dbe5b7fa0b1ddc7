// SPDX-License-Identifier: MIT
// The hybrid shift: takes a path to another pixel or frame, as a step machine that asks for one ray at a time.
//
// The camera ray keeps its place inside the pixel and on the lens (lens-vertex copy: Zhang et al. 2024, Area ReSTIR; Jacobian 1), or it is that of the
// pixel the path goes to (ShiftRules.pixelCamera): then it is no dimension of the path, the integrand is radiance through that one place, and the
// Jacobian is 1 as well. From y_1 the
// path's own numbers are replayed up to y_{k-1}, which is connected to x_k; what follows x_k is kept (Lin et al. 2022, Generalized Resampled
// Importance Sampling, section 7.2; Lin et al. 2026, ReSTIR PT Enhanced, section 2.3). Without x_k the whole path is replayed. Where
// something moved between the two Worlds, what follows x_k is walked again by its numbers, so that its radiance belongs to the World it is
// shifted to; so it is where levels are chosen pixel by pixel and the two pixels may see others.
//
// The shift fails (jacobian 0) wherever shifting back would not lead to the same path: before k no pair of vertices may be connectable, the
// pair at k must be, and the light must be met as it was.
#include "base/math.glsl"
#include "restir/path_vertex.glsl"
#include "restir/probe_path.glsl"
#include "restir/sample_hit.h"
#include "trace/known_ray.glsl"
#include "world/camera.glsl"
#include "world/exposure.glsl"

const uint SHIFT_WALK = 0u;     // `ray` looks for the next vertex
const uint SHIFT_CONNECT = 1u;  // it asks whether y_{k-1} sees x_k
const uint SHIFT_LIGHT = 2u;    // it asks how much the last vertex sees of the light sample
const uint SHIFT_SEE = 3u;      // it asks whether the lens sees y_1, which is known
const uint SHIFT_DONE = 4u;

struct Shift {
    Reservoir path;      // the base path; after success the shifted one: seed and shape stay, W means nothing
    SampleHit hit;       // of the shifted path
    float jacobian;      // |dT/dx| in the mixed measure; 0: failed
    PathShape shape;
    ConnectionCriteria criteria;
    bool refresh;        // walk anew what follows x_k
    bool known;          // y_1 is in `hit` already: no ray is needed
    bool carried;        // y_1 is x_1 where it is now, and keeps the texture coordinate it was stored with, so that the way back finds it
    uint number;         // by which rays choose levels where the path goes
    uint state;          // SHIFT_*
    uint vertex;         // j of the last vertex y_j that was reached
    Ray ray;
    Ray onward;          // leaves x_k while `ray` connects to it, if `resumes`
    bool resumes;
    vec3 throughput;     // f / p up to y_{k-1}, times f there; behind x_k of the suffix alone
    vec3 prefix;         // behind x_k: all up to and with f at x_k
    vec3 from;           // y_{j-1}
    float before;        // roughness of the lobe sampled there
    float pdf;           // of all lobes, of the direction from there; 0: camera or delta lobe
    float cosine;        // of that direction with the triangle's normal there
};

/// What is to be shifted, and where to.
struct ShiftTask {
    Reservoir path;
    SampleHit base;    // where it begins
    ivec2 to;          // the pixel it goes to
    PrimaryHit first;  // a camera hit of that pixel, in the World the path goes to
    bool carried;      // `first` is the path's own first hit, taken there, and has to be seen from its place on film and lens; otherwise it is where the
                       // path begins only if that is the pixel's (ShiftRules.pixelCamera)
    float jacobian;    // of what has happened to the path already; 0: there is nothing to shift
    bool refresh;      // walk anew what follows x_k
};

ShiftTask shiftOfNothing() {
    PrimaryHit nowhere = PrimaryHit(NONE, NONE, vec2(0.0), vec2(0.0), vec2(0.0));
    return ShiftTask(emptyReservoir(0.0), SampleHit(nowhere, 0.0, vec2(0.0), TrianglePlace(vec2(0.0), vec2(0.0)), 0u), ivec2(0), nowhere, false, 0.0, false);
}

/// The shift of a path to pixel `to`, whose camera hit `centre` is known.
ShiftTask shiftTo(ivec2 to, PrimaryHit centre, Reservoir path, SampleHit base) { return ShiftTask(path, base, to, centre, false, 1.0, false); }

// The two shifts that a partner costs (reuse_driver.glsl).
const uint FORTH = 0u;  // of the path that is to be reused
const uint BACK = 1u;   // of the path it is weighed against, to where the other was made
const uint WAYS = 2u;

/// Starts a shift in an image of `size` pixels of a frame's World. False: there is nothing to shift.
bool shiftStart(inout Shift t, World w, ShiftRules rules, ShiftTask task, uvec2 size) {
    t.path = task.path;
    t.hit = task.base;
    t.jacobian = holdsPath(task.path) ? task.jacobian : 0.0;
    t.shape = unpackShape(task.path.shape);
    t.refresh = task.refresh;
    t.carried = task.carried;
    t.known = task.carried || rules.pixelCamera != 0u;
    if (t.known) t.hit.hit = task.first;
    else t.hit.hit = PrimaryHit(NONE, NONE, vec2(0.0), task.base.hit.film, task.base.hit.lens);
    t.number = pathNumber(rules, w, task.to, task.path.seed);
    w = atTime(w, pathTime(rules, w, task.to, task.base.time));
    t.hit.time = w.time;
    t.state = task.carried ? SHIFT_SEE : SHIFT_WALK;
    t.vertex = 0u;
    t.resumes = false;
    t.throughput = t.prefix = vec3(1.0);
    t.before = t.pdf = t.cosine = 0.0;
    t.criteria = ConnectionCriteria(CRITERIA_DISTANCE, 1.0, 0.0);
    t.ray = cameraRay(w, filmOf(task.to, t.hit.hit.film, size), t.hit.hit.lens);
    t.from = t.ray.origin;
    if (task.carried && task.first.primitive != NONE) {
        float gap;
        vec3 way = segmentEnd(w, pointOf(task.first), t.ray.origin, gap) - t.ray.origin;
        t.ray.direction = safeNormalize(way, t.ray.direction);
        float reach = length(way);
        t.ray.tMax = reach - min(gap, 0.5 * reach);
    }
    t.onward = t.ray;
    PROBE_RESERVOIR(base, task.path);
    PROBE_TEXT_IF(failed, "there is no path to shift", t.jacobian == 0.0);
    PROBE(walksSuffix, t.refresh);
    PROBE(jacobianBefore, t.jacobian);
    return t.jacobian > 0.0;
}

Ray shiftRay(Shift t, out bool anyHit, out uint purpose) {
    anyHit = t.state != SHIFT_WALK;
    purpose = t.state == SHIFT_CONNECT ? RAYS_CONNECT
              : t.state == SHIFT_LIGHT ? RAYS_NEE
              : t.state == SHIFT_SEE   ? RAYS_VISIBILITY
              : t.vertex == 0u         ? RAYS_PRIMARY
                                       : RAYS_REPLAY;
    if (t.known && t.state == SHIFT_WALK && t.vertex == 0u) return knownRay(purpose);
    return t.ray;
}

void shiftFail(inout Shift t) {
    t.jacobian = 0.0;
    t.state = SHIFT_DONE;
}

/// Where it is decided whether the shift can be undone: pairs before k must not be connectable, the pair at k must be. `at` and `pdf`: roughness at y_j
/// and density of the direction that leaves it. `s`: y_j, where it has a surface.
bool agreesOnConnection(Shift t, bool target, uint end, float at, float pdf, Surface s, float distance) {
    bool suffix = t.shape.k > 0u && t.vertex > t.shape.k;
    if (t.vertex < 2u || suffix) return true;
    Pair pair = Pair(end, t.before, at, t.pdf, pdf, t.cosine, abs(dot(s.normal, s.view)), distance);
    PROBE_PAIR(pairs, t.criteria, pair);
    return connectable(t.criteria, pair) == target;
}

/// F of a replayed path, or radiance and F of a suffix walked again, that ends with `radiance`. The share of a light that the BSDF of x_k found
/// belongs to F but not to the stored radiance, because it depends on where the path came from.
void reachLight(inout Shift t, vec3 radiance, float share, float pdfLight) {
    if (t.shape.k == 0u || t.vertex <= t.shape.k) {
        t.path.F = t.throughput * radiance * share;
        return;
    }
    bool last = !t.shape.nee && t.shape.k + 1u == t.shape.d;
    t.path.radiance = t.throughput * radiance * (last ? 1.0 : share);
    t.path.lightPdf = last ? pdfLight : 0.0;
    t.path.F = t.prefix * t.path.radiance * (last ? share : 1.0);
}

/// The path ends here, on an emitter or in the environment (hit.primitive NONE).
void meetLight(inout Shift t, World w, ShiftRules rules, Hit hit, Surface s, vec3 direction, float distance, bool target) {
    bool environment = hit.primitive == NONE;
    bool alike = !t.shape.nee && t.vertex == t.shape.d && t.shape.light == (environment ? PATH_LIGHT_ENVIRONMENT : PATH_LIGHT_TRIANGLE);
    if (!alike || !agreesOnConnection(t, target, environment ? PAIR_ENVIRONMENT : PAIR_EMITTER, 0.0, 0.0, s, distance)) {
        PROBE_TEXT_IF(failed, "it ends here, on a surface or under the sky, where the base path goes on or ends in another kind of light", !alike);
        PROBE_TEXT_IF(failed, "the pair with its light is connectable and not x_k, or x_k and not connectable", alike);
        shiftFail(t);
        return;
    }
    vec3 radiance;
    float pdfLight;
    if (environment) {
        radiance = environmentRadiance(w, direction);
        pdfLight = environmentPdf(w, direction);
    } else {
        radiance = emittedRadiance(w, s);
        pdfLight = lightPdf(w, hit.instance, hit.primitive, direction, distance);
    }
    reachLight(t, radiance, emissionShare(rules, t.vertex - 1u, t.pdf, pdfLight), pdfLight);
    if (!target) t.state = SHIFT_DONE;
    if (target && !environment) {
        float G = connectionTerm(t.from, s);
        t.jacobian *= reconnectionJacobian(G, t.path.G);
        PROBE_FACTOR(reconnection, G, t.path.G);
        t.path.G = G;
    }
}

/// The light point that x_k is. NONE where this World has no such light.
LightPoint storedLight(World w, Shift t) {
    if (t.shape.light == PATH_LIGHT_ENVIRONMENT) return LightPoint(w.environmentLight, t.path.rcPrimitive, t.hit.rc.barycentrics);
    if (t.shape.light == PATH_LIGHT_PUNCTUAL) return LightPoint(t.path.rcPrimitive, 0u, vec2(0.0));
    return LightPoint(triangleLight(w, t.path.rcInstance, t.path.rcPrimitive), 0u, t.hit.rc.barycentrics);
}

// What a vertex scatters towards.
const uint TOWARDS_SAMPLE = 0u;  // y_{j+1}, by the path's numbers
const uint TOWARDS_LIGHT = 1u;   // a light sample, by the path's numbers or stored as x_k
const uint TOWARDS_TARGET = 2u;  // x_k
const uint TOWARDS_SUFFIX = 3u;  // what follows x_k, in the stored direction

/// How the path leaves a vertex.
struct Departure {
    uint towards;        // TOWARDS_*
    uint lobe;
    vec3 way;
    BsdfDirection next;  // TOWARDS_SAMPLE
    LightSample light;   // TOWARDS_LIGHT
    vec3 goal;           // TOWARDS_TARGET: position of x_k, where it has one,
    float gap;           // and how far before it the segment ends
};

SurfacePoint connectedPoint(Shift t) { return SurfacePoint(t.path.rcInstance, t.path.rcPrimitive, t.hit.rc.barycentrics); }

/// Direction and lobe. False: x_k is of a level that this World doesn't show.
bool depart(Shift t, World w, Surface s, Bsdf b, LobeChances chance, vec3 wo, bool target, out Departure d) {
    uint j = t.vertex, kind = reconnectionKind(t.shape);
    bool lastBeforeLight = t.shape.nee && j + 1u == t.shape.d;
    d.towards = j + 1u == t.shape.k && kind != RC_LIGHT ? TOWARDS_TARGET
                : lastBeforeLight && (!target || t.refresh) ? TOWARDS_LIGHT : target ? TOWARDS_SUFFIX : TOWARDS_SAMPLE;
    if (d.towards == TOWARDS_SAMPLE) {
        d.next = pathDirection(b, chance, wo, t.path.seed, j);
        d.lobe = d.next.lobe;
        d.way = d.next.wi;
    } else if (d.towards == TOWARDS_LIGHT) {
        d.light = lightSampleAt(w, kind == RC_LIGHT ? storedLight(w, t) : lightPoint(w, t.hit.light), s.position);
        d.lobe = LOBE_ALL;
        d.way = onGrid(d.light.direction);
    } else if (d.towards == TOWARDS_TARGET) {
        d.lobe = t.shape.lobeBefore;
        d.way = unpackDirection(t.path.rcDirection);
        if (kind != RC_ENVIRONMENT) {
            if (!isShown(w, connectedPoint(t), t.number)) return false;
            d.goal = segmentEnd(w, connectedPoint(t), s.position, d.gap);
            d.way = safeNormalize(d.goal - s.position, d.way);
        }
    } else {
        d.lobe = kind == RC_TO_LIGHT ? LOBE_ALL : t.shape.lobeAt;
        d.way = unpackDirection(t.path.rcDirection);
    }
    return true;
}

/// Keeps what the next vertex has to know of this one.
void leave(inout Shift t, Surface s, vec3 way, float roughness, float pdf) {
    t.before = roughness;
    t.pdf = pdf;
    t.cosine = abs(dot(s.normal, way));
    t.from = s.position;
}

/// Replays a vertex: the path's numbers lead on.
void replay(inout Shift t, World w, Surface s, Bsdf b, Departure d, BsdfValue value, float roughness) {
    BsdfSample drawn = d.next.delta || d.lobe == LOBE_COUNT ? deltaSample(b, d.next) : lobeSample(d.next, value);
    t.throughput *= drawn.lobeWeight;
    PROBE(lobePdf, drawn.lobePdf);
    PROBE(pdf, drawn.pdf);
    PROBE(throughput, t.throughput);
    leave(t, s, d.way, roughness, drawn.delta ? 0.0 : drawn.pdf);
    t.ray = spawnRay(w, s, d.way);
    PROBE_TEXT_IF(failed, "its numbers lead nowhere from here", t.throughput == vec3(0.0));
    if (t.throughput == vec3(0.0)) shiftFail(t);
}

/// Sets out from y_{k-1} to x_k, which `hit` and `direction` become. False: the shift has failed.
bool connect(inout Shift t, World w, Surface s, Departure d, BsdfValue value, float roughness, inout Hit hit, inout vec3 direction) {
    bool sky = reconnectionKind(t.shape) == RC_ENVIRONMENT;
    SurfacePoint goal = connectedPoint(t);
    t.throughput *= value.one;
    PROBE(lobePdf, value.onePdf);
    PROBE(pdf, value.pdf);
    PROBE(throughput, t.throughput);
    PROBE_TEXT_IF(failed, "the lobe sends nothing to x_k", t.throughput == vec3(0.0));
    leave(t, s, d.way, roughness, value.pdf);
    t.vertex = t.shape.k;
    t.state = SHIFT_CONNECT;
    t.ray = sky ? spawnRay(w, s, d.way) : rayBetween(s, d.goal, d.gap);
    hit = Hit(0.0, goal.barycentrics, sky ? NONE : goal.primitive, goal.instance);
    direction = d.way;
    if (t.throughput == vec3(0.0)) shiftFail(t);
    return t.state != SHIFT_DONE;
}

/// The last vertex of a replayed path, of a suffix, or y_{k-1} before a light that is x_k: asks how much it sees of the light.
void askLight(inout Shift t, World w, ShiftRules rules, Surface s, Departure d, BsdfValue value, float roughness, float share) {
    bool stored = reconnectionKind(t.shape) == RC_LIGHT;
    if (t.shape.k == 0u || stored) {
        bool mayConnect = lightConnectable(rules, t.criteria, s, roughness, value.pdf, d.light);
        PROBE_TEXT_IF(failed, "the light is connectable and not x_k, or x_k and not connectable", mayConnect != stored);
        if (mayConnect != stored) shiftFail(t);
    }
    PROBE(share, share);
    PROBE(lightPdf, d.light.pdf);
    PROBE(bsdfPdf, value.pdf);
    PROBE(toLight, d.way);
    reachLight(t, value.all * d.light.radianceOverPdf * (stored ? vertexDensity(w, d.light) : 1.0), share, 0.0);
    PROBE_TEXT_IF(black, "the light sends nothing here, or nothing of it is scattered", t.path.F == vec3(0.0));
    if (stored) {
        float G = connectionTerm(w, d.light);
        t.jacobian *= reconnectionJacobian(G, t.path.G);
        PROBE_FACTOR(reconnection, G, t.path.G);
        t.path.G = G;
    }
    t.ray = shadowRay(w, s, d.light);
    if (t.state != SHIFT_DONE) t.state = stored ? SHIFT_CONNECT : SHIFT_LIGHT;
}

/// x_k between y_{k-1} and what follows it, which is kept or, `refresh`, walked again. `sampled`: light sampling at x_k found the light.
void passConnection(inout Shift t, World w, Surface s, Departure d, BsdfValue value, bool sampled, float pdfLight, float share) {
    float G = connectionTerm(t.from, s);
    PROBE(share, share);
    PROBE(lobePdf, value.onePdf);
    PROBE(pdf, value.pdf);
    t.jacobian *= reconnectionJacobian(G, t.path.G);
    PROBE_FACTOR(reconnection, G, t.path.G);
    t.path.G = G;
    if (d.towards == TOWARDS_LIGHT) {
        // The light sample's numbers stay, its direction doesn't: d omega_y / d omega_x is the quotient of the densities.
        float density = pdfLight > 0.0 ? pdfLight : 1.0;
        PROBE_FACTOR(lightSample, t.path.lightPdf > 0.0 ? t.path.lightPdf : 1.0, density);
        t.jacobian *= jacobianRatio(t.path.lightPdf > 0.0 ? t.path.lightPdf : 1.0, density);
        t.path.lightPdf = pdfLight;
        t.path.radiance = d.light.radianceOverPdf * density;
        t.path.rcDirection = packDirection(d.way);
    }
    t.prefix = t.throughput * (sampled ? value.all : value.one);
    t.path.F = t.prefix * t.path.radiance * share;
    PROBE_TEXT_IF(failed, "x_k scatters nothing of what follows it back to here", t.prefix == vec3(0.0));
    if (t.prefix == vec3(0.0)) shiftFail(t);
    if (!t.refresh) return;
    t.resumes = true;
    t.onward = sampled ? shadowRay(w, s, d.light) : spawnRay(w, s, d.way);
    t.throughput = vec3(1.0);
    leave(t, s, d.way, t.before, value.pdf);
}

/// Looks at vertex `hit`, which `direction` leads to: y_j, or x_k (`target`) before it is known whether y_{k-1} sees it. True: hit and direction
/// have become x_k, which wants to be looked at before any ray is traced.
bool shiftVertex(inout Shift t, World w, ShiftRules rules, inout Hit hit, inout vec3 direction, inout bool target) {
    uint j = t.vertex, kind = reconnectionKind(t.shape);
    PROBE_OPEN(vertices);
    PROBE(vertex, j);
    PROBE_TEXT_IF(met, "environment", hit.primitive == NONE);
    Surface s;
    float distance = FAR;
    if (hit.primitive != NONE) {
        if (j >= 2u) direction = arrival(w, hit, t.from, direction);
        s = surfaceAt(w, hit, direction);
        distance = length(s.position - t.from);
        PROBE_SURFACE(s);
        t.throughput *= segmentTransmittance(w, s, distance);
        if (j == 1u && !t.carried) t.hit.uv = s.uv;
        if (j == 1u) t.criteria = criteriaOf(rules, t.path.seed, distance, abs(dot(s.normal, s.view)));
    }
    if (hit.primitive == NONE || j == t.shape.d) {
        meetLight(t, w, rules, hit, s, direction, distance, target);
        return false;
    }
    Bsdf b = bsdfAt(w, s);
    vec3 wo = -direction;
    LobeChances chance = lobeProbabilities(b, wo);
    Departure d;
    if (!depart(t, w, s, b, chance, wo, target, d)) {
        PROBE_TEXT(failed, "x_k is of a level that is not shown here");
        shiftFail(t);
        return false;
    }
    float roughness = d.lobe == LOBE_ALL ? roughestLobe(b, chance) : lobeRoughness(b, d.lobe);
    BsdfValue value = bsdfValue(b, chance, d.lobe, wo, d.way);
    PROBE_CHOICE(towards, d.towards, "next vertex, by the path's numbers|light sample|x_k|what follows x_k");
    PROBE_CHOICE(lobe, min(d.lobe, LOBE_COUNT + 1u), "diffuse|reflection|transmission|coat|through|absorbed|all");
    PROBE(roughness, roughness);
    if (!agreesOnConnection(t, target, PAIR_SURFACE, roughness, value.pdf, s, distance)) {
        PROBE_TEXT_IF(failed, "x_k is not connectable to the vertex before it", target);
        PROBE_TEXT_IF(failed, "a pair of vertices before x_k is connectable: shifted back, the path would be connected here", !target);
        shiftFail(t);
        return false;
    }
    if (d.towards == TOWARDS_SAMPLE) {
        replay(t, w, s, b, d, value, roughness);
        return false;
    }
    if (d.towards == TOWARDS_TARGET) {
        target = true;
        return connect(t, w, s, d, value, roughness, hit, direction);
    }
    float pdfLight = d.towards == TOWARDS_LIGHT ? d.light.pdf : t.path.lightPdf;  // 0: a light without extent
    bool sampled = kind == RC_TO_LIGHT || d.towards == TOWARDS_LIGHT;             // the light, by light sampling at this vertex
    float share = sampled ? lightShare(rules, j, pdfLight, value.pdf) : j + 1u == t.shape.d ? emissionShare(rules, j, value.pdf, pdfLight) : 1.0;
    if (target) passConnection(t, w, s, d, value, sampled, pdfLight, share);
    else askLight(t, w, rules, s, d, value, roughness, share);
    return false;
}

/// Goes on from what `ray` hit; false: the shift is finished, and failed if jacobian is 0.
bool shiftStep(inout Shift t, World w, ShiftRules rules, Hit hit) {
    bool seen = t.state == SHIFT_SEE && hit.primitive == NONE;
    if (seen) t.state = SHIFT_WALK;
    if (t.state == SHIFT_WALK) {
        vec3 direction = t.ray.direction;
        if (++t.vertex == 1u) {
            if (t.known) hit = hitOf(t.hit.hit);
            t.hit.hit = primaryHit(hit, t.hit.hit.film, t.hit.hit.lens);
        }
        bool target = false;
        while (shiftVertex(t, w, rules, hit, direction, target)) {}
    } else if (hit.primitive != NONE) {
        PROBE_CHOICE(hidden, t.state, "next vertex|x_k|light|first vertex, from the lens");
        PROBE_TEXT(failed, "something is in the way");
        shiftFail(t);
    } else {
        dimLight(t.path, t.shape, transmittance(hit));
        t.state = !t.resumes ? SHIFT_DONE : t.shape.nee && t.shape.k + 1u == t.shape.d ? SHIFT_LIGHT : SHIFT_WALK;
        if (t.resumes) t.ray = t.onward;
        t.resumes = false;
    }
    PROBE_TEXT_IF(black, "F is 0 here, and nothing that follows changes it", t.path.F == vec3(0.0) && t.jacobian > 0.0);
    // Nothing is gained by tracing a path that is black already; with a suffix to come, F is not known yet.
    if (t.path.F == vec3(0.0) && !(t.refresh && reconnectionKind(t.shape) == RC_SURFACE && t.state != SHIFT_DONE)) t.jacobian = 0.0;
    return t.jacobian > 0.0 && t.state != SHIFT_DONE;
}
