// SPDX-License-Identifier: MIT
// Lights by number. A path keeps the number of the light that light sampling found, whether its vertex drew the number or found it in a light tile:
// wherever the path's end is walked again, the light is drawn again by it, with the chance that it has in the World where that happens.
#include "base/random.glsl"
#include "light/light.glsl"
#include "restir/light_tiles.h"

/// Random bits that choose a light (chooseLight). Numbers that differ by 1 choose from neighbouring strata of the lights' distribution, of which
/// there are as many as a tile has lights: a tile shares them all out evenly.
uvec3 lightChoice(uint number) {
    const uint stratum = 0x80000000u / (TILE_LIGHTS / 2u);  // 2^32 / TILE_LIGHTS
    uvec3 choice = randomBits3(uvec2(number, 0u), 0u, RANDOM_LIGHT_CHOICE);
    choice.x = number % TILE_LIGHTS * stratum + choice.x / TILE_LIGHTS;
    return choice;
}

/// The light point of a number.
LightPoint lightPoint(World w, uint number) { return chooseLight(w, lightChoice(number), random3(uvec2(number, 0u), 0u, RANDOM_LIGHT_POINT)); }

/// The number that a vertex draws for one of its candidates.
uint lightNumber(uvec2 seed, uint vertex, uint candidate) { return randomBits3(seed, vertex, RANDOM_LIGHT_CHOICE | candidate << 8u).x; }
