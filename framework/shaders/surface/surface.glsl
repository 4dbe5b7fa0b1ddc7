// SPDX-License-Identifier: MIT
// The surface that a ray has hit: where it is, which way it faces, and rays that leave it.
#include "base/math.glsl"
#include "base/pack.glsl"
#include "surface/surface_point.glsl"
#include "surface/surface_struct.glsl"
#include "texture/material_map.glsl"
#include "world/scene_facts.glsl"
#if TEXEL_SURFACES
#include "surface/texel_surface.glsl"
#endif

/// Tangent, bitangent and n as columns, n being the smooth normal in world space. Zeros for n's companions where the
/// mesh has no tangents: maps then leave the normal as it is.
mat3 tangentFrame(World w, Placement placement, float mirror, uvec3 corners, vec2 barycentrics, vec3 n) {
    vec3 weights = vec3(1.0 - barycentrics.x - barycentrics.y, barycentrics), tangent = vec3(0.0);
    uint first = w.vertices.at[corners.x].tangent;
    for (int i = 0; i < 3; ++i) tangent += weights[i] * unpackTangent(w.vertices.at[corners[i]].tangent).xyz;
    if (first == TANGENT_NONE) return mat3(vec3(0.0), vec3(0.0), n);
    tangent = placeVector(placement, tangent);
    tangent = safeNormalize(tangent - dot(tangent, n) * n, basisAround(n)[0]);
    return mat3(tangent, cross(n, tangent) * (unpackTangent(first).w * mirror), n);
}

/// The normal that the material's normal map gives in the frame, in world space (glTF 2.0, section 3.9.3).
vec3 mapNormal(World w, Surface s, uvec3 corners, mat3 frame) {
    vec3 m = readMap(w, w.materials.at[s.material].normalMap, s.uv, corners, s.barycentrics).xyz * 2.0 - 1.0;
    m.xy *= w.materials.at[s.material].normalScale;
    return safeNormalize(frame * m, frame[2]);
}

/// A camera hit as a ray gave it, but for its distance.
Hit hitOf(PrimaryHit h) { return Hit(0.0, h.barycentrics, h.primitive, h.instance); }

/// `w` is the World the ray was traced in; rayDirection may have any length. All passes that are given the hit find the same position.
Surface surfaceAt(World w, Hit hit, vec3 rayDirection) {
#if TEXEL_SURFACES
    if (isTexel(hit.primitive)) return texelSurfaceAt(w, hit, rayDirection);
#endif
    uvec3 corners = cornersOf(w, hit.primitive);
    Placement placement = placementOf(w, hit.instance);
    TrianglePoint point = pointOn(w, corners, hit.barycentrics);
    vec3 view = -normalize(rayDirection);
    float mirror = placementDeterminant(placement) < 0.0 ? -1.0 : 1.0;

    Surface s;
    s.view = view;
    s.position = placePoint(placement, point.position);
    s.uv = uvOn(w, corners, hit.barycentrics, 0u);
    s.barycentrics = hit.barycentrics;
    s.primitive = hit.primitive;
    s.instance = hit.instance;
    s.material = w.primitives.at[hit.primitive].material;

    vec3 perpendicular = placeNormal(placement, cross(point.edge1, point.edge2)) * placement.winding, front = safeNormalize(perpendicular, view);
    s.twiceArea = length(perpendicular);
    s.frontFace = dot(front, view) >= 0.0;
    s.normal = s.frontFace ? front : -front;
    s.rounding = planeRounding(w, hit.instance, placement, point, s.position, s.normal, s.twiceArea);

    vec3 n = safeNormalize(placeNormal(placement, smoothNormalOn(w, corners, hit.barycentrics)) * mirror, front);
    // Files with normals that point inwards are common enough: only the normal's line is trusted, the side comes from the winding.
    n = dot(n, front) < 0.0 ? -n : n;
    s.frame = mat3(vec3(0.0), vec3(0.0), n);
    s.density = DENSITY_NONE;
    s.normalLength = 1.0;
    bool mapped = w.materials.at[s.material].normalMap.texture != NONE;
    if (mapped || (SCENE_LAYERS != 0 && w.materials.at[s.material].layers != NONE)) s.frame = tangentFrame(w, placement, mirror, corners, hit.barycentrics, n);
    if (mapped) n = mapNormal(w, s, corners, s.frame);
    s.shadingNormal = bendNormal(s.frontFace ? n : -n, s.normal, view);
    return s;
}

/// The same where the ray is at hand. Barycentrics in single precision place a point to a ten-millionth of the triangle: on ground of 200 km, to a
/// centimetre. A ray that is shorter than the triangle knows better where along the triangle it ended.
Surface surfaceAt(World w, Hit hit, Ray ray) {
    Surface s = surfaceAt(w, hit, ray.direction);
    vec3 way = hit.t * ray.direction, met = ray.origin + way;
    met += dot(s.normal, s.position - met) * s.normal;
    bool close = square(maxComponent(abs(ray.origin))) + dot(way, way) < s.twiceArea;
    s.position = close ? met : s.position;
    return s;
}

/// Where a ray that leaves the surface towards `direction` starts: off the triangle by the error bound, to that side.
vec3 spawnOrigin(Surface s, vec3 direction) { return s.position + (dot(s.normal, direction) < 0.0 ? -s.rounding : s.rounding) * s.normal; }

Ray spawnRay(World w, Surface s, vec3 direction) { return Ray(spawnOrigin(s, direction), 0.0, direction, FAR, 0u); }

/// The segment from the surface to a point, for occluded(). Its direction is not unit; it ends `gap` (world units) short of the target, at most
/// half way.
Ray rayBetween(Surface s, vec3 target, float gap) {
    vec3 origin = spawnOrigin(s, target - s.position);
    vec3 direction = target - origin;
    return Ray(origin, 0.0, direction, 1.0 - clamp(gap * inversesqrt(max(dot(direction, direction), 1e-30)), ROUNDING, 0.5), 0u);
}
