// SPDX-License-Identifier: MIT
// Spheres with levels, for tests of what chooses among them.
#include "world/test_world.glsl"

const uint TEST_LEVELS = 10u, TEST_MESHES = 11u;
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer TestLevels { LevelRecord at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer TestMeshes { MeshRecord at[]; };

// Instances, all of spheres of radius 1 whose levels, of 4096, 1024, 256 and 64 triangles, are off by 0, 0.01, 0.04, 0.16.
const uint FAR_ONE = 0u;   // twice as large, 12 away: 10 from the sphere, errors 0, 0.2, 0.8, 3.2 pixels
const uint AROUND = 1u;    // around the camera
const uint PINNED = 2u;    // as the first, but its mesh has one level
const uint FLATTENED = 3u; // twice as large along one axis, half as large along the others

void writeLevels() {
    for (uint level = 0u; level < 4u; ++level)
        for (uint mesh = 0u; mesh < 2u; ++mesh)
            TestLevels(testArray(TEST_LEVELS)).at[mesh * LEVELS + level] =
                LevelRecord(0u, 4096u >> (2u * level), level == 0u ? 0.0 : 0.01 * exp2(2.0 * float(level - 1u)), 0u);
    TestMeshes(testArray(TEST_MESHES)).at[0] = MeshRecord(vec3(0), 1.0, 4u, uvec3(0));
    TestMeshes(testArray(TEST_MESHES)).at[1] = MeshRecord(vec3(0), 1.0, 1u, uvec3(0));
    TestInstances instances = TestInstances(testArray(TEST_INSTANCES));
    instances.at[FAR_ONE] = instances.at[PINNED] = testInstance(vec4(2, 0, 0, 0), vec4(0, 2, 0, 0), vec4(0, 0, 2, -12));
    instances.at[PINNED].mesh = 1u;
    instances.at[AROUND] = testInstance(vec4(1, 0, 0, 0.5), vec4(0, 1, 0, 0), vec4(0, 0, 1, 0));
    instances.at[FLATTENED] = testInstance(vec4(0.5, 0, 0, 0), vec4(0, 2, 0, 0), vec4(0, 0, 0.5, -12));
}

World levelsWorld() {
    World w = testWorld();
    w.meshLevels = LevelArray(testArray(TEST_LEVELS));
    w.meshes = MeshArray(testArray(TEST_MESHES));
    w.camera.pixelAngle = 0.01;
    return w;
}
