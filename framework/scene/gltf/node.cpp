// SPDX-License-Identifier: MIT
// Nodes of a glTF model.
#include <framework/scene/gltf/accessor.h>
#include <framework/scene/animation.h>
#include <framework/scene/deformation.h>
#include <framework/scene/gltf/gltf.h>
#include <framework/scene/gltf/hierarchy.h>
#include <framework/scene/gltf/mesh.h>
#include <framework/scene/gltf/node.h>
#include <framework/scene/gltf/skin.h>
#include <framework/scene/lod/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace lodestir {
namespace {

float finite(const GltfFile& file, double value, const std::string& pointer) {
    const auto result = static_cast<float>(value);
    if (!std::isfinite(result)) throw file.error(pointer, fmt::format("{} is too large a number", value));
    return result;
}

template <class V> V vectorFrom(const GltfFile& file, const std::vector<double>& values, V otherwise, const std::string& pointer) {
    if (values.empty()) return otherwise;
    if (values.size() != static_cast<std::size_t>(V::length()))
        throw file.error(pointer, fmt::format("expected {} numbers, got {}", V::length(), values.size()));
    V result;
    for (int i = 0; i < V::length(); ++i) result[i] = finite(file, values[static_cast<std::size_t>(i)], pointer);
    return result;
}

Node nodeFrom(GltfImport& import, int index) {
    const GltfFile& file = import.file;
    const tinygltf::Node& source = file.model.nodes[static_cast<std::size_t>(index)];
    const std::string pointer = fmt::format("/nodes/{}", index);
    Node node;
    node.name = source.name.empty() ? fmt::format("node {}", index) : source.name;
    if (!source.matrix.empty()) {
        if (source.matrix.size() != 16)
            throw file.error(pointer + "/matrix", fmt::format("expected 16 numbers, got {}", source.matrix.size()));
        glm::mat4 matrix;
        for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = finite(file, source.matrix[static_cast<std::size_t>(i)], pointer + "/matrix");
        node.matrix = matrix;
        return node;
    }
    node.translation = vectorFrom(file, source.translation, glm::vec3(0), pointer + "/translation");
    node.scale = vectorFrom(file, source.scale, glm::vec3(1), pointer + "/scale");
    const glm::vec4 q = vectorFrom(file, source.rotation, glm::vec4(0, 0, 0, 1), pointer + "/rotation");
    const glm::dvec4 wide(q);  // the square of a large float is none
    if (!(glm::length(wide) > 0)) {
        import.note(fmt::format("node \"{}\" has a zero quaternion, which is no rotation; it is not turned", node.name));
        return node;
    }
    const glm::vec4 unit(wide / glm::length(wide));
    node.rotation = glm::quat(unit.w, unit.x, unit.y, unit.z);
    return node;
}

class NodeLoader {
public:
    explicit NodeLoader(GltfImport& import) : import_(import), model_(import.file.model) {}

    void load(const GltfVisit& visit, std::uint32_t sceneParent) {
        const auto n = static_cast<std::size_t>(visit.node);
        const tinygltf::Node& source = model_.nodes[n];
        Node node = nodeFrom(import_, visit.node);
        node.parent = visit.parent < 0 ? sceneParent : import_.nodes[static_cast<std::size_t>(visit.parent)];
        const auto place = static_cast<std::uint32_t>(import_.scene.nodes.size());
        import_.nodes[n] = place;
        import_.scene.nodes.push_back(std::move(node));
        if (source.mesh >= 0)
            addMesh(visit.node, place);
        else if (findExtension(source.extensions, "MSFT_lod"))
            import_.note("levels of detail of nodes without a mesh of their own are ignored");
        if (source.camera >= 0) addCamera(source.camera, place);
        if (const tinygltf::Value* punctual = findExtension(source.extensions, "KHR_lights_punctual")) addLight(*punctual, place);
    }

private:
    void addMesh(int node, std::uint32_t place) {
        const std::uint32_t mesh = meshOf(node);
        if (mesh == none) return;
        const tinygltf::Node& source = model_.nodes[static_cast<std::size_t>(node)];
        const std::string& meshName = import_.scene.meshes[mesh].name;
        const std::string name = source.name.empty() ? meshName : source.name;
        if (const tinygltf::Value* many = findExtension(source.extensions, "EXT_mesh_gpu_instancing"))
            addMany(*many, node, place, mesh, name);
        else
            import_.scene.instances.push_back({name, mesh, place});
    }

