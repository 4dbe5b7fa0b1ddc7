// SPDX-License-Identifier: MIT
// How the viewer looks: type, colours, spacing.
#pragma once
#include <imgui/imgui.h>

#include <array>

namespace lodestir {

/// Colours beyond those of Dear ImGui's own style.
struct Palette {
    ImVec4 accent{0.91f, 0.64f, 0.27f, 1}, quiet{0.56f, 0.58f, 0.62f, 1}, bar{0.36f, 0.53f, 0.66f, 1}, good{0.49f, 0.74f, 0.48f, 1},
        bad{0.93f, 0.42f, 0.38f, 1};
    ImVec4 badBack{0.28f, 0.09f, 0.09f, 0.97f};
};
inline constexpr float textSize = 15;  ///< points

Palette palette();
std::array<float, 3> backgroundColor();  ///< behind the picture, as the screen gets it
/// Sets style and fonts of the current Dear ImGui context. Font 0 is for text, font 1 has figures of equal width; then come smaller ones
/// for text. `density`: pixels a point, so that type is sharp where the panels are drawn larger than they are laid out.
void setTheme(float density);
ImFont* plainFont();
ImFont* plainFont(float size);  ///< drawn for about that many points, so that it stays sharp
ImFont* figureFont();

}  // namespace lodestir
