// SPDX-License-Identifier: MIT
// Makes the paths of a pixel and resamples them into one reservoir: one spine of BSDF samples from x_1, at each vertex a light sample, and
// every light the spine runs into is a path of its own.
//
// Lin et al. 2022, Generalized Resampled Importance Sampling, section 7.1. Paths of one tree differ in length, technique or lobes: their
// domains are disjoint, so each enters with weight 1. Roulette is no dimension of the path: it enters the weight, not F (Lin et al. 2026,
// ReSTIR PT Enhanced, section 6.2.4). Vertices choose their light sample from several by resampling, whose random density goes into the weight
// as well (section 6.1).
//
// The includer defines, before it includes this file, how a vertex draws the lights that it chooses from,
//   struct LightDraw { ... };
//   LightDraw drawLights(uvec2 seed, uint vertex, uint candidates);
//   LightPoint drawnLight(World w, LightDraw d, uint candidate);
//   uint drawnNumber(LightDraw d, uint candidate);  of that light: lightPoint() finds it again
#include "base/math.glsl"
#include "restir/path_vertex.glsl"
#include "restir/probe_path.glsl"
#include "restir/ris.glsl"
#include "restir/sample_hit.h"
#include "world/camera.glsl"

/// What the tree may grow to.
struct TreeLimits {
    uint segmentsMin;  // shorter paths are left to others: 1 keeps all, 3 leaves out direct light and what the camera sees directly
    uint segmentsMax;  // scatterings + 1
    bool roulette;
};

struct PathTree {
    uvec2 seed;
    ConnectionCriteria criteria;
    uint vertex;        // j of the last vertex x_j that was reached; 0: the lens
    Ray ray;            // to be traced next
    bool toLight;       // it asks how much arrives of the light of the path on offer
    Ray onward;         // the spine's own next ray, while `ray` goes to a light
    bool ends;          // there is none

    vec3 throughput;    // f / p of the sampled lobes so far
    float survival;     // chance that roulette let the spine live so far
    vec3 from;          // x_{j-1}
    Bsdf bsdf;          // there
    vec3 wo;            // there
    vec3 incoming;      // throughput before it scattered
    float before;       // roughness of the lobe sampled there
    uint lobe;          // that lobe
    float lobePdf;      // its density of the direction to x_j, its chance included
    float pdf;          // of all lobes together; 0: camera or delta lobe
    float cosine;       // of that direction with the triangle's normal there
    vec3 connected;     // throughput and pdf of x_{j-1} -> x_j if that is a connection: in the direction of its barycentrics
    float connectedPdf;

    uint k;             // reconnection vertex of paths that go on, 0: none yet
    Reservoir spine;    // its rc... and G
    uint lobeBefore, lobeAt;
    float density;      // of the directions at x_{k-1} and x_k: F's quotient between mixed measure and primary sample space
    vec3 suffix;        // f / p behind x_k
    TrianglePlace rc;   // of x_k

    SampleHit first;    // x_1 of this tree
    Reservoir offered;  // a path, W missing
    TrianglePlace offeredRc;
    uint offeredLight;  // SampleHit.light
    float offeredWeight;

    Ris ris;            // over all trees of the pixel
    uint offers;
    Reservoir kept;
    SampleHit keptHit;
};

/// Before the first tree of a pixel.
void treesStart(inout PathTree p) {
    p.ris = risStart();
    p.offers = 0u;
    p.kept = emptyReservoir(1.0);
}

/// `ray`: the camera ray of the place `film` inside the pixel through `lens` at a time of the exposure.
void treeStart(inout PathTree p, uvec2 seed, vec2 film, vec2 lens, float time, Ray ray) {
    p.seed = seed;
    p.vertex = 0u;
    p.toLight = false;
    p.ends = false;
    p.throughput = vec3(1.0);
    p.survival = 1.0;
    p.incoming = p.connected = vec3(1.0);
    p.before = p.connectedPdf = 0.0;
    p.lobe = 0u;
    p.lobePdf = 0.0;
    p.pdf = p.cosine = 0.0;
    p.criteria = ConnectionCriteria(CRITERIA_DISTANCE, 1.0, 0.0);
    p.k = 0u;
    p.lobeBefore = p.lobeAt = 0u;
    p.density = 1.0;
    p.suffix = vec3(1.0);
    p.rc = TrianglePlace(vec2(0.0), vec2(0.0));
    p.spine = emptyReservoir(1.0);
    p.first = SampleHit(PrimaryHit(NONE, NONE, vec2(0.0), film, lens), time, vec2(0.0), p.rc, 0u);
    p.ray = ray;
    p.from = p.ray.origin;
    p.onward = p.ray;
}

