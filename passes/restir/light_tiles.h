// SPDX-License-Identifier: MIT
// Lights drawn before any path needs them: a tile of 1024 for all pixels of a block of the image (Lin et al. 2026, ReSTIR PT Enhanced, section 6.1).
#ifndef LODESTIR_LIGHT_TILES_H
#define LODESTIR_LIGHT_TILES_H
#include "base/shared.h"

LODESTIR_SHARED_BEGIN

const uint LIGHT_TILES = 128u;
const uint TILE_LIGHTS = 1024u;

struct TileLight {
    uint light;  // index in World.lights, NONE: the scene has no light
    uint texel;  // LightPoint.texel
    vec2 uv;     // LightPoint.uv
};

LODESTIR_SHARED_END
LODESTIR_SHARED(TileLight, "restir/light_tiles.h")
#endif
