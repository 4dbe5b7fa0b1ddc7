// SPDX-License-Identifier: MIT
// Deterministic random numbers: an integer hash and a small generator on top of it.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

namespace lodestir::generate {

/// Integer hash with low bias over all 32 input bits (constants: C. Wellons, "Prospecting for Hash Functions", 2018).
inline uint32_t hash(uint32_t x) {
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}

inline uint32_t hash(uint32_t a, uint32_t b) { return hash(hash(a) + 0x9e3779b9u * b); }
inline uint32_t hash(uint32_t a, uint32_t b, uint32_t c) { return hash(hash(a, b) + 0x85ebca6bu * c); }

/// The 24 high bits of a hash as a number in [0, 1).
inline float unit(uint32_t bits) { return float(bits >> 8) * 0x1p-24f; }

/// A stream of numbers fixed by its seed, the same on every platform.
class Random {
public:
    explicit Random(uint32_t seed) : key(hash(seed, 0x51ed270bu)) {}

    uint32_t bits() { return hash(key, counter++); }
    float next() { return unit(bits()); }
    float between(float low, float high) { return low + (high - low) * next(); }
    int below(int count) { return int(next() * float(count)); }

    /// Sum of three uniforms, centred and scaled to unit variance: a bell without tails, so that nothing lands far off.
    float bell() { return (next() + next() + next() - 1.5f) * 2.0f; }

private:
    uint32_t key;
    uint32_t counter = 0;
};

}  // namespace lodestir::generate
