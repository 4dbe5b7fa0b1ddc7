// SPDX-License-Identifier: MIT
// The panel that chooses which port is shown, and how it looks.
#include <framework/app/view/panels.h>

#include <framework/app/view/panel_style.h>
#include <framework/app/view/theme.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lodestir {

Look Panels::firstLook(const std::string& port, const PortField& field, bool& automatic) {
    const auto named = [&](const char* part) { return port.find(part) != std::string::npos || field.name.find(part) != std::string::npos; };
    Look look;
    const bool whole = isInteger(field.layout.number);
    if (whole) look.look = field.name.empty() ? LOOK_IDS : LOOK_HEAT;
    else if (field.layout.channels == 1) look.look = LOOK_HEAT;
    else if (field.layout.channels == 2 || named("motion") || named("normal") || !field.name.empty()) look.look = LOOK_SIGNED;
    automatic = look.look == LOOK_HEAT || (look.look == LOOK_SIGNED && !named("normal"));
    return look;
}

void Panels::drawShown() {
    heading("SHOWN");
    const auto port = std::ranges::find(graph_->ports, port_, &PortInfo::name);
    if (port == graph_->ports.end()) return;
    ImGui::SetNextItemWidth(-1);
    if (ImGui::BeginCombo("##port", port_.c_str(), ImGuiComboFlags_HeightLargest)) {
        for (const PortInfo& other : graph_->ports) {
            ImGui::PushStyleColor(ImGuiCol_Text, other.runs ? ImGui::GetStyleColorVec4(ImGuiCol_Text) : palette().quiet);
            if (ImGui::Selectable(fmt::format("{:<28}", other.name).c_str(), other.name == port_, other.fields.empty() ? ImGuiSelectableFlags_Disabled : 0)) {
                showPort(other.name);
            }
            mark("port: " + other.name);
            ImGui::PopStyleColor();
            tip(other.doc + "\n" + other.text + "\n" + bytesText(double(other.bytes)) +
                (other.runs ? "" : "\nits pass doesn't run now; choosing it has it run"));
            ImGui::SameLine(220);
            quietText(other.text);
        }
        ImGui::EndCombo();
    }
    mark("port");
    tip(port->doc + "\n" + port->text);
    if (port->fields.empty()) return;
    Shown& shown = shownOf_[port_];
    shown.field = std::min(shown.field, port->fields.size() - 1);
    if (port->fields.size() > 1) {
        ImGui::SetNextItemWidth(-1);
        const PortField& now = port->fields[shown.field];
        if (ImGui::BeginCombo("##field", (now.name + "  (" + now.type + ")").c_str(), ImGuiComboFlags_HeightLarge)) {
            for (std::size_t i = 0; i < port->fields.size(); ++i) {
                const PortField& field = port->fields[i];
                if (!ImGui::Selectable((field.name + "  (" + field.type + ")").c_str(), i == shown.field)) continue;
                shown.field = i;
                shown.look = firstLook(port_, field, shown.automatic);
                sendShow();
            }
            ImGui::EndCombo();
        }
        mark("field");
        tip("which field of each pixel's " + port->text);
    }
    drawLook(shown, port->fields[shown.field]);
}

