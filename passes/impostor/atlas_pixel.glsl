// SPDX-License-Identifier: MIT
// Pixels that show atlases: the ray of a pixel in an instance's space, the nearest instance, and the surface that comes of it. After pass.glsl.
// Who includes this defines
//
//     bool seeInstance(Atlases made, AtlasRecord object, ObjectRay ray, vec3 towards, uint level, out SeenAtlas seen)
//
// which says what a ray sees of an instance; `towards`: from the object's centre to the camera, unit, object space.
#include "basic/film.glsl"
#include "impostor/atlas_instances.glsl"
#include "impostor/baked_surface.h"

layout(buffer_reference, scalar, buffer_reference_align = 8) buffer WideKeys { uint64_t at[]; };

/// In the object's space, in radii from its centre. `direction` is as long as makes t the world's.
struct ObjectRay {
    vec3 origin, direction;
};

struct SeenAtlas {
    vec3 position;    // object space, in radii from the centre
    AtlasTexel texel; // of the surface (surfaceOfTexel)
};

bool seeInstance(Atlases made, AtlasRecord object, ObjectRay ray, vec3 towards, uint level, out SeenAtlas seen);

/// Where a ray is nearest to the centre, and half the way that it runs through a sphere around it; false where it misses that, or left it before.
bool throughSphere(ObjectRay ray, float radius, out float middle, out float reach) {
    float squared = dot(ray.direction, ray.direction);
    middle = -dot(ray.origin, ray.direction) / squared;
    vec3 nearest = ray.origin + middle * ray.direction;
    reach = sqrt(max(radius * radius - dot(nearest, nearest), 0.0) / squared);
    return reach > 0.0 && middle + reach > 0.0;
}

/// Inverse of placeVector.
vec3 unplaceVector(Placement p, vec3 v) {
    return (v.x * cross(p.row1, p.row2) + v.y * cross(p.row2, p.row0) + v.z * cross(p.row0, p.row1)) / placementDeterminant(p);
}

Ray pixelRay(World w, ivec2 pixel) {
    uvec2 seed = pathSeed(uvec2(pixel), frameIndex(), runSeed());
    return cameraRay(w, filmOf(pixel, filmPlace(seed), frameSize()), lensPlace(seed));
}

/// What the pixel shows of an instance that is drawn there, and how deep along the camera's forward direction.
bool seeFrom(World w, Atlases made, uint instance, uint level, ivec2 pixel, out SeenAtlas seen, out float depth) {
    AtlasRecord object = made.objects.at[w.instances.at[instance].mesh];
    Placement placement = placementOf(w, instance);
    Ray ray = pixelRay(w, pixel);
    vec3 center = placePoint(placement, object.center);
    ObjectRay own = ObjectRay(unplaceVector(placement, ray.origin - center) / object.radius, unplaceVector(placement, ray.direction) / object.radius);
    vec3 camera = w.camera.orthographic != 0u ? -w.camera.forward : w.camera.position - center;
    vec3 towards = safeNormalize(unplaceVector(placement, camera), vec3(0.0, 0.0, 1.0));
    depth = 0.0;
    float middle, reach;
    if (!throughSphere(own, 1.0, middle, reach) || !seeInstance(made, object, own, towards, level, seen)) return false;
    depth = dot(center + placeVector(placement, object.radius * seen.position) - w.camera.position, w.camera.forward);
    return depth > 0.0;
}

// Radii from the centre that nothing lies beyond that an atlas shows: the corner of a window and of the heights over it lies nearer.
const float FARTHEST_SHOWN = 2.0;

/// What an instance shows is at least so deep. Negative where it may be anywhere.
float leastDepth(World w, Atlases made, uint instance) {
    AtlasRecord object = made.objects.at[w.instances.at[instance].mesh];
    Placement placement = placementOf(w, instance);
    vec3 center = placePoint(placement, object.center);
    return dot(center - w.camera.position, w.camera.forward) - FARTHEST_SHOWN * object.radius * mostScale(placement);
}

/// The nearest instance of each pixel stays. 64 lanes each walk through a share of the frame's blocks, one block after the other: looking up whose a block
/// is costs more than most blocks do.
void scatterBlocks(uint lane, uint lanes) {
    World w = world();
    Atlases made = atlases();
    WideKeys keys = WideKeys(passBlock().keys.address);
    uint inner = lane % BLOCK_PIXELS, walks = lanes / BLOCK_PIXELS, share = (total(0u) + walks - 1u) / walks;
    uint begin = lane / BLOCK_PIXELS * share, end = min(begin + share, total(0u));
    if (begin >= end) return;
    uint instance = instanceOfItem(begin);
    for (uint block = begin; block < end; ++block) {
        while (instance + 1u < itemsCount() && items(instance + 1u) <= block) ++instance;
        AtlasInstance d = drawn(instance);
        uint across = d.shape & 0xffffu, within = block - items(instance);
        uvec2 place = uvec2(d.corner & 0xffffu, d.corner >> 16) + uvec2(within % across, within / across);
        ivec2 pixel = ivec2(BLOCK * place + uvec2(inner % BLOCK, inner / BLOCK));
        if (any(greaterThanEqual(uvec2(pixel), frameSize()))) continue;
        uint i = pixelIndex(pixel);
        SeenAtlas seen;
        float depth = leastDepth(w, made, instance);
        if (depth > 0.0 && floatBitsToUint(depth) > uint(keys.at[i] >> 32)) continue;  // hidden, whatever it shows
        if (!seeFrom(w, made, instance, d.shape >> 16, pixel, seen, depth)) continue;
        uint64_t key = packUint2x32(uvec2(instance, floatBitsToUint(depth)));
        if (key < keys.at[i]) atomicMin(keys.at[i], key);
    }
}

/// What the nearest instance of a pixel shows there.
void writeSurface(ivec2 pixel) {
    uint instance = keys(pixelIndex(pixel)).instance;
    BakedSurface surface = BakedSurface(NONE, 0.0, 0u, 0.0, uvec2(0u), uvec2(0u));
    if (instance != NONE) {
        World w = world();
        Placement placement = placementOf(w, instance);
        SeenAtlas seen;
        float depth;
        if (seeFrom(w, atlases(), instance, drawn(instance).shape >> 16, pixel, seen, depth)) {
            float mirror = placementDeterminant(placement) < 0.0 ? -1.0 : 1.0;
            vec3 normal = safeNormalize(placeNormal(placement, seen.texel.normal) * mirror, -w.camera.forward);
            surface = BakedSurface(instance, depth, packNormal(normal), seen.texel.alpha, packColor(vec4(seen.texel.color, seen.texel.roughness)),
                                   packColor(vec4(seen.texel.emission, seen.texel.metallic)));
        }
    }
    storeSurfaces(pixelIndex(pixel), surface);
}
