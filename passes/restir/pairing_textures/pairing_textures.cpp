// SPDX-License-Identifier: MIT
// Who is whose partner in paired spatial reuse, once for all frames.
#include "pairing_table.h"

#include <framework/pass/pass.h>
#include <passes/restir/pairing.h>

using namespace lodestir;

/// Even, and below 256 so that a step has 8 bits. Up to 3840 pixels no multiple of one is nearer than 10 pixels to one of another, 6 with the fourth: no
/// two tables repeat together. The first three are those of Lin et al. 2026, section 3.
constexpr glm::uvec4 sizes(254, 230, 210, 246);

struct PairingTextures final : Pass {
    Out<PairingTables> pairing{this, "pairing", "the partners of each pixel"};
    Param<float>       radius{this, "radius", 20, {1.6f, 50},
                              "of the disk with the mean distance of partners, pixels: they lie normally distributed with 0.53 of it per axis (Lin et al. "
                              "2026, section 3). Below 1.6 there is no such pairing, which can't be nearer than 0.8 per axis"};
    Param<int>         slots{this, "slots", 3, {1, int(PAIRING_SLOTS)}, "partners of a pixel"};
    PairingTextures() { cadence = Cadence::onChange; }

    void execute(Frame& frame) override {
        PairingTables tables{.steps = 0, .sizes = sizes, .starts = {}, .slots = std::uint32_t(slots), .pad = 0};
        std::vector<std::uint32_t> words;
        for (std::uint32_t slot = 0; slot < tables.slots; ++slot) {
            tables.starts[int(slot)] = std::uint32_t(2 * words.size());
            const std::vector<glm::ivec2> steps = pairingSteps(sizes[int(slot)], pairingSigma(radius), slot + 1);
            const auto entry = [&](std::size_t i) { return std::uint32_t(steps[i].x + 128) | std::uint32_t(steps[i].y + 128) << 8; };
            for (std::size_t i = 0; i < steps.size(); i += 2) words.push_back(entry(i) | entry(i + 1) << 16);
        }
        const Memory memory = frame.upload(words, "pairing tables");
        tables.steps = memory.address;
        frame.provide(pairing, std::as_bytes(std::span(&tables, 1)), memory.keep);
    }
};
LODESTIR_PASS(PairingTextures, "", "Pairs pixels at random, so that neighbours choose each other and share the shifts between them (paired spatial reuse).")
