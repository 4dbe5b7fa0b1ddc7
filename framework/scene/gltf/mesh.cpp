// SPDX-License-Identifier: MIT
// Meshes of a glTF model.
#include <framework/core/tasks.h>
#include <framework/scene/gltf/accessor.h>
#include <framework/scene/gltf/material.h>
#include <framework/scene/gltf/mesh.h>
#include <framework/scene/shading_frame.h>
#include <framework/scene/tangent_space.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <numeric>

namespace lodestir {
namespace {

/// A sliver this thin (area over the square of its longest edge) has no normal in single precision and no area to be hit.
constexpr double thinnest = 1e-10;

template <class V> bool isFinite(const V& v) {
    for (int i = 0; i < V::length(); ++i) {
        if (!std::isfinite(v[i])) return false;
    }
    return true;
}

class PrimitiveLoader {
public:
    PrimitiveLoader(GltfImport& import, const tinygltf::Primitive& source, std::string pointer)
        : import_(import), source_(source), pointer_(std::move(pointer)) {}

    /// The primitive alone; empty when it has no triangles. Error for what it reads out of bounds.
    MeshLevel load() {
        if (!hasTriangles()) return {};
        readVertices();
        readTriangles();
        dropTriangles();
        compact();
        if (level_.triangles.empty()) return {};
        shade();
        return std::move(level_);
    }

private:
    bool hasTriangles() {
        if (source_.mode < TINYGLTF_MODE_POINTS || source_.mode > TINYGLTF_MODE_TRIANGLE_FAN) {
            import_.note(fmt::format("primitives of mode {}, which there is none of, are left out", source_.mode));
            return false;
        }
        if (source_.mode < TINYGLTF_MODE_TRIANGLES) {
            import_.note("points and lines are left out");
            return false;
        }
        if (!source_.attributes.contains("POSITION")) {
            import_.note("primitives without positions are left out");
            return false;
        }
        const Accessor positions(import_.file, source_.attributes.at("POSITION"), pointer_ + "/attributes/POSITION");
        if (source_.targets.empty() && !positions.hasData()) {  // all vertices would be in one place
            import_.note("primitives without positions are left out");
            return false;
        }
        return true;
    }

    /// An attribute as vectors of V, shorter elements filled from `fill`; empty when the primitive has none.
    template <class V> std::vector<V> attribute(const std::string& name, int leastComponents, V fill) {
        return attributeOf<V>(source_.attributes, pointer_ + "/attributes", name, leastComponents, fill);
    }
    template <class V>
    std::vector<V> attributeOf(const std::map<std::string, int>& attributes, const std::string& place, const std::string& name,
                               int leastComponents, V fill) {
        const auto found = attributes.find(name);
        if (found == attributes.end()) return {};
        const std::string user = place + "/" + name;
        const Accessor accessor(import_.file, found->second, user);
        if (accessor.components() < leastComponents || accessor.components() > V::length()) {
            throw import_.file.error(user, fmt::format("{} cannot have {} components", name, accessor.components()));
        }
        if (!level_.positions.empty() && accessor.count() != level_.positions.size()) {
            throw import_.file.error(user,
                                     fmt::format("{} has {} elements, POSITION has {}", name, accessor.count(), level_.positions.size()));
        }
        return accessor.vectors(fill);
    }

    void readVertices() {
        level_.positions = attribute<glm::vec3>("POSITION", 3, {});
        level_.normals = attribute<glm::vec3>("NORMAL", 3, {});
        level_.tangents = attribute<glm::vec4>("TANGENT", 4, {});
        level_.uv0 = attribute<glm::vec2>("TEXCOORD_0", 2, {});
        level_.uv1 = attribute<glm::vec2>("TEXCOORD_1", 2, {});
        level_.colors = attribute<glm::vec4>("COLOR_0", 3, glm::vec4(1));
        for (auto* uvs : {&level_.uv0, &level_.uv1}) {
            for (glm::vec2& uv : *uvs) {
                if (!isFinite(uv)) uv = glm::vec2(0);
            }
        }
        for (glm::vec4& color : level_.colors) color = isFinite(color) ? glm::max(color, 0.0f) : glm::vec4(1);
        readJoints();
        readTargets();
    }

