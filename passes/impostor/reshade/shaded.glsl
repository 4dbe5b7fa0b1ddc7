// SPDX-License-Identifier: MIT
// What a pixel shows, whichever of the inputs says so: a surface, the materials that it is of and their shares.
#include "bsdf/material.glsl"
#include "impostor/reduce.glsl"
#include "light/emission.glsl"
#include "surface/texel_surface.glsl"
#include "world/camera.glsl"

/// A material's BSDF at the pixel, and the chances of its lobes.
struct Lobes {
    Bsdf bsdf;
    LobeChances chance;
};

/// Where a pixel's centre sees a depth. The place inside the pixel that a surface was found at may be another; what that would change is below what its
/// normal is known to.
vec3 seenPosition(World w, ivec2 pixel, float depth, out vec3 view) {
    Ray ray = cameraRay(w, filmOf(pixel, vec2(0.5), frameSize()), LENS_CENTRE);
    view = -ray.direction;
    return ray.origin + depth / dot(ray.direction, w.camera.forward) * ray.direction;
}

#if HAS_surfels
struct Shaded {
    Surface surface;
    float depth, alpha;
    uint materials;   // how many; 0: nothing is shown
    uint counts;      // of the palette; 0: one material, the surface's
    uint mesh;
};

/// Normal of the plane that a surfel lies on, world space, unit, on the side that is seen. No light comes from below it, however far a normal map leans.
vec3 planeOf(Surfel f, uint mesh, Placement placement, vec3 seen) {
    if ((f.measures >> 24 & TEXEL_BUMPED) == 0u) return seen;
    Impostors made = impostors();
    TexelPlace x = texelPlace(made, f.texel);
    ImpostorTexel t = shapeAt(made, mesh, x.level, x.view, x.texel);
    vec3 plane = normalOutOfView(placement, impostorView(made.views, x.view), planeNormal(made, mesh, x, t), seen);
    bool turned = ((f.measures >> 24 ^ t.flags) & TEXEL_BACK) != 0u;
    return turned ? -plane : plane;
}

Shaded shadedAt(World w, ivec2 pixel) {
    Shaded shown;
    shown.alpha = 0.0;
    shown.depth = 0.0;
    shown.materials = 0u;
    Surfel f = surfels(pixelIndex(pixel));
    if (f.instance == NONE) return shown;
    vec3 view, position = seenPosition(w, pixel, f.depth, view);
    shown.depth = f.depth;
    shown.alpha = f.alpha;
    shown.mesh = w.instances.at[f.instance].mesh;
    uint flags = f.measures >> 24, level = levelOfTexel(impostors(), f.texel);
    shown.counts = (flags & SURFEL_COUNTS) != 0u ? f.materials : 0u;
    shown.materials = 1u;
    uint material = f.materials;
    if (shown.counts != 0u) {
        shown.materials = 0u;
        for (uint i = 0u; i < PALETTE; ++i) shown.materials += countOf(shown.counts, i) != 0u ? 1u : 0u;
        material = impostors().objects.at[shown.mesh].palette[commonestPlace(shown.counts)];
    }
    Placement placement = placementOf(w, f.instance);
    float side = texelSide(impostors(), impostors().objects.at[shown.mesh].radius, level) * placementScale(placement);
    vec3 normal = unpackNormal(f.normal), plane = planeOf(f, shown.mesh, placement, normal);
    float density = unpackDensity((f.measures >> 16) & 0xffu);
    shown.surface = texelSurface(f.instance, TEXEL | f.texel, material, position, plane, normal, view, unpackUv(f.uv), density, side,
                                 texelRounding(w, f.instance, placement, side), (flags & TEXEL_BACK) == 0u);
    if (params.spread) shown.surface.normalLength = float(f.measures & 0xffffu) / 65535.0;
    return shown;
}

/// Place in the palette of the i-th material that there is some of.
uint placeOf(Shaded shown, uint i) {
    for (uint place = 0u; place < PALETTE; ++place)
        if (countOf(shown.counts, place) != 0u && i-- == 0u) return place;
    return 0u;
}

