// SPDX-License-Identifier: MIT
#include <framework/graph/source.h>
#include <framework/study/measured_port.h>

#include <fmt/format.h>

namespace lodestir {

Source measuredPort(const Graph& graph, const StudyGraph& choice) {
    if (!choice.port.empty()) return findSource(graph, choice.port, choice.portWhere);
    for (Source source = graph.show;;) {
        const GraphNode& node = graph.nodes[std::size_t(source.node)];
        const int in = node.pass->forDisplay ? bypassOf(*node.pass, source.port) : -1;
        if (in < 0 || !node.inputs[std::size_t(in)]) return source;
        source = *node.inputs[std::size_t(in)];
    }
}

Source counterPort(const Graph& graph, const Counter& counter) {
    const Source source = findSource(graph, counter.port, counter.where);
    const Port& port = graph.port(source);
    const bool isCounted = port.type.kind == PortType::Kind::buffer && port.type.name == "uint";
    if (!isCounted || port.count.kind != Count::Kind::fixed || port.count.number > 2)
        throw Error(counter.where, fmt::format("{} is no number", counter.port), "a count is read from a buffer of one uint, or of two as 64 bits");
    return source;
}

}  // namespace lodestir
