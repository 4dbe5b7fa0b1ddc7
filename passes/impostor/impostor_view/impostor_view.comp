// SPDX-License-Identifier: MIT
#version 460
#include "pass.glsl"
#include "base/random.glsl"
#include "impostor/reduce.glsl"

// The mesh that was named, or the first that was baked; NONE: none was.
uint shownMesh(Impostors all) {
    for (uint m = 0u; m < all.meshes; ++m)
        if (all.objects.at[m].radius > 0.0 && (argument(0) == NONE || argument(0) == m)) return m;
    return NONE;
}

// View (NONE: none) and texel that a pixel shows. Rows of texels go up, those of pixels down.
uint shownView(Impostors all, uint level, ivec2 p, out uvec2 texel) {
    bool one = params.view >= 0;
    uint views = one ? 1u : all.views, columns = one ? 1u : all.views == 18u ? 6u : all.views == 12u ? 4u : 3u, rows = views / columns;
    uint side = min(frameSize().x / columns, frameSize().y / rows), n = levelResolution(all, level);
    texel = uvec2(0u);
    if (side == 0u) return NONE;
    uvec2 tile = uvec2(p) / side, place = uvec2(p) % side;
    if (tile.x >= columns || tile.y >= rows) return NONE;
    texel = uvec2((vec2(place.x, side - 1u - place.y) + 0.5) * float(n) / float(side));
    uint shown = one ? uint(params.view) : tile.y * columns + tile.x;
    return shown < all.views ? shown : NONE;
}

vec3 colorOfMaterial(uint material) {
    return 0.2 + 0.8 * vec3(random2(uvec2(material, 7u), 0u, RANDOM_FREE), random2(uvec2(material, 7u), 1u, RANDOM_FREE).x);
}

vec3 colorOf(ImpostorRecord object, ImpostorTexel t, vec3 normal) {
    if (params.show == show_depth) return vec3(1.0 - t.depth);
    if (params.show == show_alpha) return vec3(t.alpha);
    if (params.show == show_uv) return vec3(t.uv, 0.0);
    if (params.show == show_length) return vec3(length(normal));
    if (params.show == show_normal) return 0.5 + 0.5 * safeNormalize(normal, vec3(0.0));
    if (t.material != NONE) return colorOfMaterial(t.material);
    vec3 sum = vec3(0.0);
    for (uint p = 0u; p < PALETTE; ++p) {
        uint count = countOf(t.counts, p);
        if (count > 0u) sum += float(count) / 15.0 * colorOfMaterial(object.palette[p]);
    }
    return sum;
}

void main() {
    if (skip()) return;
    Impostors all = impostors();
    ShownTexel shown = ShownTexel(vec3(0.0), 1.0, vec3(0.0), 0.0, vec2(0.0), DENSITY_NONE, 0u, NONE, 0u, NONE, 0u);
    vec3 color = vec3(0.0);
    uint mesh = shownMesh(all), level = min(uint(params.level), all.levels - 1u);
    uvec2 texel;
    uint view = shownView(all, level, pixel(), texel);
    if (mesh != NONE && view != NONE) {
        ImpostorRecord object = all.objects.at[mesh];
        ImpostorView v = impostorView(all.views, view);
        ImpostorTexel t = texelAt(all, mesh, level, view, texel);
        vec2 window = (vec2(texel) + 0.5) / float(levelResolution(all, level));
        vec3 normal = outOfView(v, t.normal);
        vec3 position = windowPoint(all, object.center, object.radius, v, window, t.depth);
        shown = ShownTexel(position, t.depth, normal, t.alpha, t.uv, t.density, t.flags, t.material, t.counts, view, 0u);
        if (isSeen(t)) color = colorOf(object, t, normal);
    }
    storeColor(pixel(), vec4(color, 1.0));
    storeTexels(pixelIndex(pixel()), shown);
}
