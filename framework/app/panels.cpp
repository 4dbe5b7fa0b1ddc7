// SPDX-License-Identifier: MIT
#include <framework/app/panels.h>

#include <framework/app/orbit_camera.h>
#include <framework/app/theme.h>
#include <framework/core/log.h>

#include <fmt/format.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>

namespace lodestir {
namespace {

constexpr float panelWidth = 372, stripHeight = 212;

constexpr ImGuiWindowFlags fixedWindow = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                                         ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav;

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

/// Text that ends at the right edge of the cell or window.
void rightText(const std::string& text) {
    const float space = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
    if (space > 0) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + space);
    ImGui::TextUnformatted(text.c_str());
}

std::string timeText(double milliseconds) { return fmt::format("{:.{}f}", milliseconds, milliseconds < 10 ? 2 : milliseconds < 100 ? 1 : 0); }

/// How a picture looks best at first, going by its numbers and its name.
Look firstLook(const std::string& port, const PortField& field, bool& automatic) {
    const auto named = [&](const char* part) { return port.find(part) != std::string::npos || field.name.find(part) != std::string::npos; };
    Look look;
    const bool whole = isInteger(field.layout.number);
    if (whole) look.look = field.name.empty() ? LOOK_IDS : LOOK_HEAT;
    else if (field.layout.channels == 1) look.look = LOOK_HEAT;
    else if (field.layout.channels == 2 || named("motion") || named("normal") || !field.name.empty()) look.look = LOOK_SIGNED;
    automatic = look.look == LOOK_HEAT || (look.look == LOOK_SIGNED && !named("normal"));
    return look;
}

}  // namespace

Panels::Panels(RenderThread& renderer, Window& window, Viewport& viewport, Path out, bool wantsStatistics)
    : renderer_(renderer), window_(window), viewport_(viewport), out_(std::move(out)), wantsStatistics_(wantsStatistics) {}

Rectangle Panels::pictureArea(glm::uvec2 window) const {
    return {.corner = {int(panelWidth), 0}, .size = glm::max(glm::ivec2(window) - glm::ivec2(int(panelWidth), int(stripHeight)), glm::ivec2(0))};
}

void Panels::mark(const std::string& name) {
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    widgets_[name] = {low.x, low.y, high.x, high.y};
}

bool Panels::button(const char* name, const char* label, const char* tipText, float width) {
    const bool pressed = ImGui::Button(label, {width, 0});
    mark(name);
    tip(tipText);
    return pressed;
}

TexelLayout Panels::layout() const {
    if (!graph_) return {};
    const auto port = std::ranges::find(graph_->ports, port_, &PortInfo::name);
    const auto shown = shownOf_.find(port_);
    if (port == graph_->ports.end() || port->fields.empty() || shown == shownOf_.end()) return {};
    return port->fields[std::min(shown->second.field, port->fields.size() - 1)].layout;
}

void Panels::sendShow() {
    const TexelLayout layout = this->layout();
    const Shown& shown = shownOf_[port_];
    send([port = port_, layout, pick = shown.look.pick, statistics = wantsStatistics_ || shown.automatic](ViewSession& s) { s.show(port, layout, pick, statistics); });
}

void Panels::moveCamera(const std::optional<CameraKey>& camera) {
    viewport_.setCamera(camera);
    if (camera) send([key = *camera](ViewSession& s) { s.setCamera(key); });
    else send([](ViewSession& s) { s.resetCamera(); });
}

/// Takes over what a new session has.
void Panels::follow(const ViewStatus& status) {
    if (status.graph == graph_ || !status.graph) return;
    graph_ = status.graph;
    values_.clear();
    for (const PassInfo& pass : graph_->passes)
        for (const Parameter& parameter : pass.parameters) values_[pass.name + "." + std::string(parameter.name)] = parameter.value;
    const bool known = std::ranges::find(graph_->ports, port_, &PortInfo::name) != graph_->ports.end();
    if (!known) port_ = graph_->show;
    for (const PortInfo& port : graph_->ports) {
        if (port.fields.empty() || shownOf_.contains(port.name)) continue;
        Shown shown;
        shown.look = firstLook(port.name, port.fields[0], shown.automatic);
        shownOf_[port.name] = shown;
    }
    sendShow();
}

