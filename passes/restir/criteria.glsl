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

/// May x_{j-1} and x_j be connected? `before`: roughness of the lobe sampled at x_{j-1}, `at`: at x_j.
bool surfaceConnectable(ConnectionCriteria c, float before, float at, float distance) {
    return isRough(c, before) && isRough(c, at) && distance >= c.distance;
}

/// The same where the path ends on an emitter at x_j, found by the BSDF: nothing scatters there.
bool emitterConnectable(ConnectionCriteria c, float before, float distance) { return isRough(c, before) && distance >= c.distance; }

/// The same where it ends in the environment: infinitely far.
bool environmentConnectable(ConnectionCriteria c, float before) { return isRough(c, before); }

/// k after looking at the pair (x_{j-1}, x_j), j = 2, 3, ...: the first connectable pair's j. 0: none so far. A light found by light
/// sampling counts as connectable whatever the criteria say (Lin et al. 2026, section 6.2.3).
uint firstConnection(uint k, uint j, bool connectable) { return k == 0u && connectable ? j : k; }
