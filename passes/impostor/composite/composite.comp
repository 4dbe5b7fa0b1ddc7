// SPDX-License-Identifier: MIT
#version 460
#include "pass.glsl"
#include "light/environment.glsl"
#include "world/camera.glsl"

vec3 radianceBehind(ivec2 p) {
#if HAS_behind
    return behind(p).rgb;
#else
    World w = world();
    return environmentRadiance(w, cameraRay(w, filmOf(p, vec2(0.5), frameSize()), LENS_CENTRE).direction);
#endif
}

float depthBehind(ivec2 p) {
#if HAS_behindDepth
    return behindDepth(p) > 0.0 ? behindDepth(p) : FAR;
#else
    return FAR;
#endif
}

void main() {
    if (skip()) return;
    ivec2 p = pixel();
    vec4 over = color(p);
    float share = depth(p) > 0.0 && depth(p) <= depthBehind(p) ? over.a : 0.0;
    storeColor(p, vec4(mix(radianceBehind(p), over.rgb, share), 1.0));
}
