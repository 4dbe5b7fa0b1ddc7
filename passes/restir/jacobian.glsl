// SPDX-License-Identifier: MIT
// Jacobians of the hybrid shift: random replay up to x_{k-1}, then reconnection to x_k.
//
// Two forms of the same estimator, never to be mixed between passes:
// - Primary sample space: F = f / p over random numbers; the Jacobian has the densities at x_{k-1} and x_k (Lin et al. 2026, ReSTIR PT
//   Enhanced, Eq. 2).
// - Mixed measure, the form that Reservoir stores: F is not divided by the densities of the directions at x_{k-1} and x_k (nor by a
//   light's, where x_k or x_{k+1} is a light found by light sampling), W is divided by them instead. What is left of the Jacobian is the
//   reconnection's in solid angle (Lin et al. 2022, Generalized Resampled Importance Sampling, Eq. 52).
// Densities are those of the sampled lobe, its probability included. A result of 0 means that the shift fails.
#include "restir/reservoir.glsl"

/// Solid angle at `from` per area at `to`: |n . d| / r^2, with the cosine where the connection arrives. `normal`: of the triangle at `to`,
/// unit, never a shading normal. 0 where the points coincide.
float geometryTerm(vec3 from, vec3 to, vec3 normal) {
    vec3 way = to - from;
    float squared = dot(way, way);
    return squared > 0.0 ? abs(dot(normal, way)) / (squared * sqrt(squared)) : 0.0;
}

/// y / x; 0 where it is not a positive finite number.
float jacobianRatio(float y, float x) {
    float ratio = x > 0.0 && y > 0.0 ? y / x : 0.0;
    return isinf(ratio) ? 0.0 : ratio;
}

/// Lin et al. 2022, Eq. 52: solid angle at y_{k-1} per solid angle at x_{k-1}, for the same x_k. It is the whole Jacobian in the mixed
/// measure. Gx is the base path's term (Reservoir.G), Gy the shifted path's; both 1 where x_k is the environment or a punctual light, or
/// nothing is connected.
float reconnectionJacobian(float Gy, float Gx) { return jacobianRatio(Gy, Gx); }

/// The terms of Eq. 2 that belong to one path; they are all that has to be known of a base path.
struct ReconnectionTerms {
    float pBefore;  // of the direction x_{k-1} -> x_k, per solid angle; RC_LIGHT: of the light's point, per area (environment: solid angle)
    float G;        // x_{k-1} -> x_k
    float pAt;      // of the direction that leaves x_k, per solid angle
};

/// Leaves only those terms that the kind of reconnection has: light sampling doesn't depend on the direction the path came from, an
/// emitter scatters nothing, and the environment's vertex is a direction.
ReconnectionTerms reconnectionTerms(uint kind, float pBefore, float G, float pAt) {
    if (kind == RC_NONE) return ReconnectionTerms(1.0, 1.0, 1.0);
    if (kind == RC_LIGHT || kind == RC_ENVIRONMENT) return ReconnectionTerms(pBefore, 1.0, 1.0);
    return ReconnectionTerms(pBefore, G, kind == RC_SURFACE ? pAt : 1.0);
}

/// Lin et al. 2026, Eq. 2: Jacobian in primary sample space, by quotients so that narrow lobes at large distances don't overflow.
float hybridJacobian(ReconnectionTerms y, ReconnectionTerms x) {
    float before = jacobianRatio(y.pBefore, x.pBefore), at = jacobianRatio(y.pAt, x.pAt), connection = jacobianRatio(y.G, x.G);
    return jacobianRatio(before * at * connection, 1.0);
}

/// Random replay of one vertex: solid angle after the shift per solid angle before, p^x / p^y, as the numbers stay: d omega = du / p.
float replayJacobian(float py, float px) { return jacobianRatio(px, py); }

/// Brings one direction's share of a Jacobian from solid angle to primary sample space (Lin et al. 2022, Eq. 53, 54). A replayed vertex
/// comes out as 1.
float primarySampleJacobian(float solidAngleJacobian, float py, float px) { return solidAngleJacobian * jacobianRatio(py, px); }