    /// Two sets of four joints are read; weights are scaled to sum to 1, which not every file's do.
    void readJoints() {
        for (int set = 0; set < 2; ++set) {
            const auto joints = attribute<glm::vec4>(fmt::format("JOINTS_{}", set), 4, {});
            const auto weights = attribute<glm::vec4>(fmt::format("WEIGHTS_{}", set), 4, {});
            if (joints.empty() || weights.empty()) break;
            level_.joints.resize(level_.positions.size());
            for (std::size_t v = 0; v < joints.size(); ++v) {
                for (int i = 0; i < 4; ++i) {
                    const auto slot = static_cast<std::size_t>(4 * set + i);
                    level_.joints[v].joints[slot] = static_cast<std::uint16_t>(std::clamp(joints[v][i], 0.0f, 65535.0f));
                    level_.joints[v].weights[slot] = std::isfinite(weights[v][i]) ? std::max(weights[v][i], 0.0f) : 0.0f;
                }
            }
        }
        if (source_.attributes.contains("JOINTS_2")) import_.note("vertices follow eight joints at most");
        for (VertexJoints& v : level_.joints) makeWhole(v);
    }

    void readTargets() {
        for (std::size_t i = 0; i < source_.targets.size(); ++i) {
            const std::string place = fmt::format("{}/targets/{}", pointer_, i);
            MorphTarget& target = level_.targets.emplace_back();
            const auto read = [&](std::vector<glm::vec3>& values, const char* name) {
                values = attributeOf<glm::vec3>(source_.targets[i], place, name, 3, {});
                for (glm::vec3& v : values)
                    if (!isFinite(v)) v = glm::vec3(0);
            };
            read(target.positions, "POSITION");
            read(target.normals, "NORMAL");
            read(target.tangents, "TANGENT");
        }
    }

    bool deforms() const { return !level_.joints.empty() || !level_.targets.empty(); }

    void readTriangles() {
        std::vector<std::uint32_t> indices;
        if (source_.indices >= 0) {
            const Accessor accessor(import_.file, source_.indices, pointer_ + "/indices");
            indices = accessor.indices();
            const std::size_t count = level_.positions.size();
            const auto wrong = std::find_if(indices.begin(), indices.end(), [&](std::uint32_t i) { return i >= count; });
            if (wrong != indices.end()) {
                throw import_.file.error(pointer_ + "/indices", fmt::format("index {} (at {} of {}) is past the {} vertices", *wrong,
                                                                            wrong - indices.begin(), indices.size(), count));
            }
        } else {
            indices.resize(level_.positions.size());
            std::iota(indices.begin(), indices.end(), 0u);
        }
        if (source_.mode == TINYGLTF_MODE_TRIANGLES) {
            if (indices.size() % 3 != 0) import_.note("vertices that make no whole triangle are left out");
            level_.triangles.resize(indices.size() / 3);
            if (!level_.triangles.empty()) std::memcpy(level_.triangles.data(), indices.data(), level_.triangles.size() * sizeof(glm::uvec3));
            return;
        }
        // glTF 2.0, section 3.7.2.1: triangle i of a strip and of a fan.
        const bool strip = source_.mode == TINYGLTF_MODE_TRIANGLE_STRIP;
        for (std::size_t i = 0; i + 2 < indices.size(); ++i) {
            if (strip)
                level_.triangles.emplace_back(indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]);
            else
                level_.triangles.emplace_back(indices[i + 1], indices[i + 2], indices[0]);
        }
    }

    enum class Fault : std::uint8_t { none, thin, infinite };

