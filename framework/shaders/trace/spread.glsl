// SPDX-License-Identifier: MIT
// Data that the 8 lanes of a subgroup hold together: loaded by one instruction, read by broadcast, reduced by shuffles.
uint packetLane() { return gl_SubgroupInvocationID; }

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer SpreadWords { uint64_t value; };

// 2 * lanes dwords that lie together, two in each lane.
uint64_t loadSpread(uint64_t address, uint lanes) { return SpreadWords(address + uint64_t(min(packetLane(), lanes - 1u) * 8u)).value; }
uint dwordOf(uint64_t spread, uint i) {
    uvec2 words = unpackUint2x32(spread);
    return subgroupBroadcast((i & 1u) == 0u ? words.x : words.y, i >> 1);
}
float numberOf(uint64_t spread, uint i) { return uintBitsToFloat(dwordOf(spread, i)); }
vec3 numbersOf(uint64_t spread, uint i) { return vec3(numberOf(spread, i), numberOf(spread, i + 1u), numberOf(spread, i + 2u)); }

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
uint minFour(uint x) {
    x = min(x, subgroupShuffleXor(x, 1u));
    return min(x, subgroupShuffleXor(x, 2u));
}
uint minAll(uint x) { return minFour(min(x, subgroupShuffleXor(x, 4u))); }

// Lane i of the result holds the least of all lanes' i-th number, i < 4; so does lane i + 4. A transposition that keeps minima as it goes.
uint minOfEach(uint a, uint b, uint c, uint d) {
    bool odd = (packetLane() & 1u) != 0u, high = (packetLane() & 2u) != 0u;
    uint ab = min(odd ? b : a, subgroupShuffleXor(odd ? a : b, 1u));
    uint cd = min(odd ? d : c, subgroupShuffleXor(odd ? c : d, 1u));
    uint all = min(high ? cd : ab, subgroupShuffleXor(high ? ab : cd, 2u));
    return min(all, subgroupShuffleXor(all, 4u));
}

// Sorts the four numbers in lanes 0-3, the least first; lanes 4-7 likewise.
uint sortFour(uint x) {
    uint i = packetLane() & 3u;
    uint other = subgroupShuffleXor(x, 1u);
    x = (i & 1u) != 0u ? max(x, other) : min(x, other);
    other = subgroupShuffleXor(x, 2u);
    x = (i & 2u) != 0u ? max(x, other) : min(x, other);
    bool inner = i == 1u || i == 2u;
    other = subgroupShuffle(x, packetLane() ^ (inner ? 3u : 0u));
    return i == 2u ? max(x, other) : min(x, other);
}
