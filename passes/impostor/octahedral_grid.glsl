// SPDX-License-Identifier: MIT
// Directions on the grid of an octahedral impostor, and which of them are mixed for one that lies between (Brucks 2018, Octahedral Impostors). Y is up: it
// is in the middle of the grid.
#include "impostor/texel.glsl"

const float HORIZON = 1e-5;  // least height of a direction on the map of the hemisphere: what lies lower is seen as from there

/// A unit direction on [-1, 1]^2 and back: the sphere, whose lower pole is in all four corners, or the upper hemisphere.
vec2 gridPlace(bool isHemi, vec3 direction) {
    if (!isHemi) return octahedral(direction.xzy);
    return hemiOctahedral(vec3(direction.xz, max(direction.y, HORIZON)));
}
vec3 gridDirection(bool isHemi, vec2 place) { return isHemi ? fromHemiOctahedral(place).xzy : fromOctahedral(place).xzy; }

/// Three views and how much each counts, which makes 1.
struct GridViews {
    uvec3 views;
    vec3 weights;
};

/// The corners of the triangle that `place` lies in: cells of the grid are cut along one diagonal.
GridViews viewsAround(uint across, vec2 place) {
    vec2 at = (clamp(place, -1.0, 1.0) * 0.5 + 0.5) * float(across - 1u);
    uvec2 cell = min(uvec2(at), uvec2(across - 2u));
    vec2 f = at - vec2(cell);
    uint first = cell.y * across + cell.x, beside = f.x > f.y ? first + 1u : first + across;
    return GridViews(uvec3(first, beside, first + across + 1u), vec3(min(1.0 - f.x, 1.0 - f.y), abs(f.x - f.y), min(f.x, f.y)));
}

/// View (x, y) of the grid is number y across + x; those at its border look from the map's border.
vec2 placeOfView(uint across, uint view) { return 2.0 * vec2(view % across, view / across) / float(across - 1u) - 1.0; }
