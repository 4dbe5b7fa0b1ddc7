// SPDX-License-Identifier: MIT
// Where the views of an atlas stand, and how their texels lie in space and in memory.
#include "impostor/atlases.h"
#include "impostor/octahedral_grid.glsl"

bool isGrid(Atlases atlases) { return atlases.arrangement <= ATLAS_HEMI; }
uint atlasViews(Atlases atlases) { return isGrid(atlases) ? atlases.across * atlases.across : atlases.across; }

/// Both sides of a card: views 2 i and 2 i + 1 look at each other.
vec3 cardDirection(uint arrangement, uint view) {
    float side = (view & 1u) != 0u ? -1.0 : 1.0;
    if (arrangement == ATLAS_CROSS) return viewDirection(6u, view);
    if (view >= 6u) return vec3(0.0, side, 0.0);
    float turn = PI / 3.0 * float(view >> 1);
    return side * vec3(sin(turn), 0.0, cos(turn));
}

ImpostorView atlasView(Atlases atlases, uint view) {
    return viewFrom(isGrid(atlases) ? gridDirection(atlases.arrangement == ATLAS_HEMI, placeOfView(atlases.across, view)) :
                                      cardDirection(atlases.arrangement, view));
}

/// Half the window's side, in radii: one of the finest texels more than the sphere on each side, so that the border is empty.
float atlasMargin(Atlases atlases) { return float(atlases.resolution) / float(atlases.resolution - 2u); }

/// Side of a texel, in radii.
float atlasTexelSide(Atlases atlases, uint level) { return 2.0 * atlasMargin(atlases) / float(atlases.resolution >> level); }

/// Window in [0,1]^2 of a point of the view's plane, in radii from the centre, along the view's x and y.
vec2 windowOfPlane(Atlases atlases, vec2 point) { return 0.5 + 0.5 * point / atlasMargin(atlases); }
vec2 planeOfWindow(Atlases atlases, vec2 window) { return (2.0 * window - 1.0) * atlasMargin(atlases); }

/// Place of a texel in the arrays of an AtlasRecord: level after level, in each view after view, in each row after row from the bottom.
/// Before a level lie N^2 + (N/2)^2 + ... texels of each view.
uint atlasIndex(Atlases atlases, uint level, uint view, uvec2 texel) {
    uint n = atlases.resolution >> level, before = (atlases.resolution * atlases.resolution - n * n) / 3u * 4u;
    return before * atlasViews(atlases) + (view * n + texel.y) * n + texel.x;
}
