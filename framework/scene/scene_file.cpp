// SPDX-License-Identifier: MIT
// The reading of scene files.
#include <framework/core/is_file.h>
#include <framework/core/file_kind.h>
#include <framework/scene/deformation.h>
#include <framework/scene/fields.h>
#include <framework/scene/gltf/gltf.h>
#include <framework/scene/level_policy.h>
#include <framework/scene/scene_file.h>
#include <framework/scene/scene_sections.h>

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace lodestir {
namespace {

constexpr std::size_t maxSwitches = std::size_t(1) << 20;

/// How long the lists of a scene were at a moment.
struct Mark {
    std::size_t nodes, instances, lights, animation;
};

Mark markOf(const Scene& scene) { return {scene.nodes.size(), scene.instances.size(), scene.lights.size(), scene.animation.size()}; }

/// A mesh that follows nodes, following those `shift` further on.
std::uint32_t repeatDeforming(Scene& scene, Mesh mesh, std::uint32_t shift) {
    if (mesh.node != none) mesh.node += shift;
    if (mesh.skin != none) {
        Skin skin = scene.skins[mesh.skin];
        for (std::uint32_t& node : skin.nodes) node += shift;
        mesh.skin = static_cast<std::uint32_t>(scene.skins.size());
        scene.skins.push_back(std::move(skin));
    }
    scene.meshes.push_back(std::move(mesh));
    return static_cast<std::uint32_t>(scene.meshes.size() - 1);
}

/// Places what a model has added between two marks once more, under another node; materials are shared, and meshes that don't deform.
void repeatModel(Scene& scene, const Mark& begin, const Mark& end, std::uint32_t parent) {
    const auto shift = static_cast<std::uint32_t>(scene.nodes.size() - begin.nodes);
    for (std::size_t i = begin.nodes; i < end.nodes; ++i) {
        Node node = scene.nodes[i];
        node.parent = node.parent < begin.nodes ? parent : node.parent + shift;  // only the model's roots hang outside
        scene.nodes.push_back(std::move(node));
    }
    const auto repeat = [&](auto& list, std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < to; ++i) {
            auto item = list[i];
            item.node += shift;
            list.push_back(std::move(item));
        }
    };
    repeat(scene.instances, begin.instances, end.instances);
    for (std::size_t i = end.instances - begin.instances; i > 0; --i) {
        Instance& instance = scene.instances[scene.instances.size() - i];
        if (scene.meshes[instance.mesh].deforms()) instance.mesh = repeatDeforming(scene, scene.meshes[instance.mesh], shift);
    }
    repeat(scene.lights, begin.lights, end.lights);
    repeat(scene.animation, begin.animation, end.animation);
}

struct Model {
    std::string name;
    Path path;
    Where where;
    GltfChoices choices;
    bool loaded = false;
    Mark begin{}, end{};
    std::size_t deforming = 0;  ///< vertices that each instance has for itself
};

class SceneFileLoader {
public:
    explicit SceneFileLoader(const Path& path) : path_(path), json_(Json::load(path)) { scene_.file = path; }

    Scene load(SceneFileSays& says) {
        expectKind(json_, FileKind::scene);
        Fields fields(json_, "the scene", problems_);
        fields.allow({"$schema"});
        checkFormat(fields);
        fields.text("about", scene_.about);
        readModels(fields.require("models"));
        if (const Json* camera = fields.find("camera")) readCamera(*camera, scene_, problems_);
        placeInstances(fields.find("instances"));
        if (const Json* lights = fields.find("lights")) readLights(*lights, scene_, problems_);
        if (const Json* animation = fields.find("animation")) readAnimation(*animation);
        if (const Json* cut = fields.find("cut")) readCuts(*cut);
        if (const Json* lod = fields.find("lod")) readLod(*lod);
        fields.number("exposure", scene_.exposure, -50, 50);
        const Json* environment = fields.find("environment");
        fields.finish();
        if (environment) readEnvironment(*environment, path_.parent_path(), scene_, problems_);
        says = {.environment = environment != nullptr, .exposure = json_.find("exposure") != nullptr};
        problems_.raise();
        return std::move(scene_);
    }

private:
    void checkFormat(Fields& fields) {
        int format = 1;
        if (fields.require("format")) fields.integer("format", format, 1, 1);
    }

    void readModels(const Json* models) {
        if (!models) return;
        if (!models->isObject())
            return problems_.add(models->where(), fmt::format("\"models\" must be an object, not {}", models->kindName()));
        for (const auto& [name, value] : models->members()) {
            Fields fields(value, fmt::format("model \"{}\"", name), problems_);
            std::string file;
            const Json* member = fields.require("file");
            fields.text("file", file);
            GltfChoices choices;
            const auto choose = [&](const char* key, GltfChoice& choice) {
                fields.text(key, choice.name);
                if (const Json* chosen = fields.find(key)) choice.where = chosen->where();
            };
            choose("variant", choices.variant);
            choose("animation", choices.animation);
            fields.finish();
            if (!member || file.empty()) continue;
            Path path = namedPath(path_.parent_path(), file);
            if (!isFile(path)) path = namedPath(sceneFolder(), file);
            if (!isFile(path)) {
                problems_.add(member->where(), fmt::format("there is no model \"{}\" beside the scene file", file),
                              "generated models lie in the build's scenes folder, large ones once they were asked for: "
                              "cmake --build --preset release --target scene_NAME");
                path.clear();
            }
            models_.push_back({name, path, member->where(), choices});
        }
        if (models->members().empty()) problems_.add(models->where(), "the scene has no models");
    }

    std::uint32_t addNode(Node node) {
        scene_.nodes.push_back(std::move(node));
        return static_cast<std::uint32_t>(scene_.nodes.size() - 1);
    }

    void placeModel(Model& model, std::uint32_t parent) {
        if (model.path.empty()) return;
        if (model.loaded) {
            const std::size_t more = model.end.nodes - model.begin.nodes;
            if (isFull_) return;
            deforming_ += model.deforming;
            isFull_ = scene_.nodes.size() + more > maxNodes || deforming_ > maxDeforming;
            if (!isFull_) return repeatModel(scene_, model.begin, model.end, parent);
            problems_.add(model.where,
                          fmt::format("with all its instances the scene has more than {} nodes or {} vertices that deform", maxNodes, maxDeforming));
            return;
        }
        model.loaded = true;
        model.begin = markOf(scene_);
        const std::size_t before = scene_.meshes.size();
        try {
            loadGltf(model.path, scene_, parent, model.choices);
        } catch (const Error& error) {
            problems_.add(error);
            model.path.clear();
        }
        model.end = markOf(scene_);
        for (std::size_t m = before; m < scene_.meshes.size(); ++m) model.deforming += deformingVertices(scene_.meshes[m]);
        deforming_ += model.deforming;
    }

    void placeInstances(const Json* instances) {
        if (!instances) {
            for (Model& model : models_) placeModel(model, addNode({.name = model.name}));
            return;
        }
        if (!instances->isArray())
            return problems_.add(instances->where(), fmt::format("\"instances\" must be an array, not {}", instances->kindName()));
        std::vector<std::string> names;
        for (const Model& model : models_) names.push_back(model.name);
        for (std::size_t i = 0; i < instances->items().size(); ++i) {
            Fields fields(instances->items()[i], fmt::format("instance {}", i), problems_);
            std::size_t model = models_.size();
            if (fields.require("model")) fields.choice("model", model, names);
            Node node;
            if (model < models_.size()) node.name = models_[model].name;
            fields.text("name", node.name);
            readPlacement(fields, node);
            fields.finish();
            if (model < models_.size()) placeModel(models_[model], addNode(std::move(node)));
        }
    }

    void readPlacement(Fields& fields, Node& node) {
        fields.vector("translation", node.translation);
        const Json* quaternion = fields.find("rotation");
        const Json* degrees = fields.find("rotationDegrees");
        if (quaternion && degrees)
            problems_.add(degrees->where(), fmt::format("{} has two rotations", fields.what()),
                          "give \"rotation\" (a quaternion) or \"rotationDegrees\"");
        const Json* scale = fields.find("scale");  // asked for now: a mistake in the rotation must not make it an unknown key
        try {
            if (quaternion) {
                const std::vector<double> q = numbersOf(*quaternion, "\"rotation\"", 4);
                const glm::dquat rotation(q[3], q[0], q[1], q[2]);
                if (!(glm::length(rotation) > 0)) throw Error(quaternion->where(), "a rotation cannot be a zero quaternion");
                node.rotation = glm::quat(glm::normalize(rotation));  // as floats only now: the square of a large one is none
            } else if (degrees) {  // about X first, then Y, then Z
                const std::vector<double> angles = numbersOf(*degrees, "\"rotationDegrees\"", 3);
                node.rotation = glm::angleAxis(glm::radians(float(angles[2])), glm::vec3(0, 0, 1)) *
                                glm::angleAxis(glm::radians(float(angles[1])), glm::vec3(0, 1, 0)) *
                                glm::angleAxis(glm::radians(float(angles[0])), glm::vec3(1, 0, 0));
            }
            if (scale) {
                if (scale->isNumber())
                    node.scale = glm::vec3(float(scale->asNumber()));
                else if (scale->isArray())
                    fields.vector("scale", node.scale);
                else
                    throw Error(scale->where(),
                                fmt::format("\"scale\" must be a number or an array of 3 numbers, not {}", scale->kindName()));
                if (node.scale.x * node.scale.y * node.scale.z == 0)
                    throw Error(scale->where(), fmt::format("{} has no size", fields.what()), "a scale must not be 0");
            }
        } catch (const Error& error) {
            problems_.add(error);
        }
    }

    void readAnimation(const Json& value) {
        Fields fields(value, "the animation", problems_);
        fields.number("framesPerSecond", scene_.framesPerSecond, 1e-3, 1e6);
        fields.number("speed", scene_.animationSpeed, -1e6, 1e6);
        fields.finish();
    }

    void readCuts(const Json& value) {
        try {
            for (const Json& item : value.items("\"cut\"")) {
                const std::int64_t frame = item.asInt("a frame of \"cut\"");
                if (frame < 0 || frame > 1'000'000'000) throw Error(item.where(), fmt::format("there is no frame {}", frame));
                scene_.cuts.push_back(static_cast<int>(frame));
            }
            std::sort(scene_.cuts.begin(), scene_.cuts.end());
        } catch (const Error& error) {
            problems_.add(error);
        }
    }

    void readLod(const Json& value) {
        Fields fields(value, "the level of detail policy", problems_);
        std::size_t mode = static_cast<std::size_t>(scene_.lod.mode);
        fields.choice("mode", mode, {"finest", "screen_error", "distance", "schedule", "stochastic"});
        scene_.lod.mode = static_cast<LodMode>(mode);
        fields.number("pixelError", scene_.lod.pixelError, 1e-6, 1e6);
        const Json* schedule = fields.find("schedule");
        fields.finish();
        if (!schedule) return;
        if (!schedule->isArray())
            return problems_.add(schedule->where(), fmt::format("\"schedule\" must be an array, not {}", schedule->kindName()));
        for (std::size_t i = 0; i < schedule->items().size(); ++i) {
            Fields entry(schedule->items()[i], fmt::format("switch {} of the schedule", i), problems_);
            LodSwitch change;
            if (entry.require("frame")) entry.integer("frame", change.frame, 0, 1'000'000'000);
            if (entry.require("level")) entry.integer("level", change.level, 0, maxLevels - 1);
            const Json* instance = entry.find("instance");
            std::string name;
            entry.text("instance", name);
            entry.finish();
            if (!instance)
                scene_.lod.schedule.push_back(change);
            else if (problems_.empty())
                trySwitches(change, name, *instance);  // else names would be missed only because their model failed
        }
    }

    void trySwitches(const LodSwitch& change, const std::string& name, const Json& place) {
        try {
            addSwitches(change, name, place);
        } catch (const Error& error) {
            problems_.add(error);
        }
    }

    /// One switch for each instance that is meant.
    void addSwitches(LodSwitch change, const std::string& name, const Json& place) {
        const std::vector<std::uint32_t> named = instancesNamed(scene_, name);
        if (scene_.lod.schedule.size() + named.size() > maxSwitches)
            throw Error(place.where(), fmt::format("the schedule has more than {} switches, one for each instance of a name", maxSwitches),
                        "leave \"instance\" out where all are meant");
        for (const std::uint32_t instance : named) {
            change.instance = instance;
            scene_.lod.schedule.push_back(change);
        }
        if (!named.empty()) return;
        std::set<std::string> names;
        for (const Instance& instance : scene_.instances) names.insert(instance.name);
        const std::vector<std::string> candidates(names.begin(), names.end());
        problems_.add(place.where(), fmt::format("there is no instance \"{}\"", name), didYouMean(name, candidates));
    }

    Path path_;
    Json json_;
    Scene scene_;
    Problems problems_;
    std::vector<Model> models_;
    std::size_t deforming_ = 0;  ///< vertices, so far
    bool isFull_ = false;  ///< of nodes: said once
};

}  // namespace

Scene loadSceneFile(const Path& path, SceneFileSays& says) { return SceneFileLoader(path).load(says); }

}  // namespace lodestir
