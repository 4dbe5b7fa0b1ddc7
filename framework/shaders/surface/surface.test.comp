// SPDX-License-Identifier: MIT
// If these fail, surfaces stand or face elsewhere than the rays that hit them found them: light leaks, black edges, inverted bumps.
// groups: 32
// passes: 2
#version 460
#include "base/random.glsl"
#include "surface/surface.glsl"
#include "world/test_world.glsl"
layout(local_size_x = 64) in;

// Triangle in the plane z = 0 of its object, facing +Z, smooth normals that lean outwards, tangent +X, uv = (x, y).
// Instances 0: identity, 1: turned, stretched, moved, 2: mirrored in x. Materials 0: plain, 1: normal map (0.6, 0, 0.8), 2: inward normals.
const vec4 ROWS[9] = vec4[](vec4(1, 0, 0, 0), vec4(0, 1, 0, 0), vec4(0, 0, 1, 0),
                            vec4(0, 0, 3, 10), vec4(2, 0, 0, -4), vec4(0, 1, 0, 7),  // x -> +y twice, y -> +z, z -> +x three times
                            vec4(-1, 0, 0, 0), vec4(0, 1, 0, 0), vec4(0, 0, 1, 0));

void write() {
    TestInstances instances = TestInstances(testArray(TEST_INSTANCES));
    for (uint i = 0u; i < 3u; ++i) instances.at[i] = testInstance(ROWS[3u * i], ROWS[3u * i + 1u], ROWS[3u * i + 2u]);
    for (uint v = 0u; v < 9u; ++v) {
        vec2 uv = vec2(v % 3u == 1u ? 1.0 : 0.0, v % 3u == 2u ? 1.0 : 0.0);
        vec3 n = v < 3u ? normalize(vec3(uv - 0.333, 2.0)) : v < 6u ? vec3(0, 0, 1) : vec3(0, 0, -1);
        TestPositions(testArray(TEST_POSITIONS)).at[v] = vec4(vec3(uv, 0.0), 0);
        TestVertices(testArray(TEST_VERTICES)).at[v] = VertexRecord(packNormal(n), packTangent(vec4(1, 0, 0, 1)), uv, vec2(0), packColor(vec4(1)));
    }
    for (uint m = 0u; m < 3u; ++m) {
        MaterialRecord r = testMaterial();
        if (m == 1u) r.normalMap = testSlot(0u);
        TestMaterials(testArray(TEST_MATERIALS)).at[m] = r;
        TestPrimitives(testArray(TEST_PRIMITIVES)).at[m] = PrimitiveRecord(3u * m, 3u * m + 1u, 3u * m + 2u, m);
    }
    TestTextures(testArray(TEST_TEXTURES)).at[0] = TextureRecord(testArray(TEST_TEXELS), 1u, 1u, 1u, 0u, uvec2(0));
    TestUints(testArray(TEST_TEXELS)).at[0] = 204u | 127u << 8 | 230u << 16;  // (0.6, -0.004, 0.804)
}

void main() {
    uint id = gl_GlobalInvocationID.x;
    if (testPush.pass == 0u) {
        if (id == 0u) write();
        return;
    }
    World w = testWorld();
    vec3 u = random3(uvec2(id, 1u), 0u, 0u), v = random3(uvec2(id, 1u), 0u, 1u);
    uint instance = id % 3u, primitive = id / 3u % 3u;
    vec2 barycentrics = u.x + u.y < 1.0 ? u.xy : 1.0 - u.xy;
    vec3 d = v - 0.5, unit = safeNormalize(d, vec3(1, 0, 0));
    Surface s = surfaceAt(w, Hit(1.0, barycentrics, primitive, instance), d);

    // Where it is, known by hand.
    vec2 p = barycentrics;
    vec3 place = instance == 0u ? vec3(p, 0.0) : instance == 1u ? vec3(10.0, 2.0 * p.x - 4.0, p.y + 7.0) : vec3(-p.x, p.y, 0.0);
    EXPECT_NEAR(s.position, place, 1e-5);
    EXPECT_NEAR(positionAt(w, SurfacePoint(instance, primitive, barycentrics)), place, 1e-5);
    EXPECT_NEAR(s.uv, barycentrics, 1e-6);

    // Which way it faces. The mirrored instance keeps its front: the winding is turned round with it.
    vec3 front = instance == 1u ? vec3(1, 0, 0) : vec3(0, 0, 1);
    EXPECT_EQ(s.frontFace, dot(front, d) < 0.0);
    EXPECT_NEAR(s.normal, s.frontFace ? front : -front, 1e-6);

    // The shading normal before bending: smooth, mapped, or inward and so turned. Normals go by the inverse transpose.
    vec3 n = vec3(0, 0, 1);
    if (primitive == 0u) {
        for (uint k = 0u; k < 3u; ++k) {
            vec3 corner = vec3(k == 1u ? 1.0 : 0.0, k == 2u ? 1.0 : 0.0, 2.0) - vec3(0.333, 0.333, 0.0);
            n += normalize(corner) * (k == 0u ? 1.0 - p.x - p.y : p[k - 1u]) - (k == 2u ? vec3(0, 0, 1) : vec3(0));
        }
        n = normalize(n);
        n = instance == 1u ? normalize(vec3(n.z / 3.0, n.x / 2.0, n.y)) : instance == 2u ? vec3(-n.x, n.yz) : n;
    } else if (primitive == 1u) {
        n = normalize(vec3(204.0, 127.0, 230.0) / 255.0 * 2.0 - 1.0);
        n = instance == 1u ? vec3(n.z, n.x, n.y) : instance == 2u ? vec3(-n.x, n.yz) : n;
    } else {
        n = front;
    }
    n = s.frontFace ? n : -n;
    vec3 mirrored = reflect(unit, n);
    if (dot(mirrored, s.normal) > 1e-4) EXPECT_NEAR(s.shadingNormal, n, 3e-4);

    // What bending promises: unit, towards the viewer, and mirror directions above the triangle.
    EXPECT_NEAR(length(s.shadingNormal), 1.0, 1e-5);
    EXPECT_TRUE(dot(s.shadingNormal, unit) < 0.0);
    EXPECT_TRUE(dot(reflect(unit, s.shadingNormal), s.normal) > -1e-4);

    // Rays leave on the side they go to.
    vec3 away = safeNormalize(random3(uvec2(id, 1u), 0u, 2u) - 0.5, vec3(0, 0, 1));
    Ray ray = spawnRay(w, s, away);
    EXPECT_TRUE(dot(ray.origin - s.position, s.normal) * dot(away, s.normal) >= 0.0);
    EXPECT_TRUE(distance(ray.origin, s.position) > 1e-7 && distance(ray.origin, s.position) < 3e-5);
    Ray segment = rayBetween(s, s.position + 2.0 * away, 2e-3);
    EXPECT_NEAR(segment.origin + segment.direction, s.position + 2.0 * away, 1e-5);
    EXPECT_NEAR(segment.tMax, 0.999, 2e-5);

    // A segment to the point itself ends before the triangle, but no farther from it than rounding asks for.
    float gap;
    vec3 from = s.position + s.normal + 0.5 * away, end = segmentEnd(w, SurfacePoint(instance, primitive, barycentrics), from, gap);
    EXPECT_NEAR(end, s.position, 1e-6);
    float height = gap * abs(dot(normalize(end - from), s.normal));
    EXPECT_TRUE(height > s.rounding && height < 4.0 * s.rounding + 1e-5);
}
