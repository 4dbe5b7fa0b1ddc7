// SPDX-License-Identifier: MIT
// Which level each instance shows.
#include <framework/pass/pass.h>
#include <framework/pass/scene.h>

#include <bit>
#include <cstring>

using namespace lodestir;

enum class Mode { scene, finest, fixed, schedule, distance, screen_error, total_error, depth, stochastic };
enum class Curve { log, linear };
enum class Numbers { shared, each };

struct LodSelect final : Pass {
    In<World>           world{this, "world", "the scene"};
    In<World>           worldPrev{this, "worldPrev", "this pass's own World of last frame: which levels were shown"};
    Out<World>          worldOut{this, "world", "the scene with the chosen levels"};
    State<Buffer<uint>> changed{this, "changed",
                                "of each instance, the number of the frame after the one in which its level last changed; 0: it never has",
                                Count::fixed(1 << 16)};
    Out<Buffer<uint>>   chosen{this, "chosen", "level that each instance shows", Count::fixed(1 << 16)};
    Out<Buffer<uint>>   triangles{this, "triangles", "of the levels shown, over all instances: 64 bits, the low word first", Count::fixed(2)};
    Out<Buffer<uint>>   bytes{this, "bytes", "that the levels shown take, each once: 64 bits, the low word first", Count::fixed(2)};
    Scratch<Buffer<uint>> shown{this, "shown", "how many instances show level l of mesh m, at m * LEVELS + l", Count::reserved()};
    Param<Mode>         mode{this, "mode", Mode::scene,
                     {"scene", "finest", "fixed", "schedule", "distance", "screen_error", "total_error", "depth", "stochastic"},
                     "how levels are chosen: as the scene file says; finest; one for all; by the scene file's schedule; by distance; the coarsest whose "
                     "measured error projects below pixelError; those by which geometry and noise together are least at what so many samples cost; by depth; "
                     "by depth, and in between a share of the rays sees the next coarser one already; what is listed as light switches half way"};
    Param<int>          level{this, "level", 0, {0, int(LEVELS) - 1}, "of fixed: what all instances show; the coarsest where a mesh has fewer"};
    Param<std::string>  force{this, "force", "",
                              "levels that hold whatever the mode: \"rock=2, #3=0, *=auto\"; #3 is the fourth instance, * stands for all, auto is the mode's "
                              "own again; the last that is said of an instance counts"};
    Param<float>        pixelError{this, "pixelError", 0, {0, 1000}, "largest error on the screen, pixels; 0: the scene file's"};
    Param<float>        hysteresis{this, "hysteresis", 0.2f, {0, 0.9f},
                                   "so that levels don't flicker, a coarser one is taken only where it stays below the limit by this share; of total_error, "
                                   "any other only where it wins this share of what the triangles between them cost"};
    Param<float>        samples{this, "samples", 1, {0.001f, 1e9f},
                                "of total_error: paths a pixel that the picture is made of, those of earlier frames that it reuses included"};
    Param<float>        edges{this, "edges", 0.1f, {0, 1e6f},
                              "of total_error: squared error of an object whose geometry is off by a pixel, as a multiple of the variance of one path"};
    Param<float>        doubling{this, "doubling", 0.04f, {0, 1},
                                 "of total_error: by how much a path costs more, as a share, when all it meets has twice the triangles"};
    Param<int>          lead{this, "lead", 0, {0, 1'000'000},
                             "frames by which the schedule is read ahead: what a run would look like in which its switches had been made that much earlier"};
    Param<float>        distance{this, "distance", 8, {0.01f, 1e6f},
                                 "up to where the finest level is shown, in radii of the mesh; each doubling shows the next level"};
    Param<Curve>        curve{this, "curve", Curve::log, {"log", "linear"},
                              "of depth and stochastic: how levels follow the depth along the view from depthNear, where they leave the finest, to depthFar"};
    Param<float>        depthNear{this, "depthNear", 0.1f, {1e-6f, 1e6f}, "of depth and stochastic: radii of the scene"};
    Param<float>        depthFar{this, "depthFar", 2, {1e-6f, 1e6f},
                                 "of depth and stochastic: radii of the scene, where all levels of a mesh have been gone through"};
    Param<float>        bias{this, "bias", 0, {-float(LEVELS), float(LEVELS)}, "of depth and stochastic: levels that all are coarser"};
    Param<float>        transition{this, "transition", 0.5f, {0, 1},
                                   "of stochastic: share of the way from level to level in which rays see both; 0: they switch half way, as with depth"};
    Param<int>          steps{this, "steps", 8, {1, 1 << 16},
                              "of stochastic: in how many steps the share of rays grows; eight are what masks of driver's instances can hold"};
    Param<Numbers>      numbers{this, "numbers", Numbers::shared, {"shared", "each"},
                                "of stochastic: what a ray chooses by: one number for all instances, or one of its own for each"};
    Fact                levelsOfRays{this, "RAY_LEVELS", [this](const Scene& scene) { return modeOf(scene.lod.mode) == Mode::stochastic; }};

