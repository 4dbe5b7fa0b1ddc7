// SPDX-License-Identifier: MIT
// A material changed while everything runs.
#include <framework/pass/pass.h>
#include <framework/pass/scene.h>

using namespace lodestir;

struct MaterialEdit final : Pass {
    In<World>          world{this, "world", "the scene"};
    Out<World>         worldOut{this, "world", "the scene with the material changed"};
    Param<std::string> material{this, "material", "", "its name in the scene; empty: all of them"};
    Param<float>       red{this, "red", 1, {0, 100}, "factor on the red of the base colour"};
    Param<float>       green{this, "green", 1, {0, 100}, "on its green"};
    Param<float>       blue{this, "blue", 1, {0, 100}, "on its blue"};
    Param<float>       roughness{this, "roughness", -1, {-1, 1}, "perceptual roughness, which its map scales; below 0: as it is"};
    Param<float>       metallic{this, "metallic", -1, {-1, 1}, "share of metal, which its map scales; below 0: as it is"};
    Param<float>       emission{this, "emission", 1, {0, 1e6f}, "factor on its emission"};
    PassThrough        off{this, world, worldOut};

    void execute(Frame& frame) override {
        const std::vector<Material>& materials = frame.scene().materials;
        const std::string& wanted = material;
        if (!wanted.empty()) namedThing(frame.scene(), materials, wanted, "material", "a material_edit to change");
        const Memory memory = frame.upload(std::vector<MaterialRecord>(materials.size()), "materials");
        World made = frame.valueOf(world);
        made.materials = memory.address;
        frame.provide(worldOut, std::as_bytes(std::span(&made, 1)), memory.keep, std::span<const std::byte>());
        frame.dispatch(shader, {std::uint32_t(materials.size()), 1}, {0, wanted.empty()});
        for (std::uint32_t i = 0; i < materials.size(); ++i)
            if (materials[i].name == wanted) frame.dispatch(shader, {1, 1}, {i, true});
    }
};
LODESTIR_PASS(MaterialEdit, "material_edit.comp", "Changes a material of the scene from this frame on: colour, roughness, metal, emission.")
