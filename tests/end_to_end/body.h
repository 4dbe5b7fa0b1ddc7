// SPDX-License-Identifier: MIT
// Meshes whose every point is known, written as glTF: what impostors are made of in tests.
#pragma once
#include "../cpu/gltf_model.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

namespace lodestir::test {

struct Corner {
    glm::dvec3 position, normal;
    glm::dvec2 uv;
};

/// A mesh with a primitive for each material.
class Body {
public:
    explicit Body(std::size_t materials) : parts_(materials), materials_(materials) {}

    void triangle(std::size_t material, const Corner& a, const Corner& b, const Corner& c) {
        for (const Corner* k : {&a, &b, &c}) {
            Part& part = parts_[material];
            for (int i = 0; i < 3; ++i) part.positions.push_back(float(k->position[i]));
            for (int i = 0; i < 3; ++i) part.normals.push_back(float(k->normal[i]));
            for (int i = 0; i < 2; ++i) part.uvs.push_back(float(k->uv[i]));
        }
    }
    void quad(std::size_t material, const Corner& a, const Corner& b, const Corner& c, const Corner& d) {
        triangle(material, a, b, c);
        triangle(material, a, c, d);
    }
    /// A sheet over [0,1]^2.
    void sheet(glm::ivec2 cells, const std::function<Corner(glm::dvec2)>& at) {
        for (int y = 0; y < cells.y; ++y) {
            for (int x = 0; x < cells.x; ++x) {
                const auto corner = [&](int i, int j) { return at(glm::dvec2(x + i, y + j) / glm::dvec2(cells)); };
                const Corner a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
                if (glm::distance(a.position, b.position) > 1e-9) triangle(0, a, b, c);
                if (glm::distance(c.position, d.position) > 1e-9) triangle(0, a, c, d);
            }
        }
    }
    void sphere(double radius) {
        sheet({192, 96}, [&](glm::dvec2 p) {
            const double turn = 2 * std::numbers::pi * p.x, rise = std::numbers::pi * (p.y - 0.5);
            const glm::dvec3 n(std::cos(rise) * std::sin(turn), std::sin(rise), std::cos(rise) * std::cos(turn));
            return Corner{radius * n, n, p};
        });
    }
    /// Around an axis, unit.
    void torus(double ring, double tube, const glm::dvec3& axis, const glm::dvec3& center = glm::dvec3(0)) {
        const glm::dvec3 side = glm::normalize(glm::cross(axis, std::abs(axis.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
        sheet({48, 24}, [&](glm::dvec2 p) {
            const double turn = 2 * std::numbers::pi * p.x, around = 2 * std::numbers::pi * p.y;
            const glm::dvec3 out = std::cos(turn) * side + std::sin(turn) * glm::cross(side, axis), n = std::cos(around) * out + std::sin(around) * axis;
            return Corner{center + ring * out + tube * n, n, p};
        });
    }
    nlohmann::json& material(std::size_t i) { return model.json["materials"][i]; }

    /// `placements`: translations of nodes that show the mesh.
    Path write(const Path& folder, const std::string& name, const std::vector<glm::vec3>& placements = {glm::vec3(0)}) {
        nlohmann::json primitives = nlohmann::json::array();
        for (std::size_t i = 0; i < materials_; ++i) {
            model.json["materials"][i]["name"] = "material " + std::to_string(i);
            const Part& p = parts_[i];
            if (p.positions.empty()) continue;
            primitives.push_back({{"attributes",
                                   {{"POSITION", model.positions(p.positions)},
                                    {"NORMAL", model.accessor(p.normals, 5126, "VEC3", 3)},
                                    {"TEXCOORD_0", model.accessor(p.uvs, 5126, "VEC2", 2)}}},
                                  {"material", i}});
        }
        model.json["meshes"] = {{{"name", name}, {"primitives", primitives}}};
        for (std::size_t i = 0; i < placements.size(); ++i) {
            model.json["nodes"].push_back({{"mesh", 0}, {"translation", {placements[i].x, placements[i].y, placements[i].z}}});
            model.json["scenes"][0]["nodes"].push_back(i);
        }
        return model.write(folder / (name + ".gltf"));
    }

    GltfModel model;

private:
    struct Part {
        std::vector<float> positions, normals, uvs;
    };
    std::vector<Part> parts_;
    std::size_t materials_;
};

/// Squares in the plane z, each with a material.
inline void addSquare(Body& body, std::size_t material, const glm::dvec2& low, const glm::dvec2& high, double z) {
    const auto corner = [&](double x, double y) { return Corner{{x, y, z}, {0, 0, 1}, {x, y}}; };
    body.quad(material, corner(low.x, low.y), corner(high.x, low.y), corner(high.x, high.y), corner(low.x, high.y));
}

}  // namespace lodestir::test
