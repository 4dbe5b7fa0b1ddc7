// SPDX-License-Identifier: MIT
// Finds points of a level by texture coordinate: the index that maps vertices between levels.
#include <framework/pass/pass.h>

#include <framework/core/log.h>
#include <framework/gpu/buffer.h>
#include <framework/scene/bvh/mesh_bvh.h>

#include "uv_tree.h"

using namespace lodestir;

namespace {

struct UvMemory {
    gpu::Buffer nodes, primitives, roots;
};

}  // namespace

struct LodUvBvhBuild final : Pass {
    Out<UvIndex> index{this, "index", "triangles of every level of every mesh that has several, by texture coordinate"};
    LodUvBvhBuild() { cadence = Cadence::onChange; }

    void execute(Frame& frame) override {
        const Scene& scene = frame.scene();
        UvTrees trees;
        trees.roots.assign(scene.meshes.size() * LEVELS, NONE);
        std::uint32_t firstPrimitive = 0;
        for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
            const Mesh& mesh = scene.meshes[m];
            for (std::size_t l = 0; l < mesh.levels.size(); ++l) {
                const bool wanted = mesh.levels.size() > 1;
                if (wanted) trees.roots[m * LEVELS + l] = addUvTree(trees, mesh.levels[l], meshBvh(scene, mesh, l).order, firstPrimitive);
                firstPrimitive += std::uint32_t(mesh.levels[l].triangles.size());
            }
        }
        if (trees.nodes.empty()) {  // an empty buffer has no address
            trees.nodes.emplace_back();
            trees.primitives.push_back(NONE);
        }
        if (trees.roots.empty()) trees.roots.push_back(NONE);
        auto memory = std::make_shared<UvMemory>();
        memory->nodes = gpu::makeBuffer(frame.device(), std::span<const UvNode>(trees.nodes), "UV nodes");
        memory->primitives = gpu::makeBuffer(frame.device(), std::span<const std::uint32_t>(trees.primitives), "UV primitives");
        memory->roots = gpu::makeBuffer(frame.device(), std::span<const std::uint32_t>(trees.roots), "UV roots");
        const UvIndex made{memory->nodes.address(), memory->primitives.address(), memory->roots.address()};
        frame.provide(index, std::as_bytes(std::span(&made, 1)), memory);
    }
};
LODESTIR_PASS(LodUvBvhBuild, "", "Builds the index from texture coordinates to triangles that vertex mapping between levels asks.")