void Panels::draw(const ViewStatus& status) {
    widgets_.clear();
    follow(status);
    paused_ = status.paused;
    keys(status);
    const ImVec2 window = ImGui::GetIO().DisplaySize;

    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize({panelWidth, window.y});
    ImGui::Begin("controls", nullptr, fixedWindow);
    drawGraph(status);
    if (graph_) {
        drawShown();
        drawCamera(status);
        drawPasses();
        drawOutput(status);
    }
    ImGui::End();

    ImGui::SetNextWindowPos({panelWidth, window.y - stripHeight});
    ImGui::SetNextWindowSize({std::max(window.x - panelWidth, 1.0f), stripHeight});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImVec4(0.088f, 0.095f, 0.107f, 1));
    ImGui::Begin("times", nullptr, fixedWindow);
    if (graph_) {
        const float facts = 290;
        ImGui::BeginChild("table", {std::max(ImGui::GetContentRegionAvail().x - facts - 18, 100.0f), 0});
        drawTimes(status);
        ImGui::EndChild();
        ImGui::SameLine(0, 18);
        ImGui::BeginChild("facts", {0, 0});
        drawFacts(status);
        ImGui::EndChild();
    }
    ImGui::End();
    ImGui::PopStyleColor();

    drawProblems(status);
    drawHelp();

    const Shown& shown = shownOf_[port_];
    look_ = shown.look;
    if (shown.automatic && status.statistics) {
        look_.low = look_.look == LOOK_SIGNED ? 0 : status.statistics->low;
        look_.high = look_.look == LOOK_SIGNED ? std::max(status.statistics->largest, 1e-20f) : std::max(status.statistics->high, look_.low + 1e-20f);
    }
}

void Panels::keys(const ViewStatus& status) {
    const std::vector<int> down = window_.takeKeys();
    if (ImGui::GetIO().WantTextInput) return;
    const auto pressed = [&](int key) { return std::ranges::find(down, key) != down.end(); };
    if (pressed(GLFW_KEY_SPACE)) send([paused = !paused_](ViewSession& s) { s.pause(paused); });
    if (pressed(GLFW_KEY_N)) send([](ViewSession& s) { s.step(); });
    if (pressed(GLFW_KEY_R)) send([](ViewSession& s) { s.resetHistory(); });
    if (pressed(GLFW_KEY_C)) moveCamera({});
    if (pressed(GLFW_KEY_F) && graph_) moveCamera(framed(viewport_.camera().value_or(status.camera.key), graph_->bounds, float(graph_->size.x) / float(graph_->size.y)));
    if (pressed(GLFW_KEY_0)) viewport_.fit();
    if (pressed(GLFW_KEY_1)) viewport_.zoomTo(1);
    if (pressed(GLFW_KEY_2)) viewport_.zoomTo(2);
    if (pressed(GLFW_KEY_4)) viewport_.zoomTo(4);
    if (pressed(GLFW_KEY_8)) viewport_.zoomTo(8);
    if (pressed(GLFW_KEY_S)) send([out = out_](ViewSession& s) { s.save(out); });
    if (pressed(GLFW_KEY_H) || pressed(GLFW_KEY_F1)) help_ = !help_;
    if (pressed(GLFW_KEY_ESCAPE)) help_ = false;
    if (pressed(GLFW_KEY_F12)) screenshot_ = true;
}

