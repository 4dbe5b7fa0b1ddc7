// SPDX-License-Identifier: MIT
// Paths of neighbours that choose each other, so that a shift serves both: K shifts a pixel for K neighbours instead of 2 K (Lin et al. 2026, ReSTIR PT
// Enhanced, section 3).
#include "shared_shift.h"
#include "stage.h"

#include <framework/pass/pass.h>
#include <passes/restir/pairing.h>
#include <passes/restir/pairwise.h>
#include <passes/restir/paths.h>
#include <passes/restir/rounds.h>
#include <passes/restir/rules.h>
#include <passes/restir/similarity.h>

#include <algorithm>

using namespace lodestir;

struct SpatialPairedReuse final : Pass {
    In<World>                       world{this, "world", "the scene"};
    In<Buffer<PrimaryHit>>          hits{this, "hits", "the camera hit of each pixel: which pixels are alike"};
    In<ShiftRules>                  rules{this, "rules", "of the pass that made the paths"};
    In<PairingTables>               pairing{this, "pairing", "the partners of each pixel"};
    In<Paths>                       paths{this, "paths", "a path of each pixel"};
    Out<Paths>                      pathsOut{this, "paths", "the path of each pixel after reuse", Count::perPixel()};
    Out<Image>                      color{this, "color",
                                          "radiance from the weights of all candidates of the last round instead of the kept one's (Lin et al. 2026, section "
                                          "6.3), linear Rec. 709",
                                          Format::rgba32f, Need::optional};
    Scratch<Paths>                  between{this, "between", "what one round hands to the next", Count::reserved()};
    Scratch<Buffer<SharedShift>>    shifts{this, "shifts", "of the path of each partner, to the pixel", Count::reserved()};
    Scratch<Buffer<SharedFirstHit>> firstHits{this, "firstHits", "of these shifted paths, where the camera sample belongs to the path", Count::reserved()};
    Scratch<Buffer<uint>>           replays{this, "replays", "shifts that replay, with `compaction`: their places in `shifts`", Count::reserved()};
    Scratch<Buffer<uint>>           listed{this, "listed", "how many they are", Count::fixed(1)};
    Param<int>                      rounds{this, "rounds", 1, {1, 8}, "each round reuses what the one before it made, among other partners"};
    Similarity                      similarity{this};
    PairwiseRule                    weights{this};
    Param<bool>                     compaction{this, "compaction", false,
                                               "shifts that replay more than the camera ray are made in a dispatch of their own, where they don't keep others "
                                               "waiting (Lin et al. 2026, section 6.2.2); the result is the same"};
    PassThrough                     off{this, paths, pathsOut};

    void execute(Frame& frame) override {
        if (frame.valueOf(rules).pixelCamera != 0 && frame.valueOf(world).dissolves != 0)
            throw Error("partners can't share their shifts where each pixel sees other levels: what follows the reconnection vertex is another light for each",
                        "reuse by spatial_reuse, or let paths choose their levels (initial_sampling, \"camera\": \"path\")");
        const std::uint32_t pixels = frame.size().x * frame.size().y, records = pixels * frame.valueOf(pairing).slots;
        frame.reserve(between, rounds > 1 ? pixels : 0);
        frame.reserve(shifts, records);
        frame.reserve(firstHits, frame.valueOf(rules).pixelCamera ? 0 : records);
        frame.reserve(replays, compaction ? records : 0);
        forRounds(std::uint32_t(rounds), [&](std::uint32_t round, std::uint32_t from, std::uint32_t to) {
            const auto shift = [&](glm::uvec2 extent, std::uint32_t stage) { frame.dispatch("shift_pairs.comp", extent, {round, from, to, stage}); };
            if (compaction) {
                frame.fill(listed, 0);
                shift(frame.size(), STAGE_LISTING);
                shift({std::max(frame.size().x * frame.size().y / 8, 64u), 1}, STAGE_LISTED);
            } else {
                shift(frame.size(), STAGE_ALL);
            }
            frame.dispatch(shader, frame.size(), {round, from, to});
        });
    }
};
LODESTIR_PASS(SpatialPairedReuse, "spatial_paired_reuse.comp",
              "Resamples each pixel's path with paths of partners, which share the shifts between them (paired spatial reuse of ReSTIR PT Enhanced).")
