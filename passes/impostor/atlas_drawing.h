// SPDX-License-Identifier: MIT
// What passes that draw atlases share: ports, parameters, and the dispatches of a frame. Their shaders are choose.comp, number.comp and scatter.comp of their
// own folder, made of impostor/atlas_instances.glsl and impostor/atlas_pixel.glsl, and the one that writes the surfaces.
#pragma once
#include <framework/pass/pass.h>
#include <passes/basic/film.h>
#include <passes/impostor/atlas_instance.h>
#include <passes/impostor/atlases.h>
#include <passes/impostor/baked_surface.h>
#include <passes/impostor/instance_items.h>

namespace lodestir {

struct AtlasDrawing {
    In<World>                      world;
    In<Atlases>                    atlases;
    Out<Buffer<BakedSurface>>      surfaces;
    Scratch<Buffer<AtlasInstance>> drawn;
    InstanceItems                  blocks;
    Scratch<Buffer<NearKey>>       keys;
    FilmPlace                      place;
    Param<float>                   bias;

    explicit AtlasDrawing(Pass* pass)
        : world{pass, "world", "the scene: camera, and where its instances stand"},
          atlases{pass, "atlases", "of the meshes: instances of those that were baked are drawn"},
          surfaces{pass, "surfaces", "what each pixel shows of them", Count::perPixel()},
          drawn{pass, "drawn", "where each instance is drawn", Count::reserved()},
          blocks{pass},
          keys{pass, "keys", "nearest instance of each pixel", Count::perPixel()},
          place{pass},
          bias{pass, "bias", 0, {-16, 16}, "added to the level of the mipmaps, whose texels are about as wide as a pixel"} {}

    /// `write`: the shader that writes the surfaces.
    void execute(Frame& frame, std::string_view write) {
        const std::uint32_t instances = frame.valueOf(world).instanceCount;
        frame.reserve(drawn, instances);
        blocks.reserve(frame, instances);
        frame.fill(keys, NONE);
        frame.dispatch("choose.comp", {instances, 1});
        InstanceItems::number(frame, instances);
        frame.dispatch("scatter.comp", {InstanceItems::lanes, 1});
        frame.dispatch(write, frame.size());
    }
};

}  // namespace lodestir
