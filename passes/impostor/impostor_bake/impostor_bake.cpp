// SPDX-License-Identifier: MIT
// Impostors of meshes: made once, whatever stands where.
#include <framework/pass/pass.h>
#include <framework/pass/scene.h>

#include <passes/impostor/baked_meshes.h>

#include "bake_job.h"
#include "baked_content.h"
#include "texel_memory.h"

#include <algorithm>
#include <bit>
#include <map>

using namespace lodestir;

enum class Compression { none, bc };

struct ImpostorBake final : Pass {
    In<World>         pose{this, "pose", "the scene as meshes that deform are baked in it, anew where it has them in another pose; unwired: as in frame 0",
                   Need::optional};
    Out<Impostors>    impostors{this, "impostors", "views of each mesh, with their pyramids"};
    Out<Buffer<uint>> bytes{this, "bytes", "that they take: 64 bits, the low word first", Count::fixed(2)};
    Out<Buffer<uint>> rawBytes{this, "rawBytes", "that they would take if nothing was compressed, likewise", Count::fixed(2)};
    Out<Buffer<uint>> coverage{this, "coverage", "points tried on the finest levels, spread evenly over a mesh; how many of them at least one view sees",
                               Count::fixed(2)};
    Out<Buffer<uint>> merged{this, "merged", "materials that levels above the finest take for another, because a mesh has more than 8", Count::fixed(1)};
    Param<std::string> mesh{this, "mesh", "", "name of the only mesh that is baked; empty: all that instances show"};
    Param<int>        views{this, "views", 18, {6, 18},
                     "directions that a mesh is seen from, 6: vertices of an octahedron; 12: of an icosahedron; 18: the 6 and the middles of a cube's edges"};
    Param<int>        resolution{this, "resolution", 256, {64, 1024},
                          "texels a side of a view at its finest level, a power of 2; bytes a mesh are 32 times its square a view, 15.3 times if compressed"};
    Param<Compression> compression{this, "compression", Compression::none, {"none", "bc"},
                                   "of texels; bc: normals as BC5, alpha, density and the normal's length as BC4, depth in 16 bits, the rest as it is"};
    Param<int>        points{this, "points", 1024, {0, 1 << 20}, "points a mesh that coverage is measured with"};
    Param<bool>       cache{this, "cache", true, "texels are kept on disk, and taken from there when the same mesh is baked in the same way"};
    ImpostorBake() { cadence = Cadence::onChange; }

    void execute(Frame& frame) override {
        Impostors made = impostorsOf(frame.scene()), raw = made;
        const std::vector<std::uint32_t> baked = bakedMeshes(frame.scene(), mesh, "impostor_bake");
        raw.compressed = 0;
        const TexelMemory memory(made), rawMemory(raw);
        const Memory objects = frame.objects(pose);  // before anything asks for positions

        std::erase_if(texels_, [&](const auto& known) { return std::ranges::find(baked, known.first) == baked.end(); });
        std::vector<Work> work;
        std::vector<Memory> kept{objects};
        std::vector<ImpostorRecord> records(made.meshes);
        for (const std::uint32_t m : baked) {
            work.push_back(workOf(frame, m, made, memory.bytes()));
            records[m] = work.back().record;
            memory.place(texels_[m].memory.address, records[m]);
            kept.insert(kept.end(), {work.back().names, texels_[m].memory});
        }
        kept.push_back(frame.upload(records, "impostors"));
        made.objects = raw.objects = kept.back().address;
        frame.provide(impostors, std::as_bytes(std::span(&made, 1)), std::make_shared<const std::vector<Memory>>(kept));

        if (made.compressed != 0 && std::ranges::any_of(work, &Work::isNew)) {
            // Until they are compressed, the texels of one mesh after the other lie in one place.
            const Memory shared = frame.allocate(rawMemory.bytes(), "impostor texels, raw");
            for (ImpostorRecord& record : records) rawMemory.place(shared.address, record);
            raw.objects = frame.upload(records, "impostors, raw").address;
        }
        std::uint32_t mergedMaterials = 0;
        for (const Work& m : work) mergedMaterials += m.palette.merged;
        uploadWords(frame, bytes, work.size() * memory.bytes());
        uploadWords(frame, rawBytes, work.size() * rawMemory.bytes());
        frame.upload(merged, std::as_bytes(std::span(&mergedMaterials, 1)));
        frame.fill(coverage, 0);
        for (const Work& m : work) bake(frame, m, raw, made, objects);
    }

private:
    /// Texels of a mesh, as long as nothing that they depend on changes.
    struct Texels {
        Hash key;
        Memory memory;
    };
    struct Work {
        std::uint32_t mesh;
        Hash key;
        Palette palette;
        ImpostorRecord record;
        Memory names;
        bool isNew;  ///< its texels are yet to be made
    };
    std::map<std::uint32_t, Texels> texels_;

