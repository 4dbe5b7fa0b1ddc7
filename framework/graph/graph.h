// SPDX-License-Identifier: MIT
// A checked graph: every pass constructed, every input bound, every parameter set. Still no GPU.
#pragma once
#include <framework/graph/description.h>
#include <framework/pass/pass.h>
#include <framework/graph/plugins.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lodestir {

/// A port of a node: indices into Graph::nodes and Pass::ports.
struct Source {
    int node = -1;
    int port = -1;
    bool prev = false;  ///< last frame's value
    bool operator==(const Source&) const = default;
};

struct GraphNode {
    std::string name, type;
    const Plugin* plugin = nullptr;
    Hash code;  ///< PluginLibraries::codeOf
    std::unique_ptr<Pass> pass;
    std::vector<std::optional<Source>> inputs;  ///< for each of pass->ports; empty for what is no input, and for inputs left unwired
    bool off = false;                           ///< never runs: consumers are already rewired through its bypasses
    bool implied = false;                       ///< the scene node that the file does not name
    Where where;
};

struct Graph {
    Description description;
    std::vector<GraphNode> nodes;  ///< in file order; an implied scene node comes first
    Source show;

    const Port& port(const Source& source) const {
        return *nodes[static_cast<std::size_t>(source.node)].pass->ports[static_cast<std::size_t>(source.port)];
    }
    /// "pass.port", "pass.port@prev"
    LODESTIR_API std::string nameOf(const Source& source) const;
    /// What the input `port` of a node is wired to, as a graph file writes it: a bundle's member is wired with its bundle.
    LODESTIR_API std::string wiringOf(int node, int port) const;
    /// Index of a node, -1: no such.
    LODESTIR_API int find(std::string_view name) const;
    /// The whole graph as a graph file with every default written out: for run.json and image headers. Loads to the same graph again.
    LODESTIR_API Json resolved() const;
};

/// Constructs the passes and checks everything; throws Error with all that is wrong. `libraries` must outlive the graph.
LODESTIR_API Graph buildGraph(Description description, PluginLibraries& libraries);

/// The ports that "pass.port", or "pass" where it has one output, names (for --dump): several where it is a bundle. Follows the bypasses of passes that
/// are off. `@prev` is refused. Error at `where`.
LODESTIR_API std::vector<Source> findSources(const Graph& graph, const std::string& name, const Where& where = {});
/// The same where it has to be one (for --show).
LODESTIR_API Source findSource(const Graph& graph, const std::string& name, const Where& where = {});

/// Sets "pass.param" with the checks of the graph file. Returns false when the value was that already.
LODESTIR_API bool setParameter(Graph& graph, const std::string& name, const Json& value);
/// A JSON value as a parameter's value. Error at value.where() when it has the wrong kind or is out of range; `owner` names the pass.
/// A file is relative to the file that names it, or to the working folder.
LODESTIR_API Value readValue(const Parameter& parameter, const Json& value, std::string_view owner);
/// The inverse of readValue: choices by name, floats with as few digits as give them back.
LODESTIR_API Json writeValue(const Parameter& parameter, const Value& value);

/// Pixels of an image port (an input: its source's) in a frame of `frame` pixels; {0, 0} for an unwired input.
LODESTIR_API glm::uvec2 sizeOf(const Graph& graph, int node, int port, glm::uvec2 frame);
/// Elements of a buffer port, likewise; 1 for a handle, 0 where the pass reserves them as it runs.
LODESTIR_API std::uint32_t countOf(const Graph& graph, int node, int port, glm::uvec2 frame);
/// Bytes of one copy of what a port holds; 0 for an unwired input.
LODESTIR_API std::size_t bytesOf(const Graph& graph, int node, int port, glm::uvec2 frame);

}  // namespace lodestir
