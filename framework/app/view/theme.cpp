// SPDX-License-Identifier: MIT
#include <framework/app/view/theme.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <initializer_list>

namespace lodestir {
namespace {

constexpr float smallestSize = 8;  // of text that can be read, points

/// The first of the fonts that this machine has; Dear ImGui's own where it has none.
void addFont(std::initializer_list<const char*> files, float pixels) {
    static const ImWchar glyphs[] = {0x20, 0xff, 0x2013, 0x2026, 0x2190, 0x21bb, 0x25a0, 0x25cf, 0};  // Latin, dashes, arrows, shapes
    ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
    std::error_code none;
    for (const char* file : files)
        if (std::filesystem::is_regular_file(file, none) && fonts.AddFontFromFileTTF(file, pixels, nullptr, glyphs)) return;
    ImFontConfig own;
    own.SizePixels = pixels;
    fonts.AddFontDefault(&own);
}

}  // namespace

Palette palette() { return {}; }

std::array<float, 3> backgroundColor() { return {0.065f, 0.07f, 0.08f}; }

ImFont* plainFont() { return ImGui::GetIO().Fonts->Fonts[0]; }
ImFont* plainFont(float size) {
    const int number = int(textSize) - int(std::ceil(size));
    return number <= 0 ? plainFont() : ImGui::GetIO().Fonts->Fonts[1 + std::min(number, int(textSize - smallestSize))];
}
ImFont* figureFont() { return ImGui::GetIO().Fonts->Fonts[1]; }

void setTheme(float density) {
    const auto addPlain = [density](float size) {
        addFont({"/usr/share/fonts/opentype/inter/Inter-Regular.otf", "/usr/share/fonts/truetype/inter/Inter-Regular.ttf",
                 "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf", "/usr/share/fonts/noto/NotoSans-Regular.ttf",
                 "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/TTF/DejaVuSans.ttf",
                 "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf"},
                density * size);
    };
    addPlain(textSize);
    addFont({"/usr/share/fonts/truetype/dejavu/DejaVuSansMono.ttf", "/usr/share/fonts/TTF/DejaVuSansMono.ttf",
             "/usr/share/fonts/truetype/noto/NotoSansMono-Regular.ttf", "/usr/share/fonts/noto/NotoSansMono-Regular.ttf",
             "/usr/share/fonts/truetype/liberation/LiberationMono-Regular.ttf"},
            density * (textSize - 1));
    for (float size = textSize - 1; size >= smallestSize; --size) addPlain(size);
    ImGui::GetIO().FontGlobalScale = 1 / density;

    ImGui::StyleColorsDark();
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowPadding = {14, 12};
    style.FramePadding = {8, 4};
    style.ItemSpacing = {8, 6};
    style.ItemInnerSpacing = {6, 4};
    style.CellPadding = {6, 3};
    style.IndentSpacing = 14;
    style.ScrollbarSize = 11;
    style.GrabMinSize = 9;
    style.WindowRounding = 0;
    style.FrameRounding = 3;
    style.GrabRounding = 3;
    style.PopupRounding = 4;
    style.ScrollbarRounding = 6;
    style.WindowBorderSize = 0;
    style.PopupBorderSize = 1;
    style.AntiAliasedLines = style.AntiAliasedFill = true;

    const ImVec4 accent = palette().accent;
    const auto faded = [&](float alpha) { return ImVec4(accent.x, accent.y, accent.z, alpha); };
    ImVec4* c = style.Colors;
    c[ImGuiCol_Text] = {0.86f, 0.87f, 0.89f, 1};
    c[ImGuiCol_TextDisabled] = palette().quiet;
    c[ImGuiCol_WindowBg] = {0.105f, 0.113f, 0.127f, 1};
    c[ImGuiCol_ChildBg] = {0, 0, 0, 0};
    c[ImGuiCol_PopupBg] = {0.13f, 0.14f, 0.157f, 0.98f};
    c[ImGuiCol_Border] = {0.24f, 0.255f, 0.28f, 1};
    c[ImGuiCol_FrameBg] = {0.165f, 0.176f, 0.196f, 1};
    c[ImGuiCol_FrameBgHovered] = {0.205f, 0.218f, 0.24f, 1};
    c[ImGuiCol_FrameBgActive] = {0.235f, 0.25f, 0.275f, 1};
    c[ImGuiCol_CheckMark] = c[ImGuiCol_SliderGrabActive] = c[ImGuiCol_PlotLines] = accent;
    c[ImGuiCol_SliderGrab] = {0.42f, 0.445f, 0.485f, 1};
    c[ImGuiCol_Button] = {0.19f, 0.203f, 0.225f, 1};
    c[ImGuiCol_ButtonHovered] = {0.245f, 0.26f, 0.285f, 1};
    c[ImGuiCol_ButtonActive] = faded(0.55f);
    c[ImGuiCol_Header] = {0.165f, 0.176f, 0.196f, 1};
    c[ImGuiCol_HeaderHovered] = {0.205f, 0.218f, 0.24f, 1};
    c[ImGuiCol_HeaderActive] = {0.235f, 0.25f, 0.275f, 1};
    c[ImGuiCol_Separator] = {0.19f, 0.2f, 0.22f, 1};
    c[ImGuiCol_ScrollbarBg] = {0, 0, 0, 0};
    c[ImGuiCol_ScrollbarGrab] = {0.24f, 0.255f, 0.28f, 1};
    c[ImGuiCol_TableHeaderBg] = {0, 0, 0, 0};
    c[ImGuiCol_TableRowBgAlt] = {1, 1, 1, 0.018f};
    c[ImGuiCol_TextSelectedBg] = faded(0.35f);
    c[ImGuiCol_NavHighlight] = faded(0.8f);
}

}  // namespace lodestir
