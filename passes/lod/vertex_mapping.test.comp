// SPDX-License-Identifier: MIT
// If these fail, paths of last frame are carried to wrong places when an object changes its level, or are lost there, or carry the wrong weight.
// groups: 16
// passes: 2
#version 460
#include "base/random.glsl"
#include "lod/vertex_mapping.glsl"
#include "world/test_world.glsl"
layout(local_size_x = 64) in;

const uint TEST_UV_NODES = 10u, TEST_UV_PRIMITIVES = 11u, TEST_UV_ROOTS = 12u;
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer TestUvNodes { UvNode at[]; };

// Meshes, each of levels 0 and 1.
const uint SQUARE = 0u;    // a unit square; level 1 cut along the other diagonal, twice as large
const uint MIRRORED = 1u;  // two squares apart with the same coordinates, one of them mirrored
const uint LOST = 2u;      // two such squares; level 1 has but the right one
const uint TILED = 3u;     // nine squares with the same coordinates on level 0, one on level 1
const uint FLAT = 4u;      // a square and a triangle without area in UV

uint vertexCount = 0u, primitiveCount = 0u, nodeCount = 0u, listCount = 0u;

uint addVertex(vec3 position, vec2 uv) {
    TestPositions(testArray(TEST_POSITIONS)).at[vertexCount] = vec4(position, 0);
    TestVertices(testArray(TEST_VERTICES)).at[vertexCount] = VertexRecord(0u, 0u, uv, vec2(0), uvec2(0));
    return vertexCount++;
}

void addTriangle(uint a, uint b, uint c) {
    TestPrimitives(testArray(TEST_PRIMITIVES)).at[primitiveCount] = PrimitiveRecord(a, b, c, 0u);
    TestUints(testArray(TEST_UV_PRIMITIVES)).at[listCount++] = primitiveCount++;
}

// Two triangles over coordinates [0, 1]^2, from x on, `size` wide. mirrored: x runs against u.
void addSquare(float x, float size, bool mirrored, bool otherDiagonal) {
    uint corners[4];
    for (uint i = 0u; i < 4u; ++i) {
        vec2 uv = vec2(i & 1u, i >> 1);
        corners[i] = addVertex(vec3(x + size * (mirrored ? 1.0 - uv.x : uv.x), size * uv.y, 0.0), uv);
    }
    addTriangle(corners[0], corners[1], otherDiagonal ? corners[2] : corners[3]);
    addTriangle(otherDiagonal ? corners[1] : corners[0], corners[3], corners[2]);
}

// Closes a level: a root with two leaves, of its first triangle and of the rest.
void closeLevel(uint mesh, uint level, uint first) {
    TestUvNodes nodes = TestUvNodes(testArray(TEST_UV_NODES));
    TestUints(testArray(TEST_UV_ROOTS)).at[mesh * LEVELS + level] = nodeCount;
    nodes.at[nodeCount] = UvNode(vec2(0), vec2(1), nodeCount + 1u, 0u, uvec2(0));
    nodes.at[nodeCount + 1u] = UvNode(vec2(0), vec2(1), first, 1u, uvec2(0));
    nodes.at[nodeCount + 2u] = UvNode(vec2(0), vec2(1), first + 1u, listCount - first - 1u, uvec2(0));
    nodeCount += 3u;
}

void write() {
    for (uint level = 0u; level < 2u; ++level) {
        uint first = listCount;
        addSquare(0.0, level == 0u ? 1.0 : 2.0, false, level == 1u);
        closeLevel(SQUARE, level, first);
        first = listCount;
        addSquare(-3.0, 1.0, true, level == 1u);
        addSquare(2.0, 1.0, false, level == 1u);
        closeLevel(MIRRORED, level, first);
        first = listCount;
        if (level == 0u) addSquare(-3.0, 1.0, false, false);
        addSquare(2.0, 1.0, false, false);
        closeLevel(LOST, level, first);
        first = listCount;
        for (uint i = 0u; i < (level == 0u ? 9u : 1u); ++i) addSquare(float(2u * i), 1.0, false, false);
        closeLevel(TILED, level, first);
        first = listCount;
        addSquare(0.0, 1.0, false, false);
        addTriangle(addVertex(vec3(0, 0, 1), vec2(0)), addVertex(vec3(1, 0, 1), vec2(0.5)), addVertex(vec3(1, 1, 1), vec2(1)));
        closeLevel(FLAT, level, first);
    }
}

// The triangle of a level that holds uv and lies where x is negative (left) or not.
uint primitiveAt(World w, UvIndex index, uint mesh, uint level, vec2 uv, bool left) {
    UvFound found = uvLookup(w, index, mesh, level, uv);
    for (uint i = 0u; i < found.count; ++i)
        if ((restPosition(w, found.primitives[i], found.barycentrics[i]).x < 0.0) == left) return found.primitives[i];
    return NONE;
}

