// SPDX-License-Identifier: MIT
#include <framework/scene/lod/model.h>

#include <framework/core/log.h>
#include <framework/scene/gltf/accessor.h>
#include <framework/scene/gltf/glb_file.h>
#include <framework/scene/gltf/gltf.h>
#include <framework/scene/gltf/hierarchy.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <set>

namespace lodestir {
namespace {

using OrderedJson = nlohmann::ordered_json;

/// All triangles of a mesh with all vertices of its primitives, one after the other; `materials` holds the number of the primitive.
struct GltfSurface {
    MeshLevel level;
    std::vector<std::uint32_t> starts;  ///< first vertex of each primitive, and one more
};

/// The material that a primitive names; null where it names none that is there.
const tinygltf::Material* materialOf(const GltfFile& file, const tinygltf::Primitive& primitive) {
    const bool there = primitive.material >= 0 && primitive.material < int(file.model.materials.size());
    return there ? &file.model.materials[std::size_t(primitive.material)] : nullptr;
}

bool isUnlit(const tinygltf::Material& material) { return material.extensions.contains("KHR_materials_unlit"); }

/// Whether normals of the primitive are seen.
bool isShaded(const GltfFile& file, const tinygltf::Primitive& primitive) {
    const tinygltf::Material* material = materialOf(file, primitive);
    return !material || !isUnlit(*material);
}

class SurfaceReader {
public:
    SurfaceReader(const GltfFile& file, std::size_t mesh) : file_(file), mesh_(mesh) {}

    GltfSurface read() {
        const auto& primitives = file_.model.meshes[mesh_].primitives;
        for (std::size_t i = 0; i < primitives.size(); ++i) {
            surface_.starts.push_back(std::uint32_t(surface_.level.positions.size()));
            const bool isDrawn = primitives[i].mode >= TINYGLTF_MODE_TRIANGLES && primitives[i].mode <= TINYGLTF_MODE_TRIANGLE_FAN;
            if (isDrawn && primitives[i].attributes.contains("POSITION")) add(primitives[i], i);
        }
        surface_.starts.push_back(std::uint32_t(surface_.level.positions.size()));
        return std::move(surface_);
    }

private:
    void add(const tinygltf::Primitive& primitive, std::size_t number) {
        const std::string pointer = fmt::format("/meshes/{}/primitives/{}", mesh_, number);
        const auto start = std::uint32_t(surface_.level.positions.size());
        const auto take = [&]<class V>(std::vector<V>& values, const char* name, V fill) {
            const auto found = primitive.attributes.find(name);
            if (found == primitive.attributes.end()) {
                if (!values.empty()) values.resize(surface_.level.positions.size(), fill);
                return;
            }
            const Accessor accessor(file_, found->second, pointer + "/attributes/" + name);
            const std::vector<float> numbers = accessor.floats();
            const auto components = std::size_t(accessor.components());
            if (name != std::string_view("POSITION") && start + accessor.count() != surface_.level.positions.size())
                throw file_.error(pointer + "/attributes/" + name, fmt::format("{} has {} elements, POSITION has {}", name,
                                                                               accessor.count(), surface_.level.positions.size() - start));
            values.resize(start, fill);
            for (std::size_t v = 0; v < accessor.count(); ++v) {
                V value = fill;
                for (std::size_t c = 0; c < std::min(components, std::size_t(V::length())); ++c)
                    value[int(c)] = numbers[v * components + c];
                values.push_back(value);
            }
        };
        take(surface_.level.positions, "POSITION", glm::vec3(0));
        // What isn't seen costs nothing: an unlit surface has no shading, tangents serve a normal map.
        const tinygltf::Material* material = materialOf(file_, primitive);
        const bool shaded = isShaded(file_, primitive);
        if (shaded) take(surface_.level.normals, "NORMAL", glm::vec3(0));
        if (shaded && material && material->normalTexture.index >= 0) take(surface_.level.tangents, "TANGENT", glm::vec4(0));
        surface_.level.normals.resize(surface_.level.normals.empty() ? 0 : surface_.level.positions.size(), glm::vec3(0));
        surface_.level.tangents.resize(surface_.level.tangents.empty() ? 0 : surface_.level.positions.size(), glm::vec4(0));
        take(surface_.level.uv0, "TEXCOORD_0", glm::vec2(0));
        take(surface_.level.uv1, "TEXCOORD_1", glm::vec2(0));
        take(surface_.level.colors, "COLOR_0", glm::vec4(1));
        for (glm::vec4& color : std::span(surface_.level.colors).subspan(surface_.level.colors.empty() ? 0 : start))
            for (int c = 0; c < 4; ++c) color[c] = std::isfinite(color[c]) ? std::max(color[c], 0.0f) : 1;  // as the loader has it

        std::vector<std::uint32_t> indices(surface_.level.positions.size() - start);
        std::iota(indices.begin(), indices.end(), 0u);
        if (primitive.indices >= 0) indices = Accessor(file_, primitive.indices, pointer + "/indices").indices();
        const std::size_t count = surface_.level.positions.size() - start;
        if (std::ranges::any_of(indices, [&](std::uint32_t i) { return i >= count; }))
            throw file_.error(pointer + "/indices", fmt::format("an index is past the {} vertices", count));
        const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            surface_.level.triangles.emplace_back(start + a, start + b, start + c);
            surface_.level.materials.push_back(std::uint32_t(number));
        };
        // glTF 2.0, section 3.7.2.1.
        if (primitive.mode == TINYGLTF_MODE_TRIANGLES)
            for (std::size_t i = 0; i + 2 < indices.size(); i += 3) triangle(indices[i], indices[i + 1], indices[i + 2]);
        else if (primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP)
            for (std::size_t i = 0; i + 2 < indices.size(); ++i) triangle(indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]);
        else
            for (std::size_t i = 0; i + 2 < indices.size(); ++i) triangle(indices[i + 1], indices[i + 2], indices[0]);
    }

