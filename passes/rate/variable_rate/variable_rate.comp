// SPDX-License-Identifier: MIT
// Turns the shares of tiles into blocks, takes a pixel of each, and puts the traced pixels of each 16x16 before the others.
#version 460
#include "pass.glsl"
#include "base/random.glsl"
#include "rate/rate_memory.glsl"
#include "share.glsl"
#include "tile.glsl"

shared uint wanted[64];           // step of SHARES of each quad
shared uint present[8], kept[8];  // bits of the 16x16 pixels by their place in it: which lie in the image, which are traced

uint stepOf(uvec2 corner) {
    TileNeed t = tiles(tileIndex(corner));
    if (params.manner >= manner_quality) return sufficientStep(min(t.need / params.detail, 1), coarsestStep());
    uvec2 tile = corner / tileSide();
    float u = random1(resamplingSeed(tile, frameIndex(), runSeed(), passSalt()), 0, RANDOM_FREE);
    float share = params.manner == manner_budget ? budgetShare(t.need, balance(0)) : params.budget;
    return roundedStep(share, coarsestStep(), u);
}

#if HAS_depths && HAS_normals
// How different two pixels are, by depth and normal.
float difference(uvec2 a, uvec2 b) {
    if (!inImage(a) || !inImage(b)) return 0;
    float da = depths(ivec2(a)), db = depths(ivec2(b)), most = max(da, db);
    return (most > 0 ? abs(da - db) / most : 0) + 1 - dot(normalsRgba(ivec2(a)).xyz, normalsRgba(ivec2(b)).xyz);
}
#else
float difference(uvec2 a, uvec2 b) { return 0; }
#endif

// The axis along which the pixels of a quad are more alike shares paths.
uint halfRate(uvec2 corner) {
    uvec2 x = uvec2(1, 0), y = uvec2(0, 1);
    float alongX = max(difference(corner, corner + x), difference(corner + y, corner + 1));
    float alongY = max(difference(corner, corner + y), difference(corner + x, corner + 1));
    return alongX <= alongY ? RATE_HALF_X : RATE_HALF_Y;
}

// The pixel of a block that is traced this frame.
uvec2 chosen(uvec2 corner, uvec2 block) {
    if (params.choice == choice_fixed) return corner;
    uint frame = params.choice == choice_cycle ? 0 : frameIndex() + 1;
    uint bits = randomBits3(resamplingSeed(corner, frame, runSeed(), passSalt()), 0, RANDOM_FREE + 1).x;
    uint turn = scaledIndex(bits, block.x * block.y);
    if (params.choice == choice_cycle) turn += frameIndex();
    return corner + pixelOfTurn(block, turn);
}

vec3 colorOf(uvec2 block, bool must) {
    if (must) return vec3(1);
    uint area = block.x * block.y;
    return area == 1 ? vec3(0.9, 0.1, 0.1) : area == 2 ? vec3(0.9, 0.8, 0.1) : area <= 4 ? vec3(0.1, 0.7, 0.2) : vec3(0.1, 0.3, 0.9);
}

void main() {
    if (warming()) return;
    uvec2 corner = quadCorner(), local = gl_LocalInvocationID.xy, size = frameSize();
    bool there = inImage(corner);
    uint rates = 0xff, used = RATE_QUARTER, step = 0;
    if (there) {
        step = stepOf(corner);
        for (uint i = 0; i < 4; ++i)
            if (inImage(corner + inQuad(i))) rates &= ratesOf(carried(pixelIndex(ivec2(corner + inQuad(i)))));
        uint rate = step == 0 ? RATE_FULL : step == 1 ? halfRate(corner) : RATE_QUARTER;
        // What is rounded at random keeps its mean only where earlier frames have no say.
        used = params.manner == manner_quality ? finestRate(pushRate(rates, rate), params.memoryFrames)
             : params.manner == manner_after   ? finestRate(rates, params.memoryFrames) : rate;
        rates = pushRate(rates, rate);
    }
    wanted[gl_LocalInvocationIndex] = there && (used != RATE_QUARTER || step < 3) ? 0 : 1;
    if (gl_LocalInvocationIndex < 8) present[gl_LocalInvocationIndex] = kept[gl_LocalInvocationIndex] = 0;
    barrier();
    // 4x4 only where all of its quads are for it.
    uint first = gl_LocalInvocationIndex & ~9u;
    bool four = (wanted[first] & wanted[first + 1] & wanted[first + 8] & wanted[first + 9]) != 0;
    uvec2 block = four ? uvec2(4) : uvec2((used & RATE_HALF_X) != 0 ? 2 : 1, (used & RATE_HALF_Y) != 0 ? 2 : 1);
    bvec4 traced = bvec4(false);
    for (uint i = 0; i < 4 && there; ++i) {
        uvec2 p = corner + inQuad(i), from = p / block * block, cut = min(block, size - from);
        if (!inImage(p)) continue;
        uint at = pixelIndex(ivec2(p));
        uvec2 source = chosen(from, cut);
        bool must = needs(at).must != 0;
        traced[i] = must || source == p;
        storeRatesPixels(at, TraceRate(must ? 1 : 1.0 / float(cut.x * cut.y), must ? at : pixelIndex(ivec2(source))));
        storeColors(ivec2(p), vec4(colorOf(block, must) * (traced[i] ? 1 : 0.25), 1));
        RateMemory m = carried(at);
        m.need = tiles(tileIndex(p)).need;
        m.packed = packMemory(rates, traced[i] ? 0 : ageOf(m) + 1, framesOf(m));
        storeMemory(at, m);
        uint place = placeInTile(p % 16u);
        atomicOr(present[place >> 5], 1u << (place & 31));
        if (traced[i]) atomicOr(kept[place >> 5], 1u << (place & 31));
    }
    barrier();
    uint all = 0;
    for (uint k = 0; k < 8; ++k) all += bitCount(kept[k]);
    for (uint i = 0; i < 4 && there; ++i) {
        uvec2 p = corner + inQuad(i);
        if (!inImage(p)) continue;
        uint place = placeInTile(p % 16u), before = traced[i] ? 0 : all;
        for (uint k = 0; k <= place >> 5; ++k) {
            uint below = k == place >> 5 ? (1u << (place & 31)) - 1 : 0xffffffffu;
            before += bitCount(below & (traced[i] ? kept[k] : present[k] & ~kept[k]));
        }
        storeRatesOrder(pixelsBefore(p / 16u, size) + before, pixelIndex(ivec2(p)));
    }
}
