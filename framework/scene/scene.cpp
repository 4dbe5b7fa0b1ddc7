// SPDX-License-Identifier: MIT
// Loads a scene and gives it what every scene needs: a camera, a light, a material.
#include <framework/core/error.h>
#include <framework/scene/bvh/box.h>
#include <framework/scene/camera.h>
#include <framework/scene/default_light.h>
#include <framework/scene/deformation.h>
#include <framework/scene/flattening.h>
#include <framework/scene/gltf/gltf.h>
#include <framework/scene/level_policy.h>
#include <framework/scene/panes.h>
#include <framework/scene/scene_file.h>

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <span>

namespace lodestir {
namespace {

void noteLevels(Scene& scene) {
    if (scene.lod.mode != LodMode::finest && scene.lod.mode != LodMode::schedule)
        scene.notes.push_back("levels of detail: " + describe(scene.lod));
    std::set<std::string> said;  // once for all instances of a name
    for (const LodSwitch& s : scene.lod.schedule) {
        if (s.instance == none || scene.lod.mode != LodMode::schedule) continue;
        const std::size_t levels = scene.meshes[scene.instances[s.instance].mesh].levels.size();
        if (std::size_t(s.level) < levels) continue;
        const std::string note = fmt::format("the schedule asks for level {} of \"{}\" at frame {}, which has {}: its coarsest is shown",
                                             s.level, scene.instances[s.instance].name, s.frame, levels);
        if (said.insert(note).second) scene.notes.push_back(note);
    }
}

void addCamera(Scene& scene) {
    const CameraKey key = frameBounds(scene.bounds());
    scene.camera = {.keys = {key}};
    scene.notes.push_back(fmt::format("there is no camera, so the whole is framed from ({:.3g}, {:.3g}, {:.3g})", key.position.x,
                                      key.position.y, key.position.z));
}

/// A camera of the model has no focus distance; the middle of the scene is as good a guess as any.
void focusModelCamera(Scene& scene) {
    const auto bounds = scene.bounds();
    const CameraKey pose = scene.cameraAt(0);
    if (bounds[0].x > bounds[1].x) return;
    const float depth = glm::dot(0.5f * (bounds[0] + bounds[1]) - pose.position, glm::normalize(pose.target - pose.position));
    scene.camera.keys[0].focus = depth > 0 ? depth : std::max(glm::length(bounds[1] - bounds[0]), 1e-6f);
}

/// Light sampling alone finds lights without extent, along straight segments.
void noteUnreachableLight(Scene& scene) {
    if (!scene.lights.empty() && std::ranges::any_of(scene.materials, [](const Material& m) { return m.solid && isClear(m); }))
        scene.notes.push_back("point, spot and directional lights do not shine through clear solids, which refract");
}

}  // namespace

std::array<glm::vec3, 2> Scene::bounds() const {
    const Pose pose = poseAt(*this, 0);
    Box result;
    std::vector<Box> boxes;
    std::vector<std::vector<glm::vec3>> posed(meshes.size());  // of what deforms
    const auto positionsOf = [&](std::size_t m) { return std::span<const glm::vec3>(meshes[m].deforms() ? posed[m] : meshes[m].levels[0].positions); };
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        if (meshes[m].deforms()) posed[m] = deform(*this, m, 0, pose).positions;
        boxes.push_back(boundsOf(positionsOf(m)));
    }
    for (const Instance& instance : instances) {
        const glm::mat4 matrix = instanceMatrix(instance, pose.nodes);
        // Of a thousand trees only those at the edge of the wood count: where the whole box lies inside, so do the vertices.
        const Box around = transformed(boxes[instance.mesh], matrix);
        if (glm::all(glm::lessThanEqual(result.low, around.low)) && glm::all(glm::greaterThanEqual(result.high, around.high))) continue;
        for (const glm::vec3& position : positionsOf(instance.mesh)) result.add(glm::vec3(matrix * glm::vec4(position, 1)));
    }
    return {result.low, result.high};
}

Scene loadScene(const Path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    std::error_code reason;
    if (!std::filesystem::exists(path, reason))
        throw Error(Where{path.string()}, path.empty() ? "the scene has no name" : reason ? reason.message() : "there is no such file");
    Scene scene;
    SceneFileSays says;
    if (extension == ".json") {
        scene = loadSceneFile(path, says);
    } else if (extension == ".gltf" || extension == ".glb") {
        scene.file = path;
        loadGltf(path, scene, none);
    } else {
        throw Error(Where{path.string()}, "this is no scene", "scenes are .json files, or models as .gltf or .glb");
    }
    if (scene.instances.empty()) scene.notes.push_back("there are no triangles to be seen");
    if (scene.materials.empty()) scene.materials.push_back({.name = "default"});
    noteLevels(scene);
    shapeFlatInstances(scene);
    if (scene.camera.keys.empty())
        addCamera(scene);
    else if (scene.camera.node != none)
        focusModelCamera(scene);
    if (!says.environment) addDefaultLight(scene, says.exposure);
    noteUnreachableLight(scene);
    return scene;
}

}  // namespace lodestir
