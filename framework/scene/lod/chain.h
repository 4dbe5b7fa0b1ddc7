// SPDX-License-Identifier: MIT
// A chain of coarser and coarser levels of one mesh, with measured errors.
#pragma once
#include <framework/scene/lod/error.h>
#include <framework/scene/lod/vertex_fit.h>

#include <string>

namespace lodestir {

struct LodChainOptions {
    int levels = 4;    ///< in all, the finest included: 2..maxLevels
    double ratio = 2;  ///< triangles of a level over those of the next coarser one
    bool fitNormals = true;  ///< else vertices keep the finest level's
};

struct LodLevel {
    std::vector<glm::uvec3> triangles;  ///< of the finest level's vertices
    std::vector<std::uint32_t> groups;  ///< of each triangle, as MeshLevel::materials
    VertexFit looks;                    ///< of the finest level's vertices, as this level shows them
    float error = 0;  ///< largest distance to the finest level in space and in what is seen, never below that of the level before
    LodError measured;
};

struct LodChain {
    std::vector<LodLevel> coarser;  ///< finer to coarser
    std::string end;                ///< why there are fewer than asked for; empty when there are not
    bool hasUvs = false;
    float radius = 0;  ///< of a sphere around the finest level
};

/// Simplifies the finest level further and further, fits the colours and normals of each level to those of the level before, and measures each against the
/// finest. A level that hardly has fewer triangles than the one before, is farther from the finest than a quarter of the radius, or has lost a twentieth of
/// the UVs, is not made, nor are coarser ones.
LODESTIR_API LodChain buildLodChain(const MeshLevel& finest, const LodChainOptions& options);

/// MSFT_screencoverage of each level of a chain: the share of a 16:9 image that the sphere around the mesh covers where the next level's
/// error is a pixel of 1080 rows; the coarsest is used down to 0. The vertical angle of view cancels out.
LODESTIR_API std::vector<float> screenCoverages(const LodChain& chain);

}  // namespace lodestir
