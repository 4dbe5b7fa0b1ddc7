// SPDX-License-Identifier: MIT
// Traversal by packets: the 8 lanes of a subgroup walk the tree together, with one current node and one stack. All 8 must call it; one
// without a ray gives tMax < 0. Control flow is uniform, and there is as little of it as possible: on lavapipe a branch costs more than the
// arithmetic it saves. docs/rays.md has the measurements.
#include "trace/grid_ray.glsl"
#include "trace/packet_stack.glsl"
#include "trace/triangle.glsl"
#include "world/scene_facts.glsl"

struct Packet {
    float tMin, tMax;  // tMax < 0: the lane needs nothing more
    Hit hit;
    uint instance;     // that the packet is in
    bool anyHit;
    Passage passage;   // of any-hit rays
};

void take(inout Packet p, bool accepted, Meeting m, uint primitive) {
    p.hit.t = accepted ? m.t : p.hit.t;
    p.hit.barycentrics = accepted ? m.barycentrics : p.hit.barycentrics;
    p.hit.primitive = accepted ? primitive : p.hit.primitive;
    p.hit.instance = accepted ? p.instance : p.hit.instance;
    p.tMax = accepted ? (p.anyHit ? -1.0 : m.t) : p.tMax;
}

uint64_t loadTriangle(World w, uint primitive) { return loadSpread(w.triangles + uint64_t(primitive) * 48ul, 6u); }
Meeting meetTriangle(uint64_t triangle, GridRay r, Packet p) {
    return meet(r.origin, r.direction, p.tMin, p.tMax, numbersOf(triangle, 0u), numbersOf(triangle, 3u), numbersOf(triangle, 6u));
}

// Always four triangles, the last one again where there are less: without a loop the four tests overlap.
void testLeaf(World w, uint leaf, GridRay r, inout Packet p) {
    uint first = firstTriangle(leaf), last = lastTriangle(leaf), second = min(first + 1u, last), third = min(first + 2u, last);
    uint64_t a = loadTriangle(w, first), b = loadTriangle(w, second), c = loadTriangle(w, third), d = loadTriangle(w, last);
    Meeting m = meetTriangle(a, r, p), other = meetTriangle(c, r, p);
    uint primitive = first, otherPrimitive = third;
    nearer(m, primitive, meetTriangle(b, r, p), second);
    nearer(other, otherPrimitive, meetTriangle(d, r, p), last);
    nearer(m, primitive, other, otherPrimitive);
    take(p, m.t < p.tMax, m, primitive);
}

layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer LeafTriangles { uint64_t at[]; };

// The same where only lane `lone` has a ray that matters: each lane tests a triangle for it. Of equally near ones it takes the first, too.
void testLeafOfOne(World w, uint leaf, GridRay r, inout Packet p, uint lone) {
    uint first = firstTriangle(leaf), last = lastTriangle(leaf), primitive = min(first + (packetLane() & 3u), last);
    LeafTriangles triangle = LeafTriangles(w.triangles + uint64_t(primitive) * 48ul);
    uvec2 a = unpackUint2x32(triangle.at[0]), b = unpackUint2x32(triangle.at[1]), c = unpackUint2x32(triangle.at[2]);
    uvec2 d = unpackUint2x32(triangle.at[3]), e = unpackUint2x32(triangle.at[4]);
    vec3 origin = vec3(subgroupShuffle(r.origin.x, lone), subgroupShuffle(r.origin.y, lone), subgroupShuffle(r.origin.z, lone));
    vec3 direction = vec3(subgroupShuffle(r.direction.x, lone), subgroupShuffle(r.direction.y, lone), subgroupShuffle(r.direction.z, lone));
    Meeting m = meet(origin, direction, subgroupShuffle(p.tMin, lone), subgroupShuffle(p.tMax, lone),
                     uintBitsToFloat(uvec3(a, b.x)), uintBitsToFloat(uvec3(b.y, c)), uintBitsToFloat(uvec3(d, e.x)));
    uint t = floatBitsToUint(m.t), least = minFour(t);
    uint winner = minFour(t == least ? packetLane() & 3u : 3u);
    vec2 barycentrics = vec2(subgroupShuffle(m.barycentrics.x, winner), subgroupShuffle(m.barycentrics.y, winner));
    Meeting nearest = Meeting(uintBitsToFloat(subgroupShuffle(least, 0u)), barycentrics);
    take(p, packetLane() == lone && nearest.t < p.tMax, nearest, min(first + winner, last));
}

// One triangle after the other, asking masks and panes.
void testMaskedLeaf(World w, uint leaf, Ray ray, GridRay r, inout Packet p) {
    uint last = lastTriangle(leaf);
    for (uint primitive = firstTriangle(leaf); primitive <= last; ++primitive) {
        uint64_t triangle = loadTriangle(w, primitive);
        Meeting m = meetTriangle(triangle, r, p);
        bool accepted = m.t < p.tMax;
        bool asked = dwordOf(triangle, 9u) != 0u;
        if (accepted && asked) accepted = alphaAccepts(w, primitive, m.barycentrics);
        if (p.anyHit && accepted && asked) accepted = endsLight(w, ray, Hit(m.t, m.barycentrics, primitive, p.instance), p.passage);
        take(p, accepted, m, primitive);
    }
}

