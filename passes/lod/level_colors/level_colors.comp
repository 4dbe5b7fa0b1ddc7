// SPDX-License-Identifier: MIT
#version 460
#include "pass.glsl"
#include "lod/level_color.glsl"
#include "surface/surface.glsl"
#include "world/camera.glsl"

vec3 colorOf(World w, ivec2 p) {
    PrimaryHit first = hits(pixelIndex(p));
    if (first.primitive == NONE) return vec3(0);
    uint mesh = w.instances.at[first.instance].mesh;
    vec3 color = levelColor(levelOf(w, mesh, first.primitive), w.meshes.at[mesh].levels);
    if (params.shading) {
        Surface s = surfaceAt(w, hitOf(first), cameraRay(w, filmOf(p, first.film, colorSize()), first.lens).direction);
        color *= mix(0.25, 1.0, dot(s.shadingNormal, s.view));
    }
#if HAS_light
    color *= lightRgba(p).rgb;
#endif
    return color;
}

void main() {
    if (skip()) return;
    storeColor(pixel(), vec4(colorOf(world(), pixel()), 1));
}
