// SPDX-License-Identifier: MIT
// Next-event estimation: choosing a light, a point of it, and the densities that multiple importance sampling needs.
// Units and falloffs of lights without extent: KHR_lights_punctual.
#include "base/random.glsl"
#include "base/sampling.glsl"
#include "light/emission.glsl"
#include "light/environment.glsl"
#include "light/light_levels.glsl"
#include "surface/surface.glsl"

/// A point of a light, found without knowing who looks: it can be stored and seen from elsewhere.
struct LightPoint {
    uint light;  // index in World.lights, NONE: there is no light
    uint texel;  // environment: EnvironmentPoint
    vec2 uv;     // triangle: barycentrics, environment: place inside the texel, else unused
};

struct LightSample {
    LightPoint point;
    vec3 direction;        // towards the light, unit
    float distance;        // FAR for the environment and directional lights
    vec3 radianceOverPdf;  // to be multiplied by f |cos|; 0 where the light is dark
    float pdf;             // per steradian, the light's choice included; 0 for lights without extent
    float cosine;          // at the light: its area density is pdf * cosine / distance^2; 1 where it has no surface
    float gap;             // before the light at which shadow rays end, so that rounding doesn't make it shade itself
    bool delta;            // no BSDF sample can find it
};

/// The light that a number chooses, NONE: its instance doesn't glow at the level shown. From one cut point (LightRecord.start) to the next: one step on
/// average.
uint numberedLight(World w, uint number) {
    uint part = scaledIndex(number, w.lightCount);
    uint end = part + 1u < w.lightCount ? w.lights.at[part + 1u].start : w.lightCount - 1u;
    return shownLight(w, number, lightBetween(w, number, w.lights.at[part].start, end));
}

/// Picks a light and a point of it. choice = randomBits3(.., RANDOM_LIGHT_CHOICE), u = random3(.., RANDOM_LIGHT_POINT).
LightPoint chooseLight(World w, uvec3 choice, vec3 u) {
    uint light = w.lightCount == 0u ? NONE : numberedLight(w, choice.x);
    if (light == NONE) return LightPoint(NONE, 0u, vec2(0.0));
    if (light == w.environmentLight) return LightPoint(light, sampleEnvironmentTexel(w, choice.y, u.x), u.yz);
    return LightPoint(light, 0u, uniformTriangle(u.yz));
}

/// Inverse square, a smooth end at the light's range, and a spot's cone.
float punctualFalloff(World w, uint light, vec3 direction, float distanceSquared) {
    float falloff = 1.0 / max(distanceSquared, 1e-20), range = w.lights.at[light].range;
    if (range > 0.0) falloff *= clamp(1.0 - square(distanceSquared / square(range)), 0.0, 1.0);
    if (w.lights.at[light].type == LIGHT_SPOT) {
        float inner = w.lights.at[light].cosInner, outer = w.lights.at[light].cosOuter;
        float cosine = -dot(direction, w.lights.at[light].direction);
        falloff *= square(clamp((cosine - outer) / max(inner - outer, 0.001), 0.0, 1.0));
    }
    return falloff;
}

void lightTriangle(World w, vec3 position, inout LightSample s) {
    uint instance = w.lights.at[s.point.light].instance, primitive = w.lights.at[s.point.light].primitive;
    if (SCENE_LIGHT_LEVELS != 0 && triangleLight(w, instance, primitive) != s.point.light) return;
    uvec3 corners = cornersOf(w, primitive);
    uint material = w.primitives.at[primitive].material;
    Placement placement = placementOf(w, instance);
    TrianglePoint point = pointOn(w, corners, s.point.uv);
    vec3 twiceArea = placeNormal(placement, cross(point.edge1, point.edge2)) * placement.winding;
    vec3 way = placePoint(placement, point.position) - position;
    float distanceSquared = dot(way, way), area = 0.5 * length(twiceArea);
    s.distance = sqrt(distanceSquared);
    if (!(area > 0.0 && s.distance > 0.0)) return;
    s.direction = way / s.distance;
    float facing = -dot(twiceArea, s.direction) / (2.0 * area);
    s.cosine = abs(facing);
    if (s.cosine <= 1e-6 || !emitsTo(w, material, facing > 0.0)) return;
    s.pdf = w.lights.at[s.point.light].pmf * distanceSquared / (area * s.cosine);
    s.gap = segmentGap(w, instance, placement, point, twiceArea, position + way, way);
    s.radianceOverPdf = emissionOn(w, material, corners, s.point.uv) / s.pdf;
}

