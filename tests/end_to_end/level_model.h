// SPDX-License-Identifier: MIT
// Small models of several levels for tests: sheets of square cells, each level with cells, places and texture coordinates of its own.
#pragma once
#include "../cpu/gltf_model.h"

#include <glm/glm.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace lodestir::test {

/// A place on the sheet, [0,1]^2, and the middle of the cell that is being made: what parts charts is told by the cell.
struct SheetPoint {
    glm::dvec2 at, cell;
};

struct SheetLevel {
    int cells = 8;  ///< a side
    std::function<glm::dvec3(glm::dvec2)> place;
    std::function<std::optional<glm::dvec2>(const SheetPoint&)> uv = [](const SheetPoint& p) { return p.at; };  ///< none: no texture coordinates at all
    std::function<bool(glm::dvec2)> has = [](glm::dvec2) { return true; };  ///< is there a cell with this middle?
    bool otherDiagonal = false;
    std::optional<glm::dvec3> normal = {};  ///< of all vertices; none: flat triangles
};

/// A bowl with waves, from -1 to 1 in x and z.
inline glm::dvec3 bowl(glm::dvec2 p) {
    const glm::dvec2 q = 2.0 * p - 1.0;
    return {q.x, 0.35 * glm::dot(q, q) + 0.12 * std::sin(5 * p.x + 1) * std::cos(7 * p.y), q.y};
}
/// The same square, flat.
inline glm::dvec3 flat(glm::dvec2 p) { return {2 * p.x - 1, 0, 2 * p.y - 1}; }

struct LevelModelLook {
    glm::dvec3 emission{0};
    bool unlit = false;
    std::optional<glm::dvec3> moveTo = {};  ///< over one second, turning about +Y by 40 degrees meanwhile
    std::function<glm::dvec3(glm::dvec2)> shift = {};  ///< what a morph target adds over one second; none: the mesh doesn't deform
};

/// Writes a model of one node, `name`, whose mesh has these levels.
inline Path writeLevels(const Path& folder, const std::string& name, const std::vector<SheetLevel>& levels, const LevelModelLook& look = {}) {
    GltfModel model;
    const double strength = std::max({look.emission.x, look.emission.y, look.emission.z, 1e-9});
    const glm::dvec3 hue = look.emission / strength;
    model.json["extensionsUsed"] = {"MSFT_lod", "KHR_materials_emissive_strength"};
    model.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {0.7, 0.6, 0.5, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 0.8}}},
                                {"doubleSided", true},
                                {"emissiveFactor", {hue.x, hue.y, hue.z}},
                                {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", strength}}}}}}};
    if (look.unlit) {
        model.json["extensionsUsed"].push_back("KHR_materials_unlit");
        model.json["materials"][0]["extensions"]["KHR_materials_unlit"] = nlohmann::json::object();
    }
    for (std::size_t l = 0; l < levels.size(); ++l) {
        const SheetLevel& level = levels[l];
        std::vector<float> positions, shifts, uvs, normals;
        const auto vertex = [&](int x, int y, glm::dvec2 cell) {
            const glm::dvec2 at(double(x) / level.cells, double(y) / level.cells);
            const glm::vec3 p(level.place(at));
            positions.insert(positions.end(), {p.x, p.y, p.z});
            if (look.shift) {
                const glm::vec3 by(look.shift(at));
                shifts.insert(shifts.end(), {by.x, by.y, by.z});
            }
            if (const auto uv = level.uv({at, cell})) uvs.insert(uvs.end(), {float(uv->x), float(uv->y)});
            if (level.normal) normals.insert(normals.end(), {float(level.normal->x), float(level.normal->y), float(level.normal->z)});
        };
        for (int y = 0; y < level.cells; ++y) {
            for (int x = 0; x < level.cells; ++x) {
                const glm::dvec2 cell = (glm::dvec2(x, y) + 0.5) / double(level.cells);
                if (!level.has(cell)) continue;
                const int corners[2][6][2] = {{{0, 0}, {0, 1}, {1, 1}, {0, 0}, {1, 1}, {1, 0}}, {{0, 0}, {0, 1}, {1, 0}, {0, 1}, {1, 1}, {1, 0}}};
                for (const auto& corner : corners[level.otherDiagonal]) vertex(x + corner[0], y + corner[1], cell);
            }
        }
        nlohmann::json primitive = {{"attributes", {{"POSITION", model.positions(positions)}}}, {"material", 0}};
        if (!uvs.empty()) primitive["attributes"]["TEXCOORD_0"] = model.accessor(uvs, 5126, "VEC2", 2);
        if (!normals.empty()) primitive["attributes"]["NORMAL"] = model.accessor(normals, 5126, "VEC3", 3);
        if (look.shift) primitive["targets"] = {{{"POSITION", model.positions(shifts)}}};
        model.addMesh(primitive);
        if (l > 0) model.json["nodes"][0]["extensions"]["MSFT_lod"]["ids"].push_back(l);
    }
    model.json["nodes"][0]["name"] = name;
    if (look.moveTo) {
        const int times = model.accessor(std::vector<float>{0, 1}, 5126, "SCALAR", 1);
        model.json["accessors"][std::size_t(times)].update({{"min", {0}}, {"max", {1}}});
        const glm::vec3 to(*look.moveTo);
        const float half = glm::radians(20.0f);
        const int places = model.accessor(std::vector<float>{0, 0, 0, to.x, to.y, to.z}, 5126, "VEC3", 3);
        const int turns = model.accessor(std::vector<float>{0, 0, 0, 1, 0, std::sin(half), 0, std::cos(half)}, 5126, "VEC4", 4);
        model.json["animations"] = {{{"samplers", {{{"input", times}, {"output", places}}, {{"input", times}, {"output", turns}}}},
                                     {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}},
                                                   {{"sampler", 1}, {"target", {{"node", 0}, {"path", "rotation"}}}}}}}};
    }
    if (look.shift) {
        const int times = model.accessor(std::vector<float>{0, 1}, 5126, "SCALAR", 1);
        model.json["animations"].push_back({{"samplers", {{{"input", times}, {"output", times}}}},
                                            {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}}});
    }
    return model.write(folder / (name + ".gltf"));
}

}  // namespace lodestir::test
