// SPDX-License-Identifier: MIT
// A scene as it was loaded: meshes with their levels, materials, textures, nodes, lights, camera, environment. Plain data on the CPU.
#pragma once
#include <framework/core/api.h>
#include <framework/core/files.h>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lodestir {

inline constexpr std::uint32_t none = 0xffffffffu;  ///< "no such index"

enum class Wrap : std::uint8_t { repeat, clamp, mirror };

/// 8-bit RGBA texels, top row first. Colour textures are stored sRGB-encoded and decoded when read.
struct Texture {
    std::string name;
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;  ///< 4 * width * height
    bool srgb = false;
    bool nearest = false;            ///< magnification filter of the sampler
    Wrap wrapU = Wrap::repeat, wrapV = Wrap::repeat;
};

/// How a material reads a texture: which one, which UV set, and KHR_texture_transform:
/// uv' = offset + (c x + s y, -s x + c y) with (x, y) = scale * uv, c and s of the rotation.
struct TextureSlot {
    std::uint32_t texture = none;
    std::uint32_t uvSet = 0;  ///< 0 or 1
    glm::vec2 offset{0}, scale{1};
    float rotation = 0;  ///< radians, counter-clockwise in glTF's convention
};

/// What few materials have, all of it at its neutral value: KHR_materials_specular, _sheen, _anisotropy and _clearcoat.
struct MaterialLayers {
    float specular = 1;                  ///< scales the dielectric's reflectance
    glm::vec3 specularColor{1};          ///< scales its reflectance at normal incidence
    glm::vec3 sheenColor{0};
    float sheenRoughness = 0;
    float anisotropy = 0;                ///< strength, 0 to 1
    float anisotropyRotation = 0;        ///< radians from the tangent towards the bitangent
    float coat = 0, coatRoughness = 0, coatNormalScale = 1;
    TextureSlot specularMap, specularColorMap, sheenColorMap, sheenRoughnessMap, anisotropyMap, coatMap, coatRoughnessMap, coatNormalMap;
};

enum class AlphaMode : std::uint8_t { opaque, mask, blend };

/// glTF 2.0 metallic-roughness material with emissive_strength, transmission, ior and volume (only: thin or solid, attenuation), unlit,
/// and the layers above.
struct Material {
    std::string name;
    glm::vec4 baseColor{1};
    float metallic = 1, roughness = 1;
    glm::vec3 emission{0};       ///< emissiveFactor * emissiveStrength, radiance
    float normalScale = 1, occlusionStrength = 1;
    float transmission = 0, ior = 1.5f;
    bool solid = false;          ///< a closed volume that refracts (KHR_materials_volume with thickness > 0); else thin-walled
    glm::vec3 attenuationColor{1};
    float attenuationDistance = 0;  ///< 0: none
    AlphaMode alphaMode = AlphaMode::opaque;
    float alphaCutoff = 0.5f;
    bool doubleSided = false;
    bool unlit = false;             ///< emission and emissiveMap are the base colour's, which vertex colours tint; nothing scatters
    /// Are its surfaces listed as lights, for light samples to find? Unlit ones are not, though what they emit lights what it falls on: a scan
    /// of millions of triangles is no lamp.
    bool isLight() const { return emission != glm::vec3(0) && !unlit; }
    std::optional<MaterialLayers> layers;
    TextureSlot baseColorMap, metallicRoughnessMap, normalMap, occlusionMap, emissiveMap, transmissionMap;
};

/// What a morph target adds to the vertices of a level at weight 1. Each array is empty or as long as the level's positions.
struct MorphTarget {
    std::vector<glm::vec3> positions, normals, tangents;
};

/// The joints that a vertex follows: places in its mesh's skin, and weights that sum to 1.
struct VertexJoints {
    std::array<std::uint16_t, 8> joints{};
    std::array<float, 8> weights{};
};

/// The triangles of one mesh at one level of detail. All vertex arrays are empty or as long as `positions`.
struct MeshLevel {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;    ///< always filled by the loader (from faces where the file has none)
    std::vector<glm::vec4> tangents;   ///< xyz + sign; filled where the material has a normal map
    std::vector<glm::vec2> uv0, uv1;
    std::vector<glm::vec4> colors;     ///< linear; empty means white
    std::vector<glm::uvec3> triangles;
    std::vector<std::uint32_t> materials;  ///< of each triangle, index into Scene::materials
    float error = 0;                   ///< measured geometric error against level 0, object units (0 for level 0)
    float coverage = 0;                ///< MSFT_screencoverage: of the screen, down to which the file would show this level; 0: says nothing
    std::vector<MorphTarget> targets;  ///< as many as its mesh has weights, or none
    std::vector<VertexJoints> joints;  ///< empty: no skin
    std::vector<glm::uvec3> flatFaces; ///< triangles whose vertices have the face's normal for want of another, to be made anew in each pose
};

inline constexpr int maxLevels = 8;

/// Joints that bend a mesh (glTF 2.0, section 3.7.3.3): vertices go through the inverse bind matrix and the matrix of the joint's node.
struct Skin {
    std::vector<std::uint32_t> nodes;
    std::vector<glm::mat4> inverseBind;  ///< one a node
};

struct Mesh {
    std::string name;
    std::vector<MeshLevel> levels;  ///< finest first, 1..maxLevels
    std::vector<float> weights;     ///< of the morph targets, while nothing animates them
    std::uint32_t node = none;      ///< whose animation moves the weights
    std::uint32_t skin = none;      ///< takes the vertices into the world, whatever its instance's node does
    std::uint32_t shaper = none;    ///< node of its only instance, whose matrix may be flat: the vertices take its shape (flattening.h)
    bool deforms() const { return skin != none || shaper != none || !weights.empty(); }
};

