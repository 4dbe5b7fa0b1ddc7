// SPDX-License-Identifier: MIT
// World: everything of the scene a shader may ask, as device addresses. One struct, the same in C++ and GLSL (scalar layout).
// GLSL code loads it once (`World w = world();`), hands it on, and reads arrays as `w.positions.at[i]`.
#ifndef LODESTIR_WORLD_H
#define LODESTIR_WORLD_H
#include "base/shared.h"

LODESTIR_SHARED_BEGIN

const uint NONE = 0xffffffffu;   // no such index
const uint TEXEL = 0x80000000u;  // numbers of primitives from here on: TEXEL + texel's place in the arrays of its mesh's ImpostorRecord (impostor/impostors.h)
const uint LEVELS = 8u;         // most levels of a mesh: stride of World.roots

// Attributes of a vertex that traversal does not need.
struct VertexRecord {
    uint normal;   // octahedral, snorm16 x 2
    uint tangent;  // the same with bit 0 replaced by the sign (1: bitangent = -cross(n, t)); 0: none (base/pack.glsl has the layouts)
    vec2 uv0, uv1;
    uvec2 color;   // half floats, linear
};

// A triangle for shading, in BVH order (Hit.primitive indexes it). Vertex indices are global.
struct PrimitiveRecord {
    uint v0, v1, v2;
    uint material;
};

// Where an instance stands when the shutter opens, and what it shows. Rows of 3x4 matrices, point p maps to (dot(row0.xyz, p) + row0.w, ...).
struct InstanceRecord {
    vec4 toWorld[3];
    vec4 rounding;    // of its linear part M and translation t, sizes taken by element: |M^-1| |t|, and what |M^-1| |M| mixes (scene/bvh/bvh.h, traceRounding)
    uint mesh;
    uint firstLight;  // index of the light of its mesh's first emissive triangle at the finest level, NONE when it has none
    uint flags;       // INSTANCE_*
    uint coarserLights;  // place in World.lightLevels; NONE where there are none at the finest level, or no other levels
};
const uint INSTANCE_MIRRORED = 1u;  // the way from the file's vertices to the world turns triangles inside out
const uint INSTANCE_HIDDEN = 2u;    // nothing is left of it
const uint INSTANCE_MOVES = 4u;     // while the shutter is open: World.closing has where to

// The same instance as traversal reads it: world space to grid steps of the mesh (scene/bvh/bvh.h, BvhGrid). With the origin that triangles are measured
// from in world space, o = (row0.w, row1.w, row2.w), a point p maps to (dot(row0.xyz, p - o), ...): subtracted first, so that precision
// doesn't depend on how far from the origin the instance is. 64 bytes, loaded by 8 lanes.
struct TraceInstance {
    vec4 toGrid[3];
    uint mesh;
    vec3 boxes;  // base of the grid in steps from o: where boxes are measured from
};

// How a material reads a texture: uv' = (dot(row0.xy, uv) + row0.z, dot(row1.xy, uv) + row1.z).
struct TextureSlotRecord {
    uint texture;  // NONE: no texture
    uint uvSet;
    vec3 row0, row1;
};

// A mesh at one of its levels. Levels that a mesh does not have repeat its coarsest.
struct LevelRecord {
    uint firstPrimitive;  // in World.primitives
    uint primitiveCount;
    float error;          // measured distance to level 0, object units
    uint bytes;           // that its triangles, nodes and vertices take
};

// What selecting a level asks of a mesh.
struct MeshRecord {
    vec3 center;   // of the sphere around all its levels, object space
    float radius;
    uint levels;   // that it has
    uvec3 pad;
};

struct MaterialRecord {
    vec4 baseColor;
    vec3 emission;
    float metallic;
    float roughness;
    float normalScale;
    float transmission;
    float ior;
    vec3 attenuation;   // absorption per unit length inside a solid, 1/scene unit
    float alphaCutoff;
    uint flags;         // MATERIAL_*
    uint layers;        // index in World.layers, NONE: a plain material
    TextureSlotRecord baseColorMap, metallicRoughnessMap, normalMap, emissiveMap, transmissionMap;
    uvec2 pad;
};
const uint MATERIAL_DOUBLE_SIDED = 1u;
const uint MATERIAL_MASK = 2u;
const uint MATERIAL_BLEND = 4u;
const uint MATERIAL_SOLID = 8u;     // refracts; otherwise transmission is thin-walled
const uint MATERIAL_EMISSIVE = 16u;
const uint MATERIAL_VERTEX_COLOR = 32u;
const uint MATERIAL_UNLIT = 64u;    // its emission is its base colour: vertex colours count
const uint MATERIAL_PANE = 128u;    // may let light go straight on: a delta lobe of its BSDF does

