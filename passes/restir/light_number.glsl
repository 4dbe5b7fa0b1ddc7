// SPDX-License-Identifier: MIT
// Lights by number. A path keeps the number of the light that light sampling found, whether its vertex drew the number or found it in a light tile:
// wherever the path's end is walked again, the light is drawn again by it, with the chance that it has in the World where that happens.
#include "base/random.glsl"
#include "light/light.glsl"

struct NumberedLight {
    LightPoint point;
    uint number;
};

const uint LIGHT_STRATA = 1024u;  // numbers in a row are of neighbouring slots of the alias table: as many as a tile has lights share it out evenly

/// The light point of a number. Its lowest bits are the highest of the table's slot.
LightPoint lightPoint(World w, uint number) {
    uvec2 seed = uvec2(number, 0u);
    uvec3 choice = randomBits3(seed, 0u, RANDOM_LIGHT_CHOICE);
    choice.x = number << 22 | choice.x >> 10;
    return chooseLight(w, choice, random3(seed, 0u, RANDOM_LIGHT_POINT));
}

/// A light by a number that the vertex draws.
NumberedLight ownLight(World w, uvec2 seed, uint vertex, uint candidate) {
    uint number = randomBits3(seed, vertex, RANDOM_LIGHT_CHOICE | candidate << 8u).x;
    return NumberedLight(lightPoint(w, number), number);
}
