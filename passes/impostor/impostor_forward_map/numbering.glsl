// SPDX-License-Identifier: MIT
// The texels of a frame by number: tile after tile, 64 numbers each. After pass.glsl.
#include "impostor/instance_items.glsl"
#include "impostor/views.glsl"

const uint TILE_NUMBERS = 64u;

/// A texel of the frame; of a tile its first.
struct DrawnTexel {
    uint instance;
    TexelPlace place;
    bool fades;  // it is of the level that others take over from
};

/// In all views that are kept.
uint tilesOf(Impostors made, DrawnLevel d) { return d.level == NOT_DRAWN ? 0u : bitCount(d.views) * tilesInView(made, d.level); }

/// The i-th view that is kept.
uint keptView(uint views, uint i) {
    for (; i > 0u; --i) views &= views - 1u;
    return uint(findLSB(views));
}

/// A tile of the frame by number.
DrawnTexel tileOfNumber(Impostors made, uint tile) {
    DrawnTexel found;
    found.instance = instanceOfItem(tile);
    Drawn d = drawn(found.instance);
    uint i = tile - items(found.instance), now = tilesOf(made, d.now);
    found.fades = i >= now;
    DrawnLevel part = d.now;
    if (found.fades) {
        part = d.before;
        i -= now;
    }
    uint across = tilesAcross(made, part.level), perView = tilesInView(made, part.level), inView = i % perView;
    found.place = TexelPlace(part.level, keptView(part.views, i / perView), TILE * uvec2(inView % across, inView / across));
    return found;
}

/// False where the tile has fewer than 64 texels and `number` is of none.
bool texelOfNumber(Impostors made, uint number, out DrawnTexel found) {
    uint inner = number % TILE_NUMBERS;
    found = tileOfNumber(made, number / TILE_NUMBERS);
    found.place.texel += uvec2(inner % TILE, inner / TILE);
    return all(lessThan(found.place.texel, uvec2(levelResolution(made, found.place.level))));
}
