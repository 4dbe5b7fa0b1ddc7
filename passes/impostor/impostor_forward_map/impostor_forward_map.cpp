// SPDX-License-Identifier: MIT
// Impostors drawn by scattering: all texels of all views that may be seen, the nearest in each pixel.
#include <framework/pass/pass.h>
#include <framework/shaders/impostor/impostors.h>
#include <framework/shaders/impostor/surfel.h>
#include <passes/impostor/instance_items.h>

#include "drawn.h"

using namespace lodestir;

enum class LevelRule { footprint, distance, fixed };
enum class PixelPlace { centre, frame };
enum class Atomics { wide, pair };

struct ImpostorForwardMap final : Pass {
    In<World>                 world{this, "world", "the scene: camera, and where its instances stand"};
    In<Impostors>             impostors{this, "impostors", "of the meshes: instances of those that were baked are drawn"};
    Out<World>                worldOut{this, "world", "the scene for all rays but the camera's: instances that are drawn as impostors show a coarse level "
                                                      "of their mesh, and camera hits may be texels"};
    Out<World>                rest{this, "rest", "the scene for camera rays: without the instances that are drawn as impostors"};
    Out<Buffer<Surfel>>       surfels{this, "surfels", "what each pixel shows of them", Count::perPixel()};
    Out<Buffer<uint>>         texels{this, "texels", "that were scattered, those of empty tiles left out: 64 bits, the low word first", Count::fixed(2)};
    State<Buffer<uint>>       levels{this, "levels", "of each instance: what it is drawn as, what it was before, and since when (choose.comp)",
                                     Count::fixed(1 << 16)};
    Scratch<Buffer<Drawn>>    drawn{this, "drawn", "what of each instance is drawn", Count::reserved()};
    InstanceItems             numbered{this};
    Scratch<Buffer<uint>>     totals{this, "totals", "tiles if all levels were so much coarser, 64 bits each", Count::fixed(16)};
    Scratch<Buffer<uint>>     tilesShown{this, "tilesShown", "how many tiles may be seen", Count::fixed(1)};
    Scratch<Buffer<uint>>     shown{this, "shown", "numbers of the tiles that may be seen", Count::reserved()};
    Scratch<Buffer<SplatKey>> keys{this, "keys", "nearest texel of each pixel", Count::perPixel()};
    Param<float>              pixelError{this, "pixelError", 0, {0, 1000},
                                         "an instance is drawn as its impostor where the finest texels are smaller than so many pixels, and left to "
                                         "geometry where it is nearer; 0: all are drawn, however near"};
    Param<LevelRule>          level{this, "level", LevelRule::footprint, {"footprint", "distance", "fixed"},
                                    "of an instance: whose texels are nearly as wide as a pixel; log2 of distance over radius, whatever the resolution of "
                                    "image and impostor (RiLoD, section 3.3); the same for all"};
    Param<float>              bias{this, "bias", 0, {-16, 16}, "added to the level; of fixed: the level"};
    Param<float>              hysteresis{this, "hysteresis", 0.15f, {0, 1},
                                         "levels by which the wish has to pass a border before the level changes, or geometry takes over"};
    Param<int>                transition{this, "transition", 0, {0, 1000},
                                         "frames in which a level takes over from another, or from geometry, pixel by pixel; 0: at once"};
    Param<float>              viewLimit{this, "viewLimit", 0, {-1, 1},
                                        "least cosine between a view's direction and the camera's for it to be drawn at the finest level: more views see more, "
                                        "take longer, and draw outlines thicker; coarser levels are drawn from fewer"};
    Param<float>              tolerance{this, "tolerance", 1.5f, {0, 16},
                                        "texel sides by which depths may differ and count as one surface, of which the texel that was seen most "
                                        "frontally wins; "
                                        "0: the nearest wins"};
    Param<int>                footprint{this, "footprint", 3, {1, 5}, "most pixels a side that a texel is spread over"};
    Param<bool>               backFaces{this, "backFaces", true, "texels that face away are left out before they can hide others; off: they stay"};
    Param<float>              cutoff{this, "cutoff", 0.5f, {0.01f, 1},
                                     "where the object is thinner than texels and nothing is blended: least share of a texel that it has to cover to be drawn; "
                                     "elsewhere texels are drawn in part"};
    Param<bool>               blend{this, "blend", false, "pixels keep the share of their texel that the object covers; off: all of it, or nothing"};
    Param<PixelPlace>         film{this, "film", PixelPlace::centre, {"centre", "frame"},
                                   "which place of a pixel decides what it shows: its centre, or one place for all pixels of a frame (film of visibility)"};
    Param<Atomics>            atomics{this, "atomics", Atomics::wide, {"wide", "pair"},
                                      "how the nearest is found: by atomics of 64 bits, or by two of 32, the second among the nearest of the first"};
    Param<int>                coarser{this, "coarser", 1, {0, int(LEVELS) - 1},
                                      "levels by which what other rays meet of an instance that is drawn is coarser than what the World that comes in shows"};
    Param<int>                tiles{this, "tiles", 1 << 20, {64, 1 << 26}, "of 8x8 texels, most a frame: where there would be more, all levels are coarser"};

    void execute(Frame& frame) override {
        const std::uint32_t instances = frame.valueOf(world).instanceCount;
        provideWorld(frame, rest);
        provideWorld(frame, worldOut);
        frame.reserve(drawn, instances);
        numbered.reserve(frame, instances);
        frame.reserve(shown, std::uint32_t(int(tiles)));
        for (const Port* port : std::initializer_list<const Port*>{&totals, &tilesShown, &texels}) frame.fill(*port, 0);
        frame.fill(keys, NONE);
        frame.dispatch("choose.comp", {instances, 1});
        frame.dispatch("choose.comp", {instances, 1}, {1});  // the total is known: where it is too much, coarser
        InstanceItems::number(frame, instances);
        frame.dispatch("tiles.comp", {InstanceItems::lanes, 1});
        frame.dispatch("scatter.comp", {InstanceItems::lanes, 1}, {0});
        if (atomics == Atomics::pair) frame.dispatch("scatter.comp", {InstanceItems::lanes, 1}, {1});
        frame.dispatch(shader, frame.size());
    }

private:
    /// With levels of its own for choose.comp to set.
    void provideWorld(Frame& frame, const Port& port) const {
        World made = frame.valueOf(world);
        const Memory levelsShown = frame.upload(std::vector<std::uint32_t>(made.instanceCount + 1), "levels");  // and levelsChanged
        const Memory shownAs = frame.upload(std::vector{frame.valueOf(impostors)}, "impostors");
        made.levels = levelsShown.address;
        made.levelsChanged = made.levels + made.instanceCount * sizeof(std::uint32_t);
        made.impostors = shownAs.address;
        frame.provide(port, std::as_bytes(std::span(&made, 1)), std::make_shared<std::pair<Memory, Memory>>(levelsShown, shownAs),
                      std::span<const std::byte>());
    }
};
LODESTIR_PASS(ImpostorForwardMap, "impostor_forward_map.comp",
              "Draws impostors by scattering the texels of their views into the frame, the nearest in each pixel (RiLoD's forward mapping).")
