// SPDX-License-Identifier: MIT
// A plan in words and as JSON facts.
#include <framework/graph/plan.h>
#include <framework/graph/wire.h>

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

namespace lodestir {
namespace {

std::string bytesText(std::size_t bytes) {
    if (bytes < 1024) return fmt::format("{} B", bytes);
    const char* units[] = {"KiB", "MiB", "GiB", "TiB"};
    double value = double(bytes) / 1024;
    std::size_t unit = 0;
    for (; value >= 1024 && unit < 3; ++unit) value /= 1024;
    return fmt::format("{:.1f} {}", value, units[unit]);
}

std::string sourceOf(const GraphNode& node) {
    const Path file = node.plugin->source;
    std::error_code none;
    const Path nearby = std::filesystem::relative(file, std::filesystem::current_path(none), none);
    return nearby.empty() || nearby.string().starts_with("..") ? file.string() : nearby.string();
}

/// "960 x 540 rgba16f", "518400 x 64 B", "1 x 640 B"
std::string shapeText(const Graph& graph, const PlanResource& r) {
    const Port& port = graph.port({r.node, r.port});
    const glm::uvec2 frame = graph.description.size;
    if (port.count.kind == Count::Kind::reserved) return fmt::format("? x {} B", port.type.size);
    if (port.type.kind != PortType::Kind::image) return fmt::format("{} x {} B", countOf(graph, r.node, r.port, frame), port.type.size);
    const glm::uvec2 size = sizeOf(graph, r.node, r.port, frame);
    return fmt::format("{} x {} {}", size.x, size.y, factsOf(port.format).name);
}

std::string lifeText(const Graph& graph, const PlanResource& r) {
    const Port& port = graph.port({r.node, r.port});
    const bool isState = port.role == Port::Role::state;
    std::string text =
        r.firstStep == r.lastStep ? fmt::format("step {}", r.firstStep + 1) : fmt::format("steps {}..{}", r.firstStep + 1, r.lastStep + 1);
    if (r.history) text = r.copies == 2 ? "two copies (@prev)" : "kept (@prev)";
    if (r.keeps && !r.history) text = isState ? "kept (state)" : "kept (onChange)";
    if (port.count.kind == Count::Kind::reserved) text += ", sized by the pass";
    if (r.pinned) text += ", pinned";
    if (r.group >= 0) text += fmt::format(", shares memory {}", r.group + 1);
    return text;
}

std::size_t ownBytes(const Graph& graph, const PlanResource& r) {
    return bytesOf(graph, r.node, r.port, graph.description.size) * std::size_t(r.copies);
}

std::string edgesText(const Graph& graph, int index) {
    const GraphNode& node = graph.nodes[std::size_t(index)];
    std::vector<std::string> edges;
    for (const Wire& wire : wiresOf(*node.pass)) {
        if (node.inputs[std::size_t(wire.first)]) edges.push_back(fmt::format("{} = {}", wire.name(), graph.wiringOf(index, wire.first)));
    }
    return fmt::format("{}", fmt::join(edges, ", "));
}

}  // namespace

std::string text(const Plan& plan, const Graph& graph) {
    const glm::uvec2 size = graph.description.size;
    const auto barriers = std::ranges::count_if(plan.steps, [](const PlanStep& step) { return !step.barrier.empty(); });
    std::size_t nameWidth = 0, typeWidth = 0, resourceWidth = 0, kindWidth = 0, shapeWidth = 0;
    for (const PlanStep& step : plan.steps) {
        nameWidth = std::max(nameWidth, graph.nodes[std::size_t(step.node)].name.size());
        typeWidth = std::max(typeWidth, graph.nodes[std::size_t(step.node)].type.size());
    }
    for (const PlanResource& r : plan.resources) {
        resourceWidth = std::max(resourceWidth, graph.nameOf({r.node, r.port}).size());
        kindWidth = std::max(kindWidth, graph.port({r.node, r.port}).type.text().size());
        shapeWidth = std::max(shapeWidth, shapeText(graph, r).size());
    }

    std::string out =
        fmt::format("{}: {} steps, {} barriers, {} at {} x {}, shows {}\n", graph.description.file.string(), plan.steps.size(), barriers,
                    bytesText(planBytes(plan, graph, size)), size.x, size.y, graph.nameOf(graph.show));
    for (std::size_t s = 0; s < plan.steps.size(); ++s) {
        const PlanStep& step = plan.steps[s];
        const GraphNode& node = graph.nodes[std::size_t(step.node)];
        if (!step.barrier.empty()) out += fmt::format("       barrier: {}\n", step.barrier);
        out += fmt::format("  {:3}  {:{}}  {:{}}  {}{}\n", s + 1, node.name, nameWidth, node.type, typeWidth, sourceOf(node),
                           step.onChange ? "  (onChange)" : "");
        if (const std::string edges = edgesText(graph, step.node); !edges.empty()) out += "         " + edges + "\n";
    }
    out += "memory\n";
    for (const PlanResource& r : plan.resources) {
        out += fmt::format("  {:{}}  {:{}}  {:{}}  {:>10}  {}\n", graph.nameOf({r.node, r.port}), resourceWidth,
                           graph.port({r.node, r.port}).type.text(), kindWidth, shapeText(graph, r), shapeWidth,
                           bytesText(ownBytes(graph, r)), lifeText(graph, r));
    }
    for (const int index : plan.culled) {
        const GraphNode& node = graph.nodes[std::size_t(index)];
        out += fmt::format("not run: {} ({})\n", node.name, node.off ? "off" : "nothing shown needs it");
    }
    return out;
}

Json facts(const Plan& plan, const Graph& graph) {
    Json out = Json::object();
    out["graph"] = graph.resolved();
    out["show"] = graph.nameOf(graph.show);
    out["steps"] = Json::array();
    for (const PlanStep& step : plan.steps) {
        const GraphNode& node = graph.nodes[std::size_t(step.node)];
        Json fact = Json::object();
        fact["pass"] = node.name;
        fact["type"] = node.type;
        fact["source"] = std::string(node.plugin->source);
        fact["cadence"] = step.onChange ? "onChange" : "everyFrame";
        if (!step.barrier.empty()) fact["barrier"] = step.barrier;
        out["steps"].push(std::move(fact));
    }
    out["memory"] = Json::array();
    for (const PlanResource& r : plan.resources) {
        const Port& port = graph.port({r.node, r.port});
        Json fact = Json::object();
        fact["port"] = graph.nameOf({r.node, r.port});
        fact["type"] = port.type.text();
        if (port.type.kind == PortType::Kind::image) fact["format"] = std::string(factsOf(port.format).name);
        fact["bytes"] = std::int64_t(ownBytes(graph, r));
        fact["steps"].push(r.firstStep);
        fact["steps"].push(r.lastStep);
        fact["history"] = r.history;
        fact["copies"] = r.copies;
        fact["keeps"] = r.keeps;
        if (r.group >= 0) fact["group"] = r.group;
        out["memory"].push(std::move(fact));
    }
    out["bytes"] = std::int64_t(planBytes(plan, graph, graph.description.size));
    out["culled"] = Json::array();
    for (const int index : plan.culled) out["culled"].push(graph.nodes[std::size_t(index)].name);
    return out;
}

}  // namespace lodestir
