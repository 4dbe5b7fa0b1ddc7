// SPDX-License-Identifier: MIT
#include <framework/app/session.h>

#include <framework/app/command_line.h>
#include <framework/app/port_value.h>
#include <framework/app/validators.h>
#include <framework/core/log.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <iterator>
#include <limits>
#include <optional>

namespace lodestir {

glm::uvec2 readSize(const std::string& option, const std::string& text) {
    glm::uvec2 size{0};
    const char* end = text.data() + text.size();
    const auto [x, ok] = std::from_chars(text.data(), end, size.x);
    if (ok == std::errc() && x != end && *x == 'x') {
        const auto [rest, good] = std::from_chars(x + 1, end, size.y);
        if (good == std::errc() && rest == end && size.x > 0 && size.y > 0) return size;
    }
    refuseOption(option, "\"" + text + "\" is no size; write it like 960x540");
}

void addRendererOptions(Command& command, RendererOptions& options) {
    command.option("--passes", options.passes, "another folder of pass libraries").repeatable();
    command.option("--device", options.device, "name or index, see `lodestir devices`").check(checkNotEmpty);
    command.option("--rays", options.rays, "how rays are traced: packet, lane or ray_query").check(checkNotEmpty);
}

namespace {

Setting readSetOption(const std::string& text) {
    try {
        return readSetting(text);
    } catch (const Error& error) {
        const Problem& problem = error.problems().front();
        refuseOption(problem.where.file, problem.what + "; " + problem.hint);
    }
}

}  // namespace

void SessionOptions::addGraph(Command& command) {
    command.option("graph", graph, "graph file").required();
    const auto takeScene = [this](const std::string& v) { changes.scene = v; };
    command.taken<std::string>("--scene", takeScene, "scene file or model, instead of the graph's").check(checkNotEmpty);
    command.taken<std::string>("--size", [this](const std::string& v) { changes.size = readSize("--size", v); }, "of the frame, WIDTHxHEIGHT");
    command.taken<std::uint32_t>("--seed", [this](std::uint32_t v) { changes.seed = v; }, "of the random numbers").check(checkNotEmpty);
    const auto takeSettings = [this](const std::vector<std::string>& texts) {
        for (const std::string& text : texts) changes.set.push_back(readSetOption(text));
    };
    command.taken<std::vector<std::string>>("--set", takeSettings, "pass.parameter=value").repeatable();
    command.taken<std::string>(
        "--variant", [this](const std::string& v) { changes.variant = v; }, "one of the graph's variants, or several: \"A + B\"");
    addRendererOptions(command, renderer);
}

void SessionOptions::addTo(Command& command) {
    addGraph(command);
    command.taken<int>("--frames", [this](int v) { changes.frames = v; }, "number of frames").within(1, std::numeric_limits<int>::max());
    command.taken<std::string>("--show", [this](const std::string& v) { changes.show = v; }, "pass.port to show");
    command.option("--dump", dumps, "pass.port to write as well").repeatable();
    command.flag("--check-bounds", checkBounds, "fail when a shader reads or writes outside a port");
    command.flag("--all-barriers", allBarriers, "a barrier before every pass, to find missing ones by comparing images");
    command.flag("--share-memory", shareMemory, "ports that aren't needed at the same time share memory");
    command.flag("--count-steps", countSteps, "count the nodes that rays visit");
}

Session::Session(const SessionOptions& options, SessionParts parts) : renderer_(options.renderer, parts.device), scene_(std::move(parts.scene)) {
    graph_ = std::make_unique<Graph>(renderer_.build(options.graph, options.changes));
    if (parts.adjust) parts.adjust(*graph_);
    for (const std::string& name : options.dumps) std::ranges::copy(findSources(*graph_, name, {"--dump", 0, 0}), std::back_inserter(dumps_));
    if (parts.probe) std::ranges::copy(pixelPorts(*graph_), std::back_inserter(dumps_));
    if (graph_->description.scene.empty()) throw Error({graph_->description.file.string(), 0, 0}, "the graph names no scene", "add \"scene\" or give --scene");
    if (!scene_ || scene_->file != graph_->description.scene) {
        const auto start = std::chrono::steady_clock::now();
        scene_ = std::make_shared<Scene>(loadScene(graph_->description.scene));
        for (const std::string& note : scene_->notes) log::note("{}", note);
        sceneMilliseconds_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    }
    if (!parts.device) {
        const std::string why = options.renderer.rays.empty() ? whyRayBody(device().facts()) : std::string(nameOf(rays())) + ", as asked for";
        log::note("device {}, {}; rays by {}", device().facts().name, device().reason(), why);
    }
    const RunnerOptions how{
        .pinned = dumps_, .checkBounds = options.checkBounds, .allBarriers = options.allBarriers, .keepAll = parts.keepAll, .shareMemory = options.shareMemory,
        .countSteps = options.countSteps, .probe = parts.probe, .slice = parts.slice};
    std::optional<log::Progress> progress;
    runner_ = renderer_.bringUp(*graph_, *scene_, how, parts.compiled ? parts.compiled : [&](std::size_t done, std::size_t all) {
        if (!progress) progress.emplace("compiling shaders, which the driver keeps for the next start", all);
        if (done > 0) progress->advance();
    });
}

}  // namespace lodestir
