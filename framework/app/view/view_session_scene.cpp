// SPDX-License-Identifier: MIT
// The scene as the panel of it asks for and edits it.
#include <framework/app/view/view_session.h>

#include <framework/app/view/camera_path.h>
#include <framework/core/log.h>
#include <framework/gpu/commands.h>
#include <framework/scene/bvh/mesh_bounds.h>
#include <framework/scene/level_policy.h>
#include <framework/shaders/world/primary_hit.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace lodestir {
namespace {

const Parameter* parameterOf(const GraphNode& node, std::string_view name) {
    const auto found = std::ranges::find(node.pass->parameters, name, [](const Parameter* p) { return p->name; });
    return found == node.pass->parameters.end() ? nullptr : *found;
}

const std::string& textOf(const GraphNode& node, std::string_view parameter) { return std::get<std::string>(parameterOf(node, parameter)->value); }

const char* nameOf(EnvironmentType type) { return type == EnvironmentType::constant ? "constant" : type == EnvironmentType::sky ? "sky" : "map"; }

SceneInfo::Light describeLight(const Light& light) {
    const bool directional = light.type == LightType::directional;
    return {.name = light.name,
            .type = directional                     ? "directional"
                    : light.type == LightType::spot ? "spot"
                                                    : "point",
            .unit = directional ? "lx" : "cd",
            .intensity = light.intensity,
            .edit = {}};
}

/// Names of the instances; where several have one, behind that of the outermost node around each.
std::vector<std::string> titlesOf(const Scene& scene) {
    std::map<std::string, int> count;
    for (const Instance& instance : scene.instances) ++count[instance.name];
    std::vector<std::string> titles;
    for (const Instance& instance : scene.instances) {
        titles.push_back(instance.name);
        if (count[instance.name] == 1) continue;
        std::uint32_t outermost = instance.node;
        for (std::uint32_t node = instance.node; node != none; node = scene.nodes[node].parent)
            if (!scene.nodes[node].name.empty()) outermost = node;
        if (scene.nodes[outermost].name != instance.name) titles.back() = scene.nodes[outermost].name + " / " + instance.name;
    }
    return titles;
}

int lastFrameOf(const Scene& scene) {
    float last = std::max(scene.camera.keys.back().frame, scene.animationLength * scene.framesPerSecond / std::max(std::abs(scene.animationSpeed), 1e-6f));
    for (const LodSwitch& change : scene.lod.schedule) last = std::max(last, float(change.frame) + 8);
    return int(std::clamp(last, 60.0f, 1e6f));
}

}  // namespace

/// The frame whose pose and camera a frame shows.
float ViewSession::poseFrame(std::uint32_t frame) const {
    const auto& nodes = session_->graph().nodes;
    const auto node = std::ranges::find(nodes, "scene", &GraphNode::type);
    if (node == nodes.end()) return float(frame);  // no pass takes a World
    return std::get<bool>(parameterOf(*node, "animate")->value) ? float(frame) : float(std::get<int>(parameterOf(*node, "pose")->value));
}

/// The port of the first pass of a type that runs.
std::optional<Source> ViewSession::running(std::string_view type, std::string_view port) const {
    const Graph& graph = session_->graph();
    for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
        if (graph.nodes[n].type != type || graph.nodes[n].off || session_->runner().plan().stepOf(int(n)) < 0) continue;
        const auto& ports = graph.nodes[n].pass->ports;
        const auto found = std::ranges::find_if(ports, [&](const Port* p) { return !p->isInput() && p->name == port; });
        if (found != ports.end()) return Source{int(n), int(found - ports.begin()), false};
    }
    return std::nullopt;
}

template <class T> std::vector<T> ViewSession::read(const Source& source, std::size_t count) const {
    std::vector<T> values(count);
    const gpu::Buffer& memory = session_->runner().memoryOf(source);
    values.resize(std::min(count, memory.size() / sizeof(T)));
    gpu::readBuffer(*device_, memory, 0, std::as_writable_bytes(std::span(values)));
    return values;
}

