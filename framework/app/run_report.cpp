// SPDX-License-Identifier: MIT
#include <framework/app/run_report.h>

#include <fmt/format.h>
#include <lodestir/revision.h>
#include <nlohmann/json.hpp>

#include <numeric>

#include <sys/resource.h>

namespace lodestir {

using OrderedJson = nlohmann::ordered_json;

namespace {

/// The most memory that the process ever had.
std::size_t peakBytes() {
    rusage use{};
    getrusage(RUSAGE_SELF, &use);
    return std::size_t(use.ru_maxrss) * 1024;
}

}  // namespace

OrderedJson frameJson(const FrameReport& frame, const std::map<std::string, double>& metrics, bool countSteps) {
    OrderedJson passes = OrderedJson::object();
    for (const PassReport& pass : frame.passes) {
        if (pass.setup) continue;
        OrderedJson rays;
        for (std::size_t i = 0; i < rayPurposes.size(); ++i)
            if (i != RAYS_STEPS || countSteps) rays[std::string(rayPurposes[i])] = pass.rays[i];
        passes[pass.name] = {{"ms", pass.milliseconds}, {"rays", rays}};
    }
    return {{"frame", frame.frame}, {"ms", frame.milliseconds}, {"wholeMs", frame.wholeMilliseconds}, {"passes", passes}, {"metrics", metrics}};
}

OrderedJson traceJson(std::span<const FrameReport> frames, const std::string& device) {
    OrderedJson events = OrderedJson::array();
    double begin = 0;  // milliseconds
    const auto add = [&](const std::string& name, double start, double length, int row, OrderedJson facts) {
        events.push_back({{"name", name}, {"ph", "X"}, {"ts", 1000 * (begin + start)}, {"dur", 1000 * length}, {"pid", 0}, {"tid", row},
                          {"args", std::move(facts)}});
    };
    for (const FrameReport& frame : frames) {
        add("frame " + std::to_string(frame.frame), 0, frame.wholeMilliseconds, 0, OrderedJson::object());
        for (const PassReport& pass : frame.passes) {
            if (!pass.ran) continue;
            const auto rays = std::accumulate(pass.rays.begin(), pass.rays.begin() + RAYS_STEPS, std::uint64_t(0));
            add(pass.name, pass.start, pass.milliseconds, 1, {{"rays", rays}});
        }
        begin += frame.wholeMilliseconds;
    }
    return {{"traceEvents", events}, {"displayTimeUnit", "ms"}, {"otherData", {{"device", device}}}};
}

std::string timesCsv(std::span<const FrameReport> frames) {
    std::string text = "frame,pass,ms";
    for (std::size_t i = 0; i < RAYS_STEPS; ++i) text += fmt::format(",{} rays", rayPurposes[i]);
    text += "\n";
    for (const FrameReport& frame : frames)
        for (const PassReport& pass : frame.passes) {
            if (!pass.ran) continue;
            text += fmt::format("{},{},{:.4f}", frame.frame, pass.name, pass.milliseconds);
            for (std::size_t i = 0; i < RAYS_STEPS; ++i) text += fmt::format(",{}", pass.rays[i]);
            text += "\n";
        }
    return text;
}

OrderedJson runJson(Session& session, double totalMilliseconds) {
    const gpu::DeviceFacts& device = session.device().facts();
    OrderedJson shaders = OrderedJson::array();
    for (const ShaderReport& s : session.runner().shaders())
        shaders.push_back({{"pass", s.pass}, {"shader", s.shader}, {"cached", s.cached}, {"compileMs", s.compileMilliseconds},
                           {"driverMs", s.driverMilliseconds}});
    const glm::uvec2 size = session.runner().size();
    return {{"lodestir", std::string(LODESTIR_VERSION)},
            {"revision", LODESTIR_REVISION},
            {"graph", session.graph().resolved().plain()},
            {"device", {{"name", device.name}, {"driver", device.driver}, {"driverVersion", device.driverVersion}, {"type", device.type},
                        {"rays", nameOf(session.rays())}}},
            {"size", {size.x, size.y}},
            {"seed", session.graph().description.seed},
            {"frames", OrderedJson::array()},
            {"setup", {{"ms", totalMilliseconds}, {"sceneMs", session.sceneMilliseconds()}, {"shaders", shaders}}},
            {"memory", {{"portBytes", session.runner().memoryBytes()},
                        {"bytesPerPixel", double(session.runner().memoryBytes()) / (double(size.x) * size.y)},
                        {"peakBytes", peakBytes()}}}};
}

}  // namespace lodestir