// The packet's rays in an instance's grid.
GridRay enterInstance(uint64_t record, vec3 origin, vec3 direction) {
    vec4 x = vec4(numbersOf(record, 0u), numberOf(record, 3u));
    vec4 y = vec4(numbersOf(record, 4u), numberOf(record, 7u));
    vec4 z = vec4(numbersOf(record, 8u), numberOf(record, 11u));
    return gridRay(pointToGrid(x, y, z, origin), directionToGrid(x, y, z, direction), numbersOf(record, 13u), vec3(1.0));
}

Hit traceRay(World w, Ray ray, bool anyHit) {
    GridRay outside = gridRay(ray.origin, ray.direction, w.gridBase, w.gridScale), r = outside;
    Packet p = Packet(max(ray.tMin, 0.0), ray.tMax, Hit(ray.tMax, vec2(0.0), NONE, NONE), NONE, anyHit, passageStart());

    // The top level's stack is set aside while a mesh has its own. Where only one lane's ray is still inside, all lanes test boxes for that
    // one: not 0, loneSize says that until the stack is smaller than this only lane `lone` is inside of anything.
    PacketStack stack = stackOf(REF_NONE), outsideStack = stack;
    uint lone = 0u, loneSize = 0u, outsideLoneSize = 0u;
    uint current = subgroupAny(ray.tMax > 0.0) ? w.topRoot : REF_NONE;
    while (current != REF_NONE) {
        uint top = topOf(stack);
        if (current < REF_LEAF) {
#ifdef COUNT_STEPS
            ++traceSteps;
#endif
            uint64_t node = loadSpread(w.nodes + uint64_t(current) * 64ul, 8u);
            Boxes boxes = boxesOf(node);
            uint key, nearest;
            if (loneSize != 0u) {
                key = childKeysOfOne(boxes, r, p.tMin, p.tMax, lone);
                nearest = minFour(key);
            } else {
                uint key0 = childKey(boxes, r, p.tMin, p.tMax, 0u), key1 = childKey(boxes, r, p.tMin, p.tMax, 1u);
                uint key2 = childKey(boxes, r, p.tMin, p.tMax, 2u), key3 = childKey(boxes, r, p.tMin, p.tMax, 3u);
                uint least = min(min(key0, key1), min(key2, key3));
                uint insides = addAll(least < KEY_MISS ? 256u + packetLane() : 0u);  // how many, and the sum of their numbers
                lone = insides & 7u;
                loneSize = (insides >> 8) == 1u ? stack.size : 0u;
                key = minOfEach(key0, key1, key2, key3);
                nearest = minAll(least);
            }
            // The nearest child is next: found apart from the order of all, because the next step waits for it. The others are pushed,
            // the farthest first.
            bool entered = nearest < KEY_MISS;
            uint references = referencesOf(node);
            current = entered ? subgroupShuffle(references, 4u + childOf(nearest)) : top;
            key = sortFour(key);
            uint pushed = addFour(key < KEY_MISS ? 1u : 0u) - (entered ? 1u : 0u);
            uint mine = subgroupShuffle(key, rankInPush(stack, pushed) & 3u);
            pushRanked(stack, subgroupShuffle(references, 4u + childOf(mine)), pushed);
            stack.size = entered ? stack.size + pushed : stack.size - 1u;
        } else if (current < REF_BACK) {
            if ((SCENE_MASKS != 0 || (SCENE_PANES != 0 && anyHit)) && (current & REF_MASKED) != 0u) {
                testMaskedLeaf(w, current, ray, r, p);
            } else if (loneSize != 0u) {
                testLeafOfOne(w, current, r, p, lone);
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
            p.instance = current & REF_INSTANCE_BITS;
            uint64_t record = loadSpread(w.traceInstances + uint64_t(p.instance) * 64ul, 8u);
            vec3 from = outside.origin, way = outside.direction;
            intoOpening(w, p.instance, from, way);
            r = enterInstance(record, from, way);
            outsideStack = stack;
            uint level = w.levels.at[p.instance];
#if RAY_LEVELS
            // Where rays see two levels, those that see the coarser one come in alone, after the others, who then wait.
            bool coarser = seesCoarser(w, p.instance, ray.flags), counts = loneSize != 0u ? packetLane() == lone : p.tMax > 0.0;
            bool second = (current & REF_COARSER) != 0u || !subgroupAny(counts && !coarser);
            if (!second && subgroupAny(counts && coarser)) {
                pushRanked(outsideStack, current | REF_COARSER, 1u);
                ++outsideStack.size;
            }
            if (second) ++level;
            if (coarser != second) r = noRay(r);
#endif
            stack = stackOf(REF_BACK);
            outsideLoneSize = loneSize;
            loneSize = loneSize != 0u ? 1u : 0u;
            current = rootOf(w, dwordOf(record, 12u), level);
        }
        loneSize = stack.size < loneSize ? 0u : loneSize;
    }
    return anyHit ? arrivedHit(p.hit, p.passage) : p.hit;
}