/// Whether x_j may be x_k: the first vertex whose pair with x_{j-1} may be connected. `at` and `pdf`: roughness there and density of the direction that
/// leaves it. `s`: x_j, where it has a surface.
bool maybeConnected(PathTree p, uint end, float at, float pdf, Surface s, float distance) {
    if (p.k > 0u || p.vertex < 2u) return false;
    Pair pair = Pair(end, p.before, at, p.pdf, pdf, p.cosine, abs(dot(s.normal, s.view)), distance);
    PROBE_PAIR(pairs, p.criteria, pair);
    return connectable(p.criteria, pair);
}

/// Puts a path on offer: its F in primary sample space and the densities that bring it into the mixed measure. `light`: number of its light. `warp`:
/// what resampling among light candidates adds to its weight.
void offer(inout PathTree p, Reservoir path, PathShape shape, TrianglePlace rc, vec3 F, float density, uint light, float warp) {
    path.seed = p.seed;
    path.shape = packShape(shape, 1.0);
    path.F = F * density;
    p.offered = path;
    p.offeredRc = rc;
    p.offeredLight = light;
    p.offeredWeight = finiteWeight(luminance(F) * warp / p.survival);
    PROBE_OPEN(offers);
    PROBE(segments, shape.d);
    PROBE(k, shape.k);
    PROBE_CHOICE(technique, shape.nee, "BSDF sampling|light sampling");
    PROBE_CHOICE(light, shape.light, "triangle|environment|punctual");
    PROBE(F, path.F);
    PROBE(density, density);
    PROBE(warp, warp);
    PROBE(survival, p.survival);
}

/// The light of the path on offer has come through panes.
void dimOffer(inout PathTree p, vec3 share) {
    float before = target(p.offered);
    dimLight(p.offered, unpackShape(p.offered.shape), share);
    PROBE(dimmed, share);
    p.offeredWeight *= before > 0.0 ? target(p.offered) / before : 0.0;
}

/// The path on offer takes part in the resampling. `decisions`: seed of the resampling stream.
void takeOffer(inout PathTree p, uvec2 decisions) {
    if (!risAdd(p.ris, p.offeredWeight, random1(decisions, p.offers++, RANDOM_FREE))) return;
    p.kept = p.offered;
    p.keptHit = p.first;
    p.keptHit.rc = p.offeredRc;
    p.keptHit.light = p.offeredLight;
}

/// Light that the spine ran into at x_j: an emitter's surface, or the environment (hit.primitive NONE).
void offerEmission(inout PathTree p, ShiftRules rules, Hit hit, Surface s, vec3 direction, float distance, vec3 radiance, float pdfLight) {
    bool environment = hit.primitive == NONE;
    vec3 throughput = p.throughput;
    float pdf = p.pdf;
    PathShape shape = PathShape(p.vertex, p.k, false, environment ? PATH_LIGHT_ENVIRONMENT : PATH_LIGHT_TRIANGLE, p.lobeBefore, p.lobeAt);
    Reservoir path = p.spine;
    float density = p.density;
    TrianglePlace rc = p.rc;
    bool connects = maybeConnected(p, environment ? PAIR_ENVIRONMENT : PAIR_EMITTER, 0.0, 0.0, s, distance);
    if (connects && !environment) {
        throughput = p.connected;
        pdf = p.connectedPdf;
    }
    float share = emissionShare(rules, p.vertex - 1u, pdf, pdfLight);
    PROBE(emission, radiance);
    PROBE(emissionPdfs, vec2(pdf, pdfLight));
    PROBE(emissionShare, share);
    if (p.k > 0u) {
        // Directly behind x_k the share depends on where the path came from, and is left to those who know.
        bool last = p.k + 1u == p.vertex;
        path.radiance = p.suffix * radiance * (last ? 1.0 : share);
        path.lightPdf = last ? pdfLight : 0.0;
    } else if (connects) {
        shape.k = p.vertex;
        shape.lobeBefore = p.lobe;
        path.rcInstance = hit.instance;
        path.rcPrimitive = hit.primitive;
        path.rcDirection = packDirection(direction);
        path.G = environment ? 1.0 : connectionTerm(p.from, s);
        density = p.lobePdf;
        if (!environment) rc = TrianglePlace(hit.barycentrics, s.uv);
    }
    offer(p, path, shape, rc, throughput * radiance * share, density, 0u, 1.0);
}

