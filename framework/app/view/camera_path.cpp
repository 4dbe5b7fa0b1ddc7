// SPDX-License-Identifier: MIT
#include <framework/app/view/camera_path.h>

#include <framework/core/is_file.h>
#include <framework/scene/fields.h>
#include <framework/scene/scene_sections.h>

#include <algorithm>
#include <filesystem>

namespace lodestir {
namespace {

/// A file that stands beside `scene`, named from `folder`; one that is found elsewhere keeps its name.
void moveName(Json* file, const Path& scene, const Path& folder) {
    if (!file || !file->isString()) return;
    const Path path = namedPath(scene.parent_path(), file->asString());
    if (isFile(path)) *file = Json(std::filesystem::proximate(std::filesystem::absolute(path), std::filesystem::absolute(folder)).generic_string());
}

}  // namespace

Json viewsJson(const std::vector<SavedView>& views) {
    Json json;
    json["format"] = 1;
    Json& all = json["views"] = Json::array();
    for (const SavedView& view : views) {
        Json one;
        one["name"] = view.name;
        one["camera"] = cameraJson(view.camera);
        all.push(std::move(one));
    }
    return json;
}

std::vector<SavedView> readViews(const Json& json) {
    Problems problems;
    std::vector<SavedView> views;
    Fields fields(json, "the views", problems);
    int format = 1;
    if (fields.require("format")) fields.integer("format", format, 1, 1);
    const Json* all = fields.require("views");
    fields.finish();
    for (std::size_t i = 0; all && i < all->items("\"views\"").size(); ++i) {
        Fields view(all->items()[i], "view " + std::to_string(i), problems);
        Scene scene;
        std::string name;
        view.text("name", name);
        if (const Json* camera = view.require("camera")) readCamera(*camera, scene, problems);
        view.finish();
        if (problems.empty()) views.push_back({name, scene.camera.keys.front()});
    }
    problems.raise();
    return views;
}

std::vector<CameraKey> withKey(std::vector<CameraKey> keys, const CameraKey& key) {
    const auto at = std::ranges::lower_bound(keys, key.frame, {}, &CameraKey::frame);
    if (at != keys.end() && at->frame == key.frame)
        *at = key;
    else
        keys.insert(at, key);
    return keys;
}

Json sceneWithPath(const Path& scene, const std::vector<CameraKey>& keys, const Path& folder) {
    Json json;
    if (scene.extension() == ".json") {
        json = Json::load(scene);
        json.remove("$schema");
        const Json models = json["models"];
        for (const auto& [name, model] : models.members()) moveName(&json["models"][name]["file"], scene, folder);
        if (json.find("environment") && json["environment"].find("file")) moveName(&json["environment"]["file"], scene, folder);
    } else {
        json["format"] = 1;
        Json& file = json["models"][scene.stem().string()]["file"] = scene.filename().string();
        moveName(&file, scene, folder);
    }
    Json& frames = (json["camera"] = Json::object())["keyframes"] = Json::array();
    for (const CameraKey& key : keys) {
        Json one;
        one["frame"] = double(key.frame);
        one.merge(cameraJson(key));
        frames.push(std::move(one));
    }
    return json;
}

}  // namespace lodestir
