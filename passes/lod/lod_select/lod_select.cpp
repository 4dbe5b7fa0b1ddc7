// SPDX-License-Identifier: MIT
// Which level each instance shows.
#include <framework/pass/pass.h>
#include <framework/pass/scene.h>

#include <bit>
#include <cstring>

using namespace lodestir;

enum class Mode { scene, finest, schedule, distance, screen_error };

struct LodSelect final : Pass {
    In<World>           world{this, "world", "the scene"};
    In<World>           worldPrev{this, "worldPrev", "this pass's own World of last frame: which levels were shown"};
    Out<World>          worldOut{this, "world", "the scene with the chosen levels"};
    State<Buffer<uint>> changed{this, "changed",
                                "of each instance, the number of the frame after the one in which its level last changed; 0: it never has",
                                Count::fixed(1 << 16)};
    Param<Mode>         mode{this, "mode", Mode::scene, {"scene", "finest", "schedule", "distance", "screen_error"},
                     "how levels are chosen: as the scene file says; finest; by the scene file's schedule; by distance; the coarsest whose measured error "
                     "projects below pixelError"};
    Param<float>        pixelError{this, "pixelError", 0, {0, 1000}, "largest error on the screen, pixels; 0: the scene file's"};
    Param<float>        hysteresis{this, "hysteresis", 0.2f, {0, 0.9f},
                                   "a coarser level is taken only where it stays below the limit by this share, so that levels don't flicker"};
    Param<int>          lead{this, "lead", 0, {0, 1'000'000},
                             "frames by which the schedule is read ahead: what a run would look like in which its switches had been made that much earlier"};
    Param<float>        distance{this, "distance", 8, {0.01f, 1e6f},
                                 "up to where the finest level is shown, in radii of the mesh; each doubling shows the next level"};

    /// Levels given by frame number are uploaded, others are left to the shader, which in both cases notes whether any differs from last frame's.
    void execute(Frame& frame) override {
        const Scene& scene = frame.scene();
        const Mode chosen = modeOf(scene.lod.mode);
        std::vector<std::uint32_t> levels(scene.instances.size(), 0);
        if (chosen == Mode::schedule) levels = scheduledLevels(scene, float(frame.index()) + float(int(lead)));
        const auto count = std::uint32_t(levels.size());
        levels.push_back(0);  // levelsChanged
        const Memory memory = frame.upload(levels, "levels");
        World made = frame.valueOf(world);
        made.levels = memory.address;
        made.levelsChanged = made.levels + count * sizeof(std::uint32_t);
        frame.provide(worldOut, std::as_bytes(std::span(&made, 1)), memory.keep);
        const float limit = pixelError > 0 ? float(pixelError) : scene.lod.pixelError;
        frame.dispatch(shader, {count, 1}, {std::uint32_t(chosen), std::bit_cast<std::uint32_t>(limit)});
    }

private:
    Mode modeOf(LodMode wanted) const {
        if (mode != Mode::scene) return mode;
        switch (wanted) {
            case LodMode::schedule: return Mode::schedule;
            case LodMode::distance: return Mode::distance;
            case LodMode::screenError: return Mode::screen_error;
            default: return Mode::finest;
        }
    }
};
LODESTIR_PASS(LodSelect, "lod_select.comp",
              "Chooses the level of detail of each instance: finest, scheduled, by distance, or by the error that a level makes on the screen.")
