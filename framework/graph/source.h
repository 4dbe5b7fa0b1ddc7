// SPDX-License-Identifier: MIT
// From names to ports: what "pass.port" and "pass" mean in a graph, and where a value really comes from when passes are off.
#pragma once
#include <framework/graph/graph.h>
#include <framework/graph/wire.h>

#include <optional>
#include <string>
#include <vector>

namespace lodestir {

std::vector<std::string> nodeNames(const std::vector<GraphNode>& nodes);

/// The output of that name: of a port, a bundle, or a bundle's member ("paths.reservoirs"). Error at `where`.
Wire outputNamed(const GraphNode& node, const std::string& name, const Where& where);
/// The only output of a node, for references that name the pass alone. Error at `where` when there is none or more than one.
Wire onlyOutput(const GraphNode& node, const Where& where);
/// The outputs that `wanted` takes, members of bundles included.
std::vector<Wire> outputsFitting(const Wire& wanted, const Pass& pass);
/// The only one of them, for wires that name the pass alone. Error at `where` when there is none or more than one.
Wire onlyOutputFor(const Wire& wanted, const GraphNode& node, const Where& where);

/// The bundle among `wires` that has a member who might be meant by `name`; null: none.
const BundlePort* bundleMeant(std::string_view name, const std::vector<Wire>& wires);
/// "reservoirs and samples travel together: wire \"paths\"", with what comes before the bundle's name.
std::string hintOf(const BundlePort& bundle, const std::string& prefix = {});

/// The input that stands for an output when its pass is off; -1: none does.
int bypassOf(const Pass& pass, int port);

/// Where the value of `source` really comes from when passes on the way are off. Empty: from an input that is unwired.
std::optional<Source> throughBypasses(const std::vector<GraphNode>& nodes, Source source, const Where& where);

}  // namespace lodestir
