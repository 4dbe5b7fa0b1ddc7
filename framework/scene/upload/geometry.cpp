// SPDX-License-Identifier: MIT
#include <framework/scene/upload/geometry.h>

#include <framework/core/log.h>
#include <framework/scene/bvh/mesh_bvh.h>
#include <framework/scene/upload/pack.h>

namespace lodestir {
namespace {

MeshRecord meshRecord(const Box& box, std::size_t levels) {
    return {.center = box.isEmpty() ? glm::vec3(0) : 0.5f * (box.low + box.high),
            .radius = box.isEmpty() ? 0 : 0.5f * glm::length(box.high - box.low),
            .levels = std::uint32_t(levels)};
}

/// Of all arrays that a level has a part of; positions are uploaded as four words.
std::uint32_t bytesOf(const Bvh& bvh, const MeshLevel& level) {
    constexpr std::size_t triangle = sizeof(BvhTriangle) + sizeof(PrimitiveRecord) + sizeof(std::uint32_t);
    constexpr std::size_t vertex = sizeof(glm::vec4) + sizeof(VertexRecord);
    return std::uint32_t(bvh.nodes.size() * sizeof(BvhNode) + bvh.triangles.size() * triangle + level.positions.size() * vertex);
}

}  // namespace

Geometry::Geometry(const Scene& scene)
    : roots(scene.meshes.size() * LEVELS, bvh_ref::empty), levels(scene.meshes.size() * LEVELS), emitters(scene.meshes.size()),
      grids(scene.meshes.size()), vertexColor(scene.materials.size(), false), places_(scene.meshes.size()) {
    log::Progress progress("building BVHs", scene.meshes.size());
    for (std::size_t m = 0; m < scene.meshes.size(); ++m, progress.advance()) {
        const Mesh& mesh = scene.meshes[m];
        bounds.push_back(boundsOf(mesh));
        for (std::size_t l = 0; l < mesh.levels.size(); ++l) addLevel(scene, m, l);
        // A mesh of lights always shows its finest level, because the list of lights is made of that one's triangles.
        const std::size_t last = emitters[m].empty() ? mesh.levels.size() - 1 : 0;
        for (std::size_t l = last + 1; l < LEVELS; ++l) {
            roots[m * LEVELS + l] = roots[m * LEVELS + last];
            levels[m * LEVELS + l] = levels[m * LEVELS + last];
        }
        meshes.push_back(meshRecord(bounds[m], last + 1));
    }
    triangles.emplace_back();
}

void Geometry::addLevel(const Scene& scene, std::size_t m, std::size_t l) {
    const MeshLevel& level = scene.meshes[m].levels[l];
    const Bvh bvh = meshBvh(scene, scene.meshes[m], l);
    grids[m] = {bvh.gridBase, bvh.gridScale};
    const auto firstTriangle = std::uint32_t(triangles.size()), firstVertex = std::uint32_t(positions.size());
    places_[m].push_back({firstVertex, level.positions.size(), {nodes.size(), bvh.nodes.size(), firstTriangle, bvh.triangles.size()}});
    roots[m * LEVELS + l] = appendNodes(bvh, nodes, firstTriangle);
    levels[m * LEVELS + l] = {firstTriangle, std::uint32_t(bvh.triangles.size()), level.error, bytesOf(bvh, level)};
    triangles.insert(triangles.end(), bvh.triangles.begin(), bvh.triangles.end());
    for (std::uint32_t t : bvh.order) {
        const glm::uvec3 corners = level.triangles[t];
        const std::uint32_t material = level.materials[t];
        std::uint32_t emitter = NONE;
        if (l == 0 && scene.materials[material].isLight()) {
            MeshEmitters& list = emitters[m];
            emitter = std::uint32_t(list.primitives.size());
            list.primitives.push_back(std::uint32_t(primitives.size()));
            list.triangles.push_back(corners);
            list.materials.push_back(material);
        }
        emitterIndices.push_back(emitter);
        primitives.push_back({firstVertex + corners.x, firstVertex + corners.y, firstVertex + corners.z, material});
        if (!level.colors.empty()) vertexColor[material] = true;
    }
    positions.insert(positions.end(), level.positions.begin(), level.positions.end());
    for (std::size_t v = 0; v < level.positions.size(); ++v)
        vertices.push_back({.normal = packNormal(level.normals[v]),
                            .tangent = level.tangents.empty() ? 0 : packTangent(level.tangents[v]),
                            .uv0 = level.uv0.empty() ? glm::vec2(0) : level.uv0[v],
                            .uv1 = level.uv1.empty() ? glm::vec2(0) : level.uv1[v],
                            .color = packColor(level.colors.empty() ? glm::vec4(1) : level.colors[v])});
}

void Geometry::pose(const Scene& scene, const Pose& pose) {
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        if (!scene.meshes[m].deforms()) continue;
        Box box;
        for (std::size_t l = 0; l < places_[m].size(); ++l) {
            const Place& place = places_[m][l];
            const PosedVertices posed = deform(scene, m, l, pose);
            for (std::size_t v = 0; v < place.vertices; ++v) {
                const std::size_t at = place.firstVertex + v;
                positions[at] = posed.positions[v];
                vertices[at].normal = packNormal(posed.normals[v]);
                if (!posed.tangents.empty()) vertices[at].tangent = packTangent(posed.tangents[v]);
                box.add(posed.positions[v]);
            }
        }
        bounds[m] = box;
        meshes[m] = meshRecord(box, meshes[m].levels);
        for (const Place& place : places_[m]) grids[m] = refitBvh(nodes, triangles, place.bvh, primitives, positions, box);
    }
}

std::span<const glm::vec3> Geometry::finestPositions(std::size_t mesh) const {
    const Place& place = places_[mesh][0];
    return std::span(positions).subspan(place.firstVertex, place.vertices);
}

}  // namespace lodestir
