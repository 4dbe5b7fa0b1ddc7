// SPDX-License-Identifier: MIT
// Atlases of colours: made once, whatever stands where.
#include <framework/pass/pass.h>
#include <framework/pass/scene.h>
#include <passes/impostor/atlases.h>
#include <passes/impostor/baked_meshes.h>

#include <bit>

using namespace lodestir;

enum class Arrangement { full, hemi, cross, star };  // ATLAS_*
enum class Attributes { paper, matched };

struct ImpostorAtlas final : Pass {
    In<World>             pose{this, "pose", "the scene as meshes that deform are baked in it; unwired: as in frame 0", Need::optional};
    Out<Atlases>          atlases{this, "atlases", "views of each mesh, with their mipmaps"};
    Out<Buffer<uint>>     bytes{this, "bytes", "that they take: 64 bits, the low word first", Count::fixed(2)};
    Scratch<Buffer<uint>> counts{this, "counts", "texels of each alpha, in 255ths, of each view and level of a mesh", Count::reserved()};
    Scratch<Buffer<uint>> limits{this, "limits", "alpha, in 255ths, that as many texels of a level reach as do one half at the finest", Count::reserved()};
    Param<std::string>    mesh{this, "mesh", "", "name of the only mesh that is baked; empty: all that instances show"};
    Param<Arrangement>    arrangement{this, "arrangement", Arrangement::full, {"full", "hemi", "cross", "star"},
                                      "directions that a mesh is seen from, full: a grid over the octahedral map of the sphere; hemi: one over that of the "
                                      "upper hemisphere; cross: both sides of three cards at right angles; star: of three upright cards and a level one"};
    Param<int>            across{this, "across", 16, {2, 64}, "of full and hemi: views a side of the grid"};
    Param<int>            resolution{this, "resolution", 128, {16, 1024},
                             "texels a side of a view at its finest level, a power of 2; with mipmaps a texel takes 10.7 bytes, 21.3 with matched attributes"};
    Param<Attributes>     attributes{this, "attributes", Attributes::matched, {"paper", "matched"},
                                    "what is kept, paper: base colour, normal and alpha, all else being the same everywhere: roughness 0.7, metallic 0, no "
                                    "emission, depth that of the view's plane; matched: depth, roughness, metallic and emission as well"};
    ImpostorAtlas() { cadence = Cadence::onChange; }

    void execute(Frame& frame) override {
        if (!std::has_single_bit(std::uint32_t(int(resolution))))
            throw Error("an impostor_atlas has a resolution of " + std::to_string(int(resolution)) + ", which is no power of 2",
                        "set \"resolution\" to " + std::to_string(std::bit_floor(std::uint32_t(int(resolution)))));
        const std::vector<std::uint32_t> baked = bakedMeshes(frame.scene(), mesh, "impostor_atlas");
        Atlases made{.objects = 0,
                     .meshes = std::uint32_t(frame.scene().meshes.size()),
                     .arrangement = std::uint32_t(Arrangement(arrangement)),
                     .across = arrangement == Arrangement::cross ? 6u : arrangement == Arrangement::star ? 8u : std::uint32_t(int(across)),
                     .resolution = std::uint32_t(int(resolution)),
                     .levels = std::uint32_t(std::bit_width(std::uint32_t(int(resolution)))) - 3,  // down to 8 texels a side
                     .isMatched = attributes == Attributes::matched ? 1u : 0u};
        const std::uint64_t texels = texelCount(made), perMesh = texels * sizeof(glm::uvec2) * (1 + made.isMatched);
        if (texels > mostTexels)
            throw Error("an impostor_atlas has " + std::to_string(texels) + " texels a mesh, more than " + std::to_string(mostTexels),
                        "lower \"across\" or \"resolution\"");
        const std::uint32_t groups = viewsOf(made) * made.levels;
        frame.reserve(counts, groups * 256);
        frame.reserve(limits, groups);
        const Memory objects = frame.objects(pose);
        std::vector<Memory> memories{objects};
        std::vector<AtlasRecord> records(made.meshes);
        for (const std::uint32_t m : baked) {
            memories.push_back(frame.allocate(perMesh, "atlas texels"));
            const Sphere sphere = sphereAround(frame.sceneRecords(), m);
            records[m] = {.shades = memories.back().address,
                          .matters = made.isMatched != 0 ? memories.back().address + texels * sizeof(glm::uvec2) : 0,
                          .center = sphere.center,
                          .radius = sphere.radius};
        }
        memories.push_back(frame.upload(records, "atlases"));
        made.objects = memories.back().address;
        frame.provide(atlases, std::as_bytes(std::span(&made, 1)), std::make_shared<const std::vector<Memory>>(memories));
        const std::uint64_t taken = baked.size() * perMesh;
        frame.upload(bytes, std::as_bytes(std::span(&taken, 1)));

        const std::uint32_t row = viewsOf(made) * made.resolution;  // what there are of texels is more than one row of workgroups may have
        const glm::uvec2 allTexels(row, (texels + row - 1) / row);
        const auto low = std::uint32_t(objects.address), high = std::uint32_t(objects.address >> 32);
        for (const std::uint32_t m : baked) {
            frame.dispatch(shader, {viewsOf(made) * made.resolution, made.resolution}, {m, low, high});
            for (std::uint32_t level = 1; level < made.levels; ++level)
                frame.dispatch("coarsen.comp", {viewsOf(made) * (made.resolution >> level), made.resolution >> level}, {m, low, high, level});
            frame.fill(counts, 0);
            frame.dispatch("keep_coverage.comp", allTexels, {m, low, high, 0});
            frame.dispatch("keep_coverage.comp", {groups, 1}, {m, low, high, 1});
            frame.dispatch("keep_coverage.comp", allTexels, {m, low, high, 2});
        }
    }

private:
    static constexpr std::uint64_t mostTexels = std::uint64_t(1) << 28;

    static std::uint32_t viewsOf(const Atlases& made) { return made.arrangement <= ATLAS_HEMI ? made.across * made.across : made.across; }

    static std::uint64_t texelCount(const Atlases& made) {
        std::uint64_t count = 0;
        for (std::uint32_t level = 0; level < made.levels; ++level) count += std::uint64_t(made.resolution >> level) * (made.resolution >> level);
        return count * viewsOf(made);
    }
};
LODESTIR_PASS(ImpostorAtlas, "impostor_atlas.comp",
              "Bakes atlases of colours of meshes: orthographic views with materials evaluated, for billboards and octahedral impostors.")
