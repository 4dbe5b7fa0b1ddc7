// SPDX-License-Identifier: MIT
// How far from its place, at right angles to its triangle, a point may be, and rays may meet the triangle, for single precision. Each sum is
// bounded by its magnitudes times the roundings that they go through (Higham 2002, Accuracy and Stability of Numerical Algorithms, section
// 3.1; Pharr, Jakob, Humphreys 2023, Physically Based Rendering, section 6.8), axis by axis, and only what lies along the normal counts
// (Waechter and Binder 2019, A Fast and Robust Method for Avoiding Self-Intersection): flat ground stays exact however wide it is.
#include "base/math.glsl"
#include "world/triangle.glsl"

const float ROUNDING = 5.9604645e-8;  // 2^-24, of one operation, relative

/// World units. `position` and `normal` (unit) are in world space, `twiceArea` is the triangle's there.
///
/// The position: differences of corners 1, products 1, sums 2, the matrix 3, the translation and the way off the surface 1 each.
/// Entering the object: our traversal subtracts a point of world space (rounded itself: 1) from the origin 1, multiplies by rows (elements 1,
/// products 1, sums 2), and has rounded the corner 1; a driver's multiplies origin and translation (4 each). With sizes by element, those
/// are at most |M^-1| |M| |x| and |M^-1| |t| of the point x in the object, of which the former is |x| and what a row mixes of the largest coordinate.
/// Meeting the triangle: the determinant of Moeller and Trumbore over (s, edge1, edge2), 8 to a term, with s within the triangle. Drivers may shear it
/// to the ray first (Woop, Benthin, Wald 2013, Watertight Ray/Triangle Intersection): then sizes along all axes enter.
float planeRounding(World w, uint instance, Placement p, TrianglePoint t, vec3 position, vec3 normal, float twiceArea) {
    vec3 a = abs(t.edge1), b = abs(t.edge2), reach = max(a, b), size = 5.0 * abs(t.corner) + 7.0 * reach;
    vec3 place = vec3(dot(abs(p.row0), size), dot(abs(p.row1), size), dot(abs(p.row2), size)) + 2.0 * abs(position);
    vec3 across = abs(cross(t.edge1, t.edge2));
#ifdef TRACE_RAY_QUERY
    float terms = length(a) * length(b) * length(reach);
#else
    float terms = dot(reach, a.yzx * b.zxy + a.zxy * b.yzx);
#endif
    vec4 moved = w.instances.at[instance].rounding;
    vec3 x = abs(t.position), entering = 7.0 * (x + moved.w * maxComponent(x)) + 8.0 * moved.xyz;
    // Found per volume of the object, over the base of that volume in the world. A sliver may be met farther off than it is wide; then by no more
    // than a square of its area.
    float met = ROUNDING * (dot(across, entering) + 8.0 * terms) * abs(placementDeterminant(p));
    return ROUNDING * dot(abs(normal), place) + min(met / max(twiceArea, 1e-30), sqrt(twiceArea));
}
