// SPDX-License-Identifier: MIT
// The scene panel's frame: its tabs, what it keeps of the scene, and the box around what is picked.
#include <framework/app/view/scene_panel.h>

#include <framework/app/view/panel_style.h>
#include <framework/app/view/theme.h>

#include <algorithm>

namespace lodestir {

void ScenePanel::toggle() {
    open_ = !open_;
    send([open = open_](ViewSession& s) { s.watchScene(open); });
}

Path ScenePanel::viewsFile() const { return out_ / (Path(scene_).stem().string() + ".views.json"); }

void ScenePanel::keepViews() {
    viewsProblem_.clear();
    try {
        writeFile(viewsFile(), viewsJson(views_).dump(2) + "\n");
    } catch (const Error& error) {
        viewsProblem_ = error.problems().front().text();
    }
}

/// Takes over what a new session has; another scene has views of its own.
void ScenePanel::follow(const ViewStatus& status) {
    if (status.graph == graph_) return;
    graph_ = status.graph;
    pending_.clear();
    listed_.clear();
    if (std::exchange(wantsColors_, wantsColors_ && graph_->contents.levelColors.empty()) && !wantsColors_) host_.show(graph_->contents.levelColors);
    if (graph_->scene == scene_) return;
    scene_ = graph_->scene;
    views_.clear();
    viewsProblem_.clear();
    path_.clear();
    try {
        if (std::filesystem::exists(viewsFile())) views_ = readViews(Json::load(viewsFile()));
    } catch (const Error& error) {
        viewsProblem_ = error.problems().front().text();
    }
}

bool ScenePanel::button(const std::string& name, const char* label, const std::string& about, float width) {
    const bool pressed = ImGui::Button((std::string(label) + "##" + name).c_str(), {width, 0});
    host_.mark(name);
    tip(about);
    return pressed;
}

void ScenePanel::draw(const ViewStatus& status, const CameraKey& camera, const Rectangle& area) {
    if (!open_ || !status.graph || area.size.x <= 0 || area.size.y <= 0) return;
    follow(status);
    ImGui::SetNextWindowPos({float(area.corner.x), float(area.corner.y)});
    ImGui::SetNextWindowSize({float(area.size.x), float(area.size.y)});
    ImGui::Begin("scene", nullptr, fixedWindow);
    if (ImGui::BeginTabBar("tabs")) {
        const auto tab = [&](const char* label, const auto& content) {
            const bool open = ImGui::BeginTabItem(label);
            host_.mark("tab: " + std::string(label));
            if (!open) return;
            content();
            ImGui::EndTabItem();
        };
        tab("Levels", [&] { drawLevels(status); });
        tab("Materials", [&] { drawMaterials(status); });
        tab("Lights", [&] { drawLights(status); });
        tab("Camera", [&] { drawCamera(status, camera); });
        ImGui::EndTabBar();
    }
    ImGui::End();
}

void ScenePanel::drawOver(const ViewStatus& status, const Rectangle& picture, const glm::mat3& toImage) const {
    if (!open_ || !status.sceneState || status.sceneState->corners.empty() || status.picture.extent.x == 0) return;
    const glm::vec2 extent(status.picture.extent);
    const glm::mat3 toWindow = glm::inverse(toImage);
    std::array<std::optional<ImVec2>, 8> corners;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto place = placeOf(status.picture.camera, status.sceneState->corners[i], extent.x / extent.y);
        if (!place) continue;
        const glm::vec3 there = toWindow * glm::vec3(*place * extent, 1);
        if (there.z > 0) corners[i] = ImVec2(float(picture.corner.x) + there.x / there.z, float(picture.corner.y) + there.y / there.z);
    }
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.PushClipRect({float(picture.corner.x), float(picture.corner.y)}, {float(picture.corner.x + picture.size.x), float(picture.corner.y + picture.size.y)});
    for (std::size_t a = 0; a < corners.size(); ++a)
        for (const std::size_t axis : {1u, 2u, 4u})
            if (const std::size_t b = a | axis; b != a && corners[a] && corners[b])
                list.AddLine(*corners[a], *corners[b], ImGui::GetColorU32(palette().accent), 1.2f);
    list.PopClipRect();
}

}  // namespace lodestir
