// SPDX-License-Identifier: MIT
// Skins of a glTF model.
#include <framework/scene/accessor.h>
#include <framework/scene/gltf_skin.h>

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace lodestir {
namespace {

Skin skinOf(const GltfImport& import, int index) {
    const tinygltf::Skin& source = import.file.model.skins[static_cast<std::size_t>(index)];
    const std::string pointer = fmt::format("/skins/{}", index);
    Skin skin;
    if (source.joints.empty()) throw import.file.error(pointer + "/joints", "a skin needs at least one joint");
    for (std::size_t i = 0; i < source.joints.size(); ++i) {
        const int node = source.joints[i];
        const std::string place = fmt::format("{}/joints/{}", pointer, i);
        if (node < 0 || static_cast<std::size_t>(node) >= import.nodes.size())
            throw import.file.error(place, fmt::format("there is no node {}, the file has {}", node, import.nodes.size()));
        const std::uint32_t joint = import.nodes[static_cast<std::size_t>(node)];
        if (joint == none) throw import.file.error(place, fmt::format("node {} is not in the scene", node));
        skin.nodes.push_back(joint);
    }
    skin.inverseBind.assign(skin.nodes.size(), glm::mat4(1));
    if (source.inverseBindMatrices < 0) return skin;
    const std::string user = pointer + "/inverseBindMatrices";
    const Accessor matrices(import.file, source.inverseBindMatrices, user);
    if (matrices.components() != 16) throw import.file.error(user, "expected 4x4 matrices");
    if (matrices.count() < skin.nodes.size())
        throw import.file.error(user, fmt::format("{} matrices for {} joints", matrices.count(), skin.nodes.size()));
    const std::vector<float> values = matrices.floats();
    for (std::size_t i = 0; i < skin.nodes.size(); ++i)
        for (int k = 0; k < 16; ++k) skin.inverseBind[i][k / 4][k % 4] = values[16 * i + static_cast<std::size_t>(k)];
    return skin;
}

void checkJoints(const GltfImport& import, const Mesh& mesh, int skin, std::size_t joints) {
    for (const MeshLevel& level : mesh.levels)
        for (const VertexJoints& v : level.joints)
            for (std::size_t i = 0; i < v.joints.size(); ++i)
                if (v.weights[i] > 0 && v.joints[i] >= joints)
                    throw import.file.error(fmt::format("/skins/{}/joints", skin),
                                            fmt::format("a vertex of mesh \"{}\" follows joint {}, the skin has {}", mesh.name, v.joints[i], joints));
}

}  // namespace

void loadGltfSkins(GltfImport& import) {
    std::map<int, std::uint32_t> known;
    for (const auto& [mesh, skin] : import.skinned) {
        try {
            if (!known.contains(skin)) {
                import.scene.skins.push_back(skinOf(import, skin));
                known[skin] = static_cast<std::uint32_t>(import.scene.skins.size() - 1);
            }
            import.scene.meshes[mesh].skin = known[skin];
            checkJoints(import, import.scene.meshes[mesh], skin, import.scene.skins[known[skin]].nodes.size());
        } catch (const Error& error) {
            import.problems.add(error);
        }
    }
}

}  // namespace lodestir
