// SPDX-License-Identifier: MIT
// The bundle that every pass of ReSTIR PT takes and makes.
#pragma once
#include <framework/pass/bundle.h>
#include <passes/restir/reservoir.h>
#include <passes/restir/sample_hit.h>

namespace lodestir {

/// A path of each pixel.
struct Paths {
    static constexpr std::string_view name = "Paths";
    static constexpr std::array members{bundled<Reservoir>("reservoirs", "the path with its weight"),
                                        bundled<SampleHit>("samples", "where it begins")};
};

}  // namespace lodestir
