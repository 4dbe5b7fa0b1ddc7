// SPDX-License-Identifier: MIT
// Loads a scene and gives it what every scene needs: a camera, a light, a material.
#include <framework/core/error.h>
#include <framework/scene/camera.h>
#include <framework/scene/gltf.h>
#include <framework/scene/scene_file.h>
#include <framework/scene/sky.h>

#include <fmt/format.h>

#include <algorithm>

namespace lodestir {
namespace {

/// Is there anything made to light the rest? A texture that glows with no more than 1 is a display or a pilot lamp: it shows in the dark, but a
/// model that has no other light was meant for a viewer that brings its own.
bool hasLight(const Scene& scene) {
    if (!scene.lights.empty()) return true;
    return std::any_of(scene.materials.begin(), scene.materials.end(), [](const Material& m) {
        const float emission = std::max({m.emission.r, m.emission.g, m.emission.b});
        return m.emissiveMap.texture == none ? emission > 0 : emission > 1;
    });
}

void addSky(Scene& scene, bool hasExposure) {
    // A white surface in this sun and sky has a radiance near 5; two stops down it is near 1.
    constexpr float exposure = -2;
    scene.environment = makeSky({});
    if (!hasExposure) scene.exposure = exposure;
    scene.notes.push_back(fmt::format("there is no light, so a clear sky with the sun is added; exposure {} stops", scene.exposure));
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

}  // namespace

std::array<glm::vec3, 2> Scene::bounds() const {
    std::array<glm::vec3, 2> result{glm::vec3(1e30f), glm::vec3(-1e30f)};
    const std::vector<glm::mat4> matrices = nodeMatrices(0);
    for (const Instance& instance : instances) {
        for (const glm::vec3& position : meshes[instance.mesh].levels[0].positions) {
            const glm::vec3 p(matrices[instance.node] * glm::vec4(position, 1));
            result[0] = glm::min(result[0], p);
            result[1] = glm::max(result[1], p);
        }
    }
    return result;
}

Scene loadScene(const Path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (!std::filesystem::exists(path)) throw Error({path.string()}, "there is no such file");
    Scene scene;
    SceneFileSays says;
    if (extension == ".json") {
        scene = loadSceneFile(path, says);
    } else if (extension == ".gltf" || extension == ".glb") {
        scene.file = path;
        loadGltf(path, scene, none);
    } else {
        throw Error({path.string()}, "this is no scene", "scenes are .json files, or models as .gltf or .glb");
    }
    if (scene.instances.empty()) scene.notes.push_back("there are no triangles to be seen");
    if (scene.materials.empty()) scene.materials.push_back({.name = "default"});
    if (!says.environment && !hasLight(scene)) addSky(scene, says.exposure);
    if (scene.camera.keys.empty())
        addCamera(scene);
    else if (scene.camera.node != none)
        focusModelCamera(scene);
    return scene;
}

}  // namespace lodestir
