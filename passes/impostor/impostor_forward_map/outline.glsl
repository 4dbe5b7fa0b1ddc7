// SPDX-License-Identifier: MIT
// Which part of a texel the object covers, where its outline runs through it: the half that neighbours say, cut so that its area is the texel's alpha
// (Youngs 1982, Time-Dependent Multi-Material Flow with Large Fluid Distortion: an interface is a line in each cell, along the gradient of the shares).
// Whole texels would move the outline by up to half a side, each view elsewhere, and what several views draw is the outermost of them.
#include "impostor/texel_plane.glsl"

const float LEAST_GRADIENT = 0.2;  // of alpha, per texel: below it the object is thinner than the texels, and has no side here

/// Covered is what has dot(xy, place) <= z, place in half sides.
const vec3 WHOLE = vec3(0.0, 0.0, 1.0);
const vec3 NONE_OF_IT = vec3(0.0, 0.0, -1.0);

float alphaBeside(Impostors made, uint mesh, TexelPlace x, ivec2 step) {
    ivec2 beside = ivec2(x.texel) + step;
    if (any(lessThan(beside, ivec2(0))) || any(greaterThanEqual(beside, ivec2(levelResolution(made, x.level))))) return 0.0;
    return alphaAt(made, mesh, x.level, x.view, uvec2(beside));
}

/// Of a line with normal n, |n.x| + |n.y| = 1, how far off the middle it cuts the share from the square.
float cutOff(vec2 n, float share) {
    float a = max(abs(n.x), abs(n.y)), b = min(abs(n.x), abs(n.y)), larger = max(share, 1.0 - share);
    float off = larger <= 1.0 - 0.5 * b / a ? 2.0 * a * (larger - 0.5) : 1.0 - sqrt(8.0 * a * b * (1.0 - larger));
    return share < 0.5 ? -off : off;
}

/// `alpha`: of the texel. What has no side here is drawn whole, or where less than `cutoff` is covered not at all.
vec3 coveredPart(Impostors made, uint mesh, TexelPlace x, float alpha, float cutoff) {
    if (alpha > 1.0 - LEAST_ALPHA) return WHOLE;
    vec2 gradient = vec2(0.0);
    for (int i = 0; i < 9; ++i) {  // by Sobel's weights
        ivec2 step = ivec2(i % 3, i / 3) - 1;
        if (step == ivec2(0)) continue;
        gradient += (step.x == 0 || step.y == 0 ? 0.25 : 0.125) * alphaBeside(made, mesh, x, step) * vec2(step);
    }
    float size = abs(gradient.x) + abs(gradient.y);
    if (size < LEAST_GRADIENT) return alpha >= cutoff ? WHOLE : NONE_OF_IT;
    vec2 outwards = -gradient / size;
    return vec3(outwards, cutOff(outwards, alpha));
}
