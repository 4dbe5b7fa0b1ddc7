// SPDX-License-Identifier: MIT
// A packet's rays in the space of a grid of boxes, and their tests against a node's four children.
#include "trace/reference.glsl"
#include "trace/spread.glsl"

// A box is given by twice its centre c and twice its half-width h: the ray is inside of it on one axis for t in
// (c * slope + offset) -+ h * steepness. A box with h < 0, which absent children have, is never entered.
struct GridRay {
    vec3 origin, direction;
    vec3 slope, offset, steepness;
};

GridRay gridRay(vec3 origin, vec3 direction, vec3 base, vec3 scale) {
    vec3 inverse = inverseOf(direction), slope = 0.5 * inverse * scale;
    return GridRay(origin, direction, slope, (base - origin) * inverse, abs(slope));
}

// What enters no box and meets no triangle.
GridRay noRay(GridRay r) {
    const float beyond = 1e37;
    return GridRay(r.origin, vec3(0.0), r.slope, vec3(beyond), r.steepness);
}

// The children's boxes: lanes 0-3 of xy hold x, lanes 4-7 y, lanes 0-3 of z hold z.
struct Boxes {
    float xyCenter, xyWidth;
    float zCenter, zWidth;
};

// Shifts of the whole 64 bits get at z sooner than taking them apart into dwords, which costs the driver two shuffles.
Boxes boxesOf(uint64_t node) {
    int xyLow = int(uint(node) & 0xffffu), xyHigh = int(uint(node) >> 16);
    int zLow = int((uint(node >> 31) >> 1) & 0xffffu), zHigh = int(node >> 48);
    return Boxes(float(xyLow + xyHigh), float(xyHigh - xyLow), float(zLow + zHigh), float(zHigh - zLow));
}
// In lanes 4-7.
uint referencesOf(uint64_t node) { return unpackUint2x32(node).y; }

// Comparing the bits of floats is cheaper than comparing floats, where NaN needs care, and right as long as the result counts only when
// it isn't negative: of two negative ones it may pick either.
float bitMax(float a, float b) { return intBitsToFloat(max(floatBitsToInt(a), floatBitsToInt(b))); }
float bitMin(float a, float b) { return intBitsToFloat(min(floatBitsToInt(a), floatBitsToInt(b))); }

// A key sorts children by distance: the bits of the distance at which the ray enters, of which the last two give way to the child's number.
const uint KEY_MISS = 0xfffffffcu;  // from here on the child isn't entered

uint keyOf(float enter, float leave, uint child) { return ((enter <= leave ? floatBitsToUint(enter) : KEY_MISS) & ~3u) | child; }
uint childOf(uint key) { return key & 3u; }

// The lane's ray and child i.
uint childKey(Boxes b, GridRay r, float tMin, float tMax, uint i) {
    float x = subgroupBroadcast(b.xyCenter, i) * r.slope.x + r.offset.x, dx = subgroupBroadcast(b.xyWidth, i) * r.steepness.x;
    float y = subgroupBroadcast(b.xyCenter, i + 4u) * r.slope.y + r.offset.y, dy = subgroupBroadcast(b.xyWidth, i + 4u) * r.steepness.y;
    float z = subgroupBroadcast(b.zCenter, i) * r.slope.z + r.offset.z, dz = subgroupBroadcast(b.zWidth, i) * r.steepness.z;
    float enter = bitMax(bitMax(x - dx, y - dy), bitMax(z - dz, tMin));
    float leave = bitMin(bitMin(x + dx, y + dy), bitMin(z + dz, tMax));
    return keyOf(enter, leave, i);
}

// All children at once where only lane `lone` has a ray that matters: key of child i in lanes i and i + 4. Lanes 0-3 test x and z, lanes 4-7 y.
uint childKeysOfOne(Boxes b, GridRay r, float tMin, float tMax, uint lone) {
    bool isX = packetLane() < 4u;
    float slope = isX ? subgroupShuffle(r.slope.x, lone) : subgroupShuffle(r.slope.y, lone);
    float offset = isX ? subgroupShuffle(r.offset.x, lone) : subgroupShuffle(r.offset.y, lone);
    float zSlope = subgroupShuffle(r.slope.z, lone), zOffset = subgroupShuffle(r.offset.z, lone);
    float xy = b.xyCenter * slope + offset, dxy = b.xyWidth * abs(slope);
    float z = b.zCenter * zSlope + zOffset, dz = b.zWidth * abs(zSlope);
    float enter = xy - dxy, leave = xy + dxy;
    enter = bitMax(bitMax(enter, subgroupShuffleXor(enter, 4u)), bitMax(z - dz, subgroupShuffle(tMin, lone)));
    leave = bitMin(bitMin(leave, subgroupShuffleXor(leave, 4u)), bitMin(z + dz, subgroupShuffle(tMax, lone)));
    uint child = packetLane() & 3u;
    return subgroupShuffle(keyOf(enter, leave, child), child);
}
