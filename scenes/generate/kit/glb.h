// SPDX-License-Identifier: MIT
// Writes a binary glTF 2.0 file: geometries, materials with embedded PNG pictures, meshes and nodes that share them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "mesh.h"
#include "picture.h"

namespace lodestir::generate {

/// A metallic-roughness material with the extensions path tracers read (emissive_strength, transmission, volume, ior, clearcoat, sheen,
/// anisotropy, specular, unlit).
/// Texture members are indices from Glb::addPicture, or none.
struct Material {
    static constexpr int none = -1;

    std::string name;
    glm::vec3 color{1};
    float alpha = 1;  ///< below 1 the material blends: the rest of the light passes straight on
    float roughness = 1;
    float metalness = 0;
    glm::vec3 emission{0};  ///< radiance, any size
    float transmission = 0;
    float ior = 1.5f;
    float thickness = 0;       ///< metres; above 0 the mesh bounds a volume
    glm::vec3 attenuation{1};  ///< what is left of white light after `attenuationDistance`
    float attenuationDistance = std::numeric_limits<float>::infinity();
    float coat = 0, coatRoughness = 0;
    glm::vec3 sheen{0};
    float sheenRoughness = 0;
    float anisotropy = 0, anisotropyRotation = 0;  ///< strength; radians from the direction of u
    float specular = 1;
    glm::vec3 specularColor{1};
    bool mask = false;  ///< cut out where alpha is below one half
    bool doubleSided = false;
    bool unlit = false;  ///< shows its colour as it is: emits it, reflects nothing, and is no lamp (KHR_materials_unlit)
    int colorPicture = none;
    int normalPicture = none;
    int roughnessPicture = none;
    float normalScale = 1;
};

/// A light without extent (KHR_lights_punctual): it shines along its node's -z.
struct LightSource {
    enum class Kind { point, spot, directional };

    std::string name;
    Kind kind = Kind::point;
    glm::vec3 color{1};
    float intensity = 1;     ///< cd; lx of a directional light
    float innerDegrees = 0;  ///< of a spot: half angle that is fully lit
    float outerDegrees = 45;
};

/// What an animation changes of a node; weight: of the morph target of its mesh.
enum class Motion { translation, rotation, scale, weight };

/// Where a node stands.
struct Placement {
    glm::vec3 translation{0};
    glm::quat rotation{1, 0, 0, 0};
    glm::vec3 scale{1};
};

/// A coarser level of a node: a mesh that stands where it stands.
struct Level {
    int mesh;
    float error;  ///< largest distance to the finest level, in units of the mesh
};

/// A joint of a skin: where it is in the mesh at rest, and the number of the joint that it hangs on, which comes before it; -1: none.
struct Joint {
    std::string name;
    glm::vec3 position{0};
    int parent = -1;
};

/// What a vertex follows: joints by their numbers, and shares whose sum is one.
struct Hold {
    glm::ivec4 joints{0};
    glm::vec4 shares{1, 0, 0, 0};
};

/// A rotation that sends -z along `direction`, for lights.
glm::quat turnTo(const glm::vec3& direction);

/// A rotation about +y, degrees, counter-clockwise seen from above.
glm::quat turnY(float degrees);

/// A named thing made of parts, each with its own material.
struct Model {
    std::string name;
    std::vector<std::pair<int, Mesh>> parts;

    /// Adds a mesh to the part that has this material.
    void add(int material, const Mesh& mesh);
};

class Glb {
public:
    Glb();
    Glb(Glb&& other) noexcept;
    ~Glb();

    int addPicture(const std::string& name, const Picture& picture);

    /// `material` wearing painted pictures; copies of it with another colour share them.
    Material dressed(Material material, const Textures& textures);
    int addMaterial(const Material& material);

    /// Vertex data that several meshes may share. Tangents are written where Mesh::hasTangents says so. `morphed`: positions at weight 1 of a morph
    /// target, which starts at weight 0; empty: none.
    int addGeometry(const Mesh& mesh, const std::vector<glm::vec3>& morphed = {});

    /// Lets each vertex of a geometry follow joints; before meshes are made of it.
    void hold(int geometry, const std::vector<Hold>& holds);
    int addMesh(const std::string& name, const std::vector<std::pair<int, int>>& geometryAndMaterial);
    /// All of one material.
    int addMesh(const std::string& name, const Mesh& mesh, int material);

    /// Computes tangents for the parts whose material has a normal picture, and adds the mesh.
    int addMesh(const Model& model);
    int addNode(const std::string& name, int mesh, const Placement& placement = {});

    /// addMesh and addNode in one, for things that stand once.
    int addNode(const Model& model, const Placement& placement = {});
    int addNode(const LightSource& light, const Placement& placement = {});

    /// Gives a node coarser levels (MSFT_lod), finer to coarser.
    void addLevels(int node, const std::vector<Level>& levels);

    /// Gives a node whose mesh is held a skeleton that stands where the node stands. Returns the nodes of its joints.
    std::vector<int> addSkin(int node, const std::vector<Joint>& joints);

    /// Linear keys at the given seconds; a rotation's are quaternions (x, y, z, w), a weight's is x.
    void animate(int node, Motion motion, const std::vector<float>& seconds, const std::vector<glm::vec4>& values);

    /// Writes aside and renames, so that no half-written file is ever seen.
    void write(const std::filesystem::path& path) const;

private:
    struct Tables;  ///< what was added so far, as JSON; that library is no light one to include
    std::unique_ptr<Tables> tables;
    std::vector<std::string> extensions;
    std::vector<uint8_t> binary;

    int addView(const void* data, size_t bytes, int target);
    int addAccessor(const void* data, size_t count, int components, int componentType, int target);
    int addPositions(const std::vector<glm::vec3>& positions);
    void use(const std::string& extension);
};

}  // namespace lodestir::generate
