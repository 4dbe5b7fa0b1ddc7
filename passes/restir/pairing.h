// SPDX-License-Identifier: MIT
// Who reuses whose path where neighbours choose each other: tables of steps from each pixel to its partner (Lin et al. 2026, ReSTIR PT
// Enhanced, section 3). restir/pairing.glsl looks partners up.
#ifndef LODESTIR_PAIRING_H
#define LODESTIR_PAIRING_H
#include "base/shared.h"
#include "world/world.h"

LODESTIR_SHARED_BEGIN

const uint PAIRING_SLOTS = 4u;  // partners of a pixel at most

/// A table of each slot repeats over the image. All have other sizes, so that a pixel's partners are not those of any other pixel's.
struct PairingTables {
    LODESTIR_ARRAY_OF(UintArray) steps;  // two entries a word: 8 bits of x + 128, 8 bits of y + 128; rows of one table after the other
    uvec4 sizes;                         // side of each slot's table, pixels, even
    uvec4 starts;                        // its first entry
    uint slots;                          // partners of a pixel
    uint pad;
};

LODESTIR_SHARED_END
LODESTIR_SHARED(PairingTables, "restir/pairing.h")
#endif
