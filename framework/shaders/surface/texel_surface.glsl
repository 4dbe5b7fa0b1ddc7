// SPDX-License-Identifier: MIT
// A texel of an impostor as a surface.
#include "impostor/texel_between.glsl"
#include "surface/surface_point.glsl"
#include "surface/surface_struct.glsl"

const float FACING_LEAST = 0.02;  // cosine that normals keep to the viewer: of what leans away from it at silhouettes

/// n, or what it becomes when it is turned towards the viewer until it is seen. Both unit.
vec3 facing(vec3 n, vec3 view) { return safeNormalize(n + max(0.0, FACING_LEAST - dot(n, view)) * view, view); }

/// `normal`: of the plane; `shading`: of what the texel shows. `side`: of the texel, world units. `front`: a front face is seen, and not one's back.
Surface texelSurface(uint instance, uint primitive, uint material, vec3 position, vec3 normal, vec3 shading, vec3 view, vec2 uv, float density, float side,
                     float rounding, bool front) {
    Surface s;
    s.view = view;
    s.position = position;
    s.normal = facing(normal, view);
    s.twiceArea = 0.25 * square(side);
    s.rounding = rounding;
    s.shadingNormal = bendNormal(facing(shading, view), s.normal, view);
    s.uv = uv;
    s.barycentrics = vec2(0.0);
    s.primitive = primitive;
    s.instance = instance;
    s.material = material;
    s.frontFace = front;
    s.frame = mat3(vec3(0.0), vec3(0.0), front ? s.normal : -s.normal);
    s.density = density;
    s.normalLength = 1.0;
    return s;
}

/// The texel that a hit names, as it is seen along rayDirection.
Surface texelSurfaceAt(World w, Hit hit, vec3 rayDirection) {
    Impostors made = impostorsOf(w);
    uint mesh = w.instances.at[hit.instance].mesh;
    TexelPlace x = texelPlace(made, hit.primitive - TEXEL);
    ImpostorTexel t = texelAt(made, mesh, x.level, x.view, x.texel);
    TexelPlane plane = texelPlane(made, mesh, x, t);
    t = texelBetween(made, mesh, x, t, hit.barycentrics);
    ImpostorView v = impostorView(made.views, x.view);
    Placement placement = placementOf(w, hit.instance);
    float mirror = placementDeterminant(placement) < 0.0 ? -1.0 : 1.0;
    vec3 view = -normalize(rayDirection);
    vec3 position = placePoint(placement, pointOn(plane, hit.barycentrics));
    vec3 perpendicular = mirror * placeNormal(placement, cross(plane.along, plane.across)), normal = safeNormalize(perpendicular, view);
    vec3 shading = normalOutOfView(placement, v, t.normal, normal);
    bool turns = (t.flags & TEXEL_TWO_SIDED) != 0u && dot(normal, view) < 0.0, front = ((t.flags & TEXEL_BACK) == 0u) != turns;
    float side = texelSide(made, made.objects.at[mesh].radius, x.level) * placementScale(placement);
    uint material = t.material;
    if (x.level > 0u) material = materialOf(made.objects.at[mesh], t, x.texel);
    Surface s = texelSurface(hit.instance, hit.primitive, material, position, turns ? -normal : normal, turns ? -shading : shading, view, t.uv, t.density, side,
                             texelRounding(w, hit.instance, placement, side), front);
    s.barycentrics = hit.barycentrics;
    s.twiceArea = length(perpendicular);
    s.normalLength = length(t.normal);
    return s;
}
