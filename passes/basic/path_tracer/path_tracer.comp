// SPDX-License-Identifier: MIT
// One path a lane, as a step machine: each turn traces one ray, either along the path or towards a light (shaders/trace/driver.glsl).
#version 460
#include "pass.glsl"
#include "base/random.glsl"
#include "basic/film.glsl"
#include "basic/light_technique.glsl"
#include "bsdf/material.glsl"
#include "light/emission.glsl"
#include "light/light.glsl"
#include "surface/probe_surface.glsl"
#include "trace/known_ray.glsl"
#include "trace/trace.glsl"
#include "world/camera.glsl"
#include "world/exposure.glsl"

struct Path {
    uvec2 seed;
    uint pixel;         // its number
    uint scatterings;   // so far
    vec3 radiance;      // sum over the samples so far
    vec3 throughput;
    float pdf;          // solid-angle density of the last direction; 0: camera or delta lobe, which light sampling can't compete with
    Ray ray;            // to be traced next
    bool toLight;       // it asks how much is seen of a light sample
    vec3 direct;        // what the light sample adds where nothing is in the way
    Ray onward;         // the path's own next ray, while `ray` goes to a light
    bool ends;          // there is none
    bool beyond;        // `ray` has come to fineReach
};

#if HAS_hits
/// What the pixel's ray is known to hit.
Hit firstHit(Path p, World w) {
    Hit hit = hitOf(hits(p.pixel));
    if (hit.primitive != NONE) hit.t = distance(p.ray.origin, positionAt(w, pointOf(hit)));
    return hit;
}
#endif

uint technique() { return uint(params.technique); }

uint pathItems(World now) { return uint(params.spp); }

World pathWorld(World now, uint item) { return now; }

void pathStart(inout Path p, World now, ivec2 pixel) { p.radiance = vec3(0); }

#define PATH_NUMBER
uint pathNumber(Path p, World w, ivec2 pixel) {
    if (p.scatterings > 0 && params.fineReach > 0) return p.beyond ? 0u : RAY_NUMBER;
    if (params.numbers == numbers_ray) return numberOfPath(randomBits3(p.seed, 2 * p.scatterings + (p.toLight ? 1 : 0), RANDOM_LEVEL).xy);
#if HAS_hits
    return numberOfPixel(w, pixel);
#else
    return numberOfPath(p.seed);
#endif
}

bool pathBegin(inout Path p, World w, ivec2 pixel, uint item) {
    uint sampleIndex = frameIndex() * uint(params.spp) + item;
    p.seed = pathSeed(uvec2(pixel), sampleIndex, runSeed());
    p.pixel = pixelIndex(pixel);
    p.scatterings = 0;
    p.throughput = vec3(1);
    p.pdf = 0;
    p.toLight = false;
    p.direct = vec3(0);
    p.ends = p.beyond = false;
    vec2 offset = filmPlace(p.seed);
    vec2 lens = lensPlace(p.seed);
#if HAS_hits
    PrimaryHit first = hits(pixelIndex(pixel));
    offset = first.film;
    lens = first.lens;
#endif
    p.ray = cameraRay(atTime(w, pathNumber(p, w, pixel)), (vec2(pixel) + offset) / vec2(colorSize()), lens);
    p.onward = p.ray;
    PROBE_OPEN(paths);
    PROBE(seed, p.seed);
    PROBE(film, offset);
    return true;
}

