// SPDX-License-Identifier: MIT
// Traversal by packets: the 8 lanes of a subgroup walk the tree together. They share the current node and one stack, spread over the
// lanes' registers, and load a node with one instruction. All 8 lanes must call it; one without a ray gives tMax < 0.
// Control flow is uniform throughout. docs/rays.md tells what was measured and why this form won.
#include "texture/alpha.glsl"
#include "trace/reference.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer PacketWords { uint64_t value; };

// 16 dwords that lie together, two in each lane.
struct Spread {
    uint even, odd;
};

uint packetLane() { return gl_SubgroupInvocationID; }

Spread loadSpread(uint64_t address, uint lanes) {
    uvec2 words = unpackUint2x32(PacketWords(address + uint64_t(min(packetLane(), lanes - 1u) * 8u)).value);
    return Spread(words.x, words.y);
}
float dwordOf(Spread s, uint i) { return uintBitsToFloat(subgroupBroadcast((i & 1u) == 0u ? s.even : s.odd, i >> 1)); }

// Of numbers whose greater (lesser) one is known not to be negative, the comparison of their bits is right, and it is cheaper than that of
// floats, which must look for NaN.
float bitMax(float a, float b) { return intBitsToFloat(max(floatBitsToInt(a), floatBitsToInt(b))); }
float bitMin(float a, float b) { return intBitsToFloat(min(floatBitsToInt(a), floatBitsToInt(b))); }

// A ray in the space of a grid. A box is given by twice its centre c and twice its half-width h: the ray is inside of it on one axis for
// t in (c * slope + offset) -+ h * steepness. A box with h < 0 is never entered.
struct GridRay {
    vec3 origin, direction;
    vec3 slope, offset;
    vec3 steepness;
};

GridRay gridRay(vec3 origin, vec3 direction, vec3 base, vec3 scale) {
    GridRay r;
    r.origin = origin;
    r.direction = direction;
    vec3 inverse = inverseOf(direction);
    r.slope = 0.5 * inverse * scale;
    r.offset = (base - origin) * inverse;
    r.steepness = abs(r.slope);
    return r;
}

// The boxes of a node's four children: lanes 0-3 of xy hold x, lanes 4-7 y, lanes 0-3 of z hold z.
struct Boxes {
    float xyCenter, xyWidth;
    float zCenter, zWidth;
};

Boxes boxesOf(Spread node) {
    float xyLow = float(node.even & 0xffffu), xyHigh = float(node.even >> 16);
    float zLow = float(node.odd & 0xffffu), zHigh = float(node.odd >> 16);
    return Boxes(xyLow + xyHigh, xyHigh - xyLow, zLow + zHigh, zHigh - zLow);
}

const int PACKET_MISS = 0x7fffffff;

// Bits of the distance at which the lane's ray enters a child, PACKET_MISS when it doesn't.
int childKey(Boxes b, GridRay r, float tMin, float tMax, uint child) {
    float x = fma(subgroupBroadcast(b.xyCenter, child), r.slope.x, r.offset.x), dx = subgroupBroadcast(b.xyWidth, child) * r.steepness.x;
    float y = fma(subgroupBroadcast(b.xyCenter, child + 4u), r.slope.y, r.offset.y), dy = subgroupBroadcast(b.xyWidth, child + 4u) * r.steepness.y;
    float z = fma(subgroupBroadcast(b.zCenter, child), r.slope.z, r.offset.z), dz = subgroupBroadcast(b.zWidth, child) * r.steepness.z;
    float enter = bitMax(bitMax(x - dx, y - dy), bitMax(z - dz, tMin));
    float leave = bitMin(bitMin(x + dx, y + dy), bitMin(z + dz, tMax));
    return enter <= leave ? floatBitsToInt(enter) : PACKET_MISS;
}

// The same when only lane `lone` has a ray that matters: lanes 0-3 test x and z of the four children, lanes 4-7 y. Valid in lanes 0-3.
int childKeyOfOne(Boxes b, GridRay r, float tMin, float tMax, uint lone) {
    bool isX = packetLane() < 4u;
    float slope = isX ? subgroupShuffle(r.slope.x, lone) : subgroupShuffle(r.slope.y, lone);
    float offset = isX ? subgroupShuffle(r.offset.x, lone) : subgroupShuffle(r.offset.y, lone);
    float slopeZ = subgroupShuffle(r.slope.z, lone), offsetZ = subgroupShuffle(r.offset.z, lone);
    float xy = fma(b.xyCenter, slope, offset), dxy = b.xyWidth * abs(slope);
    float z = fma(b.zCenter, slopeZ, offsetZ), dz = b.zWidth * abs(slopeZ);
    float enter = xy - dxy, leave = xy + dxy;
    enter = bitMax(enter, subgroupShuffleXor(enter, 4u));
    leave = bitMin(leave, subgroupShuffleXor(leave, 4u));
    enter = bitMax(enter, bitMax(z - dz, subgroupShuffle(tMin, lone)));
    leave = bitMin(leave, bitMin(z + dz, subgroupShuffle(tMax, lone)));
    return enter <= leave ? floatBitsToInt(enter) : PACKET_MISS;
}

