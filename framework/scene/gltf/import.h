// SPDX-License-Identifier: MIT
// What the steps of loading a glTF model share: the file, the scene that grows, and what was found wrong or worth saying.
#pragma once
#include <framework/scene/gltf/file.h>
#include <framework/scene/scene.h>

#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace lodestir {

struct GltfImport {
    const GltfFile& file;
    Scene& scene;
    Problems& problems;
    std::uint32_t materialBase = 0;        ///< Scene::materials index of the file's material 0
    std::uint32_t defaultMaterial = none;  ///< of primitives without one, made when first needed
    std::vector<std::uint32_t> nodes;      ///< Scene::nodes index of each node of the file, `none` where it is not in the scene
    struct Skinned {
        std::uint32_t mesh;  ///< Scene::meshes index
        int skin;            ///< of the file
    };
    std::vector<Skinned> skinned;          ///< meshes that wait for their skins
    int variant = -1;                      ///< of KHR_materials_variants, -1: none is chosen
    int animation = -1;                    ///< that plays, -1: all
    std::set<std::string> noted;           ///< each note is said once

    /// Adds a note "file name: text" to the scene.
    void note(const std::string& text);
    /// The same for something that is left out, the model being shown without it, because of an error.
    void noteLeftOut(const std::string& what, const Error& cause);
    /// Gathers an error at a JSON pointer of the file.
    void problem(const std::string& pointer, const std::string& what, const std::string& hint = {});
};

/// A tinygltf extension object of a thing, or nullptr.
const tinygltf::Value* findExtension(const tinygltf::ExtensionMap& extensions, const char* name);

/// Member `key` of an extension object (which may be nullptr) as a number, else `otherwise`.
float numberOf(const tinygltf::Value* object, const char* key, float otherwise);
/// The same for an integer that fits into an int.
int integerOf(const tinygltf::Value* object, const char* key, int otherwise);
/// The same for an array of at least three numbers, all of them finite.
glm::vec3 vectorOf(const tinygltf::Value* object, const char* key, glm::vec3 otherwise);

}  // namespace lodestir
