// SPDX-License-Identifier: MIT
// The scene panel's cameras: time, views that are kept, a path of keys.
#include <framework/app/view/scene_panel.h>

#include <framework/app/view/panel_style.h>
#include <framework/app/view/theme.h>

#include <fmt/format.h>

#include <algorithm>

namespace lodestir {

void ScenePanel::drawCamera(const ViewStatus& status, const CameraKey& camera) {
    drawTime(status);
    drawViews(camera);
    drawPath(camera);
}

void ScenePanel::drawTime(const ViewStatus& status) {
    heading("TIME");
    int frame = status.nextFrame > 0 ? int(status.nextFrame) - 1 : 0;
    const std::string scene = std::ranges::find(graph_->passes, true, &PassInfo::isScene)->name;
    const bool runs = std::get<bool>(host_.value(scene + ".animate"));
    const int last = std::max(graph_->contents.lastFrame, path_.empty() ? 0 : int(path_.back().frame));
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - 150);
    if (runs) {
        if (ImGui::SliderInt("##frame", &frame, 0, last, "frame %d")) send([frame](ViewSession& s) { s.setFrame(std::uint32_t(std::max(frame, 0))); });
    } else {
        int pose = std::get<int>(host_.value(scene + ".pose"));
        if (ImGui::SliderInt("##frame", &pose, 0, last, "pose of frame %d")) host_.set(scene + ".pose", std::max(pose, 0));
    }
    host_.mark("frame");
    tip("the next frame's number, which is the time of camera path, animation and schedule; history goes on");
    ImGui::SameLine();
    bool held = !runs;
    if (ImGui::Checkbox("hold the pose", &held)) {
        if (held) host_.set(scene + ".pose", std::max(frame, 0));
        host_.set(scene + ".animate", !held);
    }
    host_.mark("hold pose");
    tip("frames go on, camera path and animation stand still");
}

void ScenePanel::drawViews(const CameraKey& camera) {
    heading("VIEWS");
    const float width = ImGui::GetContentRegionAvail().x;
    ImGui::SetNextItemWidth(width - 92);
    ImGui::InputTextWithHint("##name", fmt::format("view {}", views_.size() + 1).c_str(), viewName_.data(), viewName_.size());
    host_.mark("view name");
    ImGui::SameLine();
    if (button("store view", "Store", "keeps where the camera is, in " + viewsFile().string(), -1)) {
        views_.push_back({viewName_[0] ? std::string(viewName_.data()) : fmt::format("view {}", views_.size() + 1), camera});
        viewName_ = {};
        keepViews();
    }
    if (!viewsProblem_.empty()) ImGui::TextColored(palette().bad, "%s", viewsProblem_.c_str());
    for (std::size_t i = 0; i < views_.size(); ++i) {
        ImGui::PushID(int(i));
        const std::string name = views_[i].name;
        if (ImGui::Selectable(name.c_str(), camera == views_[i].camera, 0, {width - 30, 0})) host_.moveCamera(views_[i].camera);
        host_.mark("view: " + name);
        tip("go there");
        ImGui::SameLine(width - 14);
        const bool removed = ImGui::SmallButton("x");
        host_.mark("delete view: " + name);
        ImGui::PopID();
        if (!removed) continue;
        views_.erase(views_.begin() + std::ptrdiff_t(i));
        keepViews();
        break;
    }
}

void ScenePanel::drawPath(const CameraKey& camera) {
    heading("PATH");
    const float space = ImGui::GetStyle().ItemSpacing.x, third = (ImGui::GetContentRegionAvail().x - 2 * space) / 3;
    constexpr float apart = 30;  // frames: a second
    if (button("add key", "Add key", "the camera as it is, 30 frames after the last key; frames can be set below", third)) {
        CameraKey key = camera;
        key.frame = path_.empty() ? 0 : path_.back().frame + apart;
        path_ = withKey(std::move(path_), key);
    }
    ImGui::SameLine();
    ImGui::BeginDisabled(path_.empty());
    if (button("play path", "Play", "from its first key on, without history, as a run begins", third)) {
        host_.letGo();
        send([keys = path_](ViewSession& s) { s.playPath(keys); });
    }
    ImGui::SameLine();
    const Path file = out_ / (Path(scene_).stem().string() + ".path.json");
    if (button("save path", "Save scene", "a scene file with this path, for `lodestir run --scene`: " + file.string(), third))
        send([file, keys = path_](ViewSession& s) { s.savePath(file, keys); });
    ImGui::EndDisabled();
    for (std::size_t i = 0; i < path_.size(); ++i) {
        ImGui::PushID(int(i));
        int frame = int(path_[i].frame);
        ImGui::SetNextItemWidth(110);
        ImGui::InputInt("##frame", &frame, 1, 10, ImGuiInputTextFlags_EnterReturnsTrue);
        const bool moved = ImGui::IsItemDeactivatedAfterEdit();
        host_.mark(fmt::format("key {}", i));
        ImGui::SameLine();
        if (ImGui::SmallButton("go")) host_.moveCamera(path_[i]);
        host_.mark(fmt::format("go to key {}", i));
        ImGui::SameLine();
        const bool removed = ImGui::SmallButton("x");
        host_.mark(fmt::format("delete key {}", i));
        ImGui::SameLine();
        quietText(fmt::format("at {:.2f} {:.2f} {:.2f}", path_[i].position.x, path_[i].position.y, path_[i].position.z));
        ImGui::PopID();
        if (!removed && !moved) continue;
        CameraKey key = path_[i];
        path_.erase(path_.begin() + std::ptrdiff_t(i));
        key.frame = float(std::max(frame, 0));
        if (moved) path_ = withKey(std::move(path_), key);
        break;
    }
}

}  // namespace lodestir
