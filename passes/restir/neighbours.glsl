// SPDX-License-Identifier: MIT
// Which pixels a pixel reuses paths of.
#include "base/sampling.glsl"
#include "restir/similarity.glsl"

/// A pixel in the disk of `radius` pixels around another; u uniform in [0, 1)^2. It may lie off the image.
ivec2 pixelInDisk(ivec2 pixel, float radius, vec2 u) { return pixel + ivec2(round(radius * uniformDisk(u))); }

/// Where last frame's image showed what the pixel shows now. It may lie off the image.
ivec2 pixelBefore(ivec2 pixel, vec2 motion) { return ivec2(floor(vec2(pixel) + 0.5 + motion)); }