/// A node of the hierarchy. Its local matrix is TRS unless `matrix` is given.
struct Node {
    std::string name;
    std::uint32_t parent = none;
    glm::vec3 translation{0};
    glm::quat rotation{1, 0, 0, 0};
    glm::vec3 scale{1};
    std::optional<glm::mat4> matrix;
};

struct Instance {
    std::string name;
    std::uint32_t mesh = 0, node = 0;
};

enum class LightType : std::uint32_t { point, spot, directional };

/// A light without extent (KHR_lights_punctual units: candela for point and spot, lux for directional), at a node, shining along its -Z.
struct Light {
    std::string name;
    LightType type = LightType::point;
    glm::vec3 color{1};
    float intensity = 1;
    float range = 0;  ///< 0: unlimited
    float innerCone = 0, outerCone = 0.785398f;  ///< half angles, radians
    std::uint32_t node = 0;
};

enum class Interpolation : std::uint8_t { step, linear, cubic };
enum class AnimatedValue : std::uint8_t { translation, rotation, scale, weight };

/// Keys of one value of one node. `values` has 4 floats a key (xyz0, quaternion xyzw, or a weight and 000), 3 * 4 a key for cubic
/// (in-tangent, value, out-tangent).
struct AnimationChannel {
    std::uint32_t node = 0;
    AnimatedValue value = AnimatedValue::translation;
    std::uint32_t target = 0;  ///< weight: of which morph target
    Interpolation interpolation = Interpolation::linear;
    std::vector<float> times;  ///< seconds, rising
    std::vector<glm::vec4> values;
};

struct CameraKey {
    float frame = 0;
    glm::vec3 position{0, 0, 5}, target{0}, up{0, 1, 0};
    float fovy = 0.785398f;  ///< radians, vertical
    float height = 0;        ///< of what an orthographic camera sees, scene units; 0: perspective
    float aperture = 0;      ///< lens radius, scene units; 0: pinhole
    float focus = 1;         ///< distance of the plane in focus along the view direction, scene units
    bool operator==(const CameraKey&) const = default;
};

/// Keys over frames (linear between, constant outside), or riding on a node of the file.
struct CameraPath {
    std::vector<CameraKey> keys;  ///< at least one
    std::uint32_t node = none;    ///< when set: pose from this node (looking along -Z), lens from keys[0]
};

enum class EnvironmentType : std::uint8_t { constant, sky, map };

/// Light from infinitely far, as an equirectangular map: row 0 is +Y, the middle column looks along -Z, columns run towards +X;
/// the exact rule is in environment.h.
struct Environment {
    EnvironmentType type = EnvironmentType::constant;
    int width = 1, height = 1;
    std::vector<glm::vec3> radiance{glm::vec3(0)};  ///< width * height, strength included
    float rotation = 0;                             ///< radians around +Y
};

enum class LodMode : std::uint8_t { finest, screenError, distance, schedule, stochastic };
struct LodSwitch { int frame = 0; std::uint32_t instance = none; int level = 0; };  ///< instance none: all
/// How levels are chosen where a graph doesn't say.
struct LodPolicy {
    LodMode mode = LodMode::finest;
    float pixelError = 1;
    std::vector<LodSwitch> schedule;
};

struct Scene {
    Path file;                        ///< scene file or model it came from
    std::string about;
    std::vector<Mesh> meshes;
    std::vector<Skin> skins;
    std::vector<Material> materials;  ///< at least one
    std::vector<Texture> textures;
    std::vector<Node> nodes;          ///< parents before children
    std::vector<Instance> instances;
    std::vector<Light> lights;
    std::vector<AnimationChannel> animation;
    float animationLength = 0;        ///< seconds; animation repeats
    float framesPerSecond = 30;
    float animationSpeed = 1;         ///< animation seconds per second
    CameraPath camera;
    Environment environment;
    std::vector<int> cuts;            ///< frames at which history is void
    LodPolicy lod;
    float exposure = 0;               ///< stops, for passes that make images for eyes
    std::size_t droppedTriangles = 0; ///< triangles of the files that were left out: without area, or with a vertex that is not finite
    std::vector<std::string> notes;   ///< what the loader decided: camera framed, sky added, extensions ignored, ...

    bool deforms() const;             ///< whether any mesh does
    /// Object to world, given those of all nodes: the identity for a mesh whose skin takes it there, size and place for one that its node shapes.
    LODESTIR_API glm::mat4 instanceMatrix(const Instance& instance, const std::vector<glm::mat4>& nodeMatrices) const;
    /// World matrices of all nodes at a frame.
    LODESTIR_API std::vector<glm::mat4> nodeMatrices(float frame) const;
    /// Weights of the morph targets of all meshes at a frame.
    LODESTIR_API std::vector<std::vector<float>> morphWeights(float frame) const;
    /// Camera pose and lens at a frame.
    LODESTIR_API CameraKey cameraAt(float frame) const;
    /// Bounds of all instances' finest levels as they stand at frame 0; {1e30, -1e30} when empty.
    LODESTIR_API std::array<glm::vec3, 2> bounds() const;
};

/// Loads a scene file (.json) or a model (.gltf, .glb). Error with every problem found.
LODESTIR_API Scene loadScene(const Path& path);

}  // namespace lodestir