// What few materials have: KHR_materials_specular, _sheen, _anisotropy, _clearcoat.
struct LayersRecord {
    vec3 specularColor;
    float specular;
    vec3 sheenColor;
    float sheenRoughness;
    vec2 anisotropyDirection;  // cosine and sine of the rotation from the tangent towards the bitangent
    float anisotropy;
    float coat, coatRoughness, coatNormalScale;
    TextureSlotRecord maps[8]; // LAYER_*
    uvec2 pad;
};
const uint LAYER_SPECULAR = 0u;         // A
const uint LAYER_SPECULAR_COLOR = 1u;
const uint LAYER_SHEEN_COLOR = 2u;
const uint LAYER_SHEEN_ROUGHNESS = 3u;  // A
const uint LAYER_ANISOTROPY = 4u;       // RG: direction in [-1, 1], B: strength
const uint LAYER_COAT = 5u;             // R
const uint LAYER_COAT_ROUGHNESS = 6u;   // G
const uint LAYER_COAT_NORMAL = 7u;
const uint LAYER_MAPS = 8u;

struct TextureRecord {
    uint64_t texels;      // RGBA8, mip levels one after the other, each (max(1, w >> l)) x (max(1, h >> l))
    uint width, height;
    uint mips;
    uint flags;           // TEXTURE_*
    uvec2 pad;
};
const uint TEXTURE_SRGB = 1u;
const uint TEXTURE_NEAREST = 2u;
const uint TEXTURE_CLAMP_U = 4u;
const uint TEXTURE_CLAMP_V = 8u;
const uint TEXTURE_MIRROR_U = 16u;
const uint TEXTURE_MIRROR_V = 32u;

// A light: an emissive triangle, a light without extent, or the environment.
struct LightRecord {
    uint type;        // LIGHT_*
    uint instance;    // triangle: of which instance
    uint primitive;   // triangle: which PrimitiveRecord
    float pmf;        // probability that this light is chosen
    vec3 position;    // point, spot: world space
    float cosOuter;   // spot
    vec3 direction;   // spot, directional: the way the light shines, unit
    float cosInner;   // spot
    vec3 intensity;   // point, spot: W/sr; directional: irradiance; times colour
    uint last;        // the last of the numbers in 0 .. 2^32 - 1 that choose this light: lights have them one after the other, each its share
    uint start;       // at place i: the light that the first number x with floor(x lightCount / 2^32) = i chooses
    float range;      // point, spot: distance of its end, 0: none
    uvec2 pad;
};
const uint LIGHT_TRIANGLE = 0u;
const uint LIGHT_POINT = 1u;
const uint LIGHT_SPOT = 2u;
const uint LIGHT_DIRECTIONAL = 3u;
const uint LIGHT_ENVIRONMENT = 4u;

// One texel of the environment map: radiance and the density (per unit square of uv) with which the alias table picks it.
struct EnvironmentTexel {
    vec3 radiance;
    float density;
    float aliasProbability;
    uint alias;
    uvec2 pad;
};

struct CameraRecord {
    vec3 position;
    float aperture;    // lens radius; 0 where the camera is orthographic
    vec3 right;        // unit vectors times the half extent of the image plane: at distance 1, or at any where the camera is orthographic
    float focus;       // distance of the plane in focus
    vec3 up;
    float pixelAngle;  // angle of one pixel at the image centre, radians; orthographic: its height, scene units
    vec3 forward;      // unit
    uint orthographic; // 1: all rays go along `forward`
};

