// SPDX-License-Identifier: MIT
// Rates in a pass that trace/driver.glsl drives, with an input `rates` that may be unwired. Before the driver, after pass.glsl: pixels are walked in the order
// of the rates where the pass dispatches them as one row.

/// Whatever the extent of the dispatch.
bool inFrame(ivec2 p) { return all(lessThan(uvec2(p), frameSize())); }

#if HAS_rates
bool isSkipped(ivec2 p) { return ratesPixels(pixelIndex(p)).source != pixelIndex(p); }

/// The pixel of p's block that is traced.
ivec2 standIn(ivec2 p) {
    uint i = ratesPixels(pixelIndex(p)).source;
    return ivec2(i % frameSize().x, i / frameSize().x);
}

ivec2 pixelInOrder(ivec2 place) {
    if (push.extent == frameSize() && frameSize().y > 1) return place;
    uint i = ratesOrder(place.x);
    return ivec2(i % frameSize().x, i / frameSize().x);
}
#define DRIVER_PIXEL pixelInOrder
#else
bool isSkipped(ivec2 p) { return false; }
ivec2 standIn(ivec2 p) { return p; }
#endif
