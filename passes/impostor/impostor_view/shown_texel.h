// SPDX-License-Identifier: MIT
// A texel of an impostor, unpacked and taken out of its view.
#ifndef LODESTIR_SHOWN_TEXEL_H
#define LODESTIR_SHOWN_TEXEL_H
#include "base/shared.h"

LODESTIR_SHARED_BEGIN

struct ShownTexel {
    vec3 position;  // object space
    float depth;
    vec3 normal;    // object space; as long as the texel's
    float alpha;    // 0: nothing is seen, or the pixel shows no texel
    vec2 uv;
    float density;
    uint flags;
    uint material;
    uint counts;
    uint view;      // NONE: the pixel shows no texel
    uint pad;
};

LODESTIR_SHARED_END
LODESTIR_SHARED(ShownTexel, "shown_texel.h")
#endif