/// A light sample at x_j (next-event estimation). False: no light.
bool offerLight(inout PathTree p, World w, ShiftRules rules, Surface s, Bsdf b, LobeChances chance, vec3 wo, float distance) {
    // Resampled importance sampling of a candidate by what it would send if nothing were in the way.
    uint candidates = lightCandidates(rules, p.vertex);
    LightDraw draw = drawLights(p.seed, p.vertex, candidates);
    LightSample light;
    uint kept;
    vec3 chosen = vec3(0.0);
    float pdfChosen = 0.0;  // of the BSDF
    Ris ris = risStart();
    for (uint i = 0u; i < candidates; ++i) {
        LightSample l = lightSampleAt(w, drawnLight(w, draw, i), s.position);
        if (l.radianceOverPdf == vec3(0.0)) continue;
        float pdf;
        vec3 f = bsdfEval(b, chance, wo, onGrid(l.direction), pdf);
        vec3 sent = f * l.radianceOverPdf * lightShare(rules, p.vertex, l.pdf, pdf);
        PROBE_OPEN(lightCandidates);
        PROBE(light, l.point.light);
        PROBE(direction, l.direction);
        PROBE(distance, l.distance);
        PROBE(lightPdf, l.pdf);
        PROBE(bsdfPdf, pdf);
        PROBE(share, lightShare(rules, p.vertex, l.pdf, pdf));
        PROBE(sent, sent);
        if (!risAdd(ris, luminance(sent), random1(p.seed, p.vertex, RANDOM_FREE | i << 8u))) continue;
        light = l;
        kept = i;
        chosen = sent;
        pdfChosen = pdf;
    }
    PROBE_CLOSE(lightCandidates);
    if (chosen == vec3(0.0)) return false;
    float warp = ris.wSum / (float(candidates) * luminance(chosen));

    uint type = w.lights.at[light.point.light].type;
    uint kind = type == LIGHT_TRIANGLE ? PATH_LIGHT_TRIANGLE : type == LIGHT_ENVIRONMENT ? PATH_LIGHT_ENVIRONMENT : PATH_LIGHT_PUNCTUAL;
    PathShape shape = PathShape(p.vertex + 1u, p.k, true, kind, p.lobeBefore, p.lobeAt);
    Reservoir path = p.spine;
    float density = p.density, pdfLight = light.delta ? 1.0 : light.pdf, roughness = roughestLobe(b, chance);
    vec3 throughput = p.throughput;
    TrianglePlace rc = p.rc;
    if (p.k > 0u) {
        path.radiance = p.suffix * chosen;
    } else if (maybeConnected(p, PAIR_SURFACE, roughness, pdfChosen, s, distance)) {
        shape.k = p.vertex;
        shape.lobeBefore = p.lobe;
        path.rcInstance = s.instance;
        path.rcPrimitive = s.primitive;
        path.rcDirection = packDirection(light.direction);
        path.radiance = light.radianceOverPdf * pdfLight;
        path.lightPdf = light.pdf;
        path.G = connectionTerm(p.from, s);
        density = p.lobePdf * pdfLight;
        throughput = p.connected;
        rc = TrianglePlace(s.barycentrics, s.uv);
    } else if (lightConnectable(rules, p.criteria, s, roughness, pdfChosen, light)) {
        shape.k = p.vertex + 1u;
        path.rcInstance = w.lights.at[light.point.light].instance;
        path.rcPrimitive = light.delta ? light.point.light : kind == PATH_LIGHT_ENVIRONMENT ? light.point.texel : w.lights.at[light.point.light].primitive;
        path.G = connectionTerm(w, light);
        density = vertexDensity(w, light);
        rc.barycentrics = light.point.uv;
        // By it the point passes to another level; that of a surface has been read, that of a light hasn't.
        if (SCENE_LIGHT_LEVELS != 0 && kind == PATH_LIGHT_TRIANGLE) rc.uv = uvAt(w, SurfacePoint(path.rcInstance, path.rcPrimitive, rc.barycentrics));
    }
    offer(p, path, shape, rc, throughput * chosen, density, drawnNumber(draw, kept), warp);
    p.ray = shadowRay(w, s, light);
    return true;
}

