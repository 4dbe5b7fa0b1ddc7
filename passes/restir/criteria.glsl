// SPDX-License-Identifier: MIT
// Where a path may be connected to another's vertices: the classic criteria, roughness and distance (of Lin et al. 2022, as stated in
// Lin et al. 2026, ReSTIR PT Enhanced, section 2.3).
//
// The same functions are asked on the base path and on the shifted one. A shift is invertible only if both find the same k: connectable
// pairs must neither appear before k nor vanish at k.

struct ConnectionCriteria {
    float roughness;  // least roughness of the sampled lobe as lobeRoughness() gives it (perceptual; 1: diffuse, 0: delta)
    float distance;   // least length of the connection, scene units: shorter ones have Jacobians without bound
};

/// A delta lobe is never rough, even with a threshold of 0. Compared in steps of 2^-12: many a material's roughness is the threshold itself, and no
/// kernel must see it on another side because its compiler rounded another way.
bool isRough(ConnectionCriteria c, float roughness) { return roughness > 0.0 && round(roughness * 4096.0) >= round(c.roughness * 4096.0); }

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

/// May the two be connected? Nothing scatters on a light, and the environment is infinitely far.
bool connectable(ConnectionCriteria c, Pair p) {
    bool far = p.end == PAIR_ENVIRONMENT || p.distance >= c.distance;
    return far && isRough(c, p.before) && (p.end != PAIR_SURFACE || isRough(c, p.at));
}
