// SPDX-License-Identifier: MIT
// Scenes of sheets with levels, written by the tests themselves.
#pragma once
#include "frames.h"
#include "level_model.h"

namespace lodestir::test {

/// Models written by the tests themselves.
class Sheets : public testing::Test {
protected:
    /// A scene of models in the folder, seen from above; `schedule` as in scene files.
    Path write(const std::string& name, const std::vector<std::string>& models, const OrderedJson& schedule, const OrderedJson& extra = OrderedJson::object()) {
        OrderedJson scene = {{"format", 1},
                             {"models", OrderedJson::object()},
                             {"environment", {{"type", "constant"}, {"color", {0.8, 0.9, 1.0}}, {"strength", 1}}},
                             {"lights", OrderedJson::array({OrderedJson{{"type", "directional"}, {"direction", {0.5, -1, -0.4}}, {"intensity", 2}}})},
                             {"camera", {{"position", {0.4, 2.6, 2.6}}, {"target", {0, 0.1, 0}}, {"fovy", 44}}},
                             {"lod", {{"mode", "schedule"}, {"schedule", schedule}}}};
        for (const std::string& model : models) scene["models"][model] = {{"file", model + ".gltf"}};
        scene.update(extra);
        writeFile(folder.path / (name + ".json"), scene.dump(2));
        return folder.path / (name + ".json");
    }
    /// The same of one new model.
    Path write(const std::string& name, const std::vector<SheetLevel>& levels, const OrderedJson& schedule, const LevelModelLook& look = {}) {
        writeLevels(folder.path, name, levels, look);
        return write(name, {name}, schedule);
    }
    static OrderedJson switchAt(int frame, int level = 1) { return OrderedJson::array({OrderedJson{{"frame", frame}, {"level", level}}}); }

    TemporaryFolder folder;
};

/// Every third row of cells has one coordinate for all of a cell.
inline std::optional<glm::dvec2> pinched(const SheetPoint& p) {
    return int(p.cell.y * 9) % 3 == 1 ? p.cell : p.at;
}

}  // namespace lodestir::test
