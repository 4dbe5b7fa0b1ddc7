// SPDX-License-Identifier: MIT
// The normal that is baked.
#include "surface/surface.glsl"

/// Shading normal with its normal map, on the side that was seen. Not bent towards the view, as Surface.shadingNormal is: it will be seen from elsewhere.
vec3 seenNormal(World w, Surface s) {
    vec3 n = s.frame[2];
    if (w.materials.at[s.material].normalMap.texture != NONE) n = mapNormal(w, s, cornersOf(w, s.primitive), s.frame);
    return s.frontFace ? n : -n;
}
