// SPDX-License-Identifier: MIT
// Any JSON as a scene file. Every model that a shipped scene names is there, as a triangle.
#include "input_file.h"
#include "json_mutator.h"

#include <framework/core/json.h>
#include <framework/scene/scene_file.h>

LODESTIR_MUTATE_JSON

namespace {

void placeModels(const lodestir::fuzz::Folder& folder) {
    const lodestir::Path source = LODESTIR_SOURCE_DIR;
    const std::string triangle = lodestir::readText(source / "tests/errors/scenes/triangle.gltf");
    for (const auto& entry : std::filesystem::directory_iterator(source / "scenes")) {
        if (entry.path().extension() != ".json") continue;
        const lodestir::Json scene = lodestir::Json::load(entry.path());
        for (const auto& [name, model] : scene.find("models")->members())
            folder.write(model.find("file")->asString(), {reinterpret_cast<const std::uint8_t*>(triangle.data()), triangle.size()});
    }
    std::filesystem::copy(source / "tests/errors/scenes/triangle.gltf", folder.path());
    std::filesystem::copy(source / "tests/errors/scenes/broken.gltf", folder.path());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const lodestir::fuzz::Folder folder;
    static const bool isSetUp = (placeModels(folder), true);
    const lodestir::Path file = folder.write(isSetUp ? "input.json" : "", {data, size});
    lodestir::fuzz::expectErrorOrResult([&] {
        // Scenes without a light get a sky, which takes a while to make: one in sixteen is enough.
        lodestir::SceneFileSays says;
        const lodestir::Scene scene = size % 16 == 0 ? lodestir::loadScene(file) : lodestir::loadSceneFile(file, says);
        for (const float frame : {0.0f, 1.5f, 1e9f}) {
            scene.nodeMatrices(frame);
            if (!scene.camera.keys.empty()) scene.cameraAt(frame);
        }
        scene.bounds();
    });
    return 0;
}