    const GltfFile& file_;
    std::size_t mesh_;
    GltfSurface surface_;
};

OrderedJson numbers(const std::vector<float>& values) {
    OrderedJson list = OrderedJson::array();
    for (float value : values) list.push_back(value);
    return list;
}

class ModelBuilder {
public:
    ModelBuilder(const GltfFile& file, const LodModelOptions& options) : file_(file), options_(options), glb_(file) {}

    LodModel build() {
        checkNames();
        const std::map<std::size_t, std::vector<std::size_t>> users = meshUsers();
        log::Progress progress("building levels of detail", users.size());
        for (const auto& [mesh, nodes] : users) {
            addChain(mesh, nodes);
            progress.advance();
        }
        std::ranges::copy(glb_.notes, std::back_inserter(model_.notes));
        model_.glb = glb_.bytes();
        return std::move(model_);
    }

private:
    /// The nodes that show each mesh and can be given levels.
    std::map<std::size_t, std::vector<std::size_t>> meshUsers() {
        const auto& nodes = file_.model.nodes;
        std::vector<char> isLevel(nodes.size(), 0), hasLevels(nodes.size(), 0);
        for (std::size_t n = 0; n < nodes.size(); ++n)
            for (int level : coarserLevels(file_, int(n))) isLevel[std::size_t(level)] = hasLevels[n] = 1;
        if (const auto kept = std::ranges::count(hasLevels, 1); kept > 0)
            model_.notes.push_back(
                fmt::format("{} node{} levels already and keep{} them", kept, kept == 1 ? " has" : "s have", kept == 1 ? "s" : ""));
        const bool materialLevels =
            std::ranges::any_of(file_.model.materials, [](const auto& m) { return m.extensions.contains("MSFT_lod"); });
        if (materialLevels) model_.notes.push_back("levels of materials are kept; every new level of a mesh wears its finest materials");
        std::map<std::size_t, std::vector<std::size_t>> users;
        for (std::size_t n = 0; n < nodes.size(); ++n)
            if (nodes[n].mesh >= int(file_.model.meshes.size()))
                throw file_.error(fmt::format("/nodes/{}/mesh", n),
                                  fmt::format("there is no mesh {}, the file has {}", nodes[n].mesh, file_.model.meshes.size()));
            else if (nodes[n].mesh >= 0 && !isLevel[n] && !hasLevels[n] && isWanted(std::size_t(nodes[n].mesh)))
                users[std::size_t(nodes[n].mesh)].push_back(n);
        return users;
    }

