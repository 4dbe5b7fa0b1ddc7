// SPDX-License-Identifier: MIT
// The panel of all passes' parameters, made from their declarations.
#include <framework/app/view/panels.h>

#include <framework/app/view/panel_style.h>
#include <framework/app/view/theme.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lodestir {

void Panels::drawPasses() {
    heading("PASSES");
    const float below = 138;
    ImGui::BeginChild("passes", {0, std::max(ImGui::GetContentRegionAvail().y - below, 60.0f)});
    for (const PassInfo& pass : graph_->passes) {
        if (pass.parameters.empty()) continue;
        bool changed = false;
        for (std::size_t i = 0; i < pass.parameters.size(); ++i) changed |= values_[pass.name + "." + std::string(pass.parameters[i].name)] != pass.given[i];
        const bool idle = pass.off || pass.culled;
        if (idle) ImGui::PushStyleColor(ImGuiCol_Text, palette().quiet);
        const bool open = ImGui::CollapsingHeader((pass.name + "###" + pass.name).c_str(), pass.name == "scene" || idle ? 0 : ImGuiTreeNodeFlags_DefaultOpen);
        if (idle) ImGui::PopStyleColor();
        mark(pass.name);
        tip(pass.type + ": " + pass.doc);
        const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
        ImDrawList& list = *ImGui::GetWindowDrawList();
        const std::string right = pass.off ? "off" : pass.culled ? "not needed" : pass.type;
        const float width = ImGui::CalcTextSize(right.c_str()).x;
        list.AddText({high.x - width - 10, low.y + ImGui::GetStyle().FramePadding.y}, ImGui::GetColorU32(palette().quiet), right.c_str());
        if (changed) list.AddCircleFilled({high.x - width - 20, 0.5f * (low.y + high.y)}, 3.5f, ImGui::GetColorU32(palette().accent));
        if (!open) continue;
        for (std::size_t i = 0; i < pass.parameters.size(); ++i) drawParameter(pass, i);
        ImGui::Dummy({0, 2});
    }
    ImGui::EndChild();
    mark("passes");
}

void Panels::drawParameter(const PassInfo& pass, std::size_t index) {
    const Parameter& parameter = pass.parameters[index];
    const std::string name = pass.name + "." + std::string(parameter.name);
    Value& value = values_[name];
    const Value before = value;
    ImGui::PushID(name.c_str());
    const bool changed = value != pass.given[index];
    ImGui::AlignTextToFramePadding();
    if (changed) ImGui::TextColored(palette().accent, "%s", std::string(parameter.name).c_str());
    else ImGui::TextUnformatted(std::string(parameter.name).c_str());
    const std::string about = fmt::format("{}\n{}, default {}{}", parameter.doc, parameter.typeText(), writeValue(parameter, parameter.initial).dump(-1),
                                          parameter.constant ? "\na constant of the shader: changing it builds the session anew" : "");
    tip(about);
    ImGui::SameLine(132);
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - 24);
    bool done = false;
    if (parameter.isChoice()) {
        int& choice = std::get<int>(value);
        if (ImGui::BeginCombo("##value", std::string(parameter.choices[std::size_t(choice)]).c_str())) {
            for (int i = 0; i < int(parameter.choices.size()); ++i) {
                if (ImGui::Selectable(std::string(parameter.choices[std::size_t(i)]).c_str(), i == choice)) {
                    choice = i;
                    done = true;
                }
                mark(name + ": " + std::string(parameter.choices[std::size_t(i)]));
            }
            ImGui::EndCombo();
        }
    } else if (bool* flag = std::get_if<bool>(&value)) {
        done = ImGui::Checkbox("##value", flag);
    } else if (int* number = std::get_if<int>(&value)) {
        const int low = std::get<int>(parameter.low), high = std::get<int>(parameter.high);
        if (high - low <= 256) ImGui::SliderInt("##value", number, low, high, "%d", ImGuiSliderFlags_AlwaysClamp);
        else ImGui::DragInt("##value", number, std::max(1.0f, 0.01f * float(std::abs(*number))), low, high, "%d", ImGuiSliderFlags_AlwaysClamp);
        done = ImGui::IsItemDeactivatedAfterEdit();
    } else if (float* real = std::get_if<float>(&value)) {
        const float low = std::get<float>(parameter.low), high = std::get<float>(parameter.high);
        if (high - low <= 200) ImGui::SliderFloat("##value", real, low, high, "%.4g", ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoRoundToFormat);
        else ImGui::DragFloat("##value", real, std::max(0.01f, 0.01f * std::abs(*real)), low, high, "%.5g", ImGuiSliderFlags_AlwaysClamp);
        done = ImGui::IsItemDeactivatedAfterEdit();
    } else {
        std::string& text = std::get<std::string>(value);
        char typed[256] = {};
        text.copy(typed, sizeof typed - 1);
        if (ImGui::InputText("##value", typed, sizeof typed, ImGuiInputTextFlags_EnterReturnsTrue)) {
            text = typed;
            done = true;
        }
    }
    mark(name);
    tip(about);
    if (changed) {  // a dot that takes it back
        ImGui::SameLine();
        const ImVec2 corner = ImGui::GetCursorScreenPos();
        const float size = ImGui::GetFrameHeight();
        if (ImGui::InvisibleButton("##back", {16, size})) {
            value = pass.given[index];
            done = true;
        }
        mark(name + " back");
        const ImVec4 color = ImGui::IsItemHovered() ? ImVec4(1, 1, 1, 1) : palette().accent;
        ImGui::GetWindowDrawList()->AddCircleFilled({corner.x + 8, corner.y + 0.5f * size}, 4, ImGui::GetColorU32(color));
        tip(fmt::format("back to the graph's {}", writeValue(parameter, pass.given[index]).dump(-1)));
        if (ImGui::BeginPopupContextItem("##more")) {
            if (ImGui::Selectable(fmt::format("default: {}", writeValue(parameter, parameter.initial).dump(-1)).c_str())) {
                value = parameter.initial;
                done = true;
            }
            ImGui::EndPopup();
        }
    }
    ImGui::PopID();
    // A constant costs a new session: it is sent when the widget is let go.
    if (parameter.constant ? done : value != before) send([name, value](ViewSession& s) { s.setParameter(name, value); });
}

}  // namespace lodestir
