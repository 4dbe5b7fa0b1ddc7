// SPDX-License-Identifier: MIT
#include <framework/app/view/pixel_panel.h>

#include <framework/app/view/orbit_camera.h>
#include <framework/app/view/panel_style.h>
#include <framework/app/view/theme.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace lodestir {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr float panelSize = 430;  // pixels

/// One colour for each pass that told of paths, apart from each other for colour-blind readers too (Okabe and Ito's palette).
ImU32 colorOf(std::size_t pass, float opacity) {
    static constexpr std::array<std::array<int, 3>, 6> colors{{{230, 159, 0}, {86, 180, 233}, {0, 158, 115}, {240, 228, 66}, {204, 121, 167}, {213, 94, 0}}};
    const auto& c = colors[pass % colors.size()];
    return IM_COL32(c[0], c[1], c[2], int(255 * opacity));
}

std::vector<std::string> passesOf(const std::vector<ToldPath>& paths) {
    std::vector<std::string> passes;
    for (const ToldPath& path : paths)
        if (std::ranges::find(passes, path.pass) == passes.end()) passes.push_back(path.pass);
    return passes;
}

bool isPlain(const OrderedJson& value) {
    return !value.is_structured() || (value.is_array() && std::ranges::none_of(value, [](const OrderedJson& item) { return item.is_structured(); }));
}

void drawTree(const std::string& name, const OrderedJson& value) {
    if (isPlain(value)) {
        quietText(name);
        ImGui::SameLine(0, 8);
        ImGui::TextUnformatted(value.is_string() ? value.get<std::string>().c_str() : value.dump().c_str());
        return;
    }
    if (value.empty() || !ImGui::TreeNode(name.c_str())) return;
    std::size_t index = 0;
    for (const auto& [key, inner] : value.items()) drawTree(value.is_array() ? fmt::format("{} {}", name, ++index) : key, inner);
    ImGui::TreePop();
}

}  // namespace

void PixelPanel::ask(const Viewport& viewport) {
    const glm::ivec2 pixel = viewport.pixelUnderPointer();
    if (pixel.x < 0) return close();
    renderer_.post([pixel](ViewSession& s) { s.askPixel(pixel); });
}

void PixelPanel::close() {
    renderer_.post([](ViewSession& s) { s.forgetPixel(); });
}

void PixelPanel::draw(const ViewStatus& status, const Viewport& viewport, const CameraKey& camera, const Rectangle& area) {
    if (!status.told) return;
    const PixelTold& told = *status.told;
    drawPaths(told, viewport, camera, area);
    path_ = -1;

    const float width = std::min(panelSize, float(area.size.x));
    ImGui::SetNextWindowPos({float(area.corner.x + area.size.x) - width, 0});
    ImGui::SetNextWindowSize({width, float(area.size.y)});
    ImGui::SetNextWindowBgAlpha(0.9f);
    ImGui::Begin("pixel", nullptr, fixedWindow & ~ImGuiWindowFlags_NoBringToFrontOnFocus);
    heading(fmt::format("PIXEL ({}, {})", told.pixel.x, told.pixel.y).c_str());
    ImGui::SameLine(width - 70);
    if (ImGui::Button("Close")) close();
    mark_("close pixel");
    tip("P beside the picture, or Esc");
    quietText(told.frame == told.first ? fmt::format("frame {}, with nothing before it", told.frame)
                                       : fmt::format("frame {}, rendered again from frame {} on", told.frame, told.first));
    drawList(told);
    heading("ALL THAT WAS TOLD");
    ImGui::PushFont(figureFont());
    ImGui::BeginChild("tree", {0, 0}, false, ImGuiWindowFlags_HorizontalScrollbar);
    for (const auto& [pass, value] : told.passes->items()) {
        drawTree(pass, value);
        mark_("told: " + pass);
    }
    ImGui::EndChild();
    ImGui::PopFont();
    ImGui::End();
}