    std::string nameOf(std::size_t mesh) const {
        const std::string& name = file_.model.meshes[mesh].name;
        return name.empty() ? fmt::format("mesh {}", mesh) : name;
    }

    bool isWanted(std::size_t mesh) const {
        return options_.meshes.empty() || std::ranges::find(options_.meshes, nameOf(mesh)) != options_.meshes.end();
    }

    void checkNames() const {
        std::vector<std::string> names;
        for (std::size_t m = 0; m < file_.model.meshes.size(); ++m) names.push_back(nameOf(m));
        for (const std::string& wanted : options_.meshes)
            if (std::ranges::find(names, wanted) == names.end())
                throw Error(Where{file_.path.string()}, fmt::format("there is no mesh \"{}\"", wanted), didYouMean(wanted, names));
    }

    void addChain(std::size_t mesh, const std::vector<std::size_t>& nodes) {
        GltfSurface surface = SurfaceReader(file_, mesh).read();
        LodMeshFacts facts{.name = nameOf(mesh), .nodes = nodes.size(), .triangles = surface.level.triangles.size()};
        if (surface.level.triangles.empty()) {
            facts.notes.push_back("it has no triangles");
        } else {
            facts.chain = buildLodChain(surface.level, options_.chain);
            writeChain(mesh, nodes, surface, facts);
        }
        model_.meshes.push_back(std::move(facts));
    }

    void writeChain(std::size_t mesh, const std::vector<std::size_t>& nodes, const GltfSurface& surface, LodMeshFacts& facts) {
        LodChain& chain = facts.chain;
        const tinygltf::Mesh& source = file_.model.meshes[mesh];
        const bool bends = std::ranges::any_of(nodes, [&](std::size_t node) { return file_.model.nodes[node].skin >= 0; });
        if (bends || std::ranges::any_of(source.primitives, [](const auto& p) { return !p.targets.empty(); }))
            facts.notes.push_back("it deforms: its levels are made and measured as the file has it at rest");
        if (!chain.hasUvs) facts.notes.push_back("it has no UVs: simplified without them, and points of its levels cannot be matched");
        if (!chain.end.empty())
            facts.notes.push_back(fmt::format("{} instead of {} levels: {}", chain.coarser.size() + 1, options_.chain.levels, chain.end));
        std::vector<std::size_t> levelMeshes;
        std::vector<float> errors{0}, uvErrors{0};
        for (LodLevel& level : chain.coarser) {
            levelMeshes.push_back(addMesh(mesh, surface, level, levelMeshes.size() + 1));
            errors.push_back(level.error);
            uvErrors.push_back(level.measured.uvLargest);
            facts.coarserTriangles.push_back(level.triangles.size());
            level.triangles = {};
            level.groups = {};
            level.looks = {};
        }
        if (levelMeshes.empty()) return;
        facts.coverages = screenCoverages(chain);
        glb_.useExtension("MSFT_lod");
        for (std::size_t node : nodes) {
            OrderedJson ids = OrderedJson::array();
            for (std::size_t k = 0; k < levelMeshes.size(); ++k) ids.push_back(addLevelNode(node, levelMeshes[k], k + 1));
            OrderedJson& json = glb_.json["nodes"][node];
            json["extensions"]["MSFT_lod"]["ids"] = ids;
            OrderedJson& extras = json["extras"];
            if (!extras.is_null() && !extras.is_object()) extras = OrderedJson{{"value", extras}};
            extras["MSFT_screencoverage"] = numbers(facts.coverages);
            extras["lod_error"] = numbers(errors);
            if (chain.hasUvs) extras["lod_uv_error"] = numbers(uvErrors);
        }
    }

