// SPDX-License-Identifier: MIT
// The scene panel's instances and their levels.
#include <framework/app/view/scene_panel.h>

#include <framework/app/view/panel_style.h>
#include <framework/app/view/theme.h>

#include <fmt/format.h>

#include <algorithm>

namespace lodestir {
namespace {

/// Of level `level` of `levels`, as the pass level_colors has it, less loud.
ImVec4 colorOfLevel(std::uint32_t level, std::size_t levels) {
    if (levels < 2) return palette().quiet;
    ImVec4 color{0, 0, 0, 1};
    ImGui::ColorConvertHSVtoRGB(float(level) / float(levels - 1) * 4 / 6, 0.55f, 0.92f, color.x, color.y, color.z);
    return color;
}

}  // namespace

void ScenePanel::drawLevels(const ViewStatus& status) {
    const SceneInfo& info = graph_->contents;
    const SceneState* state = status.sceneState.get();
    ImGui::Dummy({0, 1});
    quietText("chosen");
    ImGui::SameLine(92);
    ImGui::TextUnformatted(info.policy.c_str());
    tip(info.lod.empty() ? "by the scene file; a level forced here puts a lod_select into the graph"
                         : "by the pass \"" + info.lod + "\", but for what is forced");
    if (state) {
        quietText("triangles");
        ImGui::SameLine(92);
        ImGui::TextUnformatted(fmt::format("{} of {}   {:.1f} %", countText(double(state->triangles)), countText(double(state->finest)),
                                           100 * double(state->triangles) / double(std::max<std::size_t>(state->finest, 1)))
                                   .c_str());
        host_.mark("triangles");
        tip("of the levels shown, over all instances; of the finest ones");
        quietText("memory");
        ImGui::SameLine(92);
        ImGui::TextUnformatted(state->bytes > 0 ? bytesText(double(state->bytes)).c_str() : "known with a lod_select");
        tip("geometry and BVHs of the levels shown, each mesh's level once");
    }
    ImGui::Dummy({0, 2});
    const float space = ImGui::GetStyle().ItemSpacing.x, quarter = (ImGui::GetContentRegionAvail().x - 3 * space) / 4;
    if (button("all finer", "All finer", "each instance a level finer than it is now", quarter)) send([](ViewSession& s) { s.moveLevel(none, -1); });
    ImGui::SameLine();
    if (button("all coarser", "All coarser", "each instance a level coarser than it is now", quarter)) send([](ViewSession& s) { s.moveLevel(none, 1); });
    ImGui::SameLine();
    ImGui::SetNextItemWidth(quarter);
    if (ImGui::BeginCombo("##all", "All at")) {
        for (int level = 0; level < maxLevels; ++level) {
            if (ImGui::Selectable(fmt::format("level {}", level).c_str())) send([level](ViewSession& s) { s.forceLevel(none, level); });
            host_.mark(fmt::format("all at {}", level));
        }
        ImGui::EndCombo();
    }
    host_.mark("all at");
    tip("one level for all; the coarsest where a mesh has fewer");
    ImGui::SameLine();
    if (button("all as chosen", "As chosen", "nothing is forced", quarter)) send([](ViewSession& s) { s.forceLevel(none, {}); });
    const bool colored = !info.levelColors.empty() && status.picture.port == info.levelColors;
    if (button("show levels", colored ? "Show the picture" : "Show levels in colours", "level_colors: red is the finest, blue the coarsest", -1)) {
        if (colored)
            host_.show(graph_->show);
        else if (!info.levelColors.empty())
            host_.show(info.levelColors);
        else {
            wantsColors_ = true;
            send([](ViewSession& s) { s.addLevelColors(); });
        }
    }
    drawPicked(status);
    drawInstances(status);
}

void ScenePanel::drawPicked(const ViewStatus& status) {
    heading("PICKED");
    const SceneState* state = status.sceneState.get();
    if (!state || !state->picked || state->picked->instance >= graph_->contents.instances.size()) {
        quietText("click on the picture, or on a name below");
        return;
    }
    const std::uint32_t instance = state->picked->instance;
    const SceneInfo::Instance& what = graph_->contents.instances[instance];
    const auto& triangles = graph_->contents.meshes[what.mesh].triangles;
    const std::uint32_t level = state->levels[instance], forced = state->forced[instance];
    ImGui::TextColored(palette().accent, "%s", fmt::format("{}  #{}", what.name, instance).c_str());
    host_.mark("picked");
    ImGui::SameLine();
    rightText(fmt::format("level {} of {}   {} triangles", level, triangles.size(), countText(double(triangles[level]))));
    const float space = ImGui::GetStyle().ItemSpacing.x, third = (ImGui::GetContentRegionAvail().x - 2 * space) / 3;
    ImGui::BeginDisabled(triangles.size() < 2);
    if (button("finer", "Finer now", "a level finer, from the next frame on", third)) send([instance](ViewSession& s) { s.moveLevel(instance, -1); });
    ImGui::SameLine();
    if (button("coarser", "Coarser now", "a level coarser, from the next frame on", third)) send([instance](ViewSession& s) { s.moveLevel(instance, 1); });
    ImGui::EndDisabled();
    ImGui::SameLine();
    ImGui::BeginDisabled(forced == none);
    if (button("as chosen", "As chosen", "not forced any more", third)) send([instance](ViewSession& s) { s.forceLevel(instance, {}); });
    ImGui::EndDisabled();
}

void ScenePanel::drawInstances(const ViewStatus& status) {
    const SceneInfo& info = graph_->contents;
    heading(fmt::format("INSTANCES  {}", info.instances.size()).c_str());
    ImGui::SetNextItemWidth(-1);
    bool refilter = listed_.empty();
    if (info.instances.size() > 12) {
        refilter |= ImGui::InputTextWithHint("##filter", "part of a name", filter_.data(), filter_.size());
        host_.mark("filter instances");
    }
    if (refilter) {
        listed_.clear();
        for (std::uint32_t i = 0; i < info.instances.size(); ++i)
            if (holdsText(info.instances[i].name, filter_.data())) listed_.push_back(i);
        // Those that have a choice come first.
        std::ranges::stable_partition(listed_, [&](std::uint32_t i) { return info.meshes[info.instances[i].mesh].triangles.size() > 1; });
    }
    constexpr ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY | ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoPadOuterX;
    if (!ImGui::BeginTable("instances", 4, flags)) return;
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("triangles", 0, 66);
    ImGui::TableSetupColumn("pixels", 0, 58);
    ImGui::TableSetupColumn("level", 0, 92);
    ImGui::TableNextRow();
    ImGui::PushStyleColor(ImGuiCol_Text, palette().quiet);
    for (int column = 0; column < 4; ++column) {
        static constexpr const char* names[] = {"name", "triangles", "pixels", "level"};
        ImGui::TableSetColumnIndex(column);
        ImGui::TextUnformatted(names[column]);
    }
    ImGui::PopStyleColor();
    ImGuiListClipper clipper;
    clipper.Begin(int(listed_.size()));
    while (clipper.Step())
        for (int row = clipper.DisplayStart; row < clipper.DisplayEnd; ++row) drawInstance(status, listed_[std::size_t(row)]);
    ImGui::EndTable();
    host_.mark("instances");
}

void ScenePanel::drawInstance(const ViewStatus& status, std::uint32_t instance) {
    const SceneInfo::Instance& what = graph_->contents.instances[instance];
    const auto& triangles = graph_->contents.meshes[what.mesh].triangles;
    const SceneState* state = status.sceneState.get();
    ImGui::PushID(int(instance));
    ImGui::TableNextRow();
    ImGui::TableSetColumnIndex(0);
    const bool picked = state && state->picked && state->picked->instance == instance;
    if (ImGui::Selectable((what.name + "##name").c_str(), picked)) send([instance](ViewSession& s) { s.choose(instance); });
    host_.mark("instance: " + what.name);
    if (state && instance < state->levels.size()) {
        const std::uint32_t level = state->levels[instance], forced = state->forced[instance];
        ImGui::PushFont(figureFont());
        ImGui::TableSetColumnIndex(1);
        rightText(countText(double(triangles[level])));
        ImGui::TableSetColumnIndex(2);
        if (!state->pixels.empty()) rightText(countText(state->pixels[instance]));
        ImGui::PopFont();
        ImGui::TableSetColumnIndex(3);
        if (triangles.size() < 2) quietText("only one");
        else drawLevel(instance, level, forced);
    }
    ImGui::PopID();
}

/// The level that an instance shows, and in its list those that it can be forced to.
void ScenePanel::drawLevel(std::uint32_t instance, std::uint32_t level, std::uint32_t forced) {
    const SceneInfo::Instance& what = graph_->contents.instances[instance];
    const auto& triangles = graph_->contents.meshes[what.mesh].triangles;
    ImGui::SetNextItemWidth(-1);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {6, 0});
    ImGui::PushStyleColor(ImGuiCol_Text, colorOfLevel(level, triangles.size()));
    const std::string label = fmt::format("{} of {}{}", level, triangles.size(), forced == none ? "" : "   held");
    const bool open = ImGui::BeginCombo("##level", label.c_str(), ImGuiComboFlags_NoArrowButton);
    ImGui::PopStyleColor();
    ImGui::PopStyleVar();
    host_.mark("level: " + what.name);
    tip(forced == none ? "as it is chosen; open it to force one" : fmt::format("forced to {}", forced));
    if (!open) return;
    if (ImGui::Selectable("as chosen", forced == none)) send([instance](ViewSession& s) { s.forceLevel(instance, {}); });
    host_.mark("level as chosen");
    for (std::size_t l = 0; l < triangles.size(); ++l) {
        if (ImGui::Selectable(fmt::format("{}   {} triangles", l, countText(double(triangles[l]))).c_str(), forced == l))
            send([instance, l](ViewSession& s) { s.forceLevel(instance, int(l)); });
        host_.mark(fmt::format("level {}", l));
    }
    ImGui::EndCombo();
}

}  // namespace lodestir