    /// What is thin now may not stay so when it deforms.
    Fault faultOf(const glm::uvec3& t) const {
        const glm::dvec3 a(level_.positions[t.x]), b(level_.positions[t.y]), c(level_.positions[t.z]);
        if (!isFinite(a) || !isFinite(b) || !isFinite(c)) return Fault::infinite;
        if (deforms()) return Fault::none;
        const glm::dvec3 e = b - a, f = c - a, g = c - b;
        const double longest = std::max({glm::dot(e, e), glm::dot(f, f), glm::dot(g, g)});
        return glm::length(glm::cross(e, f)) > thinnest * longest ? Fault::none : Fault::thin;
    }

    void dropTriangles() {
        std::vector<Fault> faults(level_.triangles.size());
        parallelFor(faults.size(), 65536, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) faults[i] = faultOf(level_.triangles[i]);
        });
        const auto thin = std::ranges::count(faults, Fault::thin), infinite = std::ranges::count(faults, Fault::infinite);
        if (thin + infinite == 0) return;
        std::size_t kept = 0;
        for (std::size_t i = 0; i < faults.size(); ++i)
            if (faults[i] == Fault::none) level_.triangles[kept++] = level_.triangles[i];
        level_.triangles.resize(kept);
        import_.scene.droppedTriangles += std::size_t(thin + infinite);
        if (infinite > 0) import_.note(fmt::format("{}: {} triangles with vertices that are not finite are left out", pointer_, infinite));
    }

    /// Keeps used vertices in their order: primitives often share one large vertex buffer.
    void compact() {
        std::vector<std::uint32_t> place(level_.positions.size(), none);
        for (const glm::uvec3& t : level_.triangles) {
            for (int c = 0; c < 3; ++c) place[t[c]] = 0;
        }
        if (std::ranges::find(place, none) == place.end()) return;
        std::vector<std::uint32_t> kept;
        for (std::size_t v = 0; v < place.size(); ++v) {
            if (place[v] == none) continue;
            place[v] = static_cast<std::uint32_t>(kept.size());
            kept.push_back(static_cast<std::uint32_t>(v));
        }
        for (glm::uvec3& t : level_.triangles) t = {place[t.x], place[t.y], place[t.z]};
        gatherVertices(level_, kept);
    }

    void shade() {
        const std::uint32_t material = gltfMaterial(import_, source_);
        level_.materials.assign(level_.triangles.size(), material);
        if (level_.normals.empty()) {
            level_.tangents.clear();  // the format says so: tangents without normals mean nothing
            makeFlatNormals(level_);
            if (deforms()) level_.flatFaces = level_.triangles;
        } else if (repairNormals(level_) > 0) {
            import_.note("normals that were zero or not finite are made from the faces around them");
        }
        const std::optional<TextureSlot> map = tangentSlot(import_.scene.materials[material]);
        if (!map) {
            level_.tangents.clear();
        } else if (level_.tangents.empty()) {
            makeTangents(level_, *map);
        }
        for (std::size_t v = 0; v < level_.tangents.size(); ++v) {
            const glm::vec4 t = level_.tangents[v];
            const glm::vec3 n = level_.normals[v], projected = glm::vec3(t) - n * glm::dot(n, glm::vec3(t));
            const float length = glm::length(projected);
            level_.tangents[v] =
                glm::vec4(length > 1e-6f && std::isfinite(length) ? projected / length : perpendicular(n), t.w < 0 ? -1.0f : 1.0f);
        }
    }

    GltfImport& import_;
    const tinygltf::Primitive& source_;
    std::string pointer_;
    MeshLevel level_;
};

/// Adds `more` to `values`; where only one side has values, the other's are filled.
template <class T, class Fill>
void extend(std::vector<T>& values, std::size_t before, std::vector<T> more, std::size_t count, const Fill& fill) {
    if (values.empty() && more.empty()) return;
    while (values.size() < before) values.push_back(fill(values.size()));
    if (!more.empty()) values.insert(values.end(), more.begin(), more.end());
    while (values.size() < before + count) values.push_back(fill(values.size()));
}

