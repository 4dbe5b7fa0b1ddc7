// SPDX-License-Identifier: MIT
// What all panels have in common: their places in the window, and pieces of text.
#pragma once
#include <imgui/imgui.h>

#include <string>
#include <string_view>

namespace lodestir {

inline constexpr float panelWidth = 372, stripHeight = 212;  ///< of the panel at the left, of the strip at the bottom: pixels

inline constexpr ImGuiWindowFlags fixedWindow = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                                ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                                                ImGuiWindowFlags_NoNav;

void quietText(const std::string& text);
/// Shown while the pointer is over the last widget.
void tip(const std::string& text);
void heading(const char* text);
/// Milliseconds, with three digits that count.
std::string timeText(double milliseconds);
/// Text that ends at the right edge of the cell or window.
void rightText(const std::string& text);
/// Does `text` hold `part`, whatever their case?
bool holdsText(const std::string& text, std::string_view part);

}  // namespace lodestir
