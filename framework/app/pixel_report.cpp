// SPDX-License-Identifier: MIT
#include <framework/app/pixel_report.h>

#include <framework/app/port_value.h>
#include <framework/app/probe_tree.h>
#include <framework/core/log.h>

#include <nlohmann/json.hpp>

namespace lodestir {
namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson dispatchJson(const ProbedDispatch& dispatch, glm::ivec2 pixel) {
    OrderedJson json{{"shader", dispatch.shader}};
    if (!dispatch.arguments.empty()) json["arguments"] = dispatch.arguments;
    if (dispatch.lost > 0) json["lost"] = dispatch.lost;
    json["invocations"] = probeTree(dispatch, pixel);
    return json;
}

}  // namespace

OrderedJson pixelReport(Session& session, const std::vector<ProbedDispatch>& told, glm::ivec2 pixel) {
    const Graph& graph = session.graph();
    OrderedJson passes = OrderedJson::object();
    for (const PlanStep& step : session.runner().plan().steps) {
        const GraphNode& node = graph.nodes[std::size_t(step.node)];
        OrderedJson dispatches = OrderedJson::array(), values = OrderedJson::object();
        for (const ProbedDispatch& dispatch : told) {
            if (dispatch.node != step.node) continue;
            if (dispatch.lost > 0) log::warn("{}: {} records of {} found no room", node.name, dispatch.lost, dispatch.shader);
            dispatches.push_back(dispatchJson(dispatch, pixel));
        }
        for (const Source& port : session.dumps())
            if (port.node == step.node) values[std::string(graph.port(port).name)] = pixelValue(session, port, pixel);
        passes[node.name] = {{"type", node.type}, {"dispatches", dispatches}, {"ports", values}};
    }
    return passes;
}

}  // namespace lodestir
