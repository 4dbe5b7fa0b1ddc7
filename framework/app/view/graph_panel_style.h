// SPDX-License-Identifier: MIT
// Measures and colours of the graph panel.
#pragma once
#include <framework/app/view/view_state.h>

#include <imgui/imgui.h>

#include <string>

namespace lodestir {

/// Pixels at zoom 1.
inline constexpr float nameSize = 15, portSize = 13, smallSize = 12, timeSize = 11;  ///< of text
inline constexpr float headHeight = 59, rowHeight = 17, footHeight = 6, boxPadding = 11, leastWidth = 126, dotRadius = 3.6f;
inline constexpr glm::vec2 canvasMargin{22, 14};

inline const ImVec4 panelBack{0.055f, 0.06f, 0.07f, 0.72f}, boxBack{0.135f, 0.145f, 0.163f, 0.97f}, idleBack{0.1f, 0.106f, 0.118f, 0.94f},
    boxEdge{0.25f, 0.265f, 0.29f, 1};

float textWidth(const std::string& text, float size);
/// Of what flows along an edge.
ImVec4 colorOf(WireInfo::Kind kind);

}  // namespace lodestir
