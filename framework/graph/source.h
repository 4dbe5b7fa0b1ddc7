// SPDX-License-Identifier: MIT
// From names to ports: what "pass.port" and "pass" mean in a graph, and where a value really comes from when passes are off.
#pragma once
#include <framework/graph/graph.h>

#include <optional>
#include <string>
#include <vector>

namespace lodestir {

/// Can another pass read it? (Scratch can only be shown or dumped.)
inline bool isMade(const Port& port) { return port.role == Port::Role::out || port.role == Port::Role::state; }

/// Index of the port of that name for which fits(port) holds, -1: none.
template <class P> int findPort(const Pass& pass, std::string_view name, const P& fits) {
    for (std::size_t i = 0; i < pass.ports.size(); ++i) {
        if (pass.ports[i]->name == name && fits(*pass.ports[i])) return int(i);
    }
    return -1;
}

template <class P> std::vector<std::string> portNames(const Pass& pass, const P& fits) {
    std::vector<std::string> names;
    for (const Port* port : pass.ports) {
        if (fits(*port)) names.emplace_back(port->name);
    }
    return names;
}

std::vector<std::string> nodeNames(const std::vector<GraphNode>& nodes);

/// The only output of a node, for references that name the pass alone. Error at `where` when there is none or more than one.
int onlyOutput(const GraphNode& node, const Where& where);

/// The input that stands for an output when its pass is off; -1: none does.
int bypassOf(const Pass& pass, int port);

/// Where the value of `source` really comes from when passes on the way are off. Empty: from an input that is unwired.
std::optional<Source> throughBypasses(const std::vector<GraphNode>& nodes, Source source, const Where& where);

}  // namespace lodestir
