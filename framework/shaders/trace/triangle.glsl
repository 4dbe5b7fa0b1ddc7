// SPDX-License-Identifier: MIT
// Where a ray meets a triangle: Moeller and Trumbore, "Fast, minimum storage ray/triangle intersection", 1997.
struct Meeting {
    float t;            // tMax: they don't meet
    vec2 barycentrics;  // of the second and third vertex
};

// Between tMin and tMax, both excluded. Triangles without area and rays that aren't numbers never meet.
Meeting meet(vec3 origin, vec3 direction, float tMin, float tMax, vec3 v0, vec3 e1, vec3 e2) {
    vec3 p = cross(direction, e2), s = origin - v0, q = cross(s, e1);
    float inverse = 1.0 / dot(e1, p);
    float u = dot(s, p) * inverse, v = dot(direction, q) * inverse, t = dot(e2, q) * inverse;
    bool inside = all(bvec4(u >= 0.0, v >= 0.0, u + v <= 1.0, t > tMin)) && t < tMax;
    return Meeting(inside ? t : tMax, vec2(u, v));
}

// The nearer one; of equally near ones the first.
void nearer(inout Meeting a, inout uint primitiveA, Meeting b, uint primitiveB) {
    bool other = b.t < a.t;
    a.t = other ? b.t : a.t;
    a.barycentrics = other ? b.barycentrics : a.barycentrics;
    primitiveA = other ? primitiveB : primitiveA;
}
