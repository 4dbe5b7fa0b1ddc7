// SPDX-License-Identifier: MIT
#include <framework/app/view/comparison.h>

#include <framework/app/view/panel_style.h>

#include <algorithm>

namespace lodestir {

void Comparison::keep(const Picture& picture, const TexelLayout& layout, const Look& look, const std::string& what) {
    if (!picture.texels) return;
    kept_ = Kept{picture, layout, look, what};
    side_ = Side::split;
}

void Comparison::turn() { side_ = Side((int(side_) + 1) % 4); }

void Comparison::draw(const Rectangle& area, const std::string& what) {
    if (!kept_ || area.size.x <= 0 || area.size.y <= 0) return;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const float left = float(area.corner.x), right = left + float(area.size.x), top = float(area.corner.y), bottom = top + float(area.size.y);
    const auto name = [&](const std::string& text, float x, bool endsThere) {
        const ImVec2 size = ImGui::CalcTextSize(text.c_str());
        const ImVec2 corner{endsThere ? x - size.x - 10 : x + 10, top + 10};
        list.AddRectFilled({corner.x - 6, corner.y - 4}, {corner.x + size.x + 6, corner.y + size.y + 4}, IM_COL32(12, 13, 15, 200), 3);
        list.AddText(corner, ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
    };
    const std::string a = "A  " + kept_->what, b = "B  " + what;
    if (side_ == Side::kept) name(a, left, false);
    if (side_ == Side::now) name(b, left, false);
    if (side_ == Side::difference) name("|A - B|  " + kept_->what + "  -  " + what, left, false);
    if (side_ != Side::split) return;
    const float x = left + split_ * float(area.size.x);
    name(a, left, false);
    name(b, right, true);
    list.AddLine({x, top}, {x, bottom}, IM_COL32(240, 240, 240, 220), 1.5f);
    list.AddCircleFilled({x, 0.5f * (top + bottom)}, 5, IM_COL32(240, 240, 240, 230));
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
    return kept_ && side_ == Side::difference && kept_->picture.extent == now.extent && kept_->layout == layout ? &kept_->picture : nullptr;
}

void Comparison::prepare(gpu::Commands& commands, const Rectangle& place, const glm::mat3& toImage, bool blueFirst) {
    if (showsKept()) painter_.prepare(commands, kept_->picture, nullptr, kept_->layout, kept_->look, place, toImage, glm::ivec2(-1), blueFirst);
}

void Comparison::paint(gpu::Commands& commands, VkImage image, const PicturePainter& now) const {
    if (!showsKept()) return now.paint(commands, image);
    const float split = side_ == Side::kept ? 1 : split_;
    painter_.paint(commands, image, 0, split);
    now.paint(commands, image, split, 1);
}

}  // namespace lodestir