/// How the stored light point looks from `position`. Deterministic; visibility is the caller's.
LightSample lightSampleAt(World w, LightPoint point, vec3 position) {
    LightSample s = LightSample(point, vec3(0.0, 1.0, 0.0), FAR, vec3(0.0), 0.0, 1.0, 0.0, false);
    if (point.light == NONE) return s;
    uint type = w.lights.at[point.light].type;
    if (type == LIGHT_TRIANGLE) {
        lightTriangle(w, position, s);
        return s;
    }
    float pmf = w.lights.at[point.light].pmf;
    if (type == LIGHT_ENVIRONMENT) {
        EnvironmentPoint p = EnvironmentPoint(point.texel, point.uv);
        s.direction = environmentDirection(w, p);
        s.pdf = pmf * environmentDensity(w, p);
        if (s.pdf > 0.0) s.radianceOverPdf = environmentTexels(w, p) / s.pdf;
        return s;
    }
    s.delta = true;
    vec3 intensity = w.lights.at[point.light].intensity / max(pmf, 1e-30);
    if (type == LIGHT_DIRECTIONAL) {
        s.direction = -w.lights.at[point.light].direction;
        s.radianceOverPdf = intensity;
        return s;
    }
    vec3 way = w.lights.at[point.light].position - position;
    s.distance = length(way);
    s.gap = SEGMENT_ROUNDING * (s.distance + maxComponent(abs(w.lights.at[point.light].position)));
    s.direction = safeNormalize(way, vec3(0.0, 1.0, 0.0));
    s.radianceOverPdf = intensity * punctualFalloff(w, point.light, s.direction, dot(way, way));
    return s;
}

/// Density of a light that is a vertex of a path, known by what it is and not by the random numbers that chose it: per steradian, or the mere chance
/// of a light without extent. It doesn't belong to such a path's integrand, for the chances of all lights change as soon as one of them does.
float vertexDensity(World w, LightSample l) { return l.delta ? w.lights.at[l.point.light].pmf : l.pdf; }

LightSample sampleLight(World w, vec3 position, uvec3 choice, vec3 u) { return lightSampleAt(w, chooseLight(w, choice, u), position); }

/// Density with which light sampling finds the point that a ray of unit direction hit after `distance`, per steradian, the light's choice
/// included; 0 where the triangle is no light.
float lightPdf(World w, uint instance, uint primitive, vec3 direction, float distance) {
    if (isTexel(primitive)) return 0.0;  // rays don't meet them
    uint light = triangleLight(w, instance, primitive);
    if (light == NONE) return 0.0;
    TrianglePoint point = pointOn(w, cornersOf(w, primitive), vec2(0.0));
    vec3 twiceArea = placeNormal(placementOf(w, instance), cross(point.edge1, point.edge2));
    float projected = 0.5 * abs(dot(twiceArea, direction));
    return projected > 0.0 ? w.lights.at[light].pmf * square(distance) / projected : 0.0;
}

/// The ray that decides how much s sees of the light sample. Behind panes lights of some extent are left to paths that go through them; those
/// without extent no path finds, so that their light comes straight.
Ray shadowRay(World w, Surface s, LightSample l) {
    Ray ray;
    if (l.distance >= FAR) ray = spawnRay(w, s, l.direction);
    else ray = rayBetween(s, s.position + l.distance * l.direction, l.gap);
    ray.flags = l.delta ? RAY_THROUGH_PANES : 0u;
    return ray;
}

/// Share of light that arrives along an any-hit ray, given what it hit.
vec3 transmittance(Hit hit) {
    if (hit.primitive != NONE) return vec3(0.0);
    return SCENE_PANES != 0 ? vec3(hit.t, hit.barycentrics) : vec3(1.0);
}

/// Balance heuristic (Veach and Guibas 1995): the weight of a sample found with density pdfA that another technique finds with pdfB.
/// It is the partition of unity that reservoirs of paths are built on. Good for 0 and for infinite pdfA.
float misWeight(float pdfA, float pdfB) { return pdfA > 0.0 ? 1.0 / (1.0 + pdfB / pdfA) : 0.0; }
