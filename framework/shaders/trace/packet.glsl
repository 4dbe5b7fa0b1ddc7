// SPDX-License-Identifier: MIT
// Traversal by packets: the 8 lanes of a subgroup walk the tree together, with one current node and one stack. All 8 must call it; one
// without a ray gives tMax < 0. Control flow is uniform, and there is as little of it as possible: on lavapipe a branch costs more than the
// arithmetic it saves. Where only one lane's ray is still inside, all lanes work for that one. docs/rays.md has the measurements.
#include "texture/alpha.glsl"
#include "trace/grid_ray.glsl"
#include "trace/packet_stack.glsl"
#include "trace/triangle.glsl"

struct Packet {
    float tMin, tMax;  // tMax < 0: the lane needs nothing more
    Hit hit;
    uint instance;     // that the packet is in
    bool anyHit;
};

void take(inout Packet p, bool accepted, Meeting m, uint primitive) {
    p.hit.t = accepted ? m.t : p.hit.t;
    p.hit.barycentrics = accepted ? m.barycentrics : p.hit.barycentrics;
    p.hit.primitive = accepted ? primitive : p.hit.primitive;
    p.hit.instance = accepted ? p.instance : p.hit.instance;
    p.tMax = accepted ? (p.anyHit ? -1.0 : m.t) : p.tMax;
}

// All lanes' rays against one triangle after the other.
void testLeaf(World w, uint leaf, GridRay r, inout Packet p) {
    uint last = lastTriangle(leaf);
    for (uint primitive = firstTriangle(leaf); primitive <= last; ++primitive) {
        Spread s = loadSpread(w.triangles + uint64_t(primitive) * 48ul, 6u);
        vec3 v0 = vec3(numberOf(s, 0u), numberOf(s, 1u), numberOf(s, 2u));
        vec3 e1 = vec3(numberOf(s, 3u), numberOf(s, 4u), numberOf(s, 5u));
        vec3 e2 = vec3(numberOf(s, 6u), numberOf(s, 7u), numberOf(s, 8u));
        Meeting m = meet(r.origin, r.direction, p.tMin, p.tMax, v0, e1, e2);
        bool accepted = m.inside;
        if (dwordOf(s, 9u) != 0u) {
            if (accepted) accepted = alphaAccepts(w, primitive, m.barycentrics);
        }
        take(p, accepted, m, primitive);
    }
}

// One lane's ray against all triangles of the leaf, one triangle a lane. Not for masked ones.
void testLeafOfOne(World w, uint leaf, GridRay r, uint lone, inout Packet p) {
    uint first = firstTriangle(leaf), mine = min(first + (packetLane() & 3u), lastTriangle(leaf));
    uint64_t address = w.triangles + uint64_t(mine) * 48ul;
    vec2 a = uintBitsToFloat(loadWords(address)), b = uintBitsToFloat(loadWords(address + 8ul)), c = uintBitsToFloat(loadWords(address + 16ul));
    vec2 d = uintBitsToFloat(loadWords(address + 24ul)), e = uintBitsToFloat(loadWords(address + 32ul));
    Meeting m = meet(subgroupShuffle(r.origin, lone), subgroupShuffle(r.direction, lone), subgroupShuffle(p.tMin, lone),
                     subgroupShuffle(p.tMax, lone), vec3(a, b.x), vec3(b.y, c), vec3(d, e.x));
    // The nearest by distance, whose last two bits give way to the lane's number.
    int key = minFour(((m.inside ? floatBitsToInt(m.t) : KEY_MISS) & ~3) | int(packetLane() & 3u));
    uint winner = uint(key & 3);
    m.t = subgroupShuffle(m.t, winner);
    m.barycentrics = subgroupShuffle(m.barycentrics, winner);
    take(p, key < (KEY_MISS & ~3) && packetLane() == lone, m, first + winner);
}

