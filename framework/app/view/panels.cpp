// SPDX-License-Identifier: MIT
#include <framework/app/view/panels.h>

#include <framework/app/view/orbit_camera.h>
#include <framework/app/view/panel_style.h>
#include <framework/app/view/theme.h>
#include <framework/core/log.h>

#include <fmt/format.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>

namespace lodestir {

Panels::Panels(RenderThread& renderer, Window& window, Viewport& viewport, Comparison& comparison, Path out, float frameTime, bool wantsStatistics)
    : renderer_(renderer),
      window_(window),
      viewport_(viewport),
      comparison_(comparison),
      graphPanel_(renderer, [this](const std::string& name) { mark(name); }, [this](const std::string& port) { showPort(port); }),
      pixelPanel_(renderer, [this](const std::string& name) { mark(name); }),
      comparisonPanel_(renderer, [this](const std::string& name) { mark(name); }, out),
      scenePanel_(renderer, sceneHost(), out),
      out_(std::move(out)),
      frameTime_(frameTime),
      wantsStatistics_(wantsStatistics) {}

Rectangle Panels::pictureArea(glm::uvec2 window) const {
    const int beside = int(panelWidth) + (scenePanel_.isOpen() ? int(scenePanelWidth) : 0);
    return {.corner = {int(panelWidth), 0}, .size = glm::max(glm::ivec2(window) - glm::ivec2(beside, int(stripHeight)), glm::ivec2(0))};
}

ScenePanel::Host Panels::sceneHost() {
    return {.mark = [this](const std::string& name) { mark(name); },
            .value = [this](const std::string& name) -> const Value& { return values_[name]; },
            .set =
                [this](const std::string& name, const Value& value) {
                    values_[name] = value;
                    send([name, value](ViewSession& s) { s.setParameter(name, value); });
                },
            .show = [this](const std::string& port) { showPort(port); },
            .moveCamera = [this](const std::optional<CameraKey>& camera) { moveCamera(camera); },
            .letGo = [this] { viewport_.setCamera({}); }};
}

/// The scene's panel, and what of it lies over the picture.
void Panels::drawScene(const ViewStatus& status) {
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    const Rectangle picture = pictureArea({std::uint32_t(window.x), std::uint32_t(window.y)});
    const auto clicked = viewport_.takeClick(status.picture);
    if (clicked && scenePanel_.isOpen()) scenePanel_.click(*clicked);
    if (!graphPanel_.isOpen() && status.picture.texels) scenePanel_.drawOver(status, picture, viewport_.toImage(status.picture));
    scenePanel_.draw(status, viewport_.camera().value_or(status.camera.key), {{picture.corner.x + picture.size.x, 0}, {int(scenePanelWidth), picture.size.y}});
}

void Panels::mark(const std::string& name) {
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    const ImDrawList& list = *ImGui::GetWindowDrawList();
    const float above = list.GetClipRectMin().y, below = std::max(list.GetClipRectMax().y, above);
    widgets_[name] = {low.x, std::clamp(low.y, above, below), high.x, std::clamp(high.y, above, below)};
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

void Panels::showPort(const std::string& port) {
    port_ = port;
    sendShow();
}

void Panels::sendShow() {
    const TexelLayout layout = this->layout();
    const Shown& shown = shownOf_[port_];
    const bool color = shown.look.look == LOOK_COLOR && layout.channels >= 3;
    send([port = port_, layout, pick = color ? PICK_LUMINANCE : shown.look.pick, statistics = wantsStatistics_ || shown.automatic](ViewSession& s) {
        s.show(port, layout, pick, statistics);
    });
}

void Panels::moveCamera(const std::optional<CameraKey>& camera) {
    viewport_.setCamera(camera);
    if (camera) send([key = *camera](ViewSession& s) { s.setCamera(key); });
    else send([](ViewSession& s) { s.resetCamera(); });
}

/// Takes over what a new session has.
void Panels::follow(const ViewStatus& status) {
    if (status.graph == graph_ || !status.graph) return;
    if (graph_ && graph_->scene != status.graph->scene) viewport_.setCamera({});  // that was a place in another scene
    graph_ = status.graph;
    window_.setTitle(graph_->file.filename().string());
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
        drawComparison(status);
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

    drawScene(status);
    const Rectangle area = pictureArea({std::uint32_t(window.x), std::uint32_t(window.y)});
    if (graph_) followTime(area);
    graphPanel_.draw(status, port_, area);
    if (!graphPanel_.isOpen()) pixelPanel_.draw(status, viewport_, viewport_.camera().value_or(status.camera.key), area);
    comparisonPanel_.draw(status, area);
    drawProblems(status);
    drawHelp();

    const Shown& shown = shownOf_[port_];
    look_ = shown.look;
    if (shown.automatic && status.statistics) {
        look_.low = look_.look == LOOK_SIGNED ? 0 : status.statistics->low;
        look_.high = look_.look == LOOK_SIGNED ? std::max(status.statistics->largest, 1e-20f) : std::max(status.statistics->high, look_.low + 1e-20f);
    }
    comparison_.follow(status, layout(), look_);
}

void Panels::keys(const ViewStatus& status) {
    for (const Path& file : window_.takeDrops()) send([file](ViewSession& s) { s.open(file); });
    const std::vector<Window::Key> down = window_.takeKeys();
    if (ImGui::GetIO().WantTextInput) return;
    const auto pressed = [&](int key, bool control = false, bool shift = false) {
        return std::ranges::any_of(down, [&](const Window::Key& k) { return k.key == key && k.control == control && (!control || k.shift == shift); });
    };
    if (pressed(GLFW_KEY_Z, true)) send([](ViewSession& s) { s.undo(); });
    if (pressed(GLFW_KEY_Z, true, true) || pressed(GLFW_KEY_Y, true)) send([](ViewSession& s) { s.redo(); });
    if (pressed(GLFW_KEY_G)) graphPanel_.toggle();
    if (pressed(GLFW_KEY_P)) pixelPanel_.ask(viewport_);
    if (pressed(GLFW_KEY_O)) scenePanel_.toggle();
    if (pressed(GLFW_KEY_SPACE)) send([paused = !paused_](ViewSession& s) { s.pause(paused); });
    if (pressed(GLFW_KEY_N)) send([](ViewSession& s) { s.step(); });
    if (pressed(GLFW_KEY_R)) send([](ViewSession& s) { s.resetHistory(); });
    if (pressed(GLFW_KEY_C)) moveCamera({});
    if (pressed(GLFW_KEY_F) && graph_)
        moveCamera(framed(viewport_.camera().value_or(status.camera.key), graph_->bounds, float(graph_->size.x) / float(graph_->size.y)));
    if (pressed(GLFW_KEY_A)) keepA(status);
    if (pressed(GLFW_KEY_L)) runA(status);
    if (pressed(GLFW_KEY_E)) comparisonPanel_.toggle();
    if (pressed(GLFW_KEY_B)) comparison_.turn();
    if (pressed(GLFW_KEY_0)) graphPanel_.isOpen() ? graphPanel_.fit() : viewport_.fit();
    if (pressed(GLFW_KEY_1)) viewport_.zoomTo(1);
    if (pressed(GLFW_KEY_2)) viewport_.zoomTo(2);
    if (pressed(GLFW_KEY_4)) viewport_.zoomTo(4);
    if (pressed(GLFW_KEY_8)) viewport_.zoomTo(8);
    if (pressed(GLFW_KEY_S, true)) send([](ViewSession& s) { s.saveIntoGraph(); });
    if (pressed(GLFW_KEY_S)) send([out = out_](ViewSession& s) { s.save(out); });
    if (pressed(GLFW_KEY_T)) send([out = out_](ViewSession& s) { s.saveTimes(out); });
    if (pressed(GLFW_KEY_H) || pressed(GLFW_KEY_F1)) help_ = !help_;
    if (pressed(GLFW_KEY_ESCAPE)) {
        help_ = false;
        pixelPanel_.close();
        if (!status.refused.empty()) send([](ViewSession& s) { s.dismiss(); });
    }
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
    constexpr float space = 4;
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {space, ImGui::GetStyle().ItemSpacing.y});
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {2, ImGui::GetStyle().FramePadding.y});
    const float width = (ImGui::GetContentRegionAvail().x - 5 * space) / 6;
    if (button("pause", paused_ ? "Resume" : "Pause", "Space", width)) send([paused = !paused_](ViewSession& s) { s.pause(paused); });
    ImGui::SameLine();
    if (button("step", "Step", "one frame while paused: N", width)) send([](ViewSession& s) { s.step(); });
    ImGui::SameLine();
    if (button("reset history", "Restart", "history and accumulation start again: R", width)) send([](ViewSession& s) { s.resetHistory(); });
    ImGui::SameLine();
    if (button("graph panel", "Graph", "passes and edges, to be edited: G", width)) graphPanel_.toggle();
    ImGui::SameLine();
    if (button("scene panel", "Scene", "instances and levels, materials, lights, cameras: O", width)) scenePanel_.toggle();
    ImGui::SameLine();
    if (button("help", "Help", "keys and mouse: H", width)) help_ = !help_;
    ImGui::PopStyleVar(2);
    if (!status.busy.empty() && !graph_) quietText(status.busy + " ...");
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
    if (key.height > 0) {
        moved = ImGui::DragFloat("##height", &key.height, 0.005f * key.height, 1e-6f, 1e12f, "%.4g high", ImGuiSliderFlags_AlwaysClamp);
        mark("orthographic");
        tip("height of what is seen, scene units: the camera is orthographic");
    } else {
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
        moved = ImGui::DragFloat("##focus", &key.focus, 0.005f * key.focus, 1e-6f, 1e12f, "focus %.3f", ImGuiSliderFlags_AlwaysClamp) || moved;
        mark("focus");
        tip("distance of what is sharp, scene units");
    }
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

void Panels::drawOutput(const ViewStatus& status) {
    heading("OUTPUT");
    const float third = (ImGui::GetContentRegionAvail().x - 2 * ImGui::GetStyle().ItemSpacing.x) / 3;
    if (button("save", "Save image", "EXR and PNG of what is shown, with the graph in the header: S", third))
        send([out = out_](ViewSession& s) { s.save(out); });
    ImGui::SameLine();
    if (button("save graph", "Save graph", "the graph with all that is set now, for `lodestir run`", third))
        send([file = out_ / (graph_->file.stem().string() + ".json")](ViewSession& s) { s.saveGraph(file); });
    ImGui::SameLine();
    if (button("save into graph", "Into the file",
               "what is changed by hand, into the graph's own file (the variant's patch where one is chosen), whose other lines stay as they are: Ctrl + S",
               third))
        send([](ViewSession& s) { s.saveIntoGraph(); });
    if (button("save times", "Save times", "of the last frames, pass by pass: times.csv, and trace.json for Perfetto: T", third))
        send([out = out_](ViewSession& s) { s.saveTimes(out); });
    ImGui::SameLine();
    ImGui::SetNextItemWidth(third);
    drawSize();
    ImGui::SameLine();
    ImGui::SetNextItemWidth(third);
    ImGui::PushStyleColor(ImGuiCol_Text, frameTime_ > 0 ? palette().accent : ImGui::GetStyleColorVec4(ImGuiCol_Text));
    ImGui::DragFloat("##frame time", &frameTime_, std::max(0.1f, 0.01f * frameTime_), 0, 1e5f, frameTime_ > 0 ? "%.3g ms" : "any time",
                     ImGuiSliderFlags_AlwaysClamp);
    ImGui::PopStyleColor();
    mark("frame time");
    tip("that a frame is to take: the size follows it, and the picture is scaled up to the window; 0: the size stays");
    quietText(status.note);
    tip(status.note);
}

/// One that is chosen stays.
void Panels::drawSize() {
    static constexpr glm::uvec2 sizes[] = {{240, 135}, {320, 180}, {480, 270}, {640, 360}, {960, 540}, {1280, 720}, {1920, 1080}};
    if (ImGui::BeginCombo("##size", fmt::format("{}x{}", graph_->size.x, graph_->size.y).c_str())) {
        for (const glm::uvec2 size : sizes) {
            const std::string text = fmt::format("{}x{}", size.x, size.y);
            if (ImGui::Selectable(text.c_str(), size == graph_->size)) {
                frameTime_ = followed_.first = 0;
                send([size](ViewSession& s) {
                    s.followTime(0, size);
                    s.resize(size);
                });
            }
            mark("size: " + text);
        }
        ImGui::EndCombo();
    }
    mark("size");
    tip("size of the frame");
}

/// Tells the renderer when another time is wanted, or the window has another size.
void Panels::followTime(const Rectangle& area) {
    viewport_.fill(frameTime_ > 0);
    const float density = ImGui::GetIO().DisplayFramebufferScale.x;
    const std::pair wanted(frameTime_, frameTime_ > 0 ? area.inPixels(density).size : followed_.second);
    if (wanted == followed_) return;
    followed_ = wanted;
    send([wanted](ViewSession& s) { s.followTime(wanted.first, glm::uvec2(wanted.second)); });
}

}  // namespace lodestir
