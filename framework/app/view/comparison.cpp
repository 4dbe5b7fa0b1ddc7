// SPDX-License-Identifier: MIT
#include <framework/app/view/comparison.h>

#include <framework/app/view/panel_style.h>

#include <algorithm>

namespace lodestir {

void Comparison::follow(const ViewStatus& status, const TexelLayout& layout, const Look& look) {
    if (status.a.kind != a_.kind) side_ = Side::split;
    a_ = status.a;
    if (a_.kind == SideA::Kind::image || (a_.picture.port == status.picture.port && a_.layout == layout)) look_ = look;
}

void Comparison::turn() { side_ = Side((int(side_) + 1) % 4); }

void Comparison::draw(const Rectangle& area, const std::string& what, bool free) {
    if (!has() || area.size.x <= 0 || area.size.y <= 0) return;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const float left = float(area.corner.x), right = left + float(area.size.x), top = float(area.corner.y), bottom = top + float(area.size.y);
    const auto name = [&](const std::string& text, float x, bool endsThere) {
        if (!free) return;
        const ImVec2 size = ImGui::CalcTextSize(text.c_str());
        const ImVec2 corner{endsThere ? x - size.x - 10 : x + 10, top + 10};
        list.AddRectFilled({corner.x - 6, corner.y - 4}, {corner.x + size.x + 6, corner.y + size.y + 4}, IM_COL32(12, 13, 15, 200), 3);
        list.AddText(corner, ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
    };
    const std::string a = "A  " + a_.what, b = "B  " + what;
    if (side_ == Side::a) name(a, left, false);
    if (side_ == Side::b) name(b, left, false);
    if (side_ == Side::difference) name("|A - B|  " + a_.what + "  -  " + what, left, false);
    if (side_ != Side::split) return;
    const float x = left + split_ * float(area.size.x);
    name(a, left, false);
    name(b, right, true);
    list.AddLine({x, top}, {x, bottom}, IM_COL32(240, 240, 240, 220), 1.5f);
    list.AddCircleFilled({x, 0.5f * (top + bottom)}, 5, IM_COL32(240, 240, 240, 230));
    if (!free) return;
    // A window of its own, so that the mouse there moves the line and not the camera.
    constexpr float reach = 7;
    ImGui::SetNextWindowPos({x - reach, top});
    ImGui::SetNextWindowSize({2 * reach, float(area.size.y)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
    ImGui::Begin("divider", nullptr, fixedWindow | ImGuiWindowFlags_NoBackground);
    ImGui::InvisibleButton("line", {2 * reach, float(area.size.y)});
    if (ImGui::IsItemHovered() || ImGui::IsItemActive()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (ImGui::IsItemActive()) split_ = std::clamp((ImGui::GetIO().MousePos.x - left) / float(area.size.x), 0.0f, 1.0f);
    ImGui::End();
    ImGui::PopStyleVar(2);
}

const Picture* Comparison::subtracted(const Picture& now, const TexelLayout& layout) const {
    return has() && side_ == Side::difference && a_.picture.extent == now.extent && a_.layout == layout ? &a_.picture : nullptr;
}

void Comparison::prepare(gpu::Commands& commands, const Rectangle& place, const glm::mat3& toImage, bool blueFirst) {
    if (showsA()) painter_.prepare(commands, a_.picture, nullptr, a_.layout, look_, place, toImage, glm::ivec2(-1), blueFirst);
}

void Comparison::paint(gpu::Commands& commands, VkImage image, const PicturePainter& now) const {
    if (!showsA()) return now.paint(commands, image);
    const float split = side_ == Side::a ? 1 : split_;
    painter_.paint(commands, image, 0, split);
    now.paint(commands, image, split, 1);
}

}  // namespace lodestir
