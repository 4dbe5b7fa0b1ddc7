// SPDX-License-Identifier: MIT
// All meshes of a scene as traversal and shading read them: in arrays, level after level, mesh after mesh.
#pragma once
#include <framework/gpu/array.h>
#include <framework/scene/bvh/bvh.h>
#include <framework/scene/deformation.h>
#include <framework/scene/upload/light_list.h>

#include <vector>

namespace lodestir {

struct Geometry {
    std::vector<BvhNode> nodes;
    gpu::Array<BvhTriangle> triangles;           ///< and one more, for loads that reach behind the last
    std::vector<std::uint32_t> roots;            ///< of mesh m at level l: m * LEVELS + l; levels that a mesh does not have repeat its coarsest
    std::vector<LevelRecord> levels;             ///< the same
    std::vector<MeshRecord> meshes;
    gpu::Array<PrimitiveRecord> primitives;      ///< in the order of `triangles`
    gpu::Array<std::uint32_t> emitterIndices;    ///< of each primitive, see World.emitters
    gpu::Array<glm::vec4> positions;             ///< w: 0
    gpu::Array<VertexRecord> vertices;
    std::vector<std::vector<LevelEmitters>> emitters;  ///< of each mesh, by level
    std::vector<Box> bounds;                     ///< of each mesh, over its levels
    std::vector<BvhGrid> grids;                  ///< of each mesh
    std::vector<bool> vertexColor;               ///< of each material: some triangle with it has vertex colours

    /// The scene's meshes as their files have them. BVHs come from the cache where they were built before. Where nothing deforms the arrays are written
    /// where the device reads them; what the poses of a scene that deforms change stays with the CPU, and so does all without a device.
    explicit Geometry(const Scene& scene, const gpu::Device* device = nullptr);
    /// Moves the vertices of the meshes that deform, and fits boxes, spheres and normals to them.
    void pose(const Scene& scene, const Pose& pose);
    /// Positions of a mesh at one of its levels.
    std::span<const glm::vec4> positionsOf(std::size_t mesh, std::size_t level) const;

private:
    struct Place {  ///< of a level of a mesh in the arrays
        std::size_t firstVertex = 0, vertices = 0;
        BvhRange bvh;
    };
    /// Its tree goes to the others; the order of its triangles is left for placeLevel.
    Bvh addLevel(const Scene& scene, std::size_t mesh, std::size_t level);
    void allocate(const gpu::Device* device, bool deforms);
    void placeLevel(const Scene& scene, std::size_t mesh, std::size_t level, const Bvh& order);
    void listEmitters(const Scene& scene, std::size_t mesh, std::size_t level, std::span<const std::uint32_t> order, std::span<std::uint32_t> emitter);
    std::vector<std::vector<Place>> places_;  ///< of each level of each mesh
    std::size_t triangleCount_ = 0, vertexCount_ = 0;
};

}  // namespace lodestir