    Impostors impostorsOf(const Scene& scene) const {
        if (views % 6 != 0) throw Error("an impostor_bake has " + std::to_string(int(views)) + " views", "set \"views\" to 6, 12 or 18");
        const auto side = std::uint32_t(int(resolution));
        if (!std::has_single_bit(side))
            throw Error("an impostor_bake has a resolution of " + std::to_string(side) + ", which is no power of 2",
                        "set \"resolution\" to " + std::to_string(std::bit_floor(side)));
        return {.objects = 0,
                .meshes = std::uint32_t(scene.meshes.size()),
                .views = std::uint32_t(int(views)),
                .resolution = side,
                .levels = std::uint32_t(std::bit_width(side)) - 2,  // down to 4 texels a side
                .compressed = compression == Compression::bc,
                .pad = 0};
    }

    /// Finds its texels where they are kept, or memory for them.
    Work workOf(Frame& frame, std::uint32_t m, const Impostors& made, std::uint64_t memoryBytes) {
        const Scene& scene = frame.scene();
        Work work{.mesh = m, .key = {}, .palette = paletteOf(scene, scene.meshes[m]), .record = {}, .names = {}, .isNew = true};
        const Palette& palette = work.palette;
        if (palette.materials.size() > 0xffff)
            throw Error(Where{scene.file.string()}, "mesh \"" + scene.meshes[m].name + "\" has " + std::to_string(palette.materials.size()) +
                                                        " materials, impostors tell 65535 apart");
        std::vector<std::uint32_t> names;
        for (std::size_t i = 0; i < palette.materials.size(); ++i) names.insert(names.end(), {palette.materials[i], palette.places[i]});
        work.names = frame.upload(names, "impostor materials");
        const Sphere sphere = sphereAround(frame.sceneRecords(), m);
        work.record.names = work.names.address;
        work.record.center = sphere.center;
        work.record.radius = sphere.radius;
        for (std::size_t i = 0; i < PALETTE; ++i) work.record.palette[i] = i < palette.materials.size() ? palette.materials[i] : NONE;

        work.key = bakedContent(scene, frame.sceneRecords(), m, palette);
        work.key.addValue(made.views).addValue(made.resolution).addValue(made.compressed);
        Texels& texels = texels_[m];
        if (texels.memory.keep && texels.key == work.key) {
            work.isNew = false;
        } else if (cache && !(frame.isBound(pose) && scene.meshes[m].deforms())) {  // a file for each pose would be of little use
            const KeptMemory found = frame.kept(work.key, memoryBytes, "impostor texels");
            texels = {found.isFilled ? work.key : Hash(), found.memory};
            work.isNew = !found.isFilled;
        } else {
            texels = {Hash(), frame.allocate(memoryBytes, "impostor texels")};
        }
        return work;
    }

    void bake(Frame& frame, const Work& m, const Impostors& raw, const Impostors& made, const Memory& objects) {
        const Memory numbers = frame.upload(m.palette.numbers(frame.scene()), "impostor material numbers");
        const BakeJob job{.objects = objects.address, .numbers = numbers.address, .texels = raw, .mesh = m.mesh, .pad = 0};
        const std::uint64_t place = frame.upload(std::as_bytes(std::span(&job, 1)), "bake job").address;
        const auto low = std::uint32_t(place), high = std::uint32_t(place >> 32);
        frame.dispatch("coverage.comp", {std::uint32_t(int(points)), 1}, {low, high});
        if (!m.isNew) return;
        const auto levelSize = [&](std::uint32_t level) { return glm::uvec2(made.views * (made.resolution >> level), made.resolution >> level); };
        frame.dispatch(shader, levelSize(0), {low, high});
        for (std::uint32_t level = 1; level < made.levels; ++level) frame.dispatch("pyramid.comp", levelSize(level), {low, high, level});
        for (std::uint32_t level = 0; made.compressed != 0 && level < made.levels; ++level)
            frame.dispatch("compress.comp", levelSize(level) / 4u, {low, high, level});
        for (std::uint32_t level = 0; level < made.levels; ++level) {
            const std::uint32_t across = TexelMemory::tilesAcross(made, level);
            frame.dispatch("tiles.comp", {made.views * across, across}, {low, high, level});
        }
        texels_[m.mesh].key = m.key;
    }

    static void uploadWords(Frame& frame, const Port& port, std::uint64_t value) { frame.upload(port, std::as_bytes(std::span(&value, 1))); }
};
LODESTIR_PASS(ImpostorBake, "impostor_bake.comp",
              "Bakes reshadable impostors of meshes: orthographic views with normal, depth, alpha, texture coordinates and material, and their pyramids.")