void ViewSession::describeScene(SceneInfo& info) const {
    const Graph& graph = session_->graph();
    const Scene& scene = session_->scene();
    for (const Mesh& mesh : scene.meshes) {
        SceneInfo::Mesh& described = info.meshes.emplace_back();
        for (const MeshLevel& level : mesh.levels) described.triangles.push_back(level.triangles.size());
    }
    const std::vector<std::string> titles = titlesOf(scene);
    for (std::size_t i = 0; i < titles.size(); ++i) info.instances.push_back({titles[i], scene.instances[i].mesh});
    for (const Material& m : scene.materials)
        info.materials.push_back(
            {.name = m.name, .baseColor = glm::vec3(m.baseColor), .emission = m.emission, .roughness = m.roughness, .metallic = m.metallic, .edit = {}});
    for (const Light& light : scene.lights) info.lights.push_back(describeLight(light));
    info.environment = nameOf(scene.environment.type);
    info.policy = lodestir::describe(scene.lod);
    info.lastFrame = lastFrameOf(scene);
    for (const GraphNode& node : graph.nodes) {
        if (node.off) continue;
        if (node.type == "level_colors") info.levelColors = node.name + ".color";
        if (node.type == "lod_select" && info.lod.empty()) info.lod = node.name;
        if (node.type == "light_edit" && info.environmentEdit.empty()) info.environmentEdit = node.name;
        if (node.type == "material_edit")
            for (SceneInfo::Material& material : info.materials)
                if (material.name == textOf(node, "material")) material.edit = node.name;
        if (node.type == "light_edit")
            for (SceneInfo::Light& light : info.lights)
                if (light.name == textOf(node, "light")) light.edit = node.name;
    }
    if (info.lod.empty()) return;
    const Parameter& mode = *parameterOf(graph.nodes[std::size_t(graph.find(info.lod))], "mode");
    const std::string_view chosen = mode.choices[std::size_t(std::get<int>(mode.value))];
    if (chosen != "scene") info.policy = chosen;
}

void ViewSession::watchScene(bool watched) {
    watchesScene_ = watched;
    if (!watched) choose(none);
    lookAtScene();
    tell();
}

std::vector<std::uint32_t> ViewSession::levelsNow() const {
    const Scene& scene = session_->scene();
    std::vector<std::uint32_t> levels = levelsAt(scene, poseFrame(status_.nextFrame - 1));
    if (const auto chosen = running("lod_select", "chosen")) std::ranges::copy(read<std::uint32_t>(*chosen, levels.size()), levels.begin());
    for (std::size_t i = 0; i < levels.size(); ++i)
        levels[i] = std::min(levels[i], std::uint32_t(status_.graph->contents.meshes[scene.instances[i].mesh].triangles.size() - 1));
    return levels;
}

std::vector<ForcedLevel> ViewSession::forcedNow() const {
    const std::string& lod = status_.graph->contents.lod;
    return lod.empty() ? std::vector<ForcedLevel>() : readForced(textOf(session_->graph().nodes[std::size_t(session_->graph().find(lod))], "force"));
}

void ViewSession::lookAtScene() {
    status_.sceneState.reset();
    if (!watchesScene_ || !session_ || status_.nextFrame == 0) return;
    const Scene& scene = session_->scene();
    const SceneInfo& info = status_.graph->contents;
    auto state = std::make_shared<SceneState>();
    state->levels = levelsNow();
    state->forced = forcedLevels(scene, writeForced(forcedNow()));
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const SceneInfo::Mesh& mesh = info.meshes[scene.instances[i].mesh];
        state->triangles += mesh.triangles[state->levels[i]];
        state->finest += mesh.triangles[0];
    }
    if (const auto bytes = running("lod_select", "bytes")) state->bytes = read<std::uint64_t>(*bytes, 1).at(0);
    if (const auto hits = running("visibility", "hits")) {
        state->pixels.assign(scene.instances.size(), 0);
        const glm::uvec2 size = session_->runner().size();
        for (const PrimaryHit& hit : read<PrimaryHit>(*hits, std::size_t(size.x) * size.y))
            if (hit.primitive != NONE && hit.instance < state->pixels.size()) ++state->pixels[hit.instance];
    }
    if (picked_ && picked_->instance < scene.instances.size()) {
        state->picked = picked_;
        const Instance& instance = scene.instances[picked_->instance];
        const glm::mat4 toWorld = scene.instanceMatrix(instance, scene.nodeMatrices(poseFrame(status_.nextFrame - 1)));
        for (int corner = 0; !scene.meshes[instance.mesh].deforms() && corner < 8; ++corner)
            state->corners.push_back(toWorld * glm::vec4(pickedBox_[corner & 1].x, pickedBox_[corner >> 1 & 1].y, pickedBox_[corner >> 2].z, 1));
    }
    status_.sceneState = std::move(state);
}

void ViewSession::choose(std::uint32_t instance) {
    picked_.reset();
    if (!session_ || instance >= session_->scene().instances.size()) return;
    const Mesh& mesh = session_->scene().meshes[session_->scene().instances[instance].mesh];
    const std::vector<std::uint32_t>& materials = mesh.levels[0].materials;
    picked_ = Picked{.instance = instance, .material = materials.empty() ? none : materials[0]};
    const Box box = boundsOf(mesh);
    pickedBox_ = {box.low, box.high};
    lookAtScene();
    tell();
}

