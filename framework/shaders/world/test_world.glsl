// SPDX-License-Identifier: MIT
// For tests: a World whose arrays lie in the test's scratch memory. Pass 0 writes them, as in
// `TestMaterials(testArray(TEST_MATERIALS)).at[0] = testMaterial();`, pass 1 reads them through testWorld(). Each array has 128 KiB.
#include "base/test.glsl"
#include "world/ray.h"
#include "world/world.h"

const uint TEST_INSTANCES = 0u, TEST_PRIMITIVES = 1u, TEST_EMITTERS = 2u, TEST_POSITIONS = 3u, TEST_VERTICES = 4u, TEST_MATERIALS = 5u;
const uint TEST_TEXTURES = 6u, TEST_LIGHTS = 7u, TEST_ENVIRONMENT = 8u, TEST_TEXELS = 9u, TEST_LAYERS = 10u, TEST_SUMS = 16u;

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer TestInstances { InstanceRecord at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer TestPrimitives { PrimitiveRecord at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer TestUints { uint at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer TestPositions { vec4 at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer TestVertices { VertexRecord at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer TestMaterials { MaterialRecord at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer TestLayers { LayersRecord at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer TestTextures { TextureRecord at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer TestLights { LightRecord at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer TestEnvironment { EnvironmentTexel at[]; };

uint64_t testArray(uint array) { return testPush.results + 16ul + 48ul * uint64_t(TEST_RECORDS) + 131072ul * uint64_t(array); }

/// No lights, no environment; a unit camera at the origin that looks along -Z.
World testWorld() {
    World w;
    w.nodes = w.triangles = w.traceInstances = w.bottomLevels = w.tlas = 0ul;
    w.roots = w.levels = w.dissolves = w.lightLevels = UintArray(0ul);
    w.meshLevels = LevelArray(0ul);
    w.meshes = MeshArray(0ul);
    w.gridBase = w.gridScale = w.sceneCenter = vec3(0.0);
    w.topRoot = NONE;
    w.instanceCount = w.lightCount = w.frameKey = 0u;
    w.instances = InstanceArray(testArray(TEST_INSTANCES));
    w.primitives = PrimitiveArray(testArray(TEST_PRIMITIVES));
    w.emitters = UintArray(testArray(TEST_EMITTERS));
    w.positions = Vec4Array(testArray(TEST_POSITIONS));
    w.vertices = VertexArray(testArray(TEST_VERTICES));
    w.materials = MaterialArray(testArray(TEST_MATERIALS));
    w.layers = LayersArray(testArray(TEST_LAYERS));
    w.textures = TextureArray(testArray(TEST_TEXTURES));
    w.lights = LightArray(testArray(TEST_LIGHTS));
    w.environment = EnvironmentArray(testArray(TEST_ENVIRONMENT));
    w.environmentSize = uvec2(1u);
    w.environmentRotation = 0.0;
    w.environmentLight = NONE;
    w.sceneRadius = 1.0;
    w.camera = CameraRecord(vec3(0), 0.0, vec3(1, 0, 0), 1.0, vec3(0, 1, 0), 0.01, vec3(0, 0, -1), 0u);
    return w;
}

TextureSlotRecord testSlot(uint id) { return TextureSlotRecord(id, 0u, vec3(1, 0, 0), vec3(0, 1, 0)); }

MaterialRecord testMaterial() {
    TextureSlotRecord none = testSlot(NONE);
    return MaterialRecord(vec4(1), vec3(0), 0.0, 1.0, 1.0, 0.0, 1.5, vec3(0), 0.5, 0u, NONE, none, none, none, none, none, uvec2(0));
}

/// The identity, or any rows.
InstanceRecord testInstance(vec4 row0, vec4 row1, vec4 row2) {
    uint flags = dot(row0.xyz, cross(row1.xyz, row2.xyz)) < 0.0 ? INSTANCE_MIRRORED : 0u;
    return InstanceRecord(vec4[](row0, row1, row2), vec4(3), 0u, NONE, flags, NONE);
}

LightRecord testLight(uint type, float pmf) {
    return LightRecord(type, NONE, NONE, pmf, vec3(0), 0.0, vec3(0, -1, 0), 0.0, vec3(1), 0xffffffffu, 0u, 0.0, uvec2(0));
}
