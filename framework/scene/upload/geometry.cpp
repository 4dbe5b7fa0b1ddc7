// SPDX-License-Identifier: MIT
#include <framework/scene/upload/geometry.h>

#include <framework/core/log.h>
#include <framework/core/tasks.h>
#include <framework/scene/bvh/mesh_bvh.h>
#include <framework/scene/upload/pack.h>

#include <algorithm>
#include <utility>

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
    return std::uint32_t(bvh.nodes.size() * sizeof(BvhNode) + bvh.order.size() * triangle + level.positions.size() * vertex);
}

}  // namespace

Geometry::Geometry(const Scene& scene, const gpu::Device* device)
    : roots(scene.meshes.size() * LEVELS, bvh_ref::empty), levels(scene.meshes.size() * LEVELS), emitters(scene.meshes.size()),
      grids(scene.meshes.size()), vertexColor(scene.materials.size(), false), places_(scene.meshes.size()) {
    std::vector<std::vector<Bvh>> orders(scene.meshes.size());
    log::Progress progress("building BVHs", scene.meshes.size());
    for (std::size_t m = 0; m < scene.meshes.size(); ++m, progress.advance()) {
        bounds.push_back(boundsOf(scene.meshes[m]));
        for (std::size_t l = 0; l < scene.meshes[m].levels.size(); ++l) orders[m].push_back(addLevel(scene, m, l));
    }
    allocate(device, scene.deforms());
    for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
        const std::size_t count = scene.meshes[m].levels.size();
        for (std::size_t l = 0; l < count; ++l) placeLevel(scene, m, l, std::exchange(orders[m][l], {}));
        for (std::size_t l = count; l < LEVELS; ++l) {
            roots[m * LEVELS + l] = roots[m * LEVELS + count - 1];
            levels[m * LEVELS + l] = levels[m * LEVELS + count - 1];
        }
        meshes.push_back(meshRecord(bounds[m], count));
    }
    triangles.values().back() = {};
    const auto upload = [](auto&... arrays) { (arrays.upload(), ...); };
    upload(triangles, primitives, emitterIndices, positions, vertices);
}

Bvh Geometry::addLevel(const Scene& scene, std::size_t m, std::size_t l) {
    const MeshLevel& level = scene.meshes[m].levels[l];
    Bvh bvh = meshBvh(scene, scene.meshes[m], l);
    grids[m] = {bvh.gridBase, bvh.gridScale};
    places_[m].push_back({vertexCount_, level.positions.size(), {nodes.size(), bvh.nodes.size(), triangleCount_, bvh.order.size()}});
    roots[m * LEVELS + l] = appendNodes(bvh, nodes, triangleCount_);
    levels[m * LEVELS + l] = {std::uint32_t(triangleCount_), std::uint32_t(bvh.order.size()), level.error, bytesOf(bvh, level)};
    triangleCount_ += bvh.order.size();
    vertexCount_ += level.positions.size();
    bvh.nodes = {};
    return bvh;
}

void Geometry::allocate(const gpu::Device* device, bool deforms) {
    const gpu::Device* shapes = deforms ? nullptr : device;
    triangles = {shapes, triangleCount_ + 1, "triangles"};
    positions = {shapes, vertexCount_, "positions"};
    vertices = {shapes, vertexCount_, "vertices"};
    primitives = {device, triangleCount_, "primitives"};
    emitterIndices = {device, triangleCount_, "emitters"};
}

void Geometry::placeLevel(const Scene& scene, std::size_t m, std::size_t l, const Bvh& bvh) {
    const MeshLevel& level = scene.meshes[m].levels[l];
    const auto& [firstVertex, vertexCount, range] = places_[m][l];
    const std::vector<std::uint32_t> masks = triangleMasks(scene, level);
    placeTriangles({level.positions, level.triangles, masks}, bvh, triangles.values().subspan(range.firstTriangle, range.triangles));

    const auto first = std::uint32_t(firstVertex);
    const std::span<PrimitiveRecord> mine = primitives.values().subspan(range.firstTriangle, range.triangles);
    parallelFor(range.triangles, 16384, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const glm::uvec3 corners = level.triangles[bvh.order[i]];
            mine[i] = {first + corners.x, first + corners.y, first + corners.z, level.materials[bvh.order[i]]};
        }
    });
    const std::span<std::uint32_t> emitter = emitterIndices.values().subspan(range.firstTriangle, range.triangles);
    std::ranges::fill(emitter, NONE);
    const auto isLight = [&](std::uint32_t material) { return scene.materials[material].isLight(); };
    emitters[m].emplace_back();
    if (std::ranges::any_of(level.materials, isLight)) listEmitters(scene, m, l, bvh.order, emitter);
    if (!level.colors.empty())
        for (const std::uint32_t material : level.materials) vertexColor[material] = true;

    parallelFor(vertexCount, 16384, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v) {
            positions.values()[firstVertex + v] = glm::vec4(level.positions[v], 0);
            vertices.values()[firstVertex + v] = {.normal = packNormal(level.normals[v]),
                                                  .tangent = level.tangents.empty() ? 0 : packTangent(level.tangents[v]),
                                                  .uv0 = level.uv0.empty() ? glm::vec2(0) : level.uv0[v],
                                                  .uv1 = level.uv1.empty() ? glm::vec2(0) : level.uv1[v],
                                                  .color = packColor(level.colors.empty() ? glm::vec4(1) : level.colors[v])};
        }
    });
}

void Geometry::listEmitters(const Scene& scene, std::size_t m, std::size_t l, std::span<const std::uint32_t> order, std::span<std::uint32_t> emitter) {
    const MeshLevel& level = scene.meshes[m].levels[l];
    LevelEmitters& list = emitters[m][l];
    for (std::size_t i = 0; i < order.size(); ++i) {
        const std::uint32_t material = level.materials[order[i]];
        if (!scene.materials[material].isLight()) continue;
        emitter[i] = std::uint32_t(list.primitives.size());
        list.primitives.push_back(std::uint32_t(places_[m][l].bvh.firstTriangle + i));
        list.triangles.push_back(level.triangles[order[i]]);
        list.materials.push_back(material);
    }
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
                positions.values()[at] = glm::vec4(posed.positions[v], 0);
                vertices.values()[at].normal = packNormal(posed.normals[v]);
                if (!posed.tangents.empty()) vertices.values()[at].tangent = packTangent(posed.tangents[v]);
                box.add(posed.positions[v]);
            }
        }
        bounds[m] = box;
        meshes[m] = meshRecord(box, meshes[m].levels);
        for (const Place& place : places_[m]) grids[m] = refitBvh(nodes, triangles.values(), place.bvh, primitives.values(), positions.values(), box);
    }
}

std::span<const glm::vec4> Geometry::positionsOf(std::size_t mesh, std::size_t level) const {
    const Place& place = places_[mesh][level];
    return positions.values().subspan(place.firstVertex, place.vertices);
}

}  // namespace lodestir
