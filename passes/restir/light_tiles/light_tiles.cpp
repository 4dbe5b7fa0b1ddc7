// SPDX-License-Identifier: MIT
// Lights that vertices choose from, drawn once a frame.
#include <framework/pass/pass.h>
#include <passes/restir/light_tiles.h>

using namespace lodestir;

struct LightTiles final : Pass {
    In<World>              world{this, "world", "the scene"};
    Out<Buffer<TileLight>> tiles{this, "tiles", "128 tiles of 1024 lights, each light with its chance; places of a tile are strata",
                                 Count::fixed(LIGHT_TILES * TILE_LIGHTS)};
};
LODESTIR_PASS(LightTiles, "light_tiles.comp", "Draws the lights of a frame that the vertices of all paths choose from (Lin et al. 2026, section 6.1).")
