// SPDX-License-Identifier: MIT
#version 460
#include "pass.glsl"
#include "restir/light_tiles.glsl"

void main() {
    if (skip()) return;
    uint entry = uint(pixel().x);
    LightPoint p = lightPoint(world(), tileNumber(entry, frameIndex(), runSeed()));
    storeTiles(entry, TileLight(p.light, p.texel, p.uv));
}
