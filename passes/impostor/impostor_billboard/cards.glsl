// SPDX-License-Identifier: MIT
// Cards through the middle of an object, each with what was seen of it from the side that faces the ray. After pass.glsl.
#include "impostor/atlas_pixel.glsl"

// Cosines between a ray and a card's normal at which the card is gone and at which it is all there: edge-on it would show a line.
const float EDGE_ON = 0.15, FACE_ON = 0.45;

/// The nearest card that is there. Depths that the atlas knows place what the card shows, but not where on the card that is.
bool seeInstance(Atlases made, AtlasRecord object, ObjectRay ray, vec3 towards, uint level, out SeenAtlas seen) {
    float nearest = FAR;
    vec3 unit = normalize(ray.direction);
    for (uint card = 0u; card < made.across / 2u; ++card) {
        uint view = 2u * card + (dot(cardDirection(made.arrangement, 2u * card), unit) > 0.0 ? 1u : 0u);
        ImpostorView v = atlasView(made, view);
        float facing = -dot(v.d, unit), t = -dot(v.d, ray.origin) / dot(v.d, ray.direction);
        float share = smoothstep(EDGE_ON, FACE_ON, facing);
        if (share == 0.0 || t < 0.0 || t >= nearest) continue;
        vec3 place = intoView(v, ray.origin + t * ray.direction);
        AtlasTexel texel = atlasAt(made, object, level, view, windowOfPlane(made, place.xy));
        if (share * texel.alpha <= ALPHA_LIMIT) continue;
        nearest = t;
        seen.texel = surfaceOfTexel(texel);
        seen.position = outOfView(v, vec3(place.xy, 1.0 - 2.0 * seen.texel.depth));
    }
    return nearest < FAR;
}
