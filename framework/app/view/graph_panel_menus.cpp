// SPDX-License-Identifier: MIT
// The graph panel's buttons and menus.
#include <framework/app/view/graph_panel.h>

#include <framework/app/view/graph_panel_style.h>
#include <framework/app/view/panel_style.h>
#include <framework/app/view/theme.h>

#include <algorithm>

namespace lodestir {
void GraphPanel::drawBar(const ViewStatus& status) {
    const auto button = [&](const char* name, const char* label, bool enabled, const std::string& about) {
        ImGui::BeginDisabled(!enabled);
        const bool pressed = ImGui::Button(label);
        mark_(name);
        ImGui::EndDisabled();
        tip(about);
        ImGui::SameLine();
        return pressed;
    };
    if (button("undo", "Undo", !status.undo.empty(), (status.undo.empty() ? "nothing to take back" : "takes back: " + status.undo) + "; Ctrl+Z"))
        send([](ViewSession& s) { s.undo(); });
    if (button("redo", "Redo", !status.redo.empty(), (status.redo.empty() ? "nothing to do again" : "again: " + status.redo) + "; Ctrl+Y"))
        send([](ViewSession& s) { s.redo(); });
    if (button("add pass", "Add pass", !graph_->edits.types.empty(), "one of all types; it runs when something needs it, or when it is shown")) {
        filter_ = {};
        adding_.reset();
        ImGui::OpenPopup("add");
    }
    if (button("fit graph", "Fit", true, "all of the graph: 0, or a double click; the wheel zooms, the right or middle button moves")) fit();
    drawAddMenu();

    static constexpr std::pair<WireInfo::Kind, const char*> kinds[] = {
        {WireInfo::Kind::image, "image"}, {WireInfo::Kind::buffer, "buffer"}, {WireInfo::Kind::handle, "scene and rules"}};
    ImGui::SameLine(0, 22);
    for (const auto& [kind, label] : kinds) {
        ImGui::TextColored(colorOf(kind), "%s", label);
        ImGui::SameLine(0, 14);
    }
    quietText("dashed: last frame's");
}

void GraphPanel::drawPassMenu() {
    if (!ImGui::BeginPopup("pass")) return;
    const auto pass = std::ranges::find(graph_->passes, menuPass_, &PassInfo::name);
    if (pass == graph_->passes.end()) {
        ImGui::CloseCurrentPopup();
        ImGui::EndPopup();
        return;
    }
    quietText(pass->name + ": " + pass->type);
    ImGui::Separator();
    if (ImGui::MenuItem(pass->off ? "Switch on" : "Switch off", nullptr, false, pass->canBeOff))
        send([name = pass->name, off = !pass->off](ViewSession& s) { s.turnPass(name, off); });
    mark_("menu: off");
    tip(pass->canBeOff ? "what comes in goes on as it is" : "nothing that comes in could stand for what goes out");
    const auto number = std::size_t(pass - graph_->passes.begin());
    const std::vector<std::size_t> swaps = graph_->edits.swaps.empty() ? std::vector<std::size_t>() : graph_->edits.swaps[number];
    const bool opened = ImGui::BeginMenu("Swap for", !swaps.empty());
    mark_("menu: swap");
    if (opened) {
        for (const std::size_t t : swaps) {
            const EditInfo::Type& type = graph_->edits.types[t];
            if (ImGui::MenuItem(type.name.c_str())) send([name = pass->name, to = type.name](ViewSession& s) { s.swapPass(name, to); });
            mark_("swap: " + type.name);
            tip(type.doc);
        }
        ImGui::EndMenu();
    }
    if (ImGui::MenuItem("Remove", nullptr, false, !pass->isScene)) send([name = pass->name](ViewSession& s) { s.removePass(name); });
    mark_("menu: remove");
    tip("who took something of it takes what it would hand through, or nothing");
    ImGui::EndPopup();
}

void GraphPanel::drawAddMenu() {
    ImGui::SetNextWindowSize({620, 0});
    if (!ImGui::BeginPopup("add")) return;
    const auto add = [&](const EditInfo::Type& type) {
        send([name = type.name, answers = answers_](ViewSession& s) { s.addPass(name, answers); });
        ImGui::CloseCurrentPopup();
    };
    if (adding_) {
        const EditInfo::Type& type = graph_->edits.types[*adding_];
        ImGui::TextColored(palette().accent, "%s", type.name.c_str());
        quietText("takes");
        for (const Question& question : type.questions) {
            std::string& answer = answers_[question.input];
            ImGui::AlignTextToFramePadding();
            ImGui::TextUnformatted(question.input.c_str());
            ImGui::SameLine(150);
            ImGui::SetNextItemWidth(-1);
            if (ImGui::BeginCombo(("##" + question.input).c_str(), answer.c_str())) {
                for (const std::string& other : question.answers) {
                    if (ImGui::Selectable(other.c_str(), other == answer)) answer = other;
                    mark_("answer: " + other);
                }
                ImGui::EndCombo();
            }
            mark_("question: " + question.input);
        }
        if (ImGui::Button("Add")) add(type);
        mark_("add");
        ImGui::EndPopup();
        return;
    }
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(-1);
    ImGui::InputTextWithHint("##filter", "part of a name or a sentence", filter_.data(), filter_.size());
    mark_("filter");
    ImGui::BeginChild("types", {0, 380});
    for (std::size_t t = 0; t < graph_->edits.types.size(); ++t) {
        const EditInfo::Type& type = graph_->edits.types[t];
        if (!holdsText(type.name, filter_.data()) && !holdsText(type.doc, filter_.data())) continue;
        // Several outputs would do for one of its inputs: the last one made, unless told otherwise.
        if (ImGui::Selectable(type.name.c_str(), false, ImGuiSelectableFlags_DontClosePopups)) {
            answers_.clear();
            for (const Question& question : type.questions) answers_[question.input] = question.answers.back();
            if (type.questions.empty())
                add(type);
            else
                adding_ = t;
        }
        mark_("add: " + type.name);
        tip(type.doc);
        ImGui::SameLine(190);
        quietText(type.doc);
    }
    ImGui::EndChild();
    ImGui::EndPopup();
}

}  // namespace lodestir