// There and back again: the same triangle, the same point, Jacobians that undo each other.
void expectReturn(World w, UvIndex index, uint mesh, vec2 uv, bool left, float areaRatio) {
    uint start = primitiveAt(w, index, mesh, 0u, uv, left);
    MappedPoint there = mapPoint(w, index, mesh, start, uv, 0u, 1u, true);
    EXPECT_TRUE(there.jacobian > 0.0);
    if (there.jacobian <= 0.0) return;
    MappedPoint back = mapPoint(w, index, mesh, there.primitive, uv, 1u, 0u, true);
    EXPECT_EQ(back.primitive, start);
    EXPECT_NEAR(there.jacobian * back.jacobian, 1.0, 1e-5);
    vec3 here = restPosition(w, start, back.barycentrics), beyond = restPosition(w, there.primitive, there.barycentrics);
    EXPECT_EQ(beyond.x < 0.0, left);
    // The coordinate stays what it was, so the squares' own map tells where the point has to be.
    EXPECT_NEAR(beyond.y, sqrt(areaRatio) * here.y, 1e-5);
    // Barycentric area there, times twice the triangle's area, is area there: its ratio to area here is that of the squares.
    uvec3 a = cornersOf(w, start), b = cornersOf(w, there.primitive);
    TrianglePoint p = pointOn(w, a, vec2(0)), q = pointOn(w, b, vec2(0));
    float ratio = there.jacobian * length(cross(q.edge1, q.edge2)) / length(cross(p.edge1, p.edge2));
    EXPECT_NEAR(ratio, areaRatio, 1e-4);
}

void main() {
    uint id = gl_GlobalInvocationID.x;
    if (testPush.pass == 0u) {
        if (id == 0u) write();
        return;
    }
    World w = testWorld();
    UvIndex index = UvIndex(UvNodeArray(testArray(TEST_UV_NODES)), UintArray(testArray(TEST_UV_PRIMITIVES)), UintArray(testArray(TEST_UV_ROOTS)));
    vec2 uv = 0.001 + 0.998 * random2(pathSeed(uvec2(id, 0), 0u, 7u), 0u, 0u);
    if (abs(uv.x - uv.y) < 1e-4 || abs(uv.x + uv.y - 1.0) < 1e-4) return;  // on a diagonal two triangles hold the point

    EXPECT_EQ(uvLookup(w, index, SQUARE, 0u, uv).count, 1u);
    expectReturn(w, index, SQUARE, uv, false, 4.0);
    EXPECT_EQ(uvLookup(w, index, MIRRORED, 0u, uv).count, 2u);
    expectReturn(w, index, MIRRORED, uv, true, 1.0);
    expectReturn(w, index, MIRRORED, uv, false, 1.0);

    // Without matching nothing is mapped where two triangles share a coordinate.
    uint left = primitiveAt(w, index, MIRRORED, 0u, uv, true);
    EXPECT_EQ(mapPoint(w, index, MIRRORED, left, uv, 0u, 1u, false).jacobian, 0.0);
    EXPECT_TRUE(mapPoint(w, index, SQUARE, primitiveAt(w, index, SQUARE, 0u, uv, false), uv, 0u, 1u, false).jacobian > 0.0);

    // A point without partner is lost, its neighbour isn't, and from the other side nothing leads to it.
    expectReturn(w, index, LOST, uv, false, 1.0);
    EXPECT_EQ(mapPoint(w, index, LOST, primitiveAt(w, index, LOST, 0u, uv, true), uv, 0u, 1u, true).jacobian, 0.0);

    // Beyond the budget a query fails whole, both ways.
    uint tile = primitiveAt(w, index, TILED, 1u, uv, false);
    EXPECT_EQ(uvLookup(w, index, TILED, 0u, uv).count, 0u);
    EXPECT_EQ(mapPoint(w, index, TILED, tile, uv, 1u, 0u, true).jacobian, 0.0);

    // Triangles without area in UV are never found; a triangle that isn't there maps nowhere; outside the chart there is nothing.
    EXPECT_EQ(uvLookup(w, index, FLAT, 0u, vec2(uv.x)).count, uvLookup(w, index, FLAT, 1u, vec2(uv.x)).count);
    EXPECT_EQ(uvLookup(w, index, FLAT, 0u, uv).count, 1u);
    EXPECT_EQ(mapPoint(w, index, SQUARE, 12345u, uv, 0u, 1u, true).jacobian, 0.0);
    EXPECT_EQ(uvLookup(w, index, SQUARE, 0u, uv + 1.0).count, 0u);
    EXPECT_EQ(uvLookup(w, index, SQUARE, 0u, -uv).count, 0u);
}