void Panels::drawGraph(const ViewStatus& status) {
    ImGui::PushStyleColor(ImGuiCol_Text, palette().accent);
    ImGui::TextUnformatted(graph_ ? graph_->file.stem().string().c_str() : "lodestir");
    ImGui::PopStyleColor();
    if (graph_) {
        tip(graph_->about + "\n\n" + graph_->file.string());
        ImGui::SameLine();
        quietText("on " + graph_->scene);
        if (!graph_->variants.empty()) {
            ImGui::SetNextItemWidth(-1);
            const std::string current = graph_->variant.empty() ? "the graph as written" : graph_->variant;
            if (ImGui::BeginCombo("##variant", current.c_str())) {
                if (ImGui::Selectable("the graph as written", graph_->variant.empty())) send([](ViewSession& s) { s.setVariant(""); });
                for (const std::string& variant : graph_->variants) {
                    if (ImGui::Selectable(variant.c_str(), variant == graph_->variant)) send([variant](ViewSession& s) { s.setVariant(variant); });
                    mark("variant: " + variant);
                }
                ImGui::EndCombo();
            }
            mark("variant");
            tip("variant of the graph; choosing one loads the graph again");
        }
    }
    ImGui::Dummy({0, 1});
    const float space = ImGui::GetStyle().ItemSpacing.x, width = (ImGui::GetContentRegionAvail().x - 3 * space) / 4;
    if (button("pause", paused_ ? "Resume" : "Pause", "Space", width)) send([paused = !paused_](ViewSession& s) { s.pause(paused); });
    ImGui::SameLine();
    if (button("step", "Step", "one frame while paused: N", width)) send([](ViewSession& s) { s.step(); });
    ImGui::SameLine();
    if (button("reset history", "Restart", "history and accumulation start again: R", width)) send([](ViewSession& s) { s.resetHistory(); });
    ImGui::SameLine();
    if (button("help", "Help", "keys and mouse: H", width)) help_ = !help_;
    if (!status.busy.empty() && !graph_) quietText(status.busy + " ...");
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
                port_ = other.name;
                sendShow();
            }
            mark("port: " + other.name);
            ImGui::PopStyleColor();
            tip(other.doc + "\n" + other.text + "\n" + bytesText(double(other.bytes)) + (other.runs ? "" : "\nits pass doesn't run now; choosing it has it run"));
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
    tip("colour: exposed, tone-mapped, sRGB\nsigned: zero is mid-grey, for normals and motion\ngrey, heat: one number over a range\nids: each whole number its own colour\nNot a number and infinity are bright green.");
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
        if (look.look == LOOK_SIGNED ? ImGui::DragFloat("##range", &range[1], speed, 1e-6f, 1e9f, "+- %.4g") : ImGui::DragFloat2("##range", range, speed, 0, 0, "%.4g")) {
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

void Panels::drawCamera(const ViewStatus& status) {
    heading("CAMERA");
    CameraKey key = viewport_.camera().value_or(status.camera.key);
    ImGui::SameLine();
    ImGui::PushStyleColor(ImGuiCol_Text, viewport_.camera() ? palette().accent : palette().quiet);
    rightText(viewport_.camera() ? "moved by hand" : "the scene's path");
    ImGui::PopStyleColor();
    const float third = (ImGui::GetContentRegionAvail().x - 2 * ImGui::GetStyle().ItemSpacing.x) / 3;
    bool moved = false;
    float degrees = glm::degrees(key.fovy);
    ImGui::SetNextItemWidth(third);
    if (ImGui::DragFloat("##fovy", &degrees, 0.2f, 1, 150, "%.1f deg", ImGuiSliderFlags_AlwaysClamp)) {
        key.fovy = glm::radians(degrees);
        moved = true;
    }
    mark("fovy");
    tip("vertical angle of view");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(third);
    moved = ImGui::DragFloat("##aperture", &key.aperture, 0.0005f, 0, 10, "lens %.4f", ImGuiSliderFlags_AlwaysClamp) || moved;
    mark("aperture");
    tip("radius of the lens, scene units; 0: everything is sharp");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(third);
    moved = ImGui::DragFloat("##focus", &key.focus, 0.005f * key.focus, 1e-4f, 1e6f, "focus %.3f", ImGuiSliderFlags_AlwaysClamp) || moved;
    mark("focus");
    tip("distance of what is sharp, scene units");
    if (moved) moveCamera(key);
    if (button("frame scene", "Frame", "all of the scene: F", third)) moveCamera(framed(key, graph_->bounds, float(graph_->size.x) / float(graph_->size.y)));
    ImGui::SameLine();
    if (button("reset camera", "Reset", "back to the scene's own: C", third)) moveCamera({});
    ImGui::SameLine();
    if (button("copy camera", "Copy", "as in a scene file, to the clipboard and the log", third)) {
        const std::string text = "\"camera\": " + cameraJson(key).dump(-1);
        window_.setClipboard(text);
        log::note("{}", text);
    }
}

void Panels::drawPasses() {
    heading("PASSES");
    const float below = 112;
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

void Panels::drawOutput(const ViewStatus& status) {
    heading("OUTPUT");
    const float third = (ImGui::GetContentRegionAvail().x - 2 * ImGui::GetStyle().ItemSpacing.x) / 3;
    if (button("save", "Save image", "EXR and PNG of what is shown, with the graph in the header: S", third)) send([out = out_](ViewSession& s) { s.save(out); });
    ImGui::SameLine();
    if (button("save graph", "Save graph", "the graph with all that is set now, for `lodestir run`", third))
        send([file = out_ / (graph_->file.stem().string() + ".json")](ViewSession& s) { s.saveGraph(file); });
    ImGui::SameLine();
    ImGui::SetNextItemWidth(third);
    static constexpr glm::uvec2 sizes[] = {{240, 135}, {320, 180}, {480, 270}, {640, 360}, {960, 540}, {1280, 720}, {1920, 1080}};
    if (ImGui::BeginCombo("##size", fmt::format("{}x{}", graph_->size.x, graph_->size.y).c_str())) {
        for (const glm::uvec2 size : sizes)
            if (ImGui::Selectable(fmt::format("{}x{}", size.x, size.y).c_str(), size == graph_->size)) send([size](ViewSession& s) { s.resize(size); });
        ImGui::EndCombo();
    }
    mark("size");
    tip("size of the frame");
    ImGui::PushStyleColor(ImGuiCol_Text, palette().quiet);
    ImGui::TextUnformatted(status.note.c_str());
    ImGui::PopStyleColor();
    tip(status.note);
}

void Panels::drawTimes(const ViewStatus& status) {
    double most = 0, all = 0, rays = 0;
    const auto raysOf = [](const PassTime& pass) {
        double sum = 0;
        for (std::uint32_t purpose = 0; purpose < RAYS_STEPS; ++purpose) sum += double(pass.rays[purpose]);
        return sum;
    };
    for (const PassTime& pass : status.passes) {
        if (pass.setup || !pass.ran) continue;
        most = std::max(most, pass.milliseconds);
        all += pass.milliseconds;
        rays += raysOf(pass);
    }
    constexpr ImGuiTableFlags flags = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY | ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_NoPadOuterX;
    if (!ImGui::BeginTable("passes", 5, flags)) return;
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableSetupColumn("pass", 0, 130);
    ImGui::TableSetupColumn("time", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("ms", 0, 64);
    ImGui::TableSetupColumn("rays", 0, 72);
    ImGui::TableSetupColumn("rays/s", 0, 72);
    const auto number = [](int column, const std::string& text) {
        ImGui::TableSetColumnIndex(column);
        ImGui::PushFont(figureFont());
        rightText(text);
        ImGui::PopFont();
    };
    ImGui::TableNextRow();
    ImGui::PushStyleColor(ImGuiCol_Text, palette().quiet);
    ImGui::TableSetColumnIndex(0);
    ImGui::TextUnformatted("pass");
    number(2, "ms");
    number(3, "rays");
    number(4, "rays/s");
    ImGui::PopStyleColor();
    for (const PassTime& pass : status.passes) {
        ImGui::TableNextRow();
        ImGui::TableSetColumnIndex(0);
        ImGui::TextUnformatted(pass.name.c_str());
        ImGui::TableSetColumnIndex(1);
        if (pass.setup || !pass.ran) {
            quietText(pass.ran ? "set up" : "kept");
        } else {
            const ImVec2 corner = ImGui::GetCursorScreenPos();
            const float width = ImGui::GetContentRegionAvail().x, length = most > 0 ? float(pass.milliseconds / most) * width : 0;
            const float top = corner.y + 5, bottom = corner.y + ImGui::GetTextLineHeight() - 3;
            ImGui::GetWindowDrawList()->AddRectFilled({corner.x, top}, {corner.x + width, bottom}, ImGui::GetColorU32(ImVec4(1, 1, 1, 0.03f)), 2);
            ImGui::GetWindowDrawList()->AddRectFilled({corner.x, top}, {corner.x + std::max(length, 2.0f), bottom}, ImGui::GetColorU32(palette().bar), 2);
        }
        number(2, pass.ran ? timeText(pass.milliseconds) : "");
        const double traced = pass.ran ? raysOf(pass) : 0;
        number(3, traced > 0 ? countText(traced) : "");
        number(4, traced > 0 && pass.milliseconds > 0 ? countText(1000 * traced / pass.milliseconds) : "");
    }
    ImGui::TableNextRow();
    ImGui::PushStyleColor(ImGuiCol_Text, palette().accent);
    ImGui::TableSetColumnIndex(0);
    ImGui::TextUnformatted("frame");
    number(2, timeText(all));
    number(3, countText(rays));
    number(4, all > 0 ? countText(1000 * rays / all) : "");
    ImGui::PopStyleColor();
    ImGui::EndTable();
}

void Panels::drawFacts(const ViewStatus& status) {
    const auto fact = [](const char* name, const std::string& value, const std::string& more = {}) {
        quietText(name);
        ImGui::SameLine(86);
        ImGui::TextUnformatted(value.c_str());
        tip(more.empty() ? value : more);
    };
    fact("frame", fmt::format("{}   ({} since a change)", status.nextFrame > 0 ? status.nextFrame - 1 : 0, status.framesStill));
    fact("a frame", fmt::format("{} ms   {:.1f} a second", timeText(status.wallMilliseconds), status.wallMilliseconds > 0 ? 1000 / status.wallMilliseconds : 0),
         "from start to end, with all that the CPU does in between");
    fact("size", fmt::format("{} x {}   zoom {:.0f} %", graph_->size.x, graph_->size.y, 100 * viewport_.zoom()));
    fact("memory", bytesText(double(graph_->memoryBytes)) + fmt::format("   {:.0f} B a pixel", double(graph_->memoryBytes) / (double(graph_->size.x) * graph_->size.y)), "of the ports");
    fact("rays by", graph_->rays);
    fact("device", graph_->device.substr(0, graph_->device.find(" (")), graph_->device);
    if (graph_->software) quietText("times are the CPU's: rays and ratios\nmean more than milliseconds");
}

void Panels::drawProblems(const ViewStatus& status) {
    const Rectangle area = pictureArea({std::uint32_t(ImGui::GetIO().DisplaySize.x), std::uint32_t(ImGui::GetIO().DisplaySize.y)});
    if (!status.busy.empty() && graph_) {
        ImGui::SetNextWindowPos({float(area.corner.x) + 0.5f * float(area.size.x), float(area.size.y) - 14}, 0, {0.5f, 1});
        ImGui::SetNextWindowBgAlpha(0.85f);
        ImGui::Begin("busy", nullptr, fixedWindow | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoInputs);
        ImGui::TextUnformatted((status.busy + " ...").c_str());
        ImGui::End();
    }
    if (status.problems.empty()) return;
    const float width = float(area.size.x) - 32;
    ImGui::SetNextWindowPos({float(area.corner.x) + 16, 16});
    ImGui::SetNextWindowSizeConstraints({width, 0}, {width, float(area.size.y) - 32});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, palette().badBack);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 5);
    ImGui::Begin("problems", nullptr, (fixedWindow & ~ImGuiWindowFlags_NoBringToFrontOnFocus) | ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::TextColored(palette().bad, "%s", graph_ ? "What was saved last doesn't work; what worked before goes on." : "This doesn't work yet; it is read again when a file changes.");
    ImGui::PushFont(figureFont());
    ImGui::PushTextWrapPos(width - 14);
    for (const std::string& problem : status.problems) ImGui::TextUnformatted(problem.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopFont();
    ImGui::End();
    ImGui::PopStyleVar();
    ImGui::PopStyleColor();
}

void Panels::drawProbe(const ViewStatus& status, const std::optional<PicturePainter::Probe>& probe, const Rectangle& area) {
    std::string text = status.picture.texels ? port_ : "";
    if (!status.picture.texels && graph_) text = port_ + ": nothing to look at";
    if (probe && viewport_.pixelUnderPointer().x >= 0) text += "   " + probeText(probe->pixel, probe->bits, probe->layout);
    if (text.empty()) return;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    ImGui::PushFont(figureFont());
    const ImVec2 size = ImGui::CalcTextSize(text.c_str()), corner{float(area.corner.x) + 10, float(area.size.y) - size.y - 12};
    list.AddRectFilled({corner.x - 6, corner.y - 4}, {corner.x + size.x + 6, corner.y + size.y + 4}, IM_COL32(12, 13, 15, 200), 3);
    list.AddText(corner, ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
    ImGui::PopFont();
}

void Panels::drawHelp() {
    if (!help_) return;
    static constexpr const char* lines[][2] = {{"left drag", "orbit around the target"},
                                               {"right or middle drag", "move sideways"},
                                               {"wheel", "closer, farther"},
                                               {"Ctrl + wheel, Ctrl + drag", "zoom and move the picture"},
                                               {"0   1 2 4 8", "picture as large as fits; zoom"},
                                               {"F   C", "frame the scene; the scene's own camera"},
                                               {"Space   N", "pause; one frame"},
                                               {"R", "restart history and accumulation"},
                                               {"S", "save what is shown (EXR, PNG)"},
                                               {"F12", "picture of the whole window"},
                                               {"Ctrl + click on a slider", "type the number"},
                                               {"orange dot", "changed; click: back to the graph's value"},
                                               {"H, Esc", "this help"}};
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * (window.x + panelWidth), 0.42f * window.y}, 0, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({560, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 6);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {22, 18});
    ImGui::Begin("help", nullptr, fixedWindow & ~ImGuiWindowFlags_NoBringToFrontOnFocus);
    for (const auto& line : lines) {
        ImGui::TextColored(palette().accent, "%s", line[0]);
        ImGui::SameLine(210);
        ImGui::TextUnformatted(line[1]);
    }
    ImGui::Dummy({0, 4});
    quietText("Graph, scene and shaders are read again when they are saved.");
    ImGui::End();
    ImGui::PopStyleVar(2);
}

}  // namespace lodestir
