// SPDX-License-Identifier: MIT
#include <framework/app/session.h>

#include <framework/app/command_line.h>
#include <framework/app/validators.h>
#include <framework/core/log.h>
#include <framework/graph/scene_node.h>

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

void SessionOptions::addTo(Command& command) {
    command.option("graph", graph, "graph file").required();
    command.taken<std::string>("--scene", [this](const std::string& v) { changes.scene = v; }, "scene file or model, instead of the graph's").check(checkNotEmpty);
    command.taken<int>("--frames", [this](int v) { changes.frames = v; }, "number of frames").within(1, std::numeric_limits<int>::max());
    command.taken<std::string>("--size", [this](const std::string& v) { changes.size = readSize("--size", v); }, "of the frame, WIDTHxHEIGHT");
    command.taken<std::uint32_t>("--seed", [this](std::uint32_t v) { changes.seed = v; }, "of the random numbers").check(checkNotEmpty);
    command.option("--set", changes.set, "pass.parameter=value").repeatable();
    command.taken<std::string>("--variant", [this](const std::string& v) { changes.variant = v; }, "one of the graph's variants");
    command.taken<std::string>("--show", [this](const std::string& v) { changes.show = v; }, "pass.port to show");
    command.option("--dump", dumps, "pass.port to write as well").repeatable();
    command.option("--passes", passes, "another folder of pass libraries").repeatable();
    command.option("--device", device, "name or index, see `lodestir devices`").check(checkNotEmpty);
    command.option("--rays", rays, "how rays are traced: packet, lane or ray_query").check(checkNotEmpty);
    command.flag("--check-bounds", checkBounds, "fail when a shader reads or writes outside a port");
    command.flag("--all-barriers", allBarriers, "a barrier before every pass, to find missing ones by comparing images");
    command.flag("--count-steps", countSteps, "count the nodes that rays visit");
}

namespace {

void prepareWithProgress(Runner& runner) {
    std::optional<log::Progress> progress;
    runner.prepare([&](std::size_t done, std::size_t all) {
        if (!progress) progress.emplace("compiling shaders, which the driver keeps for the next start", all);
        if (done > 0) progress->advance();
    });
}

}  // namespace

Session::Session(const SessionOptions& options, SessionParts parts)
    : device_(std::move(parts.device)), libraries_(options.passes), scene_(std::move(parts.scene)) {
    libraries_.addBuiltIn("scene", scenePlugin());
    graph_ = std::make_unique<Graph>(buildGraph(loadDescription(options.graph, options.changes), libraries_));
    if (parts.adjust) parts.adjust(*graph_);
    for (const std::string& name : options.dumps) std::ranges::copy(findSources(*graph_, name, {"--dump", 0, 0}), std::back_inserter(dumps_));
    if (graph_->description.scene.empty()) throw Error({graph_->description.file.string(), 0, 0}, "the graph names no scene", "add \"scene\" or give --scene");
    if (!scene_ || scene_->file != graph_->description.scene) {
        const auto start = std::chrono::steady_clock::now();
        scene_ = std::make_shared<Scene>(loadScene(graph_->description.scene));
        for (const std::string& note : scene_->notes) log::note("{}", note);
        sceneMilliseconds_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    }
    const bool isNew = !device_;
    if (isNew) device_ = std::make_shared<const gpu::Device>(gpu::DeviceOptions{.choice = options.device});
    rays_ = chooseRayBody(device_->facts(), options.rays);
    if (isNew) log::note("device {}, {}; rays by {}", device_->facts().name, device_->reason(), options.rays.empty() ? whyRayBody(device_->facts()) : options.rays + ", as asked for");
    runner_ = std::make_unique<Runner>(*device_, *graph_, *scene_,
                                       RunnerOptions{.rays = rays_, .pinned = dumps_, .checkBounds = options.checkBounds, .allBarriers = options.allBarriers, .countSteps = options.countSteps, .slice = parts.slice});
    if (parts.compiled) runner_->prepare(parts.compiled);
    else prepareWithProgress(*runner_);
}

}  // namespace lodestir
