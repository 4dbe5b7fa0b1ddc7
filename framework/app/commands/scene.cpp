// SPDX-License-Identifier: MIT
// `lodestir scene`: loads a scene without a GPU and tells triangles, levels, materials, lights, memory, camera and notes.
#include <framework/app/commands/commands.h>
#include <framework/app/command_line.h>
#include <framework/core/json.h>
#include <framework/scene/scene.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>

namespace lodestir {
namespace {

struct Options {
    std::string scene, device, rays;
    bool json = false;
};

struct MeshFacts {
    std::string name;
    std::vector<std::size_t> triangles;  ///< of each level
    std::vector<float> errors;
    std::size_t instances = 0, joints = 0, targets = 0;  ///< joints of its skin, morph targets
};

struct Facts {
    std::vector<MeshFacts> meshes;
    std::size_t uniqueTriangles = 0, instancedTriangles = 0, emissiveTriangles = 0;  ///< finest levels
    std::size_t geometryBytes = 0, textureBytes = 0, environmentBytes = 0;
    std::array<std::size_t, 3> lights{};  ///< point, spot, directional
};

template <class T> std::size_t bytesOf(const std::vector<T>& values) { return values.size() * sizeof(T); }

std::size_t bytesOf(const MeshLevel& l) {
    std::size_t targets = 0;
    for (const MorphTarget& t : l.targets) targets += bytesOf(t.positions) + bytesOf(t.normals) + bytesOf(t.tangents);
    return targets + bytesOf(l.joints) + bytesOf(l.positions) + bytesOf(l.normals) + bytesOf(l.tangents) + bytesOf(l.uv0) + bytesOf(l.uv1) + bytesOf(l.colors) +
           bytesOf(l.triangles) + bytesOf(l.materials);
}

Facts gather(const Scene& scene) {
    Facts facts;
    std::vector<std::size_t> emissive;  // triangles of each mesh
    for (const Mesh& mesh : scene.meshes) {
        MeshFacts& m = facts.meshes.emplace_back(MeshFacts{.name = mesh.name});
        m.joints = mesh.skin == none ? 0 : scene.skins[mesh.skin].nodes.size();
        m.targets = mesh.weights.size();
        for (const MeshLevel& level : mesh.levels) {
            m.triangles.push_back(level.triangles.size());
            m.errors.push_back(level.error);
            facts.geometryBytes += bytesOf(level);
        }
        facts.uniqueTriangles += m.triangles[0];
        const auto glows = [&](std::uint32_t material) { return scene.materials[material].isLight(); };
        emissive.push_back(
            static_cast<std::size_t>(std::count_if(mesh.levels[0].materials.begin(), mesh.levels[0].materials.end(), glows)));
    }
    for (const Instance& instance : scene.instances) {
        MeshFacts& m = facts.meshes[instance.mesh];
        ++m.instances;
        facts.instancedTriangles += m.triangles[0];
        facts.emissiveTriangles += emissive[instance.mesh];
    }
    for (const Texture& texture : scene.textures) facts.textureBytes += texture.rgba.size();
    for (const Light& light : scene.lights) ++facts.lights[static_cast<std::size_t>(light.type)];
    facts.environmentBytes = bytesOf(scene.environment.radiance);
    return facts;
}

const char* nameOf(EnvironmentType type) {
    constexpr std::array names{"constant", "sky", "map"};
    return names[static_cast<std::size_t>(type)];
}

const char* nameOf(LodMode mode) {
    constexpr std::array names{"finest", "screen_error", "distance", "schedule", "stochastic"};
    return names[static_cast<std::size_t>(mode)];
}

Json count(std::size_t value) { return Json(static_cast<std::int64_t>(value)); }

Json vectorJson(glm::vec3 v) {
    Json array = Json::array();
    for (int i = 0; i < 3; ++i) array.push(Json(double(v[i])));
    return array;
}

Json toJson(const Scene& scene, const Facts& facts) {
    Json json = Json::object();
    json["file"] = Json(scene.file.string());
    json["about"] = Json(scene.about);
    json["triangles"]["unique"] = count(facts.uniqueTriangles);
    json["triangles"]["instanced"] = count(facts.instancedTriangles);
    json["triangles"]["emissive"] = count(facts.emissiveTriangles);
    json["triangles"]["dropped"] = count(scene.droppedTriangles);
    Json meshes = Json::array();
    for (const MeshFacts& m : facts.meshes) {
        Json mesh = Json::object(), levels = Json::array();
        mesh["name"] = Json(m.name);
        mesh["instances"] = count(m.instances);
        mesh["joints"] = count(m.joints);
        mesh["morphTargets"] = count(m.targets);
        for (std::size_t level = 0; level < m.triangles.size(); ++level) {
            Json entry = Json::object();
            entry["triangles"] = count(m.triangles[level]);
            entry["error"] = Json(double(m.errors[level]));
            levels.push(entry);
        }
        mesh["levels"] = levels;
        meshes.push(mesh);
    }
    json["meshes"] = meshes;
    json["instances"] = count(scene.instances.size());
    json["nodes"] = count(scene.nodes.size());
    Json materials = Json::array(), textures = Json::array();
    for (const Material& material : scene.materials) materials.push(Json(material.name));
    for (const Texture& t : scene.textures) {
        Json texture = Json::object();
        texture["name"] = Json(t.name);
        texture["size"] = Json::array();
        texture["size"].push(Json(t.width));
        texture["size"].push(Json(t.height));
        textures.push(texture);
    }
    json["materials"] = materials;
    json["textures"] = textures;
    json["lights"]["point"] = count(facts.lights[0]);
    json["lights"]["spot"] = count(facts.lights[1]);
    json["lights"]["directional"] = count(facts.lights[2]);
    json["environment"]["type"] = Json(nameOf(scene.environment.type));
    json["environment"]["size"] = Json::array();
    json["environment"]["size"].push(Json(scene.environment.width));
    json["environment"]["size"].push(Json(scene.environment.height));
    json["animation"]["channels"] = count(scene.animation.size());
    json["animation"]["seconds"] = Json(double(scene.animationLength));
    json["lod"] = Json(nameOf(scene.lod.mode));
    const CameraKey camera = scene.cameraAt(0);
    json["camera"]["position"] = vectorJson(camera.position);
    json["camera"]["target"] = vectorJson(camera.target);
    if (camera.height > 0) {
        json["camera"]["orthographic"] = Json(double(camera.height));
    } else {
        json["camera"]["fovy"] = Json(double(glm::degrees(camera.fovy)));
        json["camera"]["aperture"] = Json(double(camera.aperture));
    }
    json["camera"]["focus"] = Json(double(camera.focus));
    json["camera"]["keys"] = count(scene.camera.keys.size());
    const auto bounds = scene.bounds();
    json["bounds"] = Json::array();
    if (!scene.instances.empty()) {
        json["bounds"].push(vectorJson(bounds[0]));
        json["bounds"].push(vectorJson(bounds[1]));
    }
    json["memory"]["geometry"] = count(facts.geometryBytes);
    json["memory"]["textures"] = count(facts.textureBytes);
    json["memory"]["environment"] = count(facts.environmentBytes);
    Json notes = Json::array();
    for (const std::string& note : scene.notes) notes.push(Json(note));
    json["notes"] = notes;
    return json;
}

std::string megabytes(std::size_t bytes) { return fmt::format("{:.1f} MB", double(bytes) / 1e6); }
std::string triple(glm::vec3 v) { return fmt::format("({:.4g}, {:.4g}, {:.4g})", v.x, v.y, v.z); }

void print(const Scene& scene, const Facts& facts) {
    const auto line = [](std::string_view name, const std::string& text) { fmt::print("{:12} {}\n", name, text); };
    line("scene", scene.file.string());
    if (!scene.about.empty()) line("about", scene.about);
    line("triangles", fmt::format("{} in {} meshes; {} in {} instances; {} emissive{}", facts.uniqueTriangles, facts.meshes.size(),
                                  facts.instancedTriangles, scene.instances.size(), facts.emissiveTriangles,
                                  scene.droppedTriangles ? fmt::format("; {} without area left out", scene.droppedTriangles) : ""));
    constexpr std::size_t shown = 12;
    std::vector<const MeshFacts*> largest;
    for (const MeshFacts& m : facts.meshes) largest.push_back(&m);
    std::stable_sort(largest.begin(), largest.end(), [](const auto* a, const auto* b) { return a->triangles[0] > b->triangles[0]; });
    for (std::size_t i = 0; i < std::min(shown, largest.size()); ++i) {
        std::string levels;
        for (std::size_t level = 0; level < largest[i]->triangles.size(); ++level) {
            levels += fmt::format("{}{}", level ? " > " : "", largest[i]->triangles[level]);
            if (level > 0) levels += fmt::format(" (error {:.3g})", largest[i]->errors[level]);
        }
        std::string moves;
        if (largest[i]->joints > 0) moves += fmt::format(", {} joints", largest[i]->joints);
        if (largest[i]->targets > 0) moves += fmt::format(", {} morph target{}", largest[i]->targets, largest[i]->targets == 1 ? "" : "s");
        fmt::print("{:12} {}: {} triangles, {} instance{}{}\n", i == 0 ? "meshes" : "", largest[i]->name, levels, largest[i]->instances,
                   largest[i]->instances == 1 ? "" : "s", moves);
    }
    if (largest.size() > shown) fmt::print("{:12} and {} smaller ones\n", "", largest.size() - shown);
    line("materials", fmt::format("{}, {} textures", scene.materials.size(), scene.textures.size()));
    line("lights", fmt::format("{} point, {} spot, {} directional", facts.lights[0], facts.lights[1], facts.lights[2]));
    line("environment", fmt::format("{}, {}x{}", nameOf(scene.environment.type), scene.environment.width, scene.environment.height));
    if (!scene.animation.empty()) line("animation", fmt::format("{} channels, {:.3g} s", scene.animation.size(), scene.animationLength));
    line("levels", fmt::format("policy {}", nameOf(scene.lod.mode)));
    const CameraKey camera = scene.cameraAt(0);
    line("camera",
         fmt::format("at {}, towards {}, {}{}", triple(camera.position), triple(camera.target),
                     camera.height > 0 ? fmt::format("orthographic, {:.3g} high", camera.height) : fmt::format("{:.3g} degrees", glm::degrees(camera.fovy)),
                     camera.aperture > 0 ? fmt::format(", lens {:.3g}, focus {:.3g}", camera.aperture, camera.focus) : ""));
    const auto bounds = scene.bounds();
    if (!scene.instances.empty()) line("bounds", triple(bounds[0]) + " to " + triple(bounds[1]));
    line("memory", fmt::format("geometry {}, textures {}, environment {}", megabytes(facts.geometryBytes), megabytes(facts.textureBytes),
                               megabytes(facts.environmentBytes)));
    for (const std::string& note : scene.notes) line("note", note);
}

int describe(const Options& options) {
    const Scene scene = loadScene(options.scene);
    const Facts facts = gather(scene);
    if (options.json)
        fmt::print("{}\n", toJson(scene, facts).dump());
    else
        print(scene, facts);
    return 0;
}

}  // namespace

void addScene(CLI::App& app, std::function<int()>& run) {
    auto options = std::make_shared<Options>();
    Command command(app, "scene", "Tells what a scene or a model holds; needs no GPU.");
    command.option("SCENE", options->scene, "a scene file (.json) or a model (.gltf, .glb)").required();
    command.flag("--json", options->json, "facts as JSON");
    command.option("--device", options->device, "accepted everywhere; not used here");
    command.option("--rays", options->rays, "accepted everywhere; not used here");
    command.does(run, [options] { return describe(*options); });
}

}  // namespace lodestir