void Panels::drawLook(Shown& shown, const PortField& field) {
    static constexpr const char* looks[] = {"colour", "signed", "grey", "heat", "ids"};
    static constexpr const char* curves[] = {"no curve", "neutral", "ACES", "Reinhard"};
    static constexpr const char* picks[] = {"x / red", "y / green", "z / blue", "w / alpha", "luminance", "length"};
    Look& look = shown.look;
    const float half = 0.5f * (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x);
    bool again = false;
    int choice = int(look.look);
    ImGui::SetNextItemWidth(half);
    if (ImGui::Combo("##look", &choice, looks, 5)) {
        look.look = std::uint32_t(choice);
        shown.automatic = look.look == LOOK_HEAT || look.look == LOOK_GREY || look.look == LOOK_SIGNED;
        again = true;
    }
    mark("look");
    tip("colour: exposed, tone-mapped, sRGB\nsigned: zero is mid-grey, for normals and motion\ngrey, heat: one number over a range\nids: each whole number its "
        "own colour\nNot a number and infinity are bright green.");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(half);
    if (look.look == LOOK_COLOR) {
        choice = int(look.curve);
        if (ImGui::Combo("##curve", &choice, curves, 4)) look.curve = std::uint32_t(choice);
        mark("curve");
        ImGui::SetNextItemWidth(-1);
        ImGui::SliderFloat("##exposure", &look.exposure, -10, 10, "exposure %+.2f stops");
        mark("exposure");
        if (ImGui::IsItemClicked(1)) look.exposure = 0;
        tip("of the window only; right click: 0");
        return;
    }
    if (look.look == LOOK_GREY || look.look == LOOK_HEAT || look.look == LOOK_IDS) {
        choice = int(look.pick);
        if (ImGui::BeginCombo("##pick", picks[choice])) {
            for (int i = 0; i < 6; ++i) {
                if (i < 4 && i >= int(field.layout.channels)) continue;
                if (ImGui::Selectable(picks[i], i == choice)) {
                    look.pick = std::uint32_t(i);
                    again = true;
                }
            }
            ImGui::EndCombo();
        }
        mark("pick");
    } else {
        ImGui::Dummy({half, 0});
    }
    if (look.look != LOOK_IDS) {
        again = ImGui::Checkbox("auto", &shown.automatic) || again;
        mark("auto range");
        tip("the range follows the picture (0.5 % of the pixels lie beyond each end)");
        ImGui::SameLine();
        float range[2] = {look_.low, look_.high};
        ImGui::SetNextItemWidth(-1);
        const float speed = std::max(0.002f * std::abs(range[1] - range[0]), 1e-6f);
        if (look.look == LOOK_SIGNED ? ImGui::DragFloat("##range", &range[1], speed, 1e-6f, 1e9f, "+- %.4g")
                                     : ImGui::DragFloat2("##range", range, speed, 0, 0, "%.4g")) {
            again = again || shown.automatic;
            shown.automatic = false;
            look.low = range[0];
            look.high = range[1];
        }
        mark("range");
    }
    if (again) {
        look.low = look_.low;
        look.high = look_.high;
        sendShow();
    }
}

/// A reference image stays what errors are those against while A is something else.
void Panels::keepA(const ViewStatus& status) {
    if (status.a.kind == SideA::Kind::kept || status.a.kind == SideA::Kind::live) send([](ViewSession& s) { s.releaseA(); });
    else send([picture = status.picture, layout = layout()](ViewSession& s) { s.keepAsA(picture, layout); });
}

void Panels::runA(const ViewStatus& status) {
    if (status.a.kind == SideA::Kind::live) send([](ViewSession& s) { s.releaseA(); });
    else send([](ViewSession& s) { s.runAsA(); });
}

void Panels::drawComparison(const ViewStatus& status) {
    const bool live = status.a.kind == SideA::Kind::live, keeps = status.a.kind == SideA::Kind::kept;
    const float space = ImGui::GetStyle().ItemSpacing.x, width = (ImGui::GetContentRegionAvail().x - 6 * space) / 7, wide = 1.5f * width + 0.5f * space;
    if (button("keep", live || keeps ? "Let A go" : "Keep A",
               "what is shown now stays as A, to be compared with what comes: another port, variant, graph or value: A", wide))
        keepA(status);
    ImGui::SameLine();
    if (button("run A", live ? "Stop A" : "Run A", "what runs now goes on as A beside what is edited (B): same camera, same frames: L", wide)) runA(status);
    static constexpr std::pair<Comparison::Side, const char*> sides[] = {{Comparison::Side::split, "A | B"},
                                                                         {Comparison::Side::a, "A"},
                                                                         {Comparison::Side::b, "B"},
                                                                         {Comparison::Side::difference, "A - B"}};
    static constexpr const char* tips[] = {"side by side: drag the line", "A alone", "what is edited, alone",
                                           "how far each number is from the other's, where both are of one kind and size"};
    ImGui::BeginDisabled(!comparison_.has());
    for (const auto& [side, label] : sides) {
        ImGui::SameLine();
        const bool chosen = comparison_.side() == side;
        if (chosen) ImGui::PushStyleColor(ImGuiCol_Text, palette().accent);
        if (button(fmt::format("side {}", int(side)).c_str(), label, fmt::format("{}; the next: B", tips[int(side)]).c_str(), width)) comparison_.turnTo(side);
        if (chosen) ImGui::PopStyleColor();
    }
    ImGui::EndDisabled();
}

}  // namespace lodestir
