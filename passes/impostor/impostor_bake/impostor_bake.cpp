// SPDX-License-Identifier: MIT
// Impostors of meshes: made once, whatever stands where.
#include <framework/pass/pass.h>
#include <framework/pass/scene.h>

#include "palette.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <set>

using namespace lodestir;

struct ImpostorBake final : Pass {
    Out<Impostors>    impostors{this, "impostors", "views of each mesh, with their pyramids"};
    Out<Buffer<uint>> bytes{this, "bytes", "that they take: 64 bits, the low word first", Count::fixed(2)};
    Out<Buffer<uint>> coverage{this, "coverage", "points tried on the finest levels, spread evenly over a mesh; how many of them at least one view sees",
                               Count::fixed(2)};
    Out<Buffer<uint>> merged{this, "merged", "materials that levels above the finest take for another, because a mesh has more than 8", Count::fixed(1)};
    Param<std::string> mesh{this, "mesh", "", "name of the only mesh that is baked; empty: all that instances show"};
    Param<int>        views{this, "views", 18, {6, 18},
                     "directions that a mesh is seen from, 6: vertices of an octahedron; 12: of an icosahedron; 18: the 6 and the middles of a cube's edges"};
    Param<int>        resolution{this, "resolution", 256, {64, 1024},
                          "texels a side of a view at its finest level, a power of 2; bytes a mesh are 32 times its square a view"};
    Param<int>        points{this, "points", 1024, {0, 1 << 20}, "points a mesh that coverage is measured with"};
    ImpostorBake() { cadence = Cadence::onChange; }

    void execute(Frame& frame) override {
        if (views % 6 != 0) throw Error("an impostor_bake has " + std::to_string(int(views)) + " views", "set \"views\" to 6, 12 or 18");
        if (!std::has_single_bit(std::uint32_t(int(resolution))))
            throw Error("an impostor_bake has a resolution of " + std::to_string(int(resolution)) + ", which is no power of 2",
                        "set \"resolution\" to " + std::to_string(std::bit_floor(std::uint32_t(int(resolution)))));
        const std::vector<std::uint32_t> baked = bakedMeshes(frame.scene());
        const Memory objects = frame.objects();
        std::vector<Memory> memories{objects};
        Impostors made{.objects = 0,
                       .meshes = std::uint32_t(frame.scene().meshes.size()),
                       .views = std::uint32_t(int(views)),
                       .resolution = std::uint32_t(int(resolution)),
                       .levels = std::uint32_t(std::bit_width(std::uint32_t(int(resolution)))) - 2};  // down to 4 texels a side
        std::vector<ImpostorRecord> records(made.meshes);
        std::uint32_t mergedMaterials = 0;
        for (const std::uint32_t m : baked) {
            const Palette palette = paletteOf(frame.scene(), frame.scene().meshes[m]);
            records[m] = recordOf(frame, made, m, palette, memories);
            mergedMaterials += palette.merged;
        }
        memories.push_back(frame.upload(records, "impostors"));
        made.objects = memories.back().address;
        frame.provide(impostors, std::as_bytes(std::span(&made, 1)), std::make_shared<const std::vector<Memory>>(memories));

        const std::uint64_t taken = baked.size() * texelCount(made) * bytesPerTexel;
        frame.upload(bytes, std::as_bytes(std::span(&taken, 1)));
        frame.upload(merged, std::as_bytes(std::span(&mergedMaterials, 1)));
        frame.fill(coverage, 0);
        const auto low = std::uint32_t(objects.address), high = std::uint32_t(objects.address >> 32);
        for (const std::uint32_t m : baked) {
            frame.dispatch(shader, {made.views * made.resolution, made.resolution}, {m, low, high});
            for (std::uint32_t level = 1; level < made.levels; ++level)
                frame.dispatch("pyramid.comp", {made.views * (made.resolution >> level), made.resolution >> level}, {m, low, high, level});
            frame.dispatch("coverage.comp", {std::uint32_t(int(points)), 1}, {m, low, high});
        }
    }

private:
    static constexpr std::uint64_t bytesPerTexel = sizeof(glm::uvec4) + 2 * sizeof(std::uint32_t);

    static std::uint64_t texelCount(const Impostors& made) {
        std::uint64_t count = 0;
        for (std::uint32_t level = 0; level < made.levels; ++level) count += std::uint64_t(made.resolution >> level) * (made.resolution >> level);
        return count * made.views;
    }

    std::vector<std::uint32_t> bakedMeshes(const Scene& scene) const {
        const std::string& wanted = mesh;
        std::set<std::uint32_t> shown;
        std::vector<std::string> names;
        for (const Instance& instance : scene.instances) {
            const std::string& name = scene.meshes[instance.mesh].name;
            names.push_back(name);
            if ((wanted.empty() || name == wanted) && !scene.meshes[instance.mesh].levels.front().triangles.empty()) shown.insert(instance.mesh);
        }
        if (!wanted.empty() && shown.empty())
            throw Error(Where{scene.file.string()}, "no instance shows a mesh \"" + wanted + "\" for an impostor_bake to bake", didYouMean(wanted, names));
        return {shown.begin(), shown.end()};
    }

    struct Sphere {
        glm::vec3 center;
        float radius;
    };
    /// Around the finest level, from the middle of its box: a ball fills its views.
    static Sphere sphereAround(const SceneRecords& scene, std::uint32_t m) {
        const LevelRecord& level = scene.meshLevels[m * LEVELS];
        const auto triangles = scene.primitives.subspan(level.firstPrimitive, level.primitiveCount);
        glm::vec3 low(std::numeric_limits<float>::max()), high = -low;
        for (const PrimitiveRecord& t : triangles) {
            for (const std::uint32_t v : {t.v0, t.v1, t.v2}) {
                low = glm::min(low, glm::vec3(scene.positions[v]));
                high = glm::max(high, glm::vec3(scene.positions[v]));
            }
        }
        Sphere sphere{low + 0.5f * (high - low), 0};
        for (const PrimitiveRecord& t : triangles)
            for (const std::uint32_t v : {t.v0, t.v1, t.v2})
                sphere.radius = std::max(sphere.radius, glm::distance(sphere.center, glm::vec3(scene.positions[v])));
        return sphere;
    }

    static ImpostorRecord recordOf(Frame& frame, const Impostors& made, std::uint32_t m, const Palette& palette, std::vector<Memory>& memories) {
        const std::uint64_t texels = texelCount(made);
        memories.push_back(frame.upload(std::vector<std::byte>(texels * bytesPerTexel), "impostor texels"));
        const std::uint64_t geometry = memories.back().address, uvs = geometry + texels * sizeof(glm::uvec4);
        memories.push_back(frame.upload(palette.places, "impostor palette"));
        const Sphere sphere = sphereAround(frame.sceneRecords(), m);
        ImpostorRecord record{.geometry = geometry,
                              .uvs = uvs,
                              .materials = uvs + texels * sizeof(std::uint32_t),
                              .places = memories.back().address,
                              .center = sphere.center,
                              .radius = sphere.radius};
        std::ranges::copy(palette.materials, record.palette);
        return record;
    }
};
LODESTIR_PASS(ImpostorBake, "impostor_bake.comp",
              "Bakes reshadable impostors of meshes: orthographic views with normal, depth, alpha, texture coordinates and material, and their pyramids.")
