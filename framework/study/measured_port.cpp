// SPDX-License-Identifier: MIT
#include <framework/graph/source.h>
#include <framework/study/measured_port.h>

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

}  // namespace lodestir
