// SPDX-License-Identifier: MIT
// Dual motion vectors (Lin et al. 2026, ReSTIR PT Enhanced, section 6.4): what has come into sight behind something that moves lies beside it as it did
// last frame, so it is looked for where the one that hid it was, seen from here. Only camera hits through pixel centres are asked, never samples: which
// pixel of last frame counts must not depend on what it holds.
#version 460
#include "pass.glsl"
#include "restir/neighbours.glsl"
#include "world/camera.glsl"

/// Depth that last frame's camera saw a point at that either frame hit; false: it hit nothing.
bool depthBefore(PrimaryHit h, out float depth) {
    depth = 0;
    if (h.primitive == NONE) return false;
    World before = worldPrev();
    depth = dot(positionAt(before, pointOf(h)) - before.camera.position, before.camera.forward);
    return true;
}

/// Was something before the surface of pixel p, at q in last frame's image?
bool wasHidden(ivec2 p, ivec2 q) {
    float seen, own;
    if (!depthBefore(hitsPrev(pixelIndex(q)), seen)) return false;
    if (!depthBefore(hits(pixelIndex(p)), own)) return true;
    return own - seen > params.depth * own;
}

bool serves(ivec2 p, vec2 m) {
    ivec2 q = pixelBefore(p, m);
    return inside(q) && !wasHidden(p, q);
}

vec2 dualMotion(ivec2 p, vec2 m) {
    ivec2 q = pixelBefore(p, m);
    if (!inside(q)) return -m;
    if (!wasHidden(p, q)) return m;
    vec3 now = cameraProject(world(), positionAt(world(), pointOf(hitsPrev(pixelIndex(q)))), LENS_CENTRE);
    return vec2(q) + 0.5 - now.xy * vec2(frameSize());
}

void main() {
    if (skip()) return;
    ivec2 p = pixel();
    vec2 m = motion(p);
    if (historyValid()) {
        vec2 dual = dualMotion(p, m);
        if (serves(p, dual)) m = dual;
    }
    storeMotion(p, m);
}