    /// The mesh with the triangles of a level: same vertices but for their colours and normals, same materials. What has no triangles (points, lines) stays.
    std::size_t addMesh(std::size_t mesh, const GltfSurface& surface, const LodLevel& level, std::size_t number) {
        std::vector<std::vector<std::uint32_t>> indices(surface.starts.size() - 1);
        for (std::size_t t = 0; t < level.triangles.size(); ++t)
            for (int k = 0; k < 3; ++k) indices[level.groups[t]].push_back(level.triangles[t][k] - surface.starts[level.groups[t]]);
        OrderedJson json = glb_.json["meshes"][mesh];
        OrderedJson primitives = OrderedJson::array();
        for (std::size_t p = 0; p < indices.size(); ++p) {
            OrderedJson primitive = json["primitives"][p];
            const std::size_t vertices = surface.starts[p + 1] - surface.starts[p];
            if (vertices > 0) {
                if (indices[p].empty()) continue;
                primitive.erase("mode");
                if (primitive.contains("extensions")) primitive["extensions"].erase("KHR_draco_mesh_compression");  // of other indices
                primitive["indices"] = glb_.addIndices(indices[p], vertices);
                const OrderedJson& attributes = json["primitives"][p]["attributes"];
                if (attributes.contains("COLOR_0"))
                    primitive["attributes"]["COLOR_0"] = glb_.addColors(std::span(level.looks.colors).subspan(surface.starts[p], vertices));
                if (options_.chain.fitNormals && attributes.contains("NORMAL") && isShaded(file_, file_.model.meshes[mesh].primitives[p]))
                    primitive["attributes"]["NORMAL"] = glb_.addNormals(std::span(level.looks.normals).subspan(surface.starts[p], vertices));
            }
            primitives.push_back(std::move(primitive));
        }
        json["name"] = fmt::format("{} level {}", nameOf(mesh), number);
        json["primitives"] = std::move(primitives);
        glb_.json["meshes"].push_back(std::move(json));
        return glb_.json["meshes"].size() - 1;
    }

    /// A node that stands where the finest one does and shows a level; nothing but MSFT_lod refers to it.
    std::size_t addLevelNode(std::size_t node, std::size_t mesh, std::size_t number) {
        const OrderedJson& finest = glb_.json["nodes"][node];
        OrderedJson level = OrderedJson::object();
        level["name"] = fmt::format("{} level {}", finest.value("name", fmt::format("node {}", node)), number);
        level["mesh"] = mesh;
        for (const char* key : {"matrix", "translation", "rotation", "scale", "skin", "weights"})
            if (finest.contains(key)) level[key] = finest[key];
        constexpr const char* instancing = "EXT_mesh_gpu_instancing";
        if (finest.contains("extensions") && finest["extensions"].contains(instancing))
            level["extensions"][instancing] = finest["extensions"][instancing];
        glb_.json["nodes"].push_back(std::move(level));
        return glb_.json["nodes"].size() - 1;
    }

    const GltfFile& file_;
    const LodModelOptions& options_;
    GlbFile glb_;
    LodModel model_;
};

}  // namespace

LodModel buildLodModel(const Path& path, const LodModelOptions& options) {
    Scene checked;
    loadGltf(path, checked, none);  // finds all that is wrong before anything is made
    const GltfFile file = readGltfFile(path);
    return ModelBuilder(file, options).build();
}

}  // namespace lodestir
