// SPDX-License-Identifier: MIT
// What the shaders of the viewer's picture are told: how a port's numbers lie in memory and become colour, and where these go in the window.
#ifndef LODESTIR_PICTURE_H
#define LODESTIR_PICTURE_H
#include "base/shared.h"

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

// Push constants of view/color_texels.comp.
struct ColorTexels {
    uint64_t texels;
    uint64_t minus;      // texels of another picture, whose distance from them is shown; 0: none
    uint64_t colors;     // made: a word a texel, encoded for the screen
    uint64_t ramp;       // 256 words: false colours, red in the lowest byte
    uint64_t probe;      // uvec4: bits of the texel at probePixel
    uvec2 size;          // pixels
    ivec2 probePixel;
    uint stride;         // bytes from texel to texel
    uint offset;         // bytes to the first number of a texel
    uint number;         // NUMBER_
    uint channels;       // 1 to 4
    uint look;           // LOOK_
    uint pick;           // PICK_ or a component
    uint curve;          // of LOOK_COLOR: 0 none, 1 neutral, 2 ACES, 3 Reinhard
    uint swapped;        // 1: made words hold blue in the lowest byte
    float scale;         // of LOOK_COLOR, before the curve
    float low;
    float high;
    uint probeOnly;      // 1: nothing but the probe is wanted
};

// Push constants of view/place_picture.comp.
struct PlacePicture {
    uint64_t colors;     // as view/color_texels.comp made them
    uint64_t target;     // made: a word a pixel of the viewport, row by row
    uvec2 size;          // of the image, pixels
    uvec2 viewport;      // pixels
    vec3 row0;           // from the centre of a viewport pixel (x, y, 1) to image coordinates, homogeneous: rows of the matrix
    vec3 row1;
    vec3 row2;
    uint samples;        // squared: places averaged in a pixel of the viewport; 0: one, between the pixels of the image
    uint background;     // word of what lies outside
    uint pad;
};

LODESTIR_SHARED_END
LODESTIR_SHARED(ColorTexels, "view/picture.h")
LODESTIR_SHARED(PlacePicture, "view/picture.h")
#endif
