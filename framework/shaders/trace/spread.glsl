// SPDX-License-Identifier: MIT
// Data that the 8 lanes of a subgroup hold together: loaded by one instruction, read by broadcast, reduced by shuffles.
uint packetLane() { return gl_SubgroupInvocationID; }

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer SpreadWords { uint64_t value; };
uvec2 loadWords(uint64_t address) { return unpackUint2x32(SpreadWords(address).value); }

// 2 * lanes dwords that lie together, two in each lane.
struct Spread {
    uint even, odd;
};

Spread loadSpread(uint64_t address, uint lanes) {
    uvec2 words = loadWords(address + uint64_t(min(packetLane(), lanes - 1u) * 8u));
    return Spread(words.x, words.y);
}
uint dwordOf(Spread s, uint i) { return subgroupBroadcast((i & 1u) == 0u ? s.even : s.odd, i >> 1); }
float numberOf(Spread s, uint i) { return uintBitsToFloat(dwordOf(s, i)); }

uint addAll(uint x) {
    x += subgroupShuffleXor(x, 4u);
    x += subgroupShuffleXor(x, 2u);
    return x + subgroupShuffleXor(x, 1u);
}
int maxAll(int x) {
    x = max(x, subgroupShuffleXor(x, 4u));
    x = max(x, subgroupShuffleXor(x, 2u));
    return max(x, subgroupShuffleXor(x, 1u));
}
// Over lanes 0-3 and, apart, over lanes 4-7.
uint addFour(uint x) {
    x += subgroupShuffleXor(x, 1u);
    return x + subgroupShuffleXor(x, 2u);
}
int minFour(int x) {
    x = min(x, subgroupShuffleXor(x, 1u));
    return min(x, subgroupShuffleXor(x, 2u));
}

// Lane i of the result holds the least of all lanes' i-th number, i < 4; so does lane i + 4. A transposition that keeps minima as it goes.
int minOfEach(int a, int b, int c, int d) {
    bool odd = (packetLane() & 1u) != 0u, high = (packetLane() & 2u) != 0u;
    int ab = min(odd ? b : a, subgroupShuffleXor(odd ? a : b, 1u));
    int cd = min(odd ? d : c, subgroupShuffleXor(odd ? c : d, 1u));
    int all = min(high ? cd : ab, subgroupShuffleXor(high ? ab : cd, 2u));
    return min(all, subgroupShuffleXor(all, 4u));
}

// Sorts the four numbers in lanes 0-3, the least first; lanes 4-7 likewise.
int sortFour(int x) {
    uint i = packetLane() & 3u;
    int other = subgroupShuffleXor(x, 1u);
    x = (i & 1u) != 0u ? max(x, other) : min(x, other);
    other = subgroupShuffleXor(x, 2u);
    x = (i & 2u) != 0u ? max(x, other) : min(x, other);
    bool inner = i == 1u || i == 2u;
    other = subgroupShuffle(x, packetLane() ^ (inner ? 3u : 0u));
    return i == 2u ? max(x, other) : min(x, other);
}
