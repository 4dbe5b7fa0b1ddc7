// SPDX-License-Identifier: MIT
// Light from infinitely far: an equirectangular map, read between texels and sampled by its alias table.
// u = fract((atan(d.x, -d.z) + rotation) / 2 PI + 0.5), v = acos(d.y) / PI: row 0 is +Y, the middle column looks along -Z.
#include "base/math.glsl"
#include "base/random.glsl"
#include "world/world.h"

/// Map coordinates of a unit direction. The angle from +Y is taken from both sine and cosine: acos alone is blind at the poles.
vec2 environmentUv(World w, vec3 d) {
    float u = (atan(d.x, -d.z) + w.environmentRotation) * (1.0 / TWO_PI) + 0.5;
    return vec2(u - floor(u), atan(length(d.xz), d.y) * INV_PI);
}

vec3 environmentDirection(World w, vec2 uv) {
    float phi = TWO_PI * (uv.x - 0.5) - w.environmentRotation, theta = PI * uv.y, r = sin(theta);
    return vec3(r * sin(phi), cos(theta), -r * cos(phi));
}

/// A point of the map. Texel and place are kept apart: of a map that is thousands of texels wide a float would round points across the borders of
/// texels, where the density of light sampling jumps.
struct EnvironmentPoint {
    uint texel;  // row by row
    vec2 place;  // inside the texel, [0,1)^2
};

EnvironmentPoint environmentPoint(World w, vec2 uv) {
    vec2 at = max(uv, 0.0) * vec2(w.environmentSize);
    uvec2 texel = min(uvec2(at), w.environmentSize - 1u);
    return EnvironmentPoint(texel.y * w.environmentSize.x + texel.x, min(at - vec2(texel), 1.0));
}

uvec2 texelOf(World w, EnvironmentPoint p) {
    uint row = p.texel / w.environmentSize.x;
    return uvec2(p.texel - row * w.environmentSize.x, row);
}

vec2 environmentUv(World w, EnvironmentPoint p) { return (vec2(texelOf(w, p)) + p.place) / vec2(w.environmentSize); }

vec3 environmentDirection(World w, EnvironmentPoint p) { return environmentDirection(w, environmentUv(w, p)); }

/// Bilinear: columns repeat, rows end at the poles.
vec3 environmentTexels(World w, EnvironmentPoint p) {
    ivec2 size = ivec2(w.environmentSize);
    vec2 x = p.place - 0.5, low = floor(x), f = x - low;
    ivec2 a = ivec2(texelOf(w, p)) + ivec2(low), b = a + 1;
    a.x = a.x < 0 ? size.x - 1 : a.x;
    b.x = b.x >= size.x ? 0 : b.x;
    a = clamp(a, ivec2(0), size - 1);
    b = clamp(b, ivec2(0), size - 1);
    vec3 radiance = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 texel = ivec2((i & 1) == 0 ? a.x : b.x, (i & 2) == 0 ? a.y : b.y);
        float weight = ((i & 1) == 0 ? 1.0 - f.x : f.x) * ((i & 2) == 0 ? 1.0 - f.y : f.y);
        radiance += weight * w.environment.at[texel.y * size.x + texel.x].radiance;
    }
    return radiance;
}

/// Radiance from a unit direction.
vec3 environmentRadiance(World w, vec3 d) {
    if (w.environmentLight == NONE) return vec3(0.0);
    return environmentTexels(w, environmentPoint(w, environmentUv(w, d)));
}

/// Solid-angle density at a point of the map once the environment has been chosen. The table's density is constant inside a texel and per unit of uv;
/// d omega = 2 PI^2 sin(theta) du dv.
float environmentDensity(World w, EnvironmentPoint p) {
    return w.environment.at[p.texel].density / (TWO_PI * PI * max(sin(PI * environmentUv(w, p).y), 1e-6));
}

/// Density with which light sampling finds the unit direction d, per steradian; holds the chance that the environment is chosen.
float environmentPdf(World w, vec3 d) {
    if (w.environmentLight == NONE) return 0.0;
    return w.lights.at[w.environmentLight].pmf * environmentDensity(w, environmentPoint(w, environmentUv(w, d)));
}

/// A texel by the alias table: slot from 32 bits, keep in [0,1). Any place in it is as likely as another.
uint sampleEnvironmentTexel(World w, uint slot, float keep) {
    uint i = scaledIndex(slot, w.environmentSize.x * w.environmentSize.y);
    return keep >= w.environment.at[i].aliasProbability ? w.environment.at[i].alias : i;
}
