// SPDX-License-Identifier: MIT
#include <framework/scene/lod/chain.h>

#include <framework/scene/lod/simplify.h>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace lodestir {
namespace {

constexpr double leastProgress = 0.85;  ///< of the triangles before: a level above it is not worth its memory
constexpr float largestError = 0.25f;   ///< of the radius: beyond, a level no longer resembles the mesh
constexpr float mostLost = 0.05f;       ///< of the area, of UVs that the other level has not: paths cannot be mapped there
constexpr std::size_t fewestTriangles = 2;

}  // namespace

LodChain buildLodChain(const MeshLevel& finest, const LodChainOptions& options) {
    const LodReference reference(finest);
    Simplifier simplifier(finest);
    LodChain chain{.hasUvs = reference.hasUvs(), .radius = reference.radius()};
    MeshLevel before = finest;
    float error = 0;
    for (int k = 1; k < options.levels; ++k) {
        const auto target = std::size_t(double(finest.triangles.size()) / std::pow(options.ratio, k));
        if (target < fewestTriangles) {
            chain.end = fmt::format("{} triangle{} too few to go on", before.triangles.size(), before.triangles.size() == 1 ? " is" : "s are");
            break;
        }
        simplifier.reduce(target);
        Simplified simplified = simplifier.result();
        if (double(simplified.triangles.size()) > leastProgress * double(before.triangles.size())) {
            chain.end = fmt::format("{} triangles cannot be made fewer without tearing the surface or its UVs", before.triangles.size());
            break;
        }
        VertexFit looks = fitVertices(before, simplified.triangles, simplified.groups);
        if (!options.fitNormals) looks.normals = finest.normals;
        const LodError measured = reference.measure(simplified.triangles, looks);
        if (measured.distance() > largestError * chain.radius) {
            chain.end = fmt::format("with {} triangles it would be off by {:.3g}, more than a quarter of its radius",
                                    simplified.triangles.size(), measured.distance());
            break;
        }
        if (const float lost = std::max(measured.uvLostCoarse, measured.uvLostFinest); lost > mostLost) {
            chain.end = fmt::format("with {} triangles {:.0f} % of its UVs would have no partner", simplified.triangles.size(), 100 * lost);
            break;
        }
        error = std::max(error, measured.largest());
        before.triangles = simplified.triangles;
        before.materials = simplified.groups;
        before.colors = looks.colors;
        before.normals = looks.normals;
        chain.coarser.push_back({std::move(simplified.triangles), std::move(simplified.groups), std::move(looks), error, measured});
    }
    return chain;
}

std::vector<float> screenCoverages(const LodChain& chain) {
    constexpr float rows = 1080, shape = 16.0f / 9;
    std::vector<float> coverages;
    for (const LodLevel& next : chain.coarser) {
        // At distance d, an error e is e rows / (2 d tan(fovy/2)) pixels, and the sphere is 2 r / (2 d tan(fovy/2)) images high.
        const float height = next.error > 0 ? 2 * chain.radius / (next.error * rows) : 1e3f;
        coverages.push_back(std::min(1.0f, glm::quarter_pi<float>() * height * height / shape));
    }
    coverages.push_back(0);
    return coverages;
}

}  // namespace lodestir
