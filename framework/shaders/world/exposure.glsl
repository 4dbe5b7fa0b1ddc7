// SPDX-License-Identifier: MIT
// Motion blur: each path sees the scene at one time of the exposure, which is drawn by the number that its rays choose levels by. Where the camera sample is
// the path's, so is the time: it travels along (SampleHit.time) to other pixels and frames, where the exposure is another but the share of it that has
// passed is the same (Liu et al. 2025, Reservoir Splatting), unless the path is splatted to several parts of it.
// Instances and the camera go straight from where the shutter opens to where it closes.
//
// A World is that of the opening until a time is chosen: what reads surfaces of a path calls atTime first.
#include "world/ray_levels.glsl"

/// The share of the exposure that has passed when rays of a number first see the scene, [0, 1). No other choice by the number hangs on it.
float timeOf(uint number) { return float(randomBits3(uvec2(number & RAY_NUMBER, 1u), 0u, RANDOM_LEVEL).x >> 8) * (1.0 / 16777216.0); }

/// Unit axes stay unit, and square to each other.
CameraRecord cameraBetween(CameraRecord a, CameraRecord b, float time) {
    CameraRecord c = a;
    c.position = mix(a.position, b.position, time);
    c.aperture = mix(a.aperture, b.aperture, time);
    c.focus = mix(a.focus, b.focus, time);
    c.pixelAngle = mix(a.pixelAngle, b.pixelAngle, time);
    c.forward = normalize(mix(a.forward, b.forward, time));
    vec3 right = mix(a.right, b.right, time);
    right = normalize(right - dot(right, c.forward) * c.forward);
    c.right = mix(length(a.right), length(b.right), time) * right;
    c.up = mix(length(a.up), length(b.up), time) * cross(right, c.forward);
    return c;
}

/// A frame's World when so large a share of the exposure has passed.
World atTime(World w, float time) {
#if MOTION_BLUR
    w.time = time;
    w.camera = cameraBetween(w.camera, w.closingCamera, time);
#endif
    return w;
}

/// A frame's World as rays of a number first see it.
World atTime(World w, uint number) { return atTime(w, timeOf(number)); }
