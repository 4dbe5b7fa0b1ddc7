// SPDX-License-Identifier: MIT
#include <framework/app/view/self_report.h>

#include <framework/app/view/orbit_camera.h>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace lodestir {

void SelfReport::answered(std::chrono::steady_clock::time_point since) {
    latencies_.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - since).count());
}

void SelfReport::write(const ViewStatus& status, const Panels& panels, const Viewport& viewport, const Rectangle& area) {
    using OrderedJson = nlohmann::ordered_json;
    ++drawn_;
    if (!wanted()) return;
    std::vector<double> sorted = latencies_;
    std::ranges::sort(sorted);
    const auto at = [&](double share) { return sorted.empty() ? 0.0 : sorted[std::size_t(share * double(sorted.size() - 1))]; };
    OrderedJson json = {{"drawn", drawn_},
                        {"frames", status.framesDone},
                        {"framesStill", status.framesStill},
                        {"nextFrame", status.nextFrame},
                        {"builds", status.builds},
                        {"reloads", status.reloads},
                        {"paused", status.paused},
                        {"busy", status.busy},
                        {"problems", status.problems},
                        {"note", status.note},
                        {"refused", status.refused},
                        {"undo", status.undo},
                        {"redo", status.redo},
                        {"types", status.graph ? status.graph->edits.types.size() : 0},
                        {"ms", status.deviceMilliseconds},
                        {"frameMs", status.wallMilliseconds},
                        {"input", {{"count", sorted.size()}, {"median", at(0.5)}, {"p95", at(0.95)}, {"largest", at(1)}}},
                        {"camera", {{"own", status.camera.own}, {"key", cameraJson(status.camera.key).plain()}}},
                        {"shown", status.picture.port},
                        {"pixel", {viewport.pixelUnderPointer().x, viewport.pixelUnderPointer().y}},
                        {"zoom", viewport.zoom()},
                        {"area", {area.corner.x, area.corner.y, area.size.x, area.size.y}},
                        {"comparison",
                         {{"keeps", panels.comparison().keeps()}, {"side", int(panels.comparison().side())}, {"split", panels.comparison().split()}}},
                        {"widgets", panels.widgets()}};
    if (const SceneState* scene = status.sceneState.get())
        json["scene"] = {{"levels", scene->levels}, {"triangles", scene->triangles}, {"pixels", scene->pixels},
                         {"picked", scene->picked ? int(scene->picked->instance) : -1}};
    if (status.statistics) json["mean"] = status.statistics->mean;
    for (const PassTime& pass : status.passes) json["runs"][pass.name] = pass.runs;
    for (const auto& [name, value] : panels.values())
        std::visit([&, key = name](const auto& v) { json["parameters"][key] = v; }, value);
    writeFile(file_, json.dump(1) + "\n");
}

}  // namespace lodestir
