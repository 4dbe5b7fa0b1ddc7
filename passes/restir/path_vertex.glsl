// SPDX-License-Identifier: MIT
// What paths do at a vertex, alike where they are made (path_tree.glsl) and where they are shifted (shift.glsl).
//
// Directions that are not of delta lobes lie on the grid that Reservoir stores them with: the path is exactly what is stored of it, and a shift
// back finds the numbers that it started from. The grid is so fine that sums over it stand for the integrals. What leaves x_{j-1} in the
// sampled direction arrives at x_j in the direction of its barycentrics, which is all that a connection knows of it.
#include "base/random.glsl"
#include "basic/light_technique.glsl"
#include "bsdf/material.glsl"
#include "restir/criteria.glsl"
#include "restir/jacobian.glsl"
#include "restir/light_number.glsl"
#include "restir/rules.h"
#include "world/exposure.glsl"
#include "world/primary_hit.h"
#include "world/ray_levels.glsl"

vec3 onGrid(vec3 direction) { return unpackDirection(packDirection(direction)); }

/// The direction in which x_j, j >= 2, is reached from x_{j-1}.
vec3 arrival(World w, Hit hit, vec3 from, vec3 direction) {
    return safeNormalize(positionAt(w, pointOf(hit)) - from, direction);
}

/// By which the rays of a path choose levels in pixel `p`: it goes with the camera sample, which is the path's own or the pixel's.
uint pathNumber(ShiftRules rules, World w, ivec2 p, uvec2 seed) { return rules.pixelCamera != 0u ? numberOfPixel(w, p) : numberOfPath(seed); }

/// When rays of a path whose own time is `time` see the scene in pixel `p`: likewise.
float pathTime(ShiftRules rules, World w, ivec2 p, float time) { return rules.pixelCamera != 0u ? timeOf(numberOfPixel(w, p)) : time; }

/// The geometry term of the Jacobian per barycentric area of x_k instead of per area: barycentrics are what a shift keeps, so that a triangle
/// that grew from one frame to the next is accounted for.
float connectionTerm(vec3 from, Surface s) { return geometryTerm(from, s.position, s.normal) * s.twiceArea; }

/// The same for a light point; 1 where it has no surface. pmf / pdf is the solid angle per share of the triangle.
float connectionTerm(World w, LightSample l) { return l.distance < FAR && !l.delta ? w.lights.at[l.point.light].pmf / l.pdf : 1.0; }

/// A direction of the path and the lobe it came from, by the path's own numbers.
BsdfDirection pathDirection(Bsdf b, LobeChances chance, vec3 wo, uvec2 seed, uint vertex) {
    BsdfDirection d = bsdfDirection(b, chance, wo, random3(seed, vertex, RANDOM_BSDF));
    if (!d.delta && d.wi != vec3(0.0)) d.wi = onGrid(d.wi);
    return d;
}

/// The further down the path, the less a good choice is worth (Lin et al. 2026, ReSTIR PT Enhanced, section 7: 32 / B^2).
uint lightCandidates(ShiftRules rules, uint vertex) { return max(rules.lightCandidates / (vertex * vertex), 1u); }

/// omega_t of a light that the BSDF at `vertex` found with total density pdf (0: by a delta lobe, or it is seen by the camera), and light
/// sampling with pdfLight (0: never, it is an unlit surface).
float emissionShare(ShiftRules rules, uint vertex, float pdf, float pdfLight) {
    return foundShare(rules.technique, pdf, float(lightCandidates(rules, vertex)) * pdfLight);
}

/// omega_t of a light that light sampling at `vertex` found with density pdfLight (0: a light without extent).
float lightShare(ShiftRules rules, uint vertex, float pdfLight, float pdf) {
    return sampledShare(rules.technique, float(lightCandidates(rules, vertex)) * pdfLight, pdf);
}

/// What the path of `seed` asks of connections where its first hit is at `distance` from the lens, under `cosine` with the triangle's normal. Those of
/// the pixel and frame that the path is in: a shift asks anew.
ConnectionCriteria criteriaOf(ShiftRules rules, uvec2 seed, float distance, float cosine) {
    if (rules.criteria == CRITERIA_DISTANCE) return ConnectionCriteria(rules.criteria, rules.roughness, rules.distance);
    float least = rules.footprint * pathThreshold(seed, rules.spread);
    return ConnectionCriteria(rules.criteria, rules.roughness, least * primaryFootprint(distance, cosine));
}

/// Roughness of a vertex that scatters towards a light sample with all its lobes: that of the roughest. 0 where all are delta lobes.
float roughestLobe(Bsdf b, LobeChances chances) {
    vec4 chance = chances.scatter;
    if (chance.x > 0.0) return 1.0;
    float base = max(chance.y > 0.0 ? lobeRoughness(b, LOBE_REFLECTION) : 0.0, chance.z > 0.0 ? lobeRoughness(b, LOBE_TRANSMISSION) : 0.0);
    return max(base, chance.w > 0.0 ? lobeRoughness(b, LOBE_COAT) : 0.0);
}

/// Whether the light behind a vertex, found by light sampling, may be x_k itself: always where that is forced, so that lights are never replayed
/// (Lin et al. 2026, ReSTIR PT Enhanced, section 6.2.3). `roughness` and `pdf` (of its direction): of all lobes at the vertex.
bool lightConnectable(ShiftRules rules, ConnectionCriteria criteria, Surface s, float roughness, float pdf, LightSample l) {
    if (rules.forcedNee != 0u) return true;
    Pair pair = Pair(PAIR_LIGHT, roughness, 0.0, pdf, 0.0, abs(dot(s.normal, l.direction)), l.cosine, l.distance);
    PROBE_PAIR(pairs, criteria, pair);
    return connectable(criteria, pair);
}

PrimaryHit primaryHit(Hit hit, vec2 film, vec2 lens) { return PrimaryHit(hit.instance, hit.primitive, hit.barycentrics, film, lens); }
