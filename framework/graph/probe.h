// SPDX-License-Identifier: MIT
// What shaders tell of one pixel (base/probe.glsl): where in their texts they do, and what they told.
#pragma once
#include <framework/core/api.h>
#include <framework/shaders/base/probe.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace lodestir {

namespace gpu {
class IncludeClosure;
}

/// One PROBE macro of a shader's text.
struct ProbeSite {
    std::string name;
    std::string words;  ///< what stands between quotation marks, if anything
};

/// The macros of a line; more than one can't be told apart.
LODESTIR_API std::vector<ProbeSite> probeSitesOf(std::string_view line);

/// By ProbeRecord::place. Error where two stand in one line.
using ProbeSites = std::map<std::uint32_t, ProbeSite>;
LODESTIR_API ProbeSites probeSites(const gpu::IncludeClosure& closure);

/// What one dispatch told.
struct ProbedDispatch {
    int node = -1;
    std::string shader;
    std::vector<std::uint32_t> arguments;       ///< of Frame::dispatch
    std::shared_ptr<const ProbeSites> sites;
    std::vector<ProbeRecord> records;           ///< in order of each invocation, of several in any
    std::uint32_t lost = 0;                     ///< records that there was no room for
};

}  // namespace lodestir
