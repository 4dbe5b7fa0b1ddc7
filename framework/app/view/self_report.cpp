// SPDX-License-Identifier: MIT
#include <framework/app/view/self_report.h>

#include <framework/app/view/orbit_camera.h>

#include <nlohmann/json.hpp>

#include <algorithm>

namespace lodestir {

void SelfReport::answered(std::chrono::steady_clock::time_point since) {
    latencies_.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - since).count());
}

void SelfReport::write(const ViewStatus& status, const Panels& panels, const Viewport& viewport, const Rectangle& area, float density) {
    using OrderedJson = nlohmann::ordered_json;
    ++drawn_;
    if (!wanted()) return;
    std::vector<double> sorted = latencies_;
    std::ranges::sort(sorted);
    const auto at = [&](double share) { return sorted.empty() ? 0.0 : sorted[std::size_t(share * double(sorted.size() - 1))]; };
    auto widgets = panels.widgets();
    for (auto& [name, corners] : widgets)
        for (float& corner : corners) corner *= density;
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
                        {"graph", status.graph ? status.graph->file.filename().string() : ""},
                        {"of", status.graph ? status.graph->scene : ""},
                        {"types", status.graph ? status.graph->edits.types.size() : 0},
                        {"ms", status.deviceMilliseconds},
                        {"frameMs", status.wallMilliseconds},
                        {"input", {{"count", sorted.size()}, {"median", at(0.5)}, {"p95", at(0.95)}, {"largest", at(1)}}},
                        {"camera", {{"own", status.camera.own}, {"key", cameraJson(status.camera.key).plain()}}},
                        {"shown", status.picture.port},
                        {"pixel", {viewport.pixelUnderPointer().x, viewport.pixelUnderPointer().y}},
                        {"zoom", viewport.zoom()},
                        {"density", density},
                        {"area", {area.corner.x, area.corner.y, area.size.x, area.size.y}},
                        {"size", {status.picture.extent.x, status.picture.extent.y}},
                        {"comparison",
                         {{"keeps", panels.comparison().has()}, {"side", int(panels.comparison().side())}, {"split", panels.comparison().split()}}},
                        {"widgets", std::move(widgets)}};
    if (status.told)
        json["told"] = {{"pixel", {status.told->pixel.x, status.told->pixel.y}}, {"frame", status.told->frame}, {"first", status.told->first},
                        {"paths", status.told->paths.size()}, {"passes", *status.told->passes}};
    const auto pictured = [](const Picture& picture) {
        return OrderedJson{{"port", picture.port}, {"frame", picture.frame}, {"camera", cameraJson(picture.camera).plain()}};
    };
    json["b"] = pictured(status.picture);
    if (status.a.picture.texels) {
        static constexpr const char* kinds[] = {"nothing", "kept", "image", "live"};
        json["a"] = pictured(status.a.picture);
        json["a"]["kind"] = kinds[int(status.a.kind)];
    }
    if (status.compared) {
        const auto last = [](const std::vector<ErrorPoint>& curve) {
            return curve.empty() ? OrderedJson() : OrderedJson{{"frames", curve.back().frames}, {"mse", curve.back().mse}, {"relmse", curve.back().relmse}};
        };
        const ComparedNumbers& numbers = *status.compared;
        json["errors"] = {{"reference", numbers.reference}, {"points", numbers.b.size()}, {"a", last(numbers.a)}, {"b", last(numbers.b)}};
    }
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