    /// EXT_mesh_gpu_instancing: a child node with an instance for each element of the attributes.
    void addMany(const tinygltf::Value& extension, int node, std::uint32_t place, std::uint32_t mesh, const std::string& name) {
        const std::string pointer = fmt::format("/nodes/{}/extensions/EXT_mesh_gpu_instancing/attributes", node);
        std::size_t count = 0;
        const auto values = [&](const char* key, int components) {
            std::vector<float> result;
            if (!extension.Has("attributes") || !extension.Get("attributes").Has(key)) return result;
            const Accessor accessor(import_.file, integerOf(&extension.Get("attributes"), key, -1), pointer + "/" + key);
            if (accessor.components() != components)
                throw import_.file.error(pointer + "/" + key,
                                         fmt::format("expected {} components, got {}", components, accessor.components()));
            if (!accessor.hasData()) throw import_.file.error(pointer + "/" + key, "the attribute has no data: all instances would be one");
            if (count != 0 && accessor.count() != count)
                throw import_.file.error(pointer + "/" + key, "the attributes have different counts");
            count = accessor.count();
            return accessor.floats();
        };
        const std::vector<float> translations = values("TRANSLATION", 3), rotations = values("ROTATION", 4), scales = values("SCALE", 3);
        if (import_.scene.nodes.size() + count > maxNodes) {
            if (!std::exchange(isFull_, true))
                import_.problem(pointer, fmt::format("with {} instances more the scene has more than {} nodes", count, maxNodes));
            return;
        }
        const auto isFinite = [](const std::vector<float>& numbers, std::size_t i, std::size_t components) {
            return numbers.empty() ||
                   std::all_of(&numbers[components * i], &numbers[components * i] + components, [](float v) { return std::isfinite(v); });
        };
        for (std::size_t i = 0; i < count; ++i) {
            if (!isFinite(translations, i, 3) || !isFinite(rotations, i, 4) || !isFinite(scales, i, 3)) {
                import_.note("instances with numbers that are not finite are left out");
                continue;
            }
            Node child;
            child.name = fmt::format("{} {}", name, i);
            child.parent = place;
            if (!translations.empty()) child.translation = {translations[3 * i], translations[3 * i + 1], translations[3 * i + 2]};
            if (!scales.empty()) child.scale = {scales[3 * i], scales[3 * i + 1], scales[3 * i + 2]};
            if (!rotations.empty()) {
                const glm::quat q(rotations[4 * i + 3], rotations[4 * i], rotations[4 * i + 1], rotations[4 * i + 2]);
                if (glm::dot(q, q) > 0) child.rotation = glm::normalize(q);
            }
            import_.scene.instances.push_back({child.name, mesh, static_cast<std::uint32_t>(import_.scene.nodes.size())});
            import_.scene.nodes.push_back(std::move(child));
        }
    }

    /// Scene mesh of a node: its own mesh and the meshes of its coarser levels; `none` when it has no triangles.
    std::uint32_t meshOf(int node) {
        std::vector<int> chain{node};
        const std::vector<int> coarser = coarserLevels(import_.file, node);
        chain.insert(chain.end(), coarser.begin(), coarser.end());
        std::vector<std::pair<int, std::vector<float>>> key;  // mesh and placement of each level
        std::vector<glm::mat4> placements;
        const glm::mat4 base = localMatrix(nodeFrom(import_, node));
        for (int level : chain) {
            const glm::mat4 local = localMatrix(nodeFrom(import_, level));
            // Levels that stand where the node stands are shared by all nodes of the mesh; rounding must not part them.
            const glm::mat4 placement = local == base ? glm::mat4(1) : glm::inverse(base) * local;
            placements.push_back(placement);
            key.emplace_back(model_.nodes[static_cast<std::size_t>(level)].mesh,
                             std::vector<float>(&placement[0][0], &placement[0][0] + 16));
        }
        const auto known = meshes_.find(key);
        if (known != meshes_.end() && model_.nodes[static_cast<std::size_t>(node)].skin < 0) return known->second;
        const std::uint32_t mesh = buildMesh(node, chain, placements);
        if (mesh != none && import_.scene.meshes[mesh].deforms()) return mesh;  // each node has a pose of its own
        meshes_.emplace(std::move(key), mesh);
        return mesh;
    }

