// SPDX-License-Identifier: MIT
// The stack that a packet shares: 64 references (scene/bvh/bvh.h, bvhStack), entry i in lane i % 8 of word i / 8.
#include "trace/spread.glsl"

struct PacketStack {
    uint w0, w1, w2, w3, w4, w5, w6, w7;
    uint size;
};

PacketStack stackOf(uint bottom) { return PacketStack(bottom, 0u, 0u, 0u, 0u, 0u, 0u, 0u, 1u); }

uint topOf(PacketStack s) {
    uint i = s.size - 1u, word = i >> 3;
    bool odd = (word & 1u) != 0u;
    uint low = (word & 2u) == 0u ? (odd ? s.w1 : s.w0) : (odd ? s.w3 : s.w2);
    uint high = (word & 2u) == 0u ? (odd ? s.w5 : s.w4) : (odd ? s.w7 : s.w6);
    return subgroupShuffle(word < 4u ? low : high, i & 7u);
}

// Which of `count` pushed references this lane must hold, counted from 1, the last pushed; means nothing in other lanes.
uint rankInPush(PacketStack s, uint count) { return count - ((packetLane() - s.size) & 7u); }

// Writes `count` references, each in the lane that rankInPush named, without a branch. `size` is left as it is.
void pushRanked(inout PacketStack s, uint reference, uint count) {
    uint place = packetLane() - s.size;
    s.w0 = place < count ? reference : s.w0;
    s.w1 = place + 8u < count ? reference : s.w1;
    s.w2 = place + 16u < count ? reference : s.w2;
    s.w3 = place + 24u < count ? reference : s.w3;
    s.w4 = place + 32u < count ? reference : s.w4;
    s.w5 = place + 40u < count ? reference : s.w5;
    s.w6 = place + 48u < count ? reference : s.w6;
    s.w7 = place + 56u < count ? reference : s.w7;
}
