// SPDX-License-Identifier: MIT
// Where a path may be connected to another's vertices. Two criteria:
// - distance, the classic one: roughness at both ends and a least length (of Lin et al. 2022, as stated in Lin et al. 2026, ReSTIR PT Enhanced,
//   section 2.3);
// - footprint: roughness at x_{j-1} alone, and the areas that the directions between the two vertices spread over have to be large beside the
//   footprint of the pixel (Lin et al. 2026, Eq. 5), whatever the scene's scale.
//
// The same functions are asked on the base path and on the shifted one. A shift is invertible only if both find the same k: connectable
// pairs must neither appear before k nor vanish at k.
#include "base/math.glsl"
#include "base/probe.glsl"
#include "base/random.glsl"

const uint CRITERIA_DISTANCE = 0u;
const uint CRITERIA_FOOTPRINT = 1u;

/// What one path asks of connections.
struct ConnectionCriteria {
    uint kind;        // CRITERIA_*
    float roughness;  // least roughness of the sampled lobe as lobeRoughness() gives it (perceptual; 1: diffuse, 0: delta)
    float least;      // distance: length of the connection, scene units: shorter ones have Jacobians without bound; footprint: area, scene units squared
};

/// A delta lobe is never rough, even with a threshold of 0. Compared in steps of 2^-12: many a material's roughness is the threshold itself, and no
/// kernel must see it on another side because its compiler rounded another way.
bool isRough(ConnectionCriteria c, float roughness) { return roughness > 0.0 && round(roughness * 4096.0) >= round(c.roughness * 4096.0); }

/// The area that a camera ray of all directions would spread over at x_1 (Lin et al. 2026, below Eq. 5): 4 pi r^2 / cos, of which the least footprint
/// is a share. `cosine`: of the camera ray with the triangle's normal. Rays of an orthographic camera are taken as if they came from its plane.
float primaryFootprint(float distance, float cosine) { return 4.0 * PI * square(distance) / max(cosine, 1e-6); }

/// A number around 1 with a relative deviation of `spread`, the same wherever the path of `seed` goes: it softens the threshold, whose edge
/// would show.
float pathThreshold(uvec2 seed, float spread) {
    if (spread <= 0.0) return 1.0;
    vec2 u = random2(seed, 0u, RANDOM_THRESHOLD);
    return max(1.0 + spread * sqrt(-2.0 * log(1.0 - u.x)) * cos(TWO_PI * u.y), 0.0);
}

/// Two vertices x_{j-1}, x_j, as far as it matters to whether they may be connected. Roughness is that of the lobe sampled there.
struct Pair {
    uint end;            // PAIR_*: what x_j is
    float before, at;    // roughness at x_{j-1} and, where it scatters, at x_j
    float pdfBefore;     // of the direction x_{j-1} -> x_j, of all lobes, per solid angle; 0: a delta lobe's
    float pdfAt;         // of the direction that leaves x_j, likewise
    float cosineBefore;  // at x_{j-1}, of the segment with the triangle's normal
    float cosineAt;      // at x_j
    float distance;      // between them; FAR: infinite
};
const uint PAIR_SURFACE = 0u;      // x_j scatters
const uint PAIR_EMITTER = 1u;      // it is an emitter that the BSDF found
const uint PAIR_ENVIRONMENT = 2u;  // it is the environment, found by the BSDF
const uint PAIR_LIGHT = 3u;        // it is a light found by light sampling
const uint PAIR_REACHED = 4u;      // what it is or does is not known yet: no is final

/// Does a direction of density pdf spread over `least` at least, at `distance` and under `cosine`? The footprint is 1 / (p G) (Lin et al. 2026, Eq. 3).
bool spreadsOver(float least, float pdf, float cosine, float distance) { return pdf > 0.0 && square(distance) >= least * pdf * cosine; }

/// An emitter, which scatters nothing, is taken for one that sends light alike to all sides.
float pdfFrom(Pair p) { return p.end == PAIR_SURFACE ? p.pdfAt : 0.5 * INV_PI; }

/// May the two be connected? Nothing scatters on a light, and the environment is infinitely far.
bool connectable(ConnectionCriteria c, Pair p) {
    if (!isRough(c, p.before)) return false;
    if (p.end == PAIR_ENVIRONMENT) return true;
    if (c.kind == CRITERIA_DISTANCE) return p.distance >= c.least && (p.end != PAIR_SURFACE || isRough(c, p.at));
    if (!spreadsOver(c.least, p.pdfBefore, p.cosineAt, p.distance)) return false;
    // The way back, with the cosine where it arrives.
    if (p.end == PAIR_REACHED) return true;
    return (p.end != PAIR_SURFACE || p.at > 0.0) && spreadsOver(c.least, pdfFrom(p), p.cosineBefore, p.distance);
}

#ifdef PROBING
// What the criteria say of a pair, one by one.
void probePair(uint place, ConnectionCriteria c, Pair p) {
    probeAppend(place, PROBE_SCOPE, 0u, uvec4(0u));
    PROBE(connectable, connectable(c, p));
    PROBE_CHOICE(end, p.end, "surface|emitter|environment|light|reached");
    PROBE(roughnessBefore, p.before);
    PROBE(roughnessAt, p.at);
    PROBE(roughnessLeast, c.roughness);
    PROBE(distance, p.distance);
    PROBE_CHOICE(criteria, c.kind, "distance|footprint");
    PROBE(least, c.least);
    PROBE(pdfBefore, p.pdfBefore);
    PROBE(pdfAt, p.pdfAt);
    PROBE(cosineBefore, p.cosineBefore);
    PROBE(cosineAt, p.cosineAt);
    probeAppend(place, PROBE_SCOPE_END, 0u, uvec4(0u));
}
#define PROBE_PAIR(name, criteria, pair) probePair(PROBE_PLACE, criteria, pair)
#else
#define PROBE_PAIR(name, criteria, pair)
#endif