// One step of a transposition that keeps minima: lanes whose bit `distance` is clear go on with a, the others with b.
int halve(int a, int b, uint distance) {
    bool upper = (packetLane() & distance) != 0u;
    return min(upper ? b : a, subgroupShuffleXor(upper ? a : b, distance));
}
uint orAll(uint x) {
    x |= subgroupShuffleXor(x, 4u);
    x |= subgroupShuffleXor(x, 2u);
    return x | subgroupShuffleXor(x, 1u);
}
int maxAll(int x) {
    x = max(x, subgroupShuffleXor(x, 4u));
    x = max(x, subgroupShuffleXor(x, 2u));
    return max(x, subgroupShuffleXor(x, 1u));
}

// 48 references, entry i in lane i % 8 of words[i / 8]. The first one is never popped but by mistake: see traceRay.
struct PacketStack {
    uint s0, s1, s2, s3, s4, s5;
    uint size;
};
PacketStack stackOf(uint bottom) { return PacketStack(bottom, 0u, 0u, 0u, 0u, 0u, 1u); }

uint topOf(PacketStack s) {
    uint i = s.size - 1u, group = i >> 3;
    uint word = group < 3u ? (group == 0u ? s.s0 : (group == 1u ? s.s1 : s.s2)) : (group == 3u ? s.s3 : (group == 4u ? s.s4 : s.s5));
    return subgroupShuffle(word, i & 7u);
}

void order(inout int a, inout int b) {
    int low = min(a, b);
    b = max(a, b);
    a = low;
}

