// SPDX-License-Identifier: MIT
// Skins of a glTF model.
#include <framework/scene/gltf/accessor.h>
#include <framework/scene/gltf/mesh.h>
#include <framework/scene/gltf/skin.h>

#include <fmt/format.h>

#include <cmath>
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
    for (std::size_t i = 0; i < skin.nodes.size(); ++i) {
        for (int k = 0; k < 16; ++k) {
            const float value = values[16 * i + static_cast<std::size_t>(k)];
            if (!std::isfinite(value)) throw import.file.error(user, fmt::format("matrix {} is not finite", i));
            skin.inverseBind[i][k / 4][k % 4] = value;
        }
    }
    return skin;
}

/// Takes away what vertices follow of joints past the last; true where there was any.
bool dropForeignJoints(Mesh& mesh, std::size_t joints) {
    bool any = false;
    for (MeshLevel& level : mesh.levels) {
        for (VertexJoints& v : level.joints) {
            for (std::size_t i = 0; i < v.joints.size(); ++i) {
                if (v.joints[i] < joints) continue;
                any = any || v.weights[i] > 0;
                v.joints[i] = 0;
                v.weights[i] = 0;
            }
            makeWhole(v);
        }
    }
    return any;
}

void takeOffSkin(Mesh& mesh) {
    mesh.skin = none;
    for (MeshLevel& level : mesh.levels) {
        level.joints.clear();
        if (!mesh.deforms()) level.flatFaces.clear();
    }
}

}  // namespace

void loadGltfSkins(GltfImport& import) {
    std::map<int, std::uint32_t> known;  // none: cannot be used
    for (const auto& [index, skin] : import.skinned) {
        Mesh& mesh = import.scene.meshes[index];
        const auto [place, isNew] = known.try_emplace(skin, none);
        if (isNew) {
            try {
                import.scene.skins.push_back(skinOf(import, skin));
                place->second = static_cast<std::uint32_t>(import.scene.skins.size() - 1);
            } catch (const Error& error) {
                import.noteLeftOut(fmt::format("skin {}", skin), error);
            }
        }
        mesh.skin = place->second;
        if (mesh.skin == none)
            takeOffSkin(mesh);
        else if (dropForeignJoints(mesh, import.scene.skins[mesh.skin].nodes.size()))
            import.note(
                fmt::format("vertices of mesh \"{}\" follow joints that skin {} has not; their weights go to the others", mesh.name, skin));
    }
}

}  // namespace lodestir
