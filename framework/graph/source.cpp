// SPDX-License-Identifier: MIT
// Finds ports by name and follows bypasses.
#include <framework/graph/source.h>

#include <fmt/format.h>

#include <algorithm>

namespace lodestir {

std::vector<std::string> nodeNames(const std::vector<GraphNode>& nodes) {
    std::vector<std::string> names;
    for (const GraphNode& node : nodes) names.push_back(node.name);
    return names;
}

int onlyOutput(const GraphNode& node, const Where& where) {
    // What a pass keeps for itself is asked for by name where it has an output to give.
    std::vector<std::string> outputs = portNames(*node.pass, [](const Port& port) { return port.role == Port::Role::out; });
    if (outputs.empty()) outputs = portNames(*node.pass, isMade);
    if (outputs.size() == 1) return findPort(*node.pass, outputs[0], isMade);
    if (outputs.empty()) throw Error(where, fmt::format("pass \"{}\" has no output", node.name));
    throw Error(where, fmt::format("pass \"{}\" has {} outputs", node.name, outputs.size()),
                fmt::format("name one: {}.{}", node.name, fmt::join(outputs, fmt::format(", {}.", node.name))));
}

int bypassOf(const Pass& pass, int port) {
    const auto bypass = std::ranges::find(pass.bypasses, pass.ports[std::size_t(port)], &Pass::Bypass::out);
    return bypass == pass.bypasses.end() ? -1 : int(std::ranges::find(pass.ports, bypass->in) - pass.ports.begin());
}

std::optional<Source> throughBypasses(const std::vector<GraphNode>& nodes, Source source, const Where& where) {
    for (std::size_t steps = 0; nodes[std::size_t(source.node)].off; ++steps) {
        const GraphNode& node = nodes[std::size_t(source.node)];
        const std::string name(node.pass->ports[std::size_t(source.port)]->name);
        if (steps > nodes.size())
            throw Error(where, fmt::format("pass \"{}\" is off and its \"{}\" comes back to itself", node.name, name));
        const int in = bypassOf(*node.pass, source.port);
        if (in < 0) {
            throw Error(where, fmt::format("pass \"{}\" is off, and no input stands for its \"{}\"", node.name, name),
                        "wire another source");
        }
        const std::optional<Source>& next = node.inputs[std::size_t(in)];
        if (!next) return std::nullopt;
        if (next->prev && source.prev) {
            throw Error(where,
                        fmt::format("pass \"{}\" is off, and last frame's \"{}\" would be the value of two frames ago", node.name, name));
        }
        source = {next->node, next->port, next->prev || source.prev};
    }
    return source;
}

Source findSource(const Graph& graph, const std::string& name, const Where& where) {
    if (name.ends_with("@prev")) throw Error(where, fmt::format("\"{}\" can't be shown or dumped", name), "name the port without @prev");
    const std::size_t dot = name.find('.');
    const std::string nodeName = name.substr(0, dot);
    const int index = graph.find(nodeName);
    if (index < 0) throw Error(where, "no pass \"" + nodeName + "\"", didYouMean(nodeName, nodeNames(graph.nodes)));
    const GraphNode& node = graph.nodes[std::size_t(index)];
    Source source{index, dot == name.npos ? onlyOutput(node, where) : -1};
    if (source.port < 0) {
        const std::string portName = name.substr(dot + 1);
        const auto any = [](const Port&) { return true; };
        source.port = findPort(*node.pass, portName, isMade);
        if (source.port < 0) source.port = findPort(*node.pass, portName, any);
        if (source.port < 0)
            throw Error(where, fmt::format("pass \"{}\" has no port \"{}\"", nodeName, portName),
                        didYouMean(portName, portNames(*node.pass, any)));
    }
    const bool isInput = graph.port(source).isInput();
    const std::optional<Source> real = isInput ? node.inputs[std::size_t(source.port)] : throughBypasses(graph.nodes, source, where);
    if (!real) throw Error(where, fmt::format("\"{}\" is not wired, so there is nothing to show", graph.nameOf(source)));
    const std::optional<Source> made = isInput ? throughBypasses(graph.nodes, *real, where) : real;
    if (!made) throw Error(where, fmt::format("\"{}\" is not wired, so there is nothing to show", graph.nameOf(source)));
    if (made->prev)
        throw Error(where, fmt::format("\"{}\" is last frame's value", name),
                    fmt::format("name {}", graph.nameOf({made->node, made->port})));
    return *made;
}

}  // namespace lodestir