void append(MeshLevel& level, MeshLevel part) {
    if (level.positions.empty()) {
        level = std::move(part);
        return;
    }
    const std::size_t before = level.positions.size(), count = part.positions.size();
    for (const glm::uvec3& t : part.triangles) level.triangles.push_back(t + static_cast<std::uint32_t>(before));
    for (const glm::uvec3& t : part.flatFaces) level.flatFaces.push_back(t + static_cast<std::uint32_t>(before));
    level.materials.insert(level.materials.end(), part.materials.begin(), part.materials.end());
    level.positions.insert(level.positions.end(), part.positions.begin(), part.positions.end());
    level.normals.insert(level.normals.end(), part.normals.begin(), part.normals.end());
    extend(level.tangents, before, std::move(part.tangents), count,
           [&](std::size_t v) { return glm::vec4(perpendicular(level.normals[v]), 1); });
    extend(level.uv0, before, std::move(part.uv0), count, [](std::size_t) { return glm::vec2(0); });
    extend(level.uv1, before, std::move(part.uv1), count, [](std::size_t) { return glm::vec2(0); });
    extend(level.colors, before, std::move(part.colors), count, [](std::size_t) { return glm::vec4(1); });
    extend(level.joints, before, std::move(part.joints), count, [](std::size_t) { return VertexJoints{.weights = {1}}; });
    level.targets.resize(std::max(level.targets.size(), part.targets.size()));
    part.targets.resize(level.targets.size());
    for (std::size_t i = 0; i < level.targets.size(); ++i) {
        const auto none = [](std::size_t) { return glm::vec3(0); };
        extend(level.targets[i].positions, before, std::move(part.targets[i].positions), count, none);
        extend(level.targets[i].normals, before, std::move(part.targets[i].normals), count, none);
        extend(level.targets[i].tangents, before, std::move(part.targets[i].tangents), count, none);
    }
}

}  // namespace

MeshLevel loadGltfMesh(GltfImport& import, int index) {
    const tinygltf::Mesh& mesh = import.file.model.meshes[static_cast<std::size_t>(index)];
    MeshLevel level;
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
        try {
            append(level, PrimitiveLoader(import, mesh.primitives[i], fmt::format("/meshes/{}/primitives/{}", index, i)).load());
        } catch (const Error& error) {
            import.problems.add(error);
        }
    }
    return level;
}

void makeWhole(VertexJoints& vertex) {
    const float sum = std::accumulate(vertex.weights.begin(), vertex.weights.end(), 0.0f);
    if (sum > 0)
        for (float& weight : vertex.weights) weight /= sum;
    else
        vertex.weights[0] = 1;
}

void transformLevel(MeshLevel& level, const glm::mat4& matrix) {
    const glm::mat3 linear(matrix), normals = glm::transpose(glm::inverse(linear));
    const bool mirrors = glm::determinant(linear) < 0;
    for (glm::vec3& p : level.positions) p = glm::vec3(matrix * glm::vec4(p, 1));
    for (glm::vec3& n : level.normals) n = glm::normalize(normals * n);
    for (glm::vec4& t : level.tangents) t = glm::vec4(glm::normalize(linear * glm::vec3(t)), mirrors ? -t.w : t.w);
    for (MorphTarget& target : level.targets) {
        for (glm::vec3& p : target.positions) p = linear * p;
        for (glm::vec3& n : target.normals) n = normals * n;
        for (glm::vec3& t : target.tangents) t = linear * t;
    }
    if (!mirrors) return;
    for (auto* triangles : {&level.triangles, &level.flatFaces})
        for (glm::uvec3& t : *triangles) std::swap(t.y, t.z);
}

}  // namespace lodestir
