// SPDX-License-Identifier: MIT
#include <framework/app/view/panel_style.h>

#include <framework/app/view/theme.h>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace lodestir {

void quietText(const std::string& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, palette().quiet);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopStyleColor();
}

void tip(const std::string& text) {
    if (text.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(380);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void heading(const char* text) {
    ImGui::Dummy({0, 4});
    ImGui::Separator();
    ImGui::Dummy({0, 2});
    quietText(text);
}

std::string timeText(double milliseconds) { return fmt::format("{:.{}f}", milliseconds, milliseconds < 10 ? 2 : milliseconds < 100 ? 1 : 0); }

void rightText(const std::string& text) {
    const float space = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
    if (space > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + space);
    ImGui::TextUnformatted(text.c_str());
}

bool holdsText(const std::string& text, std::string_view part) {
    const auto same = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b)); };
    return std::ranges::search(text, part, same).begin() != text.end() || part.empty();
}

}  // namespace lodestir