/// The spine's next direction. False: it ends here.
bool growSpine(inout PathTree p, World w, TreeLimits limits, Surface s, Bsdf b, LobeChances chance, vec3 wo, float distance) {
    PROBE_CLOSE(offers);
    if (limits.roulette) {
        float q = min(luminance(p.throughput), 1.0);
        PROBE(roulette, q);
        PROBE(rouletteNumber, random1(p.seed, p.vertex, RANDOM_ROULETTE));
        if (random1(p.seed, p.vertex, RANDOM_ROULETTE) >= q) return false;
        p.survival *= q;
    }
    BsdfDirection d = pathDirection(b, chance, wo, p.seed, p.vertex);
    BsdfSample next = d.delta || d.lobe == LOBE_COUNT ? deltaSample(b, d) : lobeSample(d, bsdfValue(b, chance, d.lobe, wo, d.wi));
    PROBE_CHOICE(lobe, next.lobe, "diffuse|reflection|transmission|coat|through|absorbed");
    PROBE(next, next.wi);
    PROBE(lobePdf, next.lobePdf);
    PROBE(pdf, next.pdf);
    if (next.pdf == 0.0 || next.lobeWeight == vec3(0.0)) return false;
    float roughness = lobeRoughness(b, next.lobe);
    PROBE(roughness, roughness);
    if (p.k > 0u) {
        p.suffix *= next.lobeWeight;
    } else if (maybeConnected(p, PAIR_SURFACE, roughness, next.pdf, s, distance)) {
        p.k = p.vertex;
        p.lobeBefore = p.lobe;
        p.lobeAt = next.lobe;
        p.density = p.lobePdf * next.lobePdf;
        p.rc = TrianglePlace(s.barycentrics, s.uv);
        p.spine.rcInstance = s.instance;
        p.spine.rcPrimitive = s.primitive;
        p.spine.rcDirection = packDirection(next.wi);
        p.spine.G = connectionTerm(p.from, s);
        p.throughput = p.connected;
    }
    p.incoming = p.throughput;
    p.throughput *= next.lobeWeight;
    p.bsdf = b;
    p.wo = wo;
    p.from = s.position;
    p.before = roughness;
    p.lobe = next.lobe;
    p.lobePdf = next.lobePdf;
    p.pdf = next.delta ? 0.0 : next.pdf;
    p.cosine = abs(dot(s.normal, next.wi));
    p.onward = spawnRay(w, s, next.wi);
    return true;
}

/// Goes on from what `ray` hit; false: the tree is finished.
bool treeStep(inout PathTree p, World w, ShiftRules rules, TreeLimits limits, Hit hit, uvec2 decisions) {
    if (p.toLight) {
        PROBE_REOPEN(offers);
        PROBE(hidden, hit.primitive != NONE);
        if (hit.primitive == NONE) {
            if (SCENE_PANES != 0) dimOffer(p, transmittance(hit));
            takeOffer(p, decisions);
        }
        PROBE_CLOSE(offers);
        p.toLight = false;
        p.ray = p.onward;
        return !p.ends;
    }
    uint j = ++p.vertex;
    PROBE_OPEN(vertices);
    PROBE(vertex, j);
    PROBE_TEXT_IF(met, "environment", hit.primitive == NONE);
    vec3 direction = p.ray.direction, radiance;
    float distance = FAR, pdfLight;
    bool escaped = hit.primitive == NONE;
    Surface s;
    if (escaped) {
        radiance = environmentRadiance(w, direction);
        pdfLight = environmentPdf(w, direction);
    } else {
        if (j >= 2u) direction = arrival(w, hit, p.from, direction);
        s = surfaceAt(w, hit, direction);
        distance = length(s.position - p.from);
        PROBE_SURFACE(s);
        vec3 left = segmentTransmittance(w, s, distance);
        p.throughput *= left;
        PROBE(throughput, p.throughput);
        if (p.k > 0u) p.suffix *= left;
        if (maybeConnected(p, PAIR_REACHED, 0.0, 0.0, s, distance)) {
            BsdfValue value = bsdfValue(p.bsdf, p.lobe, p.wo, direction);
            p.connected = p.incoming * value.one / p.lobePdf * left;
            p.connectedPdf = value.pdf;
        }
        radiance = emittedRadiance(w, s);
        pdfLight = lightPdf(w, hit.instance, hit.primitive, direction, distance);
    }
    if (j == 1u) {
        p.first.hit = primaryHit(hit, p.first.hit.film, p.first.hit.lens);
        if (!escaped) {
            p.first.uv = s.uv;
            p.criteria = criteriaOf(rules, p.seed, distance, abs(dot(s.normal, s.view)));
        }
    }
    if (radiance != vec3(0.0) && j >= limits.segmentsMin) {
        offerEmission(p, rules, hit, s, direction, distance, radiance, pdfLight);
        takeOffer(p, decisions);
        PROBE_CLOSE(offers);
    }
    if (escaped || j == limits.segmentsMax) return false;
    Bsdf b = bsdfAt(w, s);
    LobeChances chance = lobeProbabilities(b, -direction);
    if (j + 1u >= limits.segmentsMin && !bsdfAllDelta(b, chance)) p.toLight = offerLight(p, w, rules, s, b, chance, -direction, distance);
    p.ends = !growSpine(p, w, limits, s, b, chance, -direction, distance);
    if (p.toLight) return true;
    p.ray = p.onward;
    return !p.ends;
}

Ray treeRay(PathTree p, out bool anyHit, out uint purpose) {
    anyHit = p.toLight;
    purpose = p.toLight ? RAYS_NEE : p.vertex == 0u ? RAYS_PRIMARY : RAYS_CONTINUE;
    return p.ray;
}

/// The reservoir of `trees` trees, confidence 1.
Reservoir treesReservoir(PathTree p, uint trees) {
    p.ris.wSum /= float(trees);
    p.kept.W = contributionWeight(p.ris, target(p.kept));
    return p.kept;
}
