// SPDX-License-Identifier: MIT
// An octahedral impostor: the three views around the direction to the camera, each where the ray meets what it saw, mixed (Brucks 2018, Octahedral
// Impostors). After pass.glsl.
#include "impostor/atlas_pixel.glsl"

/// The ray in the axes of a view.
ObjectRay inAxes(ImpostorView v, ObjectRay ray) { return ObjectRay(intoView(v, ray.origin), intoView(v, ray.direction)); }

/// Where it is at a height over the view's plane.
vec2 placeAt(ObjectRay ray, float height) { return ray.origin.xy + (height - ray.origin.z) / ray.direction.z * ray.direction.xy; }

/// One step towards the surface below the point of the plane. By the sine of the angle and not its tangent, so that it stays bounded however flat the ray.
vec2 stepTowards(Atlases made, AtlasRecord object, uint view, uint level, ObjectRay ray) {
    vec2 place = placeAt(ray, 0.0);
    float height = atlasHeight(made, object, level, view, windowOfPlane(made, place));
    return place - height * normalize(ray.direction).xy;
}

const float NOTHING_BELOW = 2.0;  // radii: higher than any point of the sphere over any other

/// How far above the surface of a view a ray is at t.
float heightOver(Atlases made, AtlasRecord object, uint view, uint level, ObjectRay ray, float t) {
    vec3 p = ray.origin + t * ray.direction;
    AtlasTexel texel = atlasAt(made, object, level, view, windowOfPlane(made, p.xy));
    return texel.alpha < ALPHA_LIMIT ? NOTHING_BELOW : p.z - (1.0 - 2.0 * texel.depth / texel.alpha);
}

/// Where the ray falls below the surface: steps through the sphere, and one along the chord of the last (Policarpo et al. 2005, Real-Time Relief Mapping on
/// Arbitrary Polygonal Surfaces). At a silhouette there is no chord; there the ray has met the surface if it is below it by less than it fell, and else it
/// passes behind. Outside of the window where it meets nothing.
vec2 descend(Atlases made, AtlasRecord object, uint view, uint level, ObjectRay ray) {
    float middle, reach;
    throughSphere(ray, 1.0 + atlasTexelSide(made, level), middle, reach);  // begins above what touches the sphere
    float size = 2.0 * reach / float(params.steps), fall = size * abs(ray.direction.z);
    float t = middle - reach, before = heightOver(made, object, view, level, ray, t);
    for (int i = 0; i < params.steps; ++i) {
        float now = heightOver(made, object, view, level, ray, t + size);
        if (before == NOTHING_BELOW && now <= 0.0 && now >= -fall) return ray.origin.xy + (t + size) * ray.direction.xy;
        if (before > 0.0 && before < NOTHING_BELOW && now <= 0.0) return ray.origin.xy + (t + size * before / (before - now)) * ray.direction.xy;
        before = now;
        t += size;
    }
    return vec2(2.0);
}

/// Place in a view's plane of what the ray sees.
vec2 placeSeen(Atlases made, AtlasRecord object, uint view, uint level, ObjectRay ray) {
    if (params.parallax == parallax_relief) return descend(made, object, view, level, ray);
    if (params.parallax == parallax_step) return stepTowards(made, object, view, level, ray);
    return placeAt(ray, 0.0);
}

const float GRAZING = 0.05;  // cosine of a ray to a view's axis below which the view shows nothing of use: cells wide enough for that are few views

bool seeInstance(Atlases made, AtlasRecord object, ObjectRay ray, vec3 towards, uint level, out SeenAtlas seen) {
    GridViews grid = viewsAround(made.across, gridPlace(made.arrangement == ATLAS_HEMI, towards));
    AtlasTexel sum = emptyAtlasTexel();
    float most = 0.0;
    for (uint i = 0u; i < 3u; ++i) {
        uint view = grid.views[i];
        ImpostorView v = atlasView(made, view);
        ObjectRay own = inAxes(v, ray);
        if (grid.weights[i] == 0.0 || own.direction.z > -GRAZING * length(own.direction)) continue;
        vec2 place = placeSeen(made, object, view, level, own);
        AtlasTexel texel = atlasAt(made, object, level, view, windowOfPlane(made, place));
        addTexel(sum, texel, grid.weights[i]);
        // The mean of depths would lie where no surface is.
        if (grid.weights[i] * texel.alpha <= most) continue;
        most = grid.weights[i] * texel.alpha;
        seen.position = outOfView(v, vec3(place, 1.0 - 2.0 * texel.depth / texel.alpha));
    }
    seen.texel = surfaceOfTexel(sum);
    return sum.alpha > ALPHA_LIMIT;
}