// The packet's rays in an instance's grid.
GridRay enterInstance(Spread record, vec3 origin, vec3 direction) {
    vec4 x = vec4(numberOf(record, 0u), numberOf(record, 1u), numberOf(record, 2u), numberOf(record, 3u));
    vec4 y = vec4(numberOf(record, 4u), numberOf(record, 5u), numberOf(record, 6u), numberOf(record, 7u));
    vec4 z = vec4(numberOf(record, 8u), numberOf(record, 9u), numberOf(record, 10u), numberOf(record, 11u));
    return gridRay(pointToGrid(x, y, z, origin), directionToGrid(x, y, z, direction), vec3(0.0), vec3(1.0));
}

Hit traceRay(World w, Ray ray, bool anyHit) {
    GridRay outside = gridRay(ray.origin, ray.direction, w.gridBase, w.gridScale), r = outside;
    Packet p = Packet(max(ray.tMin, 0.0), ray.tMax, Hit(ray.tMax, vec2(0.0), NONE, NONE), NONE, anyHit);

    // The top level's stack is set aside while a mesh has its own. Not 0, loneSize says that until the stack is smaller than this only
    // lane `lone` is inside of anything.
    PacketStack stack = stackOf(REF_NONE), outsideStack = stack;
    uint lone = 0u, loneSize = 0u, outsideLoneSize = 0u;
    uint current = subgroupAny(ray.tMax > 0.0) ? w.topRoot : REF_NONE;
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
                key = childKeysOfOne(boxes, r, p.tMin, p.tMax, lone);
            } else {
                int key0 = childKey(boxes, r, p.tMin, p.tMax, 0u), key1 = childKey(boxes, r, p.tMin, p.tMax, 1u);
                int key2 = childKey(boxes, r, p.tMin, p.tMax, 2u), key3 = childKey(boxes, r, p.tMin, p.tMax, 3u);
                bool inside = min(min(key0, key1), min(key2, key3)) != KEY_MISS;
                uint insides = addAll(inside ? 256u + packetLane() : 0u);  // how many, and the sum of their numbers
                lone = insides & 7u;
                loneSize = (insides >> 8) == 1u ? stack.size : 0u;
                key = minOfEach(key0, key1, key2, key3);
            }
            // The distances' last two bits give way to the children's numbers, and they are sorted. The nearest child is next, the others
            // are pushed, the farthest first.
            key = sortFour((key & ~3) | int(packetLane() & 3u));
            uint entered = addFour(key < (KEY_MISS & ~3) ? 1u : 0u), pushed = entered == 0u ? 0u : entered - 1u;
            int mine = subgroupShuffle(key, rankInPush(stack, pushed) & 3u), nearest = subgroupBroadcast(key, 0u);
            pushRanked(stack, subgroupShuffle(node.odd, 4u + uint(mine & 3)), pushed);
            current = entered == 0u ? top : subgroupShuffle(node.odd, 4u + uint(nearest & 3));
            stack.size = entered != 0u ? stack.size + pushed : stack.size - 1u;
        } else if (current < REF_BACK) {
            if (loneSize != 0u && (current & REF_MASKED) == 0u) {
                testLeafOfOne(w, current, r, lone, p);
            } else {
                testLeaf(w, current, r, p);
            }
            current = top;
            if (anyHit) current = maxAll(floatBitsToInt(p.tMax)) < 0 ? REF_NONE : current;
            --stack.size;
        } else if (current == REF_BACK) {
            r = outside;
            stack = outsideStack;
            loneSize = outsideLoneSize;
            current = topOf(stack);
            --stack.size;
        } else {
            p.instance = current & 0x1fffffffu;
            Spread record = loadSpread(w.traceInstances + uint64_t(p.instance) * 64ul, 8u);
            r = enterInstance(record, outside.origin, outside.direction);
            outsideStack = stack;
            stack = stackOf(REF_BACK);
            outsideLoneSize = loneSize;
            loneSize = loneSize != 0u ? 1u : 0u;
            current = rootOf(w, p.instance, dwordOf(record, 12u));
        }
        loneSize = stack.size < loneSize ? 0u : loneSize;
    }
    return p.hit;
}
