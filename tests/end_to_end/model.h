// SPDX-License-Identifier: MIT
// Small models for tests: flat polygons with plain materials, written as glTF, and scene and graph files around them.
#pragma once
#include <framework/core/files.h>

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace lodestir::test {

using Point = glm::dvec3;
using OrderedJson = nlohmann::ordered_json;

struct Paint {
    Point color{0.5};
    Point emission{0};
    double metallic = 0, roughness = 1;
    double ior = 1;  ///< 1: no reflecting layer over the diffuse base
    double transmission = 0;
    bool solid = false;
    std::optional<double> alpha;  ///< of a material that blends
    OrderedJson layers = OrderedJson::object();  ///< further extensions of the material
};

/// A parallelogram; the front is the side that cross(a, b) points to.
struct Quad {
    Point corner, a, b;
    Paint paint;

    Point normal() const { return glm::normalize(glm::cross(a, b)); }
};

/// The six sides of an axis-aligned box, fronts outward, or inward for a room. Order: -x, +x, -y, +y, -z, +z.
inline std::vector<Quad> box(const Point& low, const Point& high, const Paint& paint, bool inward = false) {
    std::vector<Quad> quads;
    const Point size = high - low;
    for (int axis = 0; axis < 3; ++axis) {
        for (int side = 0; side < 2; ++side) {
            Point a(0), b(0), corner = low;
            a[(axis + 1) % 3] = size[(axis + 1) % 3];
            b[(axis + 2) % 3] = size[(axis + 2) % 3];
            if (side == 1) corner[axis] = high[axis];
            if ((side == 1) == inward) std::swap(a, b);
            quads.push_back({corner, a, b, paint});
        }
    }
    return quads;
}

inline OrderedJson toJson(const Point& p) { return OrderedJson::array({p.x, p.y, p.z}); }

/// Writes name.gltf and name.bin: one primitive and one material a quad, without normals (so they are flat).
inline void writeModel(const Path& folder, const std::string& name, const std::vector<Quad>& quads) {
    std::vector<float> numbers;
    OrderedJson gltf = {
        {"asset", {{"version", "2.0"}}},
        {"extensionsUsed", {"KHR_materials_emissive_strength", "KHR_materials_ior", "KHR_materials_transmission", "KHR_materials_volume"}},
        {"scene", 0},
        {"scenes", OrderedJson::array({OrderedJson{{"nodes", OrderedJson::array({0})}}})},
        {"nodes", OrderedJson::array({OrderedJson{{"mesh", 0}, {"name", name}}})},
        {"meshes", OrderedJson::array({OrderedJson{{"primitives", OrderedJson::array()}}})},
        {"materials", OrderedJson::array()},
        {"accessors", OrderedJson::array()},
        {"bufferViews", OrderedJson::array()}};
    for (std::size_t i = 0; i < quads.size(); ++i) {
        const Quad& q = quads[i];
        const std::array<Point, 6> corners{q.corner, q.corner + q.a, q.corner + q.a + q.b, q.corner, q.corner + q.a + q.b, q.corner + q.b};
        glm::vec3 low(std::numeric_limits<float>::max()), high(-std::numeric_limits<float>::max());
        for (const Point& p : corners) {
            const glm::vec3 v(p);
            numbers.insert(numbers.end(), {v.x, v.y, v.z});
            low = glm::min(low, v);
            high = glm::max(high, v);
        }
        gltf["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", i * 72}, {"byteLength", 72}});
        gltf["accessors"].push_back({{"bufferView", i},
                                     {"componentType", 5126},
                                     {"count", 6},
                                     {"type", "VEC3"},
                                     {"min", toJson(Point(low))},
                                     {"max", toJson(Point(high))}});
        gltf["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", i}}}, {"material", i}});

        const Paint& paint = q.paint;
        const double strength = std::max({paint.emission.x, paint.emission.y, paint.emission.z, 1e-9});
        OrderedJson material = {{"pbrMetallicRoughness",
                                 {{"baseColorFactor", {paint.color.x, paint.color.y, paint.color.z, paint.alpha.value_or(1)}},
                                  {"metallicFactor", paint.metallic},
                                  {"roughnessFactor", paint.roughness}}},
                                {"extensions", {{"KHR_materials_ior", {{"ior", paint.ior}}}}}};
        if (paint.emission != Point(0)) {
            material["emissiveFactor"] = toJson(paint.emission / strength);
            material["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", strength}};
        }
        if (paint.alpha) material["alphaMode"] = "BLEND";
        if (paint.transmission > 0) material["extensions"]["KHR_materials_transmission"] = {{"transmissionFactor", paint.transmission}};
        if (paint.solid) material["extensions"]["KHR_materials_volume"] = {{"thicknessFactor", 1.0}};
        material["extensions"].update(paint.layers);
        gltf["materials"].push_back(material);
    }
    gltf["buffers"] = OrderedJson::array({OrderedJson{{"uri", name + ".bin"}, {"byteLength", numbers.size() * sizeof(float)}}});
    writeFile(folder / (name + ".gltf"), gltf.dump());
    writeFile(folder / (name + ".bin"), std::as_bytes(std::span(numbers)));
}

struct View {
    Point position{0, 0, 5}, target{0}, up{0, 1, 0};
    double fovy = 40;  ///< degrees, vertical
};

/// A scene file of one model. `environment` and `lights` are as in scene files.
inline void writeScene(const Path& folder, const std::string& name, const View& view, const OrderedJson& environment,
                       const OrderedJson& lights = OrderedJson::array()) {
    const OrderedJson scene = {
        {"format", 1},
        {"models", {{name, {{"file", name + ".gltf"}}}}},
        {"environment", environment},
        {"lights", lights},
        {"camera", {{"position", toJson(view.position)}, {"target", toJson(view.target)}, {"up", toJson(view.up)}, {"fovy", view.fovy}}}};
    writeFile(folder / (name + ".json"), scene.dump(2));
}

inline OrderedJson constantEnvironment(const Point& radiance) {
    return {{"type", "constant"}, {"color", toJson(radiance)}, {"strength", 1.0}};
}

/// A graph of one path tracer, "trace", over scene file name.json.
inline Path writeGraph(const Path& folder, const std::string& name, int width, int height, const OrderedJson& parameters) {
    const OrderedJson graph = {{"format", 1},
                               {"scene", name + ".json"},
                               {"frame", {{"size", {width, height}}, {"count", 1}, {"seed", 1}}},
                               {"passes", {{"trace", {{"type", "path_tracer"}, {"set", parameters}}}}},
                               {"show", "trace"}};
    writeFile(folder / (name + ".graph.json"), graph.dump(2));
    return folder / (name + ".graph.json");
}

}  // namespace lodestir::test
