// SPDX-License-Identifier: MIT
// Plays a plan for several frames on an imagined memory and finds what a missing barrier, a wrong order or a wrong sharing would break.
// It knows the graph and the model in plan.h, and nothing of how the plan was made.
#pragma once
#include <framework/graph/plan.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace lodestir {

struct Hazard {
    /// The first three: two steps touch the same memory and no barrier lies between. wrongContent: a step reads what isn't, or isn't any
    /// more, the value it is wired to.
    enum class Kind : std::uint8_t { readAfterWrite, writeAfterRead, writeAfterWrite, wrongContent } kind;
    int frame = 0, step = 0;            ///< where it shows
    int otherFrame = 0, otherStep = 0;  ///< the earlier access
    std::string text;
};

/// Every distinct hazard of `plan`, leaving out the barriers before the steps in `dropped`. Empty: the plan is right.
LODESTIR_API std::vector<Hazard> findHazards(const Plan& plan, const Graph& graph, std::span<const int> dropped = {});

}  // namespace lodestir