Hit traceRay(World w, Ray ray, bool anyHit) {
    uint lane = packetLane();
    GridRay world = gridRay(ray.origin, ray.direction, w.gridBase, w.gridScale);
    world.slope = world.slope;
    GridRay r = world;
    float tMin = max(ray.tMin, 0.0), tMax = ray.tMax;
    Hit hit = Hit(tMax, vec2(0.0), NONE, NONE);
    uint instance = NONE;

    PacketStack stack = stackOf(REF_NONE), outer = stack;
    uint loneSize = 0u, lone = 0u;  // not 0: until the stack is smaller than this, only lane `lone` is active
    uint current = subgroupAny(tMax > 0.0) ? w.topRoot : REF_NONE;
    while (current != REF_NONE) {
        uint top = topOf(stack);
        if (current < REF_LEAF) {
#ifdef COUNT_STEPS
            ++traceSteps;
#endif
            Spread node = loadSpread(w.nodes + uint64_t(current) * 64ul, 8u);
            Boxes boxes = boxesOf(node);
            int key;
            if (loneSize != 0u) {
                key = childKeyOfOne(boxes, r, tMin, tMax, lone);
            } else {
                int key0 = childKey(boxes, r, tMin, tMax, 0u), key1 = childKey(boxes, r, tMin, tMax, 1u);
                int key2 = childKey(boxes, r, tMin, tMax, 2u), key3 = childKey(boxes, r, tMin, tMax, 3u);
                bool isActive = min(min(key0, key1), min(key2, key3)) != PACKET_MISS;
                uint actives = orAll(isActive ? 1u << lane : 0u);
                bool alone = actives != 0u && (actives & (actives - 1u)) == 0u;
                loneSize = alone ? stack.size : 0u;
                lone = alone ? uint(findLSB(actives)) : 0u;
                key = halve(halve(key0, key1, 1u), halve(key2, key3, 1u), 2u);
                key = min(key, subgroupShuffleXor(key, 4u));
            }
            // The distance's last two bits give way to the child's number; then the four are sorted by distance.
            key = (key & ~3) | int(lane & 3u);
            int key0 = subgroupBroadcast(key, 0u), key1 = subgroupBroadcast(key, 1u);
            int key2 = subgroupBroadcast(key, 2u), key3 = subgroupBroadcast(key, 3u);
            order(key0, key1);
            order(key2, key3);
            order(key0, key2);
            order(key1, key3);
            order(key1, key2);
            const int miss = PACKET_MISS & ~3;
            // The nearest is next; the others are pushed, the farthest first.
            uint pushed = uint(key1 < miss) + uint(key2 < miss) + uint(key3 < miss);
            uint place = lane - stack.size, rank = pushed - (place & 7u);
            int pushedKey = rank == 1u ? key1 : (rank == 2u ? key2 : key3);
            uint reference = subgroupShuffle(node.odd, 4u + uint(pushedKey & 3));
            stack.s0 = place < pushed ? reference : stack.s0;
            stack.s1 = place + 8u < pushed ? reference : stack.s1;
            stack.s2 = place + 16u < pushed ? reference : stack.s2;
            stack.s3 = place + 24u < pushed ? reference : stack.s3;
            stack.s4 = place + 32u < pushed ? reference : stack.s4;
            stack.s5 = place + 40u < pushed ? reference : stack.s5;
            bool any = key0 < miss;
            current = any ? subgroupShuffle(node.odd, 4u + uint(key0 & 3)) : top;
            stack.size = any ? stack.size + pushed : stack.size - 1u;
            loneSize = stack.size < loneSize ? 0u : loneSize;
        } else if (current < REF_BACK) {
            uint first = current & 0xfffffffu, count = (current >> 28) & 7u;
            for (uint i = 0u; i <= count; ++i) {
                uint primitive = first + i;
                Spread words = loadSpread(w.triangles + uint64_t(primitive) * 48ul, 6u);
                vec3 v0 = vec3(dwordOf(words, 0u), dwordOf(words, 1u), dwordOf(words, 2u));
                vec3 e1 = vec3(dwordOf(words, 3u), dwordOf(words, 4u), dwordOf(words, 5u));
                vec3 e2 = vec3(dwordOf(words, 6u), dwordOf(words, 7u), dwordOf(words, 8u));
                // Moeller and Trumbore, "Fast, minimum storage ray/triangle intersection", 1997.
                vec3 p = cross(r.direction, e2), s = r.origin - v0, q = cross(s, e1);
                float inverse = 1.0 / dot(e1, p);
                float u = dot(s, p) * inverse, v = dot(r.direction, q) * inverse, t = dot(e2, q) * inverse;
                bool met = min(min(u, v), 1.0 - u - v) >= 0.0 && t > tMin && t < tMax;
                if (floatBitsToUint(dwordOf(words, 9u)) != 0u) {
                    if (met) met = alphaAccepts(w, primitive, vec2(u, v));
                }
                hit.t = met ? t : hit.t;
                hit.barycentrics = met ? vec2(u, v) : hit.barycentrics;
                hit.primitive = met ? primitive : hit.primitive;
                hit.instance = met ? instance : hit.instance;
                tMax = met ? (anyHit ? -1.0 : t) : tMax;
            }
            current = top;
            --stack.size;
            loneSize = stack.size < loneSize ? 0u : loneSize;
            if (anyHit) current = maxAll(floatBitsToInt(tMax)) < 0 ? REF_NONE : current;
        } else if (current == REF_BACK) {
            r = world;
            stack = outer;
            current = topOf(stack);
            --stack.size;
            loneSize = 0u;
        } else {
            instance = current & 0x1fffffffu;
            Spread record = loadSpread(w.traceInstances + uint64_t(instance) * 64ul, 8u);
            vec4 x = vec4(dwordOf(record, 0u), dwordOf(record, 1u), dwordOf(record, 2u), dwordOf(record, 3u));
            vec4 y = vec4(dwordOf(record, 4u), dwordOf(record, 5u), dwordOf(record, 6u), dwordOf(record, 7u));
            vec4 z = vec4(dwordOf(record, 8u), dwordOf(record, 9u), dwordOf(record, 10u), dwordOf(record, 11u));
            vec3 o = world.origin, d = world.direction;
            // The direction keeps its length in the other space, so t means the same in both.
            r = gridRay(vec3(dot(x.xyz, o) + x.w, dot(y.xyz, o) + y.w, dot(z.xyz, o) + z.w),
                        vec3(dot(x.xyz, d), dot(y.xyz, d), dot(z.xyz, d)), vec3(0.0), vec3(1.0));
            outer = stack;
            stack = stackOf(REF_BACK);
            loneSize = 0u;
            current = rootOf(w, instance, floatBitsToUint(dwordOf(record, 12u)));
        }
    }
    return hit;
}
