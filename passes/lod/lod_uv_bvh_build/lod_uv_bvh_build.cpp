// SPDX-License-Identifier: MIT
// Finds points of a level by texture coordinate: the index that maps vertices between levels.
#include <framework/pass/pass.h>

#include "uv_tree.h"

#include <array>

using namespace lodestir;

struct LodUvBvhBuild final : Pass {
    Out<UvIndex> index{this, "index", "triangles of every level of every mesh that has several, by texture coordinate"};
    LodUvBvhBuild() { cadence = Cadence::onChange; }

    void execute(Frame& frame) override {
        const UvTrees trees = uvTrees(frame.sceneRecords());
        const std::array memories{frame.upload(trees.nodes, "UV nodes"), frame.upload(trees.primitives, "UV primitives"),
                                  frame.upload(trees.roots, "UV roots")};
        const UvIndex made{memories[0].address, memories[1].address, memories[2].address};
        frame.provide(index, std::as_bytes(std::span(&made, 1)), std::make_shared<const std::array<Memory, 3>>(memories));
    }
};
LODESTIR_PASS(LodUvBvhBuild, "", "Builds the index from texture coordinates to triangles that vertex mapping between levels asks.")
