// SPDX-License-Identifier: MIT
// run.json: what was run, on what, and what each frame cost.
#pragma once
#include <framework/app/session.h>
#include <framework/graph/ray_purposes.h>

#include <nlohmann/json_fwd.hpp>

#include <map>
#include <span>
#include <string>

namespace lodestir {

/// One member of "frames".
nlohmann::ordered_json frameJson(const FrameReport& frame, const std::map<std::string, double>& metrics, bool countSteps);
/// The frames' passes one after the other as Chrome's trace event format has them (chrome://tracing, Perfetto): microseconds on the device.
nlohmann::ordered_json traceJson(std::span<const FrameReport> frames, const std::string& device);
/// A line for each pass of each frame in which it ran: milliseconds on the device, rays by purpose.
std::string timesCsv(std::span<const FrameReport> frames);
/// The whole file but for "frames". `totalMilliseconds`: from the start of the program to the first frame's end, less the frame itself.
nlohmann::ordered_json runJson(Session& session, double totalMilliseconds);

}  // namespace lodestir
