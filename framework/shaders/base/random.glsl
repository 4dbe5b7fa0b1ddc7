// SPDX-License-Identifier: MIT
// Random numbers without state: a draw is a function of (seed, vertex, dimension), so that a path replays from its seed alone and
// branches never shift the numbers of what follows.
//
// A seed has 64 bits: 16 + 16 bits of pixel and 32 bits of sample index, exclusive-or a 64-bit key of (run, stream). For one key this is a
// bijection: two samples never share a seed, whatever the frame count. 32 bits were not enough: a 4K image takes 23 of them, so that
// seeds would repeat after 512 frames, and copies of a path are told by their seeds. Two runs (or streams) share seeds only if the
// difference of their keys happens to be that of two samples: a chance of 2^-30 for 4096 samples of an HD image.
//
// Source of the hash: Jarzynski and Olano 2020, Hash Functions for GPU Rendering (JCGT 9(3)), pcg4d.

// Dimensions at vertex 0, the camera.
const uint RANDOM_FILM = 0u;       // xy: place inside the pixel
const uint RANDOM_LENS = 1u;       // xy: place on the lens
const uint RANDOM_THRESHOLD = 2u;  // thresholds that are random per path
// Dimensions at a path's vertices; the primary hit is vertex 1.
const uint RANDOM_BSDF = 8u;          // x: lobe, yz: direction
const uint RANDOM_LIGHT_CHOICE = 9u;  // bits, x: light, y: slot of an environment texel
const uint RANDOM_LIGHT_POINT = 10u;  // x: keep or alias of the texel, yz: point
const uint RANDOM_ROULETTE = 11u;
const uint RANDOM_LEVEL = 12u;        // stochastic level of detail
const uint RANDOM_FREE = 64u;         // a pass's own dimensions start here

uvec4 pcg4d(uvec4 v) {
    v = v * 1664525u + 1013904223u;
    for (int turn = 0; turn < 2; ++turn) {
        v.x += v.y * v.w;
        v.y += v.z * v.x;
        v.z += v.x * v.y;
        v.w += v.y * v.z;
        if (turn == 0) v ^= v >> 16;
    }
    return v;
}

uvec2 streamSeed(uvec2 pixel, uint index, uint run, uint stream) {
    return uvec2(pixel.x | pixel.y << 16, index) ^ pcg4d(uvec4(run, stream, 0x9e3779b9u, 0x7f4a7c15u)).xy;
}

/// Seed of a path. `index` counts the samples of a pixel over the whole run: frame * samples per frame + sample. Pixels below 65536.
uvec2 pathSeed(uvec2 pixel, uint index, uint run) { return streamSeed(pixel, index, run, 0u); }

/// The pixel that a path of this run was made for.
uvec2 seedPixel(uvec2 seed, uint run) {
    uint packed = seed.x ^ streamSeed(uvec2(0u), 0u, run, 0u).x;
    return uvec2(packed & 0xffffu, packed >> 16);
}

/// Seed of resampling decisions, independent of all path seeds. `stage` tells the turns of one frame apart.
uvec2 resamplingSeed(uvec2 pixel, uint frame, uint run, uint stage) { return streamSeed(pixel, frame, run, stage + 1u); }

uvec3 randomBits3(uvec2 seed, uint vertex, uint dimension) { return pcg4d(uvec4(seed, vertex, dimension)).xyz; }

/// The upper 24 bits as a number in [0, 1): a float holds each exactly.
float unitFloat(uint bits) { return float(bits >> 8) * (1.0 / 16777216.0); }

vec3 random3(uvec2 seed, uint vertex, uint dimension) {
    return vec3(randomBits3(seed, vertex, dimension) >> 8) * (1.0 / 16777216.0);
}
vec2 random2(uvec2 seed, uint vertex, uint dimension) { return random3(seed, vertex, dimension).xy; }
float random1(uvec2 seed, uint vertex, uint dimension) { return random3(seed, vertex, dimension).x; }

/// floor(bits / 2^32 * count): a uniform index below count. Whole bits are used because a 24-bit float would favour some of many
/// thousand entries by several per cent.
uint scaledIndex(uint bits, uint count) {
    uint high, low;
    umulExtended(bits, count, high, low);
    return high;
}
