// SPDX-License-Identifier: MIT
#include <framework/app/bake_impostors.h>

#include <framework/app/session.h>
#include <framework/core/error.h>
#include <framework/core/json.h>
#include <framework/core/log.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <map>

namespace lodestir {
namespace {

constexpr const char* factPorts[] = {"bake.bytes", "bake.rawBytes", "bake.coverage"};

/// How many meshes of each name instances show, of those that are wanted.
std::map<std::string, std::size_t> shownMeshes(const Scene& scene, const std::vector<std::string>& wanted) {
    std::map<std::string, std::size_t> shown;
    std::vector<bool> counted(scene.meshes.size());
    std::vector<std::string> names;
    for (const Instance& instance : scene.instances) {
        const std::string& name = scene.meshes[instance.mesh].name;
        names.push_back(name);
        if (counted[instance.mesh] || scene.meshes[instance.mesh].levels.front().triangles.empty()) continue;
        counted[instance.mesh] = true;
        if (wanted.empty() || std::ranges::find(wanted, name) != wanted.end()) ++shown[name];
    }
    Problems problems;
    for (const std::string& name : wanted)
        if (!shown.contains(name)) problems.add({scene.file.string()}, "no instance shows a mesh \"" + name + "\"", didYouMean(name, names));
    problems.raise();
    return shown;
}

template <class T> T read(Session& session, const char* port) {
    T value{};
    const std::vector<std::byte> bytes = session.runner().readBytes(findSource(session.graph(), port));
    std::memcpy(&value, bytes.data(), std::min(bytes.size(), sizeof value));
    return value;
}

int parameterOf(const Graph& graph, std::string_view name) {
    const auto& parameters = graph.nodes[std::size_t(graph.find("bake"))].pass->parameters;
    return std::get<int>((*std::ranges::find(parameters, name, &Parameter::name))->value);
}

}  // namespace

std::vector<BakedMesh> bakeImpostors(const Path& model, const BakeOptions& options) {
    SessionParts parts;
    parts.scene = std::make_shared<Scene>(loadScene(std::filesystem::absolute(model)));
    const auto shown = shownMeshes(*parts.scene, options.meshes);
    SessionOptions session{.graph = graphFolder() / "framework/bake_impostors.json", .renderer = options.renderer,
                           .dumps = {std::begin(factPorts), std::end(factPorts)}};
    session.changes.scene = parts.scene->file;
    session.changes.set = options.set;
    Session baking(session, std::move(parts));

    std::vector<BakedMesh> baked;
    log::Progress progress("baking impostors", shown.size());
    for (const auto& [name, count] : shown) {
        setParameter(baking.graph(), "bake.mesh", Json(name));
        const FrameReport report = baking.runner().run();
        BakedMesh& mesh = baked.emplace_back();
        mesh.name = name;
        mesh.meshes = count;
        mesh.views = parameterOf(baking.graph(), "views");
        mesh.resolution = parameterOf(baking.graph(), "resolution");
        mesh.bytes = read<std::uint64_t>(baking, factPorts[0]);
        mesh.rawBytes = read<std::uint64_t>(baking, factPorts[1]);
        const glm::uvec2 points = read<glm::uvec2>(baking, factPorts[2]);
        mesh.coverage = points.x > 0 ? double(points.y) / points.x : 0;
        const PassReport& pass = *std::ranges::find(report.passes, "bake", &PassReport::name);
        mesh.seconds = pass.milliseconds / 1000;
        mesh.wasKept = pass.rays[RAYS_PRIMARY] == 0;
        progress.advance();
    }
    return baked;
}

}  // namespace lodestir