void ViewSession::pick(glm::vec2 place) {
    if (!session_ || broken_) return;
    const glm::uvec2 size = session_->runner().size();
    const ViewRay ray = viewRay(lastCamera_, place, float(size.x) / float(size.y));
    const auto picked = lodestir::pick(session_->scene(), poseAt(session_->scene(), poseFrame(status_.nextFrame - 1)), levelsNow(), ray);
    choose(picked ? picked->instance : none);
    picked_ = picked;
    lookAtScene();
    tell();
}

int ViewSession::nodeFor(const SceneEdit& wanted) const {
    const Graph& graph = session_->graph();
    for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
        const GraphNode& node = graph.nodes[n];
        if (node.type == wanted.type && !node.off && (wanted.key.empty() || textOf(node, wanted.key) == wanted.subject)) return int(n);
    }
    return -1;
}

void ViewSession::editScene(const SceneEdit& wanted) {
    if (!session_) return;
    if (const int node = nodeFor(wanted); node >= 0) {
        const std::string parameter = session_->graph().nodes[std::size_t(node)].name + "." + wanted.parameter;
        const std::string* text = std::get_if<std::string>(&wanted.value);
        setParameter(text ? parameter + " " + *text : parameter, parameter, wanted.value);  // a slider that is dragged is one step, levels are several
        describe();
        tell();
        return;
    }
    const std::string name = nameFor(session_->graph(), wanted.type);
    edit(name, "", [&](const Graph& graph) {
        WorldPass pass{.type = wanted.type, .ownPrevious = wanted.type == "lod_select"};
        if (!wanted.key.empty()) pass.set[wanted.key] = wanted.subject;
        std::visit(
            [&]<class T>(const T& value) {
                if constexpr (std::is_same_v<T, float>)
                    pass.set[wanted.parameter] = Json(double(value));
                else
                    pass.set[wanted.parameter] = Json(value);
            },
            wanted.value);
        return worldPatch(graph, name, pass);
    });
}

void ViewSession::force(const std::vector<ForcedLevel>& forced) {
    editScene({.type = "lod_select", .key = {}, .subject = {}, .parameter = "force", .value = writeForced(forced)});
}

void ViewSession::forceLevel(std::uint32_t instance, std::optional<int> level) {
    if (!session_) return;
    if (instance == none)
        force(level ? std::vector<ForcedLevel>{{"*", level}} : std::vector<ForcedLevel>());
    else if (instance < session_->scene().instances.size())
        force(withForced(session_->scene(), forcedNow(), instance, level));
}

void ViewSession::moveLevel(std::uint32_t instance, int step) {
    if (!session_) return;
    const std::vector<std::uint32_t> now = levelsNow();
    if (instance == none) return force(withAllMoved(session_->scene(), now, step));
    if (instance >= now.size()) return;
    const auto levels = int(status_.graph->contents.meshes[session_->scene().instances[instance].mesh].triangles.size());
    forceLevel(instance, std::clamp(int(now[instance]) + step, 0, levels - 1));
}

void ViewSession::addLevelColors() {
    edit("levels in colours", "", [&](const Graph& graph) {
        Json patch;
        const auto hits = std::ranges::find_if(graph.nodes, [](const GraphNode& node) { return node.type == "visibility" && !node.off; });
        const std::string from = hits == graph.nodes.end() ? nameFor(graph, "visibility") : hits->name;
        if (hits == graph.nodes.end()) patch["passes"][from]["type"] = "visibility";
        Json& colors = patch["passes"][nameFor(graph, "level_colors")];
        colors["type"] = "level_colors";
        colors["in"]["hits"] = from + ".hits";
        return patch;
    });
}

void ViewSession::playPath(const std::vector<CameraKey>& keys) {
    if (!session_ || keys.empty()) return;
    CameraPath& path = session_->sharedScene()->camera;
    if (!scenePath_) scenePath_ = path;
    path = {.keys = keys};
    resetBoth();
    setFrame(std::uint32_t(std::max(keys.front().frame, 0.0f)));
}

void ViewSession::savePath(const Path& file, const std::vector<CameraKey>& keys) {
    if (!session_) return;
    attempt([&] {
        writeFile(file, sceneWithPath(session_->scene().file, keys, file.parent_path()).dump(2) + "\n");
        noteDone("wrote " + file.string());
    });
    tell();
}

}  // namespace lodestir
