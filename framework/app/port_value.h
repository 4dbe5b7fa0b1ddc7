// SPDX-License-Identifier: MIT
// What a port holds of one pixel.
#pragma once
#include <framework/app/session.h>

#include <nlohmann/json_fwd.hpp>

#include <vector>

namespace lodestir {

/// The ports of the passes that make what is shown, which are images or have elements of each pixel.
std::vector<Source> pixelPorts(const Graph& graph);
/// After a frame: the texel that the pixel of the frame lies in, as a number or a list of channels; of a buffer the pixel's element, as an object of its
/// fields, or a list of them.
nlohmann::ordered_json pixelValue(Session& session, const Source& source, glm::ivec2 pixel);

}  // namespace lodestir
