// SPDX-License-Identifier: MIT
// The paths of this frame: a tree a pixel, resampled into one reservoir.
#include <framework/pass/pass.h>
#include <framework/pass/scene.h>
#include <passes/basic/light_technique.h>
#include <passes/rate/rates.h>
#include <passes/restir/light_tiles.h>
#include <passes/restir/paths.h>
#include <passes/restir/rules.h>

#include <algorithm>

using namespace lodestir;

enum class Criteria { distance, footprint };
enum class CameraSample { path, hits };
enum class Skipped { absent, roulette, copy };

struct InitialSampling final : Pass {
    In<World>              world{this, "world", "the scene"};
    In<Buffer<PrimaryHit>> hits{this, "hits", "camera hits: where paths begin, if camera says so", Need::optional};
    In<World>              worldPrev{this, "worldPrev", "last frame's scene, which tells where levels have switched", Need::optional};
    In<Buffer<TileLight>>  tiles{this, "tiles", "lights drawn beforehand, which vertices choose their candidates from instead of drawing each", Need::optional};
    In<Rates>              rates{this, "rates", "which pixels trace a tree (variable_rate); unwired: all", Need::optional};
    Out<Paths>             paths{this, "paths", "one of each pixel's tree; confidence 1, more where switchCandidates are taken, 0 where `rates` leave the "
                                 "pixel out (but see `skipped`)", Count::perPixel()};
    Out<ShiftRules>        rules{this, "rules", "what passes that shift these paths have to agree on"};
    Param<int>             bounces{this, "bounces", 4, {0, 30}, "most scatterings of a path; 1 is direct light only"};
    Param<int>             segmentsMin{this, "segmentsMin", 1, {1, 31},
                                       "shorter paths are left to other passes: 2 leaves out light that the camera sees directly, 3 direct light as well"};
    Param<int>             candidates{this, "candidates", 1, {1, 256}, "path trees a pixel and frame"};
    Param<int>             switchCandidates{this, "switchCandidates", 1, {1, 256},
                                            "path trees instead, in the one frame in which the object that a pixel's centre sees takes another level: there "
                                            "history knows the old one only"};
    Param<int>             lightCandidates{this, "lightCandidates", 1, {1, 256},
                                           "lights that the first vertex chooses its light sample from; vertex j chooses from a share of 1 / j^2, at least one "
                                           "(Lin et al. 2026, section 7)"};
    LightTechnique         found{this};
    Param<bool>            roulette{this, "roulette", true, "Russian roulette on the throughput, outside the integrand (Lin et al. 2026, section 6.2.4)"};
    Param<CameraSample>    camera{this, "camera", CameraSample::path, {"path", "hits"},
                                  "whose place inside the pixel and on the lens paths have: each its own, or that of the pixel's hit in `hits`, whatever path "
                                  "comes into the pixel, so that no camera ray is traced again"};
    Param<Criteria>        criteria{this, "criteria", Criteria::distance, {"distance", "footprint"},
                                    "which vertices may be connected: roughness at both ends and a least length, or roughness before the connection and "
                                    "footprints of its directions against the pixel's (Lin et al. 2026, Eq. 5)"};
    Param<Skipped>         skipped{this, "skipped", Skipped::absent, {"absent", "roulette", "copy"},
                                   "what a pixel holds that traces no tree, with `rates`: nothing, without confidence, so that reuse alone fills it (unbiased "
                                   "where reuse can find all of its paths, and the rates hang on no path); nothing, but as much confidence as any, while the "
                                   "others count by the inverse of their chance (unbiased for whatever rates); the path of the pixel that stands for its block "
                                   "(biased)"};
    Param<bool>            compaction{this, "compaction", true,
                                      "with `rates`: lanes walk traced pixels that are near each other, instead of waiting for those between; the result is "
                                      "the same"};
    Param<float>           roughness{this, "roughness", 0.2f, {0, 1}, "least perceptual roughness of the lobes at a connection"};
    Param<float>           distance{this, "distance", 0.1f, {0, 1e6f}, "criteria distance: least length of a connection, scene units"};
    Param<float>           distanceShare{this, "distanceShare", 0, {0, 1},
                                         "criteria distance: the same as a share of the shortest side of the scene's box, the larger counts (Lin et al. 2026, "
                                         "section 7, take 0.02 for the configuration of 2022)"};
    Param<float>           footprint{this, "footprint", 0.02f, {0, 100},
                                     "criteria footprint: c, least footprint in per cent of what a camera ray of all directions would spread over, "
                                     "4 pi r^2 / cos"};
    Param<float>           spread{this, "spread", 0.2f, {0, 1},
                                  "criteria footprint: relative deviation of its threshold from path to path, which softens its edge"};
    Param<bool>            forcedNee{this, "forcedNee", true,
                                     "lights found by light sampling are always connected, never replayed (Lin et al. 2026, section 6.2.3)"};

    void execute(Frame& frame) override {
        if (camera == CameraSample::hits && !frame.isBound(hits))
            throw Error("an initial_sampling has no hits for its paths to begin at", "wire its \"hits\" to a visibility, or set \"camera\" to \"path\"");
        const ShiftRules agreed{std::uint32_t(Criteria(criteria)), roughness, leastDistance(frame), footprint / 100, spread, forcedNee,
                                std::uint32_t(int(lightCandidates)), std::uint32_t(Technique(found.technique)),
                                std::uint32_t(camera == CameraSample::hits)};
        frame.provide(rules, std::as_bytes(std::span(&agreed, 1)), nullptr);
        frame.dispatch(shader, walkExtent(frame.size(), frame.isBound(rates) && compaction));
        if (frame.isBound(rates) && skipped == Skipped::copy) frame.dispatch("copy_skipped.comp", frame.size());
    }

private:
    float leastDistance(const Frame& frame) const {
        if (distanceShare == 0 || criteria == Criteria::footprint) return distance;
        const auto [low, high] = frame.scene().bounds();
        const glm::vec3 sides = high - low;
        return std::max<float>(distance, distanceShare * std::min({sides.x, sides.y, sides.z}));
    }
};
LODESTIR_PASS(InitialSampling, "initial_sampling.comp", "Traces a path tree a pixel and resamples its paths into a reservoir (ReSTIR PT's first stage).")
