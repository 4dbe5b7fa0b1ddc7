// SPDX-License-Identifier: MIT
// What view/picture.comp is told: texels and how they lie in memory, how to colour them, where they go in the window.
#ifndef LODESTIR_PICTURE_BLOCK_H
#define LODESTIR_PICTURE_BLOCK_H
#include "../base/shared.h"

LODESTIR_SHARED_BEGIN

// How numbers lie in a texel.
const uint NUMBER_FLOAT32 = 0u;
const uint NUMBER_FLOAT16 = 1u;
const uint NUMBER_UNORM8 = 2u;
const uint NUMBER_UINT32 = 3u;
const uint NUMBER_INT32 = 4u;
const uint NUMBER_UINT16 = 5u;
const uint NUMBER_UINT8 = 6u;

// How they become colour.
const uint LOOK_COLOR = 0u;   // scene-linear or display-linear colour: exposure, tone curve, sRGB
const uint LOOK_SIGNED = 1u;  // -high .. high becomes black .. white, in each channel: normals, motion
const uint LOOK_GREY = 2u;    // one number, low .. high
const uint LOOK_HEAT = 3u;    // one number, low .. high, in false colour
const uint LOOK_IDS = 4u;     // each whole number has a colour of its own

// The one number of LOOK_GREY and LOOK_HEAT: component 0 to 3, or
const uint PICK_LUMINANCE = 4u;
const uint PICK_LENGTH = 5u;  // of the vector of all components

struct PictureBlock {
    uint64_t texels;
    uint64_t target;     // one word a pixel of the viewport, row by row
    uint64_t colors;     // 256 words: false colours, red in the lowest byte
    uint64_t probe;      // uvec4: bits of the texel at probePixel
    uvec2 size;          // of the image, pixels
    uvec2 viewport;      // pixels
    vec3 row0;           // from the centre of a viewport pixel (x, y, 1) to image coordinates, homogeneous: rows of the matrix
    vec3 row1;
    vec3 row2;
    ivec2 probePixel;
    uint stride;         // bytes from texel to texel
    uint offset;         // bytes to the first number of a texel
    uint number;         // NUMBER_
    uint channels;       // 1 to 4
    uint look;           // LOOK_
    uint pick;           // PICK_ or a component
    uint curve;          // of LOOK_COLOR: 0 none, 1 neutral, 2 ACES, 3 Reinhard
    uint swapped;        // 1: words hold blue in the lowest byte
    uint background;     // word of what lies outside
    float scale;         // of LOOK_COLOR, before the curve
    float low;
    float high;
};

LODESTIR_SHARED_END
LODESTIR_SHARED(PictureBlock, "view/picture_block.h")
#endif
