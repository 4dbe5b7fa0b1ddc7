// SPDX-License-Identifier: MIT
// Unidirectional path tracing: the reference that other techniques are judged by, and the baseline they have to beat.
#include <framework/pass/pass.h>
#include <framework/shaders/world/primary_hit.h>
#include <passes/basic/film.h>
#include <passes/basic/light_technique.h>

using namespace lodestir;

enum class Numbers { path, ray };

struct PathTracer final : Pass {
    In<World>              world{this, "world", "the scene"};
    In<Buffer<PrimaryHit>> hits{this, "hits", "camera hits that all samples of a pixel begin at, whatever film and lens say; unwired: each has its ray",
                                Need::optional};
    Out<Image>             color{this, "color", "mean radiance of this frame's samples, linear Rec. 709", Format::rgba32f};
    Param<int>             spp{this, "spp", 1, {1, 4096}, "samples a pixel and frame"};
    Param<int>             bounces{this, "bounces", 4, {0, 64}, "most scatterings of a path; 1 is direct light only"};
    LightTechnique         found{this};
    Param<bool>            roulette{this, "roulette", true, "Russian roulette on the throughput"};
    Param<int>             rouletteStart{this, "rouletteStart", 3, {1, 64}, "first scattering that roulette may end a path after"};
    FilmPlace              place{this};
    Param<Numbers>         numbers{this, "numbers", Numbers::path, {"path", "ray"},
                                   "where rays choose levels (lod_select, mode stochastic): all of a path by one number; or each by its own, so that shadow "
                                   "rays start inside of what they left, to see what the former is for"};
    Param<float>           fineReach{this, "fineReach", 0, {0, 1e6f},
                                     "likewise: scene units up to where rays behind the first hit see the finer of two levels, all the coarser beyond; 0: by "
                                     "number"};
};
LODESTIR_PASS(PathTracer, "path_tracer.comp", "Path tracing with next-event estimation, multiple importance sampling and Russian roulette.")
