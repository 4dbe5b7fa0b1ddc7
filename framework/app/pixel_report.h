// SPDX-License-Identifier: MIT
// What happened to one pixel in one frame, of all passes that ran.
#pragma once
#include <framework/app/session.h>
#include <framework/graph/probe.h>

#include <nlohmann/json_fwd.hpp>

#include <vector>

namespace lodestir {

/// {"<pass>": {"type": ..., "dispatches": [{"shader", "arguments", "invocations"}], "ports": {...}}}, in the order the passes ran in. `told`: what
/// Runner::probe() gave for the frame that the session has just rendered. Warns of records that found no room.
nlohmann::ordered_json pixelReport(Session& session, const std::vector<ProbedDispatch>& told, glm::ivec2 pixel);

}  // namespace lodestir