#ifdef __cplusplus
}  // namespace lodestir
#define LODESTIR_ARRAY(name, T) static_assert(sizeof(T) == sizeof(uint) || sizeof(T) % 16 == 0, "read in texels of 16 bytes where reading by address is slow");
#define LODESTIR_ARRAY_OF(name) uint64_t
namespace lodestir {
#else
#define LODESTIR_ARRAY(name, T) layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer name { T at[]; };
#define LODESTIR_ARRAY_OF(name) name
#endif

LODESTIR_ARRAY(UintArray, uint)
LODESTIR_ARRAY(Vec4Array, vec4)
LODESTIR_ARRAY(VertexArray, VertexRecord)
LODESTIR_ARRAY(PrimitiveArray, PrimitiveRecord)
LODESTIR_ARRAY(LevelArray, LevelRecord)
LODESTIR_ARRAY(MeshArray, MeshRecord)
LODESTIR_ARRAY(InstanceArray, InstanceRecord)
LODESTIR_ARRAY(MaterialArray, MaterialRecord)
LODESTIR_ARRAY(LayersArray, LayersRecord)
LODESTIR_ARRAY(TextureArray, TextureRecord)
LODESTIR_ARRAY(LightArray, LightRecord)
LODESTIR_ARRAY(EnvironmentArray, EnvironmentTexel)

struct World {
    // Traversal (scene/bvh/bvh.h has the layouts).
    uint64_t nodes;                                  // 64-byte nodes of all mesh levels, then of the top level
    uint64_t triangles;                              // 48-byte triangles in grid space, BVH order; index = Hit.primitive
    uint64_t traceInstances;                         // TraceInstance of each instance
    LODESTIR_ARRAY_OF(UintArray) roots;              // node reference of mesh m at level l: roots[m * LEVELS + l]
    LODESTIR_ARRAY_OF(UintArray) levels;             // level shown of each instance
    LODESTIR_ARRAY_OF(UintArray) levelsChanged;      // one word: 1 where any of them differs from last frame's
    LODESTIR_ARRAY_OF(UintArray) dissolves;          // of each instance, how many of the rays see the next coarser level (world/ray_levels.glsl); 0: none
    uint64_t bottomLevels;                           // for ray queries: address of the driver's structure of mesh m at level l at m * LEVELS + l; 0: none
    uint64_t tlas;                                   // the driver's top level over the levels shown, set by the runner; 0: none
    vec3 gridBase;                                   // of the top level: world = base + scale * grid
    uint topRoot;                                    // node reference
    vec3 gridScale;
    uint instanceCount;
    uint frameKey;                                   // of run and frame: by it pixels draw the numbers that their rays choose levels and times by
    float time;                                      // at which it is seen, share of the exposure (world/exposure.glsl)

    // Geometry and materials.
    LODESTIR_ARRAY_OF(InstanceArray) instances;
    LODESTIR_ARRAY_OF(Vec4Array) closing;            // of each instance, its toWorld when the shutter closes; read where it moves
    LODESTIR_ARRAY_OF(PrimitiveArray) primitives;
    LODESTIR_ARRAY_OF(LevelArray) meshLevels;        // mesh m at level l: meshLevels[m * LEVELS + l]
    LODESTIR_ARRAY_OF(MeshArray) meshes;
    LODESTIR_ARRAY_OF(UintArray)
    emitters;  // of each primitive: its place among the lights of its mesh at its level, NONE: no light (unlit surfaces emit, but aren't sampled)
    LODESTIR_ARRAY_OF(Vec4Array) positions;          // xyz, object space
    LODESTIR_ARRAY_OF(VertexArray) vertices;
    LODESTIR_ARRAY_OF(MaterialArray) materials;
    LODESTIR_ARRAY_OF(LayersArray) layers;
    LODESTIR_ARRAY_OF(TextureArray) textures;

    // Light.
    LODESTIR_ARRAY_OF(LightArray) lights;            // lightCount of the finest levels, and behind them those of coarser ones (light/light_levels.glsl)
    LODESTIR_ARRAY_OF(UintArray) lightLevels;        // of an instance with lights at several levels: where those of level 1 begin, of 2, ..., and the end
    LODESTIR_ARRAY_OF(EnvironmentArray) environment; // environmentSize.x * environmentSize.y texels
    uvec2 environmentSize;
    float environmentRotation;                       // radians around +Y
    uint environmentLight;                           // index in lights, NONE: black
    uint lightCount;
    uint lightRecords;                               // in lights, those of coarser levels too
    float sceneRadius;                               // of the sphere around all instances
    vec3 sceneCenter;

    uint64_t impostors;                              // Impostors (impostor/impostors.h) that camera hits may be texels of; 0: none

    CameraRecord camera;
    CameraRecord closingCamera;                      // when the shutter closes
};

LODESTIR_SHARED_END
LODESTIR_SHARED(World, "world/world.h")
#endif