// What happens at a vertex of the path: emission, a light sample, the next direction.
bool scatter(inout Path p, World w, Hit hit) {
    vec3 direction = p.ray.direction;
    PROBE_OPEN(vertices);
    PROBE(vertex, p.scatterings + 1);
    PROBE_TEXT_IF(met, "environment", hit.primitive == NONE);
    if (hit.primitive == NONE) {
        PROBE(throughput, p.throughput);
        PROBE(emission, environmentRadiance(w, direction));
        PROBE(emissionPdfs, vec2(p.pdf, environmentPdf(w, direction)));
        PROBE(emissionShare, foundShare(technique(), p.pdf, environmentPdf(w, direction)));
        p.radiance += p.throughput * environmentRadiance(w, direction) * foundShare(technique(), p.pdf, environmentPdf(w, direction));
        return false;
    }
    Surface s = surfaceAt(w, hit, p.ray);
    PROBE_SURFACE(s);
    p.throughput *= segmentTransmittance(w, s, hit.t);
    PROBE(throughput, p.throughput);
    vec3 emitted = emittedRadiance(w, s);
    if (emitted != vec3(0)) {
        float pdfLight = lightPdf(w, hit.instance, hit.primitive, direction, hit.t);
        PROBE(emission, emitted);
        PROBE(emissionPdfs, vec2(p.pdf, pdfLight));
        PROBE(emissionShare, foundShare(technique(), p.pdf, pdfLight));
        p.radiance += p.throughput * emitted * foundShare(technique(), p.pdf, pdfLight);
    }
    if (p.scatterings == params.bounces) return false;
    uint vertex = ++p.scatterings;
    Bsdf b = bsdfAt(w, s);
    vec3 wo = -direction;

    // A light sample (next-event estimation).
    LobeChances chance = lobeProbabilities(b, wo);
    if (!bsdfAllDelta(b, chance)) {
        LightSample l = sampleLight(w, s.position, randomBits3(p.seed, vertex, RANDOM_LIGHT_CHOICE), random3(p.seed, vertex, RANDOM_LIGHT_POINT));
        float pdfBsdf;
        vec3 f = bsdfEval(b, chance, wo, l.direction, pdfBsdf);
        p.direct = p.throughput * f * l.radianceOverPdf * sampledShare(technique(), l.pdf, pdfBsdf);
        PROBE_OBJECT_OPEN(lightSample);
        PROBE(light, l.point.light);
        PROBE(direction, l.direction);
        PROBE(distance, l.distance);
        PROBE(lightPdf, l.pdf);
        PROBE(bsdfPdf, pdfBsdf);
        PROBE(share, sampledShare(technique(), l.pdf, pdfBsdf));
        PROBE(adds, p.direct);
        PROBE_CLOSE(lightSample);
        p.toLight = p.direct != vec3(0);
        if (p.toLight) p.ray = shadowRay(w, s, l);
    }

    // The next direction, and whether roulette lets the path live.
    BsdfSample next = bsdfSample(b, chance, wo, random3(p.seed, vertex, RANDOM_BSDF));
    PROBE_CHOICE(lobe, next.lobe, "diffuse|reflection|transmission|coat|through|absorbed");
    PROBE(next, next.wi);
    PROBE(pdf, next.pdf);
    p.ends = next.pdf == 0 || next.weight == vec3(0);
    if (!p.ends) {
        p.throughput *= next.weight;
        p.pdf = next.delta ? 0 : next.pdf;
        p.onward = spawnRay(w, s, next.wi);
        if (params.roulette && vertex >= params.rouletteStart) {
            float survival = clamp(max(p.throughput.r, max(p.throughput.g, p.throughput.b)), 0.05, 0.95);
            p.ends = random1(p.seed, vertex, RANDOM_ROULETTE) >= survival;
            PROBE(roulette, survival);
            PROBE(rouletteNumber, random1(p.seed, vertex, RANDOM_ROULETTE));
            p.throughput /= survival;
        }
    }
    if (p.toLight) return true;
    p.ray = p.onward;
    return !p.ends;
}

/// t at fineReach.
float nearPart(Ray ray) { return params.fineReach / length(ray.direction); }

Ray pathRay(inout Path p, out bool anyHit, out uint purpose) {
    anyHit = p.toLight;
    purpose = p.toLight ? RAYS_NEE : p.scatterings == 0 ? RAYS_PRIMARY : RAYS_CONTINUE;
#if HAS_hits
    if (!p.toLight && p.scatterings == 0) return knownRay(purpose);
#endif
    Ray ray = p.ray;
    if (RAY_LEVELS != 0 && params.fineReach > 0 && p.scatterings > 0 && !p.beyond) ray.tMax = min(ray.tMax, nearPart(ray));
    return ray;
}

/// A ray that sees finer levels up to fineReach and coarser ones beyond is two rays.
bool goesBeyond(inout Path p, Hit hit) {
    if (RAY_LEVELS == 0 || params.fineReach == 0 || p.scatterings == 0) return false;
    bool goes = !p.beyond && hit.primitive == NONE && p.ray.tMax > nearPart(p.ray);
    if (goes && p.toLight) p.direct *= transmittance(hit);
    if (goes) p.ray.tMin = nearPart(p.ray);
    p.beyond = goes;
    return goes;
}

bool pathStep(inout Path p, World w, Hit hit) {
    if (goesBeyond(p, hit)) return true;
#if HAS_hits
    if (!p.toLight && p.scatterings == 0) hit = firstHit(p, w);
#endif
    if (!p.toLight) return scatter(p, w, hit);
    PROBE(arrives, transmittance(hit));
    p.radiance += p.direct * transmittance(hit);
    p.toLight = false;
    p.ray = p.onward;
    return !p.ends;
}

void pathItemEnd(inout Path p, World w, ivec2 pixel, uint item) {}

void pathEnd(Path p, ivec2 pixel) { storeColor(pixel, vec4(p.radiance / float(params.spp), 1)); }

#include "trace/driver.glsl"
