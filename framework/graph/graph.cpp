// SPDX-License-Identifier: MIT
// Questions about a graph that was built: names of ports, sizes, the graph with everything written out.
#include <framework/graph/graph.h>
#include <framework/graph/wire.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace lodestir {
namespace {

/// What a port measures, found by walking along `like` and the edges. Through @prev they may go in circles, so steps are counted.
class Measure {
public:
    Measure(const Graph& graph, glm::uvec2 frame) : graph_(graph), frame_(frame) {
        for (const GraphNode& node : graph.nodes) stepsLeft_ += 2 * node.pass->ports.size();  // count() asks size() of the same port
    }

    glm::uvec2 size(int nodeIndex, int portIndex) {
        const Port& port = step(nodeIndex, portIndex);
        if (port.isInput()) {
            const auto& source = graph_.nodes[std::size_t(nodeIndex)].inputs[std::size_t(portIndex)];
            return source ? size(source->node, source->port) : glm::uvec2(0);
        }
        if (port.extent.like.empty()) return scaled(frame_, port.extent.scale);
        const int like = indexOf(nodeIndex, port.extent.like);
        return scaled(isUnwired(nodeIndex, like) ? frame_ : size(nodeIndex, like), port.extent.scale);
    }

    std::uint64_t count(int nodeIndex, int portIndex) {
        const Port& port = step(nodeIndex, portIndex);
        if (port.type.kind == PortType::Kind::handle) return 1;
        if (port.type.kind == PortType::Kind::image) return pixels(size(nodeIndex, portIndex));
        if (port.isInput()) {
            const auto& source = graph_.nodes[std::size_t(nodeIndex)].inputs[std::size_t(portIndex)];
            return source ? count(source->node, source->port) : 0;
        }
        if (port.count.kind == Count::Kind::fixed) return port.count.number;
        if (port.count.kind == Count::Kind::perPixel) return port.count.number * pixels(frame_);
        if (port.count.kind == Count::Kind::reserved) return 0;
        const int like = indexOf(nodeIndex, port.count.like);
        return port.count.number * (isUnwired(nodeIndex, like) ? pixels(frame_) : count(nodeIndex, like));
    }

private:
    static std::uint64_t pixels(glm::uvec2 size) { return std::uint64_t(size.x) * size.y; }
    static glm::uvec2 scaled(glm::uvec2 size, float scale) {
        const auto part = [&](std::uint32_t n) { return std::max(1u, std::uint32_t(std::ceil(double(n) * double(scale)))); };
        return {part(size.x), part(size.y)};
    }

    const Port& step(int nodeIndex, int portIndex) {
        if (stepsLeft_-- == 0) {
            throw Error(
                graph_.nodes[std::size_t(nodeIndex)].where,
                fmt::format("the sizes of {} and of the ports it follows depend on each other", graph_.nameOf({nodeIndex, portIndex})),
                "give one of them a size of its own");
        }
        return *graph_.nodes[std::size_t(nodeIndex)].pass->ports[std::size_t(portIndex)];
    }

    int indexOf(int nodeIndex, std::string_view name) const {
        const auto& ports = graph_.nodes[std::size_t(nodeIndex)].pass->ports;
        return int(std::ranges::find(ports, name, &Port::wire) - ports.begin());
    }

    bool isUnwired(int nodeIndex, int portIndex) const {
        const GraphNode& node = graph_.nodes[std::size_t(nodeIndex)];
        return node.pass->ports[std::size_t(portIndex)]->isInput() && !node.inputs[std::size_t(portIndex)];
    }

    const Graph& graph_;
    glm::uvec2 frame_;
    std::size_t stepsLeft_ = 1;
};

Json settingsOf(const Pass& pass) {
    Json set = Json::object();
    for (const Parameter* parameter : pass.parameters) set[parameter->name] = writeValue(*parameter, parameter->value);
    return set;
}

}  // namespace

std::string Graph::nameOf(const Source& source) const {
    return fmt::format("{}.{}{}", nodes[std::size_t(source.node)].name, port(source).name, source.prev ? "@prev" : "");
}

std::string Graph::wiringOf(int node, int port) const {
    const GraphNode& n = nodes[std::size_t(node)];
    const Source& source = *n.inputs[std::size_t(port)];
    if (!n.pass->ports[std::size_t(port)]->bundle) return nameOf(source);
    return fmt::format("{}.{}{}", nodes[std::size_t(source.node)].name, this->port(source).wire(), source.prev ? "@prev" : "");
}

int Graph::find(std::string_view name) const {
    const auto found = std::ranges::find(nodes, name, &GraphNode::name);
    return found == nodes.end() ? -1 : int(found - nodes.begin());
}

Json Graph::resolved() const {
    Json out = Json::object();
    out["format"] = 1;
    if (!description.about.empty()) out["about"] = description.about;
    if (!description.scene.empty()) out["scene"] = std::filesystem::absolute(description.scene).lexically_normal().string();
    Json size = Json::array();
    size.push(std::int64_t(description.size.x));
    size.push(std::int64_t(description.size.y));
    out["frame"]["size"] = std::move(size);
    out["frame"]["count"] = description.count;
    out["frame"]["seed"] = std::int64_t(description.seed);
    out["passes"] = Json::object();
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        const GraphNode& node = nodes[n];
        Json pass = Json::object();
        pass["type"] = node.type;
        for (const Wire& wire : wiresOf(*node.pass)) {
            if (node.inputs[std::size_t(wire.first)]) pass["in"][wire.name()] = wiringOf(int(n), wire.first);
        }
        if (!node.pass->parameters.empty()) pass["set"] = settingsOf(*node.pass);
        if (node.off) pass["off"] = true;
        out["passes"][node.name] = std::move(pass);
    }
    out["show"] = nameOf(show);
    return out;
}

glm::uvec2 sizeOf(const Graph& graph, int node, int port, glm::uvec2 frame) { return Measure(graph, frame).size(node, port); }

std::uint32_t countOf(const Graph& graph, int node, int port, glm::uvec2 frame) {
    const std::uint64_t count = Measure(graph, frame).count(node, port);
    if (count <= std::numeric_limits<std::uint32_t>::max()) return std::uint32_t(count);
    throw Error(graph.nodes[std::size_t(node)].where,
                fmt::format("{} would hold {} elements in a frame of {} x {}", graph.nameOf({node, port}), count, frame.x, frame.y),
                "shaders count with 32 bits");
}

std::size_t bytesOf(const Graph& graph, int node, int port, glm::uvec2 frame) {
    const Source source{node, port};
    if (graph.port(source).isInput()) {
        const auto& bound = graph.nodes[std::size_t(node)].inputs[std::size_t(port)];
        return bound ? bytesOf(graph, bound->node, bound->port, frame) : 0;
    }
    const Port& made = graph.port(source);
    const std::size_t each = made.type.kind == PortType::Kind::image ? factsOf(made.format).bytes : made.type.size;
    return each * countOf(graph, node, port, frame);
}

}  // namespace lodestir