void PixelPanel::drawList(const PixelTold& told) {
    const std::vector<std::string> passes = passesOf(told.paths);
    if (passes.empty()) return quietText("no pass told of a path");
    const float line = ImGui::GetTextLineHeightWithSpacing();
    ImGui::BeginChild("paths", {0, line * float(std::min<std::size_t>(told.paths.size(), 12)) + 4});
    for (std::size_t i = 0; i < told.paths.size(); ++i) {
        const ToldPath& path = told.paths[i];
        const auto pass = std::size_t(std::ranges::find(passes, path.pass) - passes.begin());
        const ImVec2 at = ImGui::GetCursorScreenPos();
        ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + 3}, {at.x + 9, at.y + line - 5}, colorOf(pass, path.failed ? 0.35f : 1), 2);
        ImGui::Selectable(fmt::format("     {}: {}##{}", path.pass, path.name, i).c_str(), false);
        mark_(fmt::format("path: {}", i));
        if (ImGui::IsItemHovered()) path_ = int(i);
        tip(fmt::format("{} vertices; {}", path.vertices.size(), path.text.empty() ? "no Jacobian" : path.text));
        ImGui::SameLine();
        ImGui::PushStyleColor(ImGuiCol_Text, path.failed ? palette().bad : palette().quiet);
        ImGui::TextUnformatted(path.text.c_str());
        ImGui::PopStyleColor();
    }
    ImGui::EndChild();
}

void PixelPanel::drawPaths(const PixelTold& told, const Viewport& viewport, const CameraKey& camera, const Rectangle& area) const {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const ImVec2 corner(float(area.corner.x), float(area.corner.y));
    list.PushClipRect(corner, {corner.x + float(area.size.x), corner.y + float(area.size.y)}, true);
    const float aspect = float(told.size.x) / float(told.size.y);
    const auto inWindow = [&](const glm::vec3& place) {
        const glm::vec2 at = viewport.inWindow(glm::vec2(place) / place.z);
        return ImVec2(at.x, at.y);
    };
    constexpr float nearest = 1e-3f;  // scene units in front of the camera: what is behind is cut off
    const std::vector<std::string> passes = passesOf(told.paths);
    for (std::size_t i = 0; i < told.paths.size(); ++i) {
        const ToldPath& path = told.paths[i];
        const bool dimmed = path_ >= 0 && path_ != int(i);
        const float opacity = dimmed ? 0.12f : path.failed ? 0.4f : 0.95f;
        const auto pass = std::size_t(std::ranges::find(passes, path.pass) - passes.begin());
        for (std::size_t v = 0; v < path.vertices.size(); ++v) {
            glm::vec3 here = placeInPicture(camera, path.vertices[v], aspect);
            if (here.z > nearest) {
                list.AddCircleFilled(inWindow(here), 5, IM_COL32(0, 0, 0, int(160 * opacity)));
                list.AddCircleFilled(inWindow(here), 3.5f, colorOf(pass, opacity));
            }
            if (v + 1 == path.vertices.size()) continue;
            glm::vec3 there = placeInPicture(camera, path.vertices[v + 1], aspect);
            if (here.z <= nearest && there.z <= nearest) continue;
            if (here.z < nearest) here = glm::mix(here, there, (nearest - here.z) / (there.z - here.z));
            if (there.z < nearest) there = glm::mix(there, here, (nearest - there.z) / (here.z - there.z));
            list.AddLine(inWindow(here), inWindow(there), IM_COL32(0, 0, 0, int(130 * opacity)), 4);
            list.AddLine(inWindow(here), inWindow(there), colorOf(pass, opacity), 2);
        }
    }
    // The pixel itself.
    const glm::vec2 size(told.size), low = viewport.inWindow(glm::vec2(told.pixel) / size), high = viewport.inWindow(glm::vec2(told.pixel + 1) / size);
    list.AddRect({low.x - 2, low.y - 2}, {high.x + 2, high.y + 2}, IM_COL32(255, 255, 255, 230));
    list.PopClipRect();
}

}  // namespace lodestir
