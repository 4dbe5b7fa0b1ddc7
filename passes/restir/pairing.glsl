// SPDX-License-Identifier: MIT
// Partners: pixels that reuse each other's paths (Lin et al. 2026, ReSTIR PT Enhanced, section 3). In each slot a pixel is its partner's partner.
#include "base/random.glsl"
#include "restir/pairing.h"

/// Where the tables lie over the image: shifted, mirrored and turned at random, the same for all pixels of a round.
struct PairingDraw {
    uvec2 offset;
    bool flipX, flipY, transpose;
};

/// `bits`: random.
PairingDraw drawPairing(uvec3 bits) {
    return PairingDraw(bits.xy >> 8, (bits.z & 0x80000000u) != 0u, (bits.z & 0x40000000u) != 0u, (bits.z & 0x20000000u) != 0u);
}

/// The place in a table of side `size` that a pixel looks at.
uvec2 pairingPlace(PairingDraw d, uint size, ivec2 pixel) {
    uvec2 p = (uvec2(pixel) + d.offset) % size;
    if (d.flipX) p.x = size - 1u - p.x;
    if (d.flipY) p.y = size - 1u - p.y;
    return d.transpose ? p.yx : p;
}

/// A step of the table as one of the image: pairingPlace undone, the last first. In another order partners lose each other.
ivec2 pairingStep(PairingDraw d, ivec2 step) {
    if (d.transpose) step = step.yx;
    if (d.flipX) step.x = -step.x;
    if (d.flipY) step.y = -step.y;
    return step;
}

/// The step that entry `i` of the tables holds.
ivec2 storedStep(PairingTables t, uint i) {
    uint entry = t.steps.at[i >> 1] >> (16u * (i & 1u));
    return ivec2(entry & 255u, entry >> 8 & 255u) - 128;
}

/// The pixel's partner. It may lie off the image: then the pixel has none, because one that were moved onto the image would have another partner.
ivec2 partnerOf(PairingTables t, PairingDraw d, uint slot, ivec2 pixel) {
    uint size = t.sizes[slot];
    uvec2 p = pairingPlace(d, size, pixel);
    return pixel + pairingStep(d, storedStep(t, t.starts[slot] + p.y * size + p.x));
}
