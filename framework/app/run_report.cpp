// SPDX-License-Identifier: MIT
#include <framework/app/run_report.h>

#include <lodestir/revision.h>
#include <nlohmann/json.hpp>

namespace lodestir {

using OrderedJson = nlohmann::ordered_json;

OrderedJson frameJson(const FrameReport& frame, const std::map<std::string, double>& metrics, bool countSteps) {
    OrderedJson passes = OrderedJson::object();
    for (const PassReport& pass : frame.passes) {
        if (pass.setup) continue;
        OrderedJson rays;
        for (std::size_t i = 0; i < rayPurposes.size(); ++i)
            if (i != RAYS_STEPS || countSteps) rays[std::string(rayPurposes[i])] = pass.rays[i];
        passes[pass.name] = {{"ms", pass.milliseconds}, {"rays", rays}};
    }
    return {{"frame", frame.frame}, {"ms", frame.milliseconds}, {"passes", passes}, {"metrics", metrics}};
}

OrderedJson runJson(Session& session, double totalMilliseconds) {
    const gpu::DeviceFacts& device = session.device().facts();
    OrderedJson shaders = OrderedJson::array();
    for (const ShaderReport& s : session.runner().shaders())
        shaders.push_back({{"pass", s.pass}, {"shader", s.shader}, {"cached", s.cached}, {"compileMs", s.compileMilliseconds}, {"driverMs", s.driverMilliseconds}});
    const glm::uvec2 size = session.runner().size();
    return {{"lodestir", std::string(LODESTIR_VERSION)},
            {"revision", LODESTIR_REVISION},
            {"graph", session.graph().resolved().plain()},
            {"device", {{"name", device.name}, {"driver", device.driver}, {"driverVersion", device.driverVersion}, {"type", device.type}, {"rays", nameOf(session.rays())}}},
            {"size", {size.x, size.y}},
            {"seed", session.graph().description.seed},
            {"frames", OrderedJson::array()},
            {"setup", {{"ms", totalMilliseconds}, {"sceneMs", session.sceneMilliseconds()}, {"shaders", shaders}}},
            {"memory", {{"portBytes", session.runner().memoryBytes()}, {"bytesPerPixel", double(session.runner().memoryBytes()) / (double(size.x) * size.y)}}}};
}

}  // namespace lodestir
