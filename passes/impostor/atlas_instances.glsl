// SPDX-License-Identifier: MIT
// Which blocks of pixels an instance's atlas is drawn in. After pass.glsl.
#include "impostor/atlas_texel.glsl"
#include "impostor/instance_items.glsl"
#include "impostor/sphere_on_film.glsl"

const uint BLOCK = 8u;          // pixels a side
const uint BLOCK_PIXELS = 64u;

/// The most that a placement enlarges anything, or more by at most the square root of 3.
float mostScale(Placement p) { return sqrt(dot(p.row0, p.row0) + dot(p.row1, p.row1) + dot(p.row2, p.row2)); }

/// Whose texels are about as wide as a pixel.
uint atlasLevel(World w, Atlases made, float radius, float distance) {
    float pixel = w.camera.pixelAngle * (w.camera.orthographic != 0u ? 1.0 : max(distance, radius));
    float level = log2(pixel / (radius * atlasTexelSide(made, 0u))) + params.bias;
    return uint(clamp(floor(level + 0.5), 0.0, float(made.levels - 1u)));
}

void chooseInstance(uint instance) {
    World w = world();
    Atlases made = atlases();
    InstanceRecord record = w.instances.at[instance];
    AtlasRecord object = made.objects.at[record.mesh];
    Placement placement = placementOf(w, instance);
    vec3 center = placePoint(placement, object.center);
    float volume = abs(placementDeterminant(placement));
    AtlasInstance chosen = AtlasInstance(0u, 0u);
    uint blocks = 0u;
    vec4 bounds;
    if (object.radius > 0.0 && volume > 0.0 && (record.flags & INSTANCE_HIDDEN) == 0u &&
        sphereOnFilm(w, center, object.radius * mostScale(placement), bounds)) {
        vec4 size = vec2(frameSize()).xyxy, pixels = clamp(bounds * size, vec4(-1.0), size + 1.0);
        ivec2 low = max(ivec2(floor(pixels.xy)), ivec2(0)), high = min(ivec2(floor(pixels.zw)), ivec2(frameSize()) - 1);
        if (all(lessThanEqual(low, high))) {
            uvec2 first = uvec2(low) / BLOCK, shape = uvec2(high) / BLOCK - first + 1u;
            uint level = atlasLevel(w, made, object.radius * pow(volume, 1.0 / 3.0), distance(center, w.camera.position));
            chosen = AtlasInstance(first.x | first.y << 16, shape.x | level << 16);
            blocks = shape.x * shape.y;
        }
    }
    storeDrawn(instance, chosen);
    storeItems(instance, blocks);
}