    /// Gives the mesh the weights of its morph targets and the skin of its node, or drops what would move it.
    void addDeformation(int node, Mesh& mesh) {
        const tinygltf::Node& source = model_.nodes[static_cast<std::size_t>(node)];
        const std::size_t targets = mesh.levels[0].targets.size();
        const auto& own = model_.meshes[static_cast<std::size_t>(source.mesh)].weights;
        const std::vector<double>& weights = source.weights.empty() ? own : source.weights;
        if (!weights.empty() && weights.size() != targets)
            import_.note(
                fmt::format("mesh \"{}\" has {} morph targets and {} weights; those it lacks are 0", mesh.name, targets, weights.size()));
        for (std::size_t i = 0; i < targets; ++i)
            mesh.weights.push_back(i < weights.size() && std::isfinite(weights[i]) ? static_cast<float>(weights[i]) : 0.0f);
        mesh.node = import_.nodes[static_cast<std::size_t>(node)];
        if (source.skin >= 0 && !mesh.levels[0].joints.empty()) {
            if (static_cast<std::size_t>(source.skin) < model_.skins.size()) {
                import_.skinned.push_back({static_cast<std::uint32_t>(import_.scene.meshes.size()), source.skin});
                mesh.skin = 0;  // until the nodes of its joints are there
            } else {
                import_.note(fmt::format("there is no skin {}, the file has {}; its meshes stand as they were modelled", source.skin,
                                         model_.skins.size()));
            }
        }
        for (MeshLevel& level : mesh.levels) {
            level.targets.resize(targets);
            if (mesh.skin == none) level.joints.clear();
            if (mesh.skin != none && level.joints.empty()) level.joints.assign(level.positions.size(), {.weights = {1}});
            if (!mesh.deforms()) level.flatFaces.clear();
        }
    }

    std::uint32_t buildMesh(int node, const std::vector<int>& chain, const std::vector<glm::mat4>& placements) {
        Mesh mesh;
        std::vector<std::size_t> source;  // index in the chain of each level
        for (std::size_t i = 0; i < chain.size(); ++i) {
            const int index = model_.nodes[static_cast<std::size_t>(chain[i])].mesh;
            const std::string user = fmt::format("/nodes/{}/mesh", chain[i]);
            if (index >= static_cast<int>(model_.meshes.size()))
                throw import_.file.error(user, fmt::format("there is no mesh {}, the file has {}", index, model_.meshes.size()));
            if (i > 0 && !model_.nodes[static_cast<std::size_t>(chain[i])].children.empty())
                import_.note("children of nodes that are levels of detail are ignored");
            MeshLevel level = index >= 0 ? loadGltfMesh(import_, index) : MeshLevel{};
            if (level.triangles.empty()) {
                if (i == 0) return none;
                import_.note(fmt::format("a level of detail without triangles (node {}) is left out", chain[i]));
                continue;
            }
            if (mesh.levels.size() == maxLevels) {
                import_.note(fmt::format("levels of detail beyond {} are left out", maxLevels));
                break;
            }
            const bool skinned = model_.nodes[static_cast<std::size_t>(node)].skin >= 0 && !level.joints.empty();  // nodes don't move these
            if (!isIdentity(placements[i]) && !skinned) transformLevel(level, placements[i]);
            mesh.levels.push_back(std::move(level));
            source.push_back(i);
        }
        readErrors(node, source, mesh);
        const int own = model_.nodes[static_cast<std::size_t>(node)].mesh;
        const std::string& name = model_.meshes[static_cast<std::size_t>(own)].name;
        mesh.name = name.empty() ? fmt::format("mesh {}", own) : name;
        addDeformation(node, mesh);
        deforming_ += deformingVertices(mesh);
        if (deforming_ > maxDeforming)
            throw import_.file.error(fmt::format("/nodes/{}/mesh", node), fmt::format("with it more than {} vertices deform", maxDeforming));
        import_.scene.meshes.push_back(std::move(mesh));
        return static_cast<std::uint32_t>(import_.scene.meshes.size() - 1);
    }

    static bool isIdentity(const glm::mat4& matrix) {
        for (int i = 0; i < 16; ++i) {
            if (std::abs(matrix[i / 4][i % 4] - (i % 5 == 0 ? 1.0f : 0.0f)) > 1e-6f) return false;
        }
        return true;
    }

    void readErrors(int node, const std::vector<std::size_t>& source, Mesh& mesh) {
        const tinygltf::Value& extras = model_.nodes[static_cast<std::size_t>(node)].extras;
        const auto has = [&](const char* key) { return extras.IsObject() && extras.Has(key) && extras.Get(key).IsArray(); };
        const auto read = [&](const char* key, std::size_t level) {
            if (!has(key)) return 0.0f;
            const tinygltf::Value& value = extras.Get(key).Get(static_cast<int>(source[level]));
            return value.IsNumber() ? static_cast<float>(value.GetNumberAsDouble()) : 0.0f;
        };
        // Levels that say nothing would be taken for as good as the finest, and be shown from the nearest.
        std::vector<float> measured;
        if (mesh.levels.size() > 1 && !has("lod_error")) {
            measured = distancesToFinest(mesh.levels);
            import_.note(fmt::format("levels of detail (node {}) bring no \"lod_error\": they were measured now, in space alone", node));
        }
        for (std::size_t i = 0; i < mesh.levels.size(); ++i) {
            if (i > 0) mesh.levels[i].error = std::max(measured.empty() ? read("lod_error", i) : measured[i], mesh.levels[i - 1].error);
            mesh.levels[i].coverage = read("MSFT_screencoverage", i);
        }
    }