Surface surfaceOf(Shaded shown, uint i) {
    Surface s = shown.surface;
    if (shown.counts != 0u && shown.materials > 1u) s.material = impostors().objects.at[shown.mesh].palette[placeOf(shown, i)];
    return s;
}

float shareOf(Shaded shown, uint i) { return shown.materials > 1u ? float(countOf(shown.counts, placeOf(shown, i))) / 15.0 : 1.0; }

Lobes lobesOf(World w, Shaded shown, uint i) {
    Lobes lobes;
    lobes.bsdf = bsdfAt(w, surfaceOf(shown, i));
    lobes.chance = lobeProbabilities(lobes.bsdf, shown.surface.view);
    return lobes;
}

vec3 emissionOf(World w, Shaded shown, uint i) { return emittedRadiance(w, surfaceOf(shown, i)); }
#else
struct Shaded {
    Surface surface;
    float depth, alpha;
    uint materials;
#if HAS_baked
    BakedSurface baked;
#endif
};

float shareOf(Shaded shown, uint i) { return 1.0; }
#endif

#if HAS_baked
Shaded shadedAt(World w, ivec2 pixel) {
    Shaded shown;
    shown.baked = baked(pixelIndex(pixel));
    bool isShown = shown.baked.instance != NONE;
    shown.materials = isShown ? 1u : 0u;
    shown.alpha = isShown ? shown.baked.alpha : 0.0;
    shown.depth = isShown ? shown.baked.depth : 0.0;
    if (!isShown) return shown;
    vec3 view, position = seenPosition(w, pixel, shown.depth, view);
    float side = shown.depth * w.camera.pixelAngle;
    vec3 normal = unpackNormal(shown.baked.normal);
    shown.surface = texelSurface(shown.baked.instance, NONE, NONE, position, normal, normal, view, vec2(0.0), DENSITY_NONE, side, 2.0 * side, true);
    return shown;
}

Lobes lobesOf(World w, Shaded shown, uint i) {
    vec4 color = unpackColor(shown.baked.color), more = unpackColor(shown.baked.more);
    Lobes lobes;
    lobes.bsdf = plainBsdf(shown.surface.shadingNormal, shown.surface.normal, color.rgb, more.a, 0.0, square(color.a), 1.5, 1.0, false);
    lobes.chance = lobeProbabilities(lobes.bsdf, shown.surface.view);
    return lobes;
}

vec3 emissionOf(World w, Shaded shown, uint i) { return unpackColor(shown.baked.more).rgb; }
#endif

#if HAS_hits
Shaded shadedAt(World w, ivec2 pixel) {
    Shaded shown;
    PrimaryHit hit = hits(pixelIndex(pixel));
    bool isShown = hit.primitive != NONE;
    shown.materials = isShown ? 1u : 0u;
    shown.alpha = isShown ? 1.0 : 0.0;
    shown.depth = 0.0;
    if (!isShown) return shown;
    shown.surface = surfaceAt(w, hitOf(hit), cameraRay(w, filmOf(pixel, hit.film, frameSize()), hit.lens).direction);
    shown.depth = dot(shown.surface.position - w.camera.position, w.camera.forward);
    return shown;
}

Lobes lobesOf(World w, Shaded shown, uint i) {
    Lobes lobes;
    lobes.bsdf = bsdfAt(w, shown.surface);
    lobes.chance = lobeProbabilities(lobes.bsdf, shown.surface.view);
    return lobes;
}

vec3 emissionOf(World w, Shaded shown, uint i) { return emittedRadiance(w, shown.surface); }
#endif

/// Which material's turn it is at `place` in [0,1) of all of them.
uint materialAt(Shaded shown, float place) {
    uint i = 0u;
    for (float before = shareOf(shown, 0u); before <= place && i + 1u < shown.materials;) before += shareOf(shown, ++i);
    return i;
}
