// SPDX-License-Identifier: MIT
// `lodestir check`: validates a graph with all its variants and prints its plan. No GPU.
#include <framework/app/commands/commands.h>
#include <framework/app/command_line.h>
#include <framework/app/session.h>
#include <framework/graph/plan.h>
#include <framework/graph/plugins.h>
#include <framework/scene/level_policy.h>
#include <framework/shaders/world/world.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <memory>

namespace lodestir {
namespace {

struct Options {
    SessionOptions session;
    bool json = false;
};

/// A variant that nobody runs today should not be found broken in the middle of a study.
void checkVariants(const Options& options, const std::vector<std::string>& names, PluginLibraries& libraries, Problems& problems) {
    for (const std::string& name : names) {
        try {
            GraphOptions changes;
            changes.variant = name;
            buildGraph(loadDescription(options.session.graph, changes), libraries);
        } catch (const Error& error) {
            for (const Problem& problem : error.problems())
                problems.add(problem.where, fmt::format("variant \"{}\": {}", name, problem.what), problem.hint);
        }
    }
}

/// Passes that show another world than the scene node does: levels they choose are theirs.
std::string worldMakers(const Graph& graph) {
    std::vector<std::string> names;
    for (const GraphNode& node : graph.nodes) {
        const auto makesWorld = [](const Port* port) { return port->role == Port::Role::out && port->type.isSame(PortTypeOf<World>::value); };
        if (!node.off && node.type != "scene" && std::ranges::any_of(node.pass->ports, makesWorld))
            names.push_back(fmt::format("{} ({})", node.name, node.type));
    }
    return fmt::to_string(fmt::join(names, ", "));
}

/// Which levels the graph shows: a graph without a pass that selects them follows the scene file.
std::string levelPolicy(const Graph& graph) {
    if (graph.description.scene.empty()) return "no scene is named";
    const std::string makers = worldMakers(graph);
    try {
        return "by the scene: " + describe(loadScene(graph.description.scene).lod) +
               (makers.empty() ? "" : fmt::format("; passes read the world of {}, which may show others", makers));
    } catch (const Error& error) {
        throw Error(graph.description.sceneWhere, fmt::format("the scene can't be loaded: {}", error.problems()[0].text()));
    }
}

int check(const Options& options) {
    PluginLibraries libraries(options.session.renderer.passes);
    Problems problems;
    const Graph graph = buildGraph(loadDescription(options.session.graph, options.session.changes), libraries);
    std::vector<Source> pinned;
    for (const std::string& dump : options.session.dumps) std::ranges::copy(findSources(graph, dump, Where{"--dump"}), std::back_inserter(pinned));
    if (!options.session.changes.variant) checkVariants(options, graph.description.variants, libraries, problems);
    problems.raise();
    const Plan plan = makePlan(graph, pinned, {.sharing = options.session.shareMemory, .allBarriers = options.session.allBarriers});
    const std::string levels = levelPolicy(graph);
    if (options.json) {
        Json json = facts(plan, graph);
        json["levels"] = levels;
        fmt::print("{}\n", json.dump());
    } else {
        fmt::print("{}levels of detail\n  {}\n", text(plan, graph), levels);
    }
    return 0;
}

}  // namespace

void addCheck(CLI::App& app, std::function<int()>& run) {
    Command command(app, "check", "Validates a graph and its variants and prints the plan; no GPU");
    const auto options = std::make_shared<Options>();
    options->session.addTo(command);
    command.flag("--json", options->json, "prints the plan as JSON, with the graph and all its defaults");
    command.does(run, [options] { return check(*options); });
}

}  // namespace lodestir