    void addCamera(int index, std::uint32_t place) {
        if (index >= static_cast<int>(model_.cameras.size())) {
            return import_.note(fmt::format("there is no camera {}, the file has {}", index, model_.cameras.size()));
        }
        const tinygltf::Camera& camera = model_.cameras[static_cast<std::size_t>(index)];
        const std::string& name = import_.scene.nodes[place].name;
        const bool orthographic = camera.type == "orthographic";
        const auto fovy = static_cast<float>(camera.perspective.yfov);
        const float height = 2 * std::abs(static_cast<float>(camera.orthographic.ymag));  // ymag is half of it; its width follows from the image
        if (orthographic && !(height > 0 && std::isfinite(height))) {
            import_.note(fmt::format("camera \"{}\" has a height of {}; it is ignored", name, height));
        } else if (!orthographic && (!(fovy > 0) || fovy >= 3.14159f)) {
            import_.note(fmt::format("camera \"{}\" has a field of view of {} radians; it is ignored", name, fovy));
        } else if (!import_.scene.camera.keys.empty()) {
            if (import_.scene.camera.node != none) import_.note("only the first camera is used");
        } else {
            import_.scene.camera.node = place;
            import_.scene.camera.keys = {orthographic ? CameraKey{.height = height} : CameraKey{.fovy = fovy}};
            import_.note(fmt::format("camera \"{}\" of the model is used", name));
        }
    }

    void addLight(const tinygltf::Value& punctual, std::uint32_t place) {
        const int index = integerOf(&punctual, "light", -1);
        if (index < 0 || static_cast<std::size_t>(index) >= model_.lights.size())
            return import_.note(fmt::format("there is no light {}, the file has {}", index, model_.lights.size()));
        try {
            import_.scene.lights.push_back(lightFrom(index, place));
        } catch (const Error& error) {
            import_.noteLeftOut(fmt::format("light {}", index), error);
        }
    }

    Light lightFrom(int index, std::uint32_t place) const {
        const tinygltf::Light& source = model_.lights[static_cast<std::size_t>(index)];
        const std::string lightPointer = fmt::format("/extensions/KHR_lights_punctual/lights/{}", index);
        Light light;
        light.name = source.name.empty() ? import_.scene.nodes[place].name : source.name;
        if (source.type == "spot")
            light.type = LightType::spot;
        else if (source.type == "directional")
            light.type = LightType::directional;
        else if (source.type != "point")
            throw import_.file.error(lightPointer + "/type", fmt::format("there is no light type \"{}\"", source.type),
                                     "known: point, spot, directional");
        light.color = glm::max(vectorFrom(import_.file, source.color, glm::vec3(1), lightPointer + "/color"), 0.0f);
        light.intensity = std::max(finite(import_.file, source.intensity, lightPointer + "/intensity"), 0.0f);
        light.range = std::max(finite(import_.file, source.range, lightPointer + "/range"), 0.0f);
        constexpr float widest = 1.5707964f;
        light.outerCone = std::clamp(static_cast<float>(source.spot.outerConeAngle), 1e-4f, widest);
        light.innerCone = std::clamp(static_cast<float>(source.spot.innerConeAngle), 0.0f, light.outerCone);
        light.node = place;
        return light;
    }

    GltfImport& import_;
    const tinygltf::Model& model_;
    std::size_t deforming_ = 0;  ///< vertices, so far
    bool isFull_ = false;  ///< of nodes: said once
    std::map<std::vector<std::pair<int, std::vector<float>>>, std::uint32_t> meshes_;
};

}  // namespace

void loadGltfNodes(GltfImport& import, std::uint32_t parent) {
    import.nodes.assign(import.file.model.nodes.size(), none);
    std::vector<GltfVisit> visits;
    try {
        visits = visitGltfScene(import.file);
    } catch (const Error& error) {
        import.problems.add(error);
        return;
    }
    NodeLoader loader(import);
    for (const GltfVisit& visit : visits) {
        try {
            loader.load(visit, parent);
        } catch (const Error& error) {
            import.problems.add(error);
        }
        if (import.nodes[static_cast<std::size_t>(visit.node)] == none) return;  // its children have nothing to hang on
    }
    loadGltfSkins(import);
}

}  // namespace lodestir
