// SPDX-License-Identifier: MIT
// Where a ray meets a triangle: Moeller and Trumbore, "Fast, minimum storage ray/triangle intersection", 1997.
struct Meeting {
    float t;
    vec2 barycentrics;  // of the second and third vertex
    bool inside;        // of the triangle and of tMin < t < tMax; false for triangles without area and for NaN
};

Meeting meet(vec3 origin, vec3 direction, float tMin, float tMax, vec3 v0, vec3 e1, vec3 e2) {
    vec3 p = cross(direction, e2), s = origin - v0, q = cross(s, e1);
    float inverse = 1.0 / dot(e1, p);
    float u = dot(s, p) * inverse, v = dot(direction, q) * inverse, t = dot(e2, q) * inverse;
    return Meeting(t, vec2(u, v), min(min(u, v), 1.0 - u - v) >= 0.0 && t > tMin && t < tMax);
}