    /// Levels that are forced or given by frame number are uploaded, others (`none`) are left to the shader, which in both cases notes whether any differs
    /// from last frame's.
    void execute(Frame& frame) override {
        const Scene& scene = frame.scene();
        const Mode wanted = modeOf(scene.lod.mode);
        if (depthFar <= depthNear)
            throw Error("depthFar of a lod_select lies no farther than its depthNear", "levels go from the finest at depthNear to the coarsest at depthFar");
        std::vector<std::uint32_t> levels = forcedLevels(scene, force), planned;
        if (wanted == Mode::finest) planned.assign(levels.size(), 0);
        if (wanted == Mode::schedule) planned = scheduledLevels(scene, float(frame.index()) + float(int(lead)));
        for (std::size_t i = 0; i < planned.size(); ++i)
            if (levels[i] == none) levels[i] = planned[i];
        const std::vector<std::uint32_t> given = levels;
        const auto count = std::uint32_t(levels.size());
        levels.resize(wanted == Mode::stochastic ? 2 * count + 1 : count + 1);  // levelsChanged, dissolves
        const Memory memory = frame.upload(levels, "levels");
        World made = frame.valueOf(world);
        made.levels = memory.address;
        made.levelsChanged = made.levels + count * sizeof(std::uint32_t);
        if (wanted == Mode::stochastic) {
            made.dissolves = made.levelsChanged + sizeof(std::uint32_t);
            made.frameKey = frameKey(frame);
        }
        frame.provide(worldOut, std::as_bytes(std::span(&made, 1)), memory.keep, std::as_bytes(std::span(given)));
        const float limit = pixelError > 0 ? float(pixelError) : scene.lod.pixelError;
        frame.reserve(shown, std::uint32_t(scene.meshes.size()) * LEVELS);
        for (const Port* port : std::initializer_list<const Port*>{&shown, &chosen, &triangles, &bytes}) frame.fill(*port, 0);
        frame.dispatch(shader, {count, 1}, {std::uint32_t(wanted), std::bit_cast<std::uint32_t>(limit)});
    }

private:
    Mode modeOf(LodMode wanted) const {
        if (mode != Mode::scene) return mode;
        switch (wanted) {
            case LodMode::schedule: return Mode::schedule;
            case LodMode::distance: return Mode::distance;
            case LodMode::screenError: return Mode::screen_error;
            case LodMode::stochastic: return Mode::stochastic;
            default: return Mode::finest;
        }
    }
};
LODESTIR_PASS(LodSelect, "lod_select.comp",
              "Chooses the level of detail of each instance: finest, fixed, scheduled, by distance or depth, by the error that a level makes on the screen, or "
              "by that and the noise that a budget leaves; ray by ray while it passes from one to the next.")
