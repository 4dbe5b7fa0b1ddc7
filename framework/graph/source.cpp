// SPDX-License-Identifier: MIT
// Finds ports by name and follows bypasses.
#include <framework/graph/source.h>

#include <fmt/format.h>

#include <algorithm>
#include <functional>

namespace lodestir {

std::vector<std::string> nodeNames(const std::vector<GraphNode>& nodes) {
    std::vector<std::string> names;
    for (const GraphNode& node : nodes) names.push_back(node.name);
    return names;
}

namespace {

/// What a pass keeps for itself is asked for by name where it has an output to give.
std::vector<Wire> outputsOf(const Pass& pass) {
    const std::vector<Wire> outputs = wiresOf(pass, [](const Port& port) { return port.role == Port::Role::out; });
    return outputs.empty() ? wiresOf(pass, isMade) : outputs;
}

std::string choiceOf(const GraphNode& node, const std::vector<Wire>& wires) {
    return fmt::format("name one: {}.{}", node.name, fmt::join(namesOf(wires), fmt::format(", {}.", node.name)));
}

/// With the members of bundles behind them.
std::vector<Wire> withMembers(std::vector<Wire> wires) {
    for (std::size_t i = 0, end = wires.size(); i < end; ++i) {
        const std::vector<Wire> members = membersOf(wires[i]);
        wires.insert(wires.end(), members.begin(), members.end());
    }
    return wires;
}

/// The wire of that name, an output before an input of the same; `first` is -1 where there is none.
template <class P> Wire findWire(const Pass& pass, std::string_view name, const P& which) {
    const std::vector<Wire> wires = withMembers(wiresOf(pass, which));
    const auto found = std::ranges::find(wires, name, &Wire::name);
    return found == wires.end() ? Wire{} : *found;
}

}  // namespace

Wire outputNamed(const GraphNode& node, const std::string& name, const Where& where) {
    const Wire found = findWire(*node.pass, name, isMade);
    if (found.first >= 0) return found;
    const std::vector<Wire> outputs = wiresOf(*node.pass, isMade);
    const BundlePort* bundle = bundleMeant(name, outputs);
    throw Error(where, fmt::format("pass \"{}\" has no output \"{}\"", node.name, name),
                bundle ? hintOf(*bundle, node.name + ".") : outputs.empty() ? "it has none" : didYouMean(name, namesOf(outputs)));
}

Wire onlyOutput(const GraphNode& node, const Where& where) {
    const std::vector<Wire> outputs = outputsOf(*node.pass);
    if (outputs.size() == 1) return outputs.front();
    if (outputs.empty()) throw Error(where, fmt::format("pass \"{}\" has no output", node.name));
    throw Error(where, fmt::format("pass \"{}\" has {} outputs", node.name, outputs.size()), choiceOf(node, outputs));
}

std::vector<Wire> outputsFitting(const Wire& wanted, const Pass& pass) {
    std::vector<Wire> fitting = withMembers(wiresOf(pass, isMade));
    std::erase_if(fitting, [&](const Wire& output) { return !wanted.fits(output); });
    return fitting;
}

Wire onlyOutputFor(const Wire& wanted, const GraphNode& node, const Where& where) {
    std::vector<Wire> fitting = outputsFitting(wanted, *node.pass);
    // What a pass keeps for itself is asked for by name where it has an output to give.
    const auto isOut = [](const Wire& wire) { return wire.port().role == Port::Role::out; };
    if (std::ranges::any_of(fitting, isOut)) std::erase_if(fitting, std::not_fn(isOut));
    const std::vector<Wire> outputs = outputsOf(*node.pass);
    if (fitting.empty() && outputs.size() > 1) {
        std::vector<std::string> made;
        for (const Wire& output : outputs) made.push_back(fmt::format("{}.{} ({})", node.name, output.name(), output.typeText()));
        throw Error(where, fmt::format("pass \"{}\" has no output of type {}", node.name, wanted.typeText()), fmt::format("it has {}", fmt::join(made, ", ")));
    }
    if (fitting.empty()) return onlyOutput(node, where);  // its type will be what is wrong
    if (fitting.size() == 1) return fitting.front();
    throw Error(where, fmt::format("pass \"{}\" has {} outputs of type {}", node.name, fitting.size(), wanted.typeText()), choiceOf(node, fitting));
}

const BundlePort* bundleMeant(std::string_view name, const std::vector<Wire>& wires) {
    const auto isMeant = [&](const BundlePort::Member& member) { return name == member.inBundle || name == member.name || name == member.identifier(); };
    for (const Wire& wire : wires) {
        if (wire.bundle && std::ranges::any_of(wire.bundle->members, isMeant)) return wire.bundle;
    }
    return nullptr;
}

std::string hintOf(const BundlePort& bundle, const std::string& prefix) {
    std::vector<std::string_view> members;
    for (const BundlePort::Member& member : bundle.members) members.push_back(member.inBundle);
    return fmt::format("{} travel together: wire \"{}{}\"", fmt::join(members, " and "), prefix, bundle.name);
}

int bypassOf(const Pass& pass, int port) {
    const auto bypass = std::ranges::find(pass.bypasses, pass.ports[std::size_t(port)], &Pass::Bypass::out);
    return bypass == pass.bypasses.end() ? -1 : int(std::ranges::find(pass.ports, bypass->in) - pass.ports.begin());
}

std::optional<Source> throughBypasses(const std::vector<GraphNode>& nodes, Source source, const Where& where) {
    for (std::size_t steps = 0; nodes[std::size_t(source.node)].off; ++steps) {
        const GraphNode& node = nodes[std::size_t(source.node)];
        const std::string name(node.pass->ports[std::size_t(source.port)]->wire());
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

namespace {

/// A wire to look at: an output, else whatever has the name.
Wire anyWire(const GraphNode& node, const std::string& name, const Where& where) {
    const auto any = [](const Port&) { return true; };
    Wire wire = findWire(*node.pass, name, isMade);
    if (wire.first < 0) wire = findWire(*node.pass, name, any);
    if (wire.first >= 0) return wire;
    const std::vector<Wire> all = withMembers(wiresOf(*node.pass));
    const auto member = std::ranges::find_if(all, [&](const Wire& w) { return w.name().ends_with("." + name); });
    throw Error(where, fmt::format("pass \"{}\" has no port \"{}\"", node.name, name),
                member == all.end() ? didYouMean(name, namesOf(all)) : fmt::format("did you mean \"{}\"?", member->name()));
}

/// The port whose content a look at `source` shows: an input is what it is wired to, a pass that is off is what it hands through. `whole`: it is a
/// member of a bundle that was asked for as a whole.
Source madeAt(const Graph& graph, const Source& source, const std::string& name, bool whole, const Where& where) {
    const bool isInput = graph.port(source).isInput();
    const std::optional<Source> real =
        isInput ? graph.nodes[std::size_t(source.node)].inputs[std::size_t(source.port)] : throughBypasses(graph.nodes, source, where);
    const std::optional<Source> made = isInput && real ? throughBypasses(graph.nodes, *real, where) : real;
    if (!made) throw Error(where, fmt::format("\"{}\" is not wired, so there is nothing to show", graph.nameOf(source)));
    if (made->prev) {
        const GraphNode& maker = graph.nodes[std::size_t(made->node)];
        const std::string shown = whole ? fmt::format("{}.{}", maker.name, wireOf(*maker.pass, made->port).name()) : graph.nameOf({made->node, made->port});
        throw Error(where, fmt::format("\"{}\" is last frame's value", name), "name " + shown);
    }
    return *made;
}

}  // namespace

std::vector<Source> findSources(const Graph& graph, const std::string& name, const Where& where) {
    if (name.ends_with("@prev")) throw Error(where, fmt::format("\"{}\" can't be shown or dumped", name), "name the port without @prev");
    const std::size_t dot = name.find('.');
    const std::string nodeName = name.substr(0, dot);
    const int index = graph.find(nodeName);
    if (index < 0) throw Error(where, "no pass \"" + nodeName + "\"", didYouMean(nodeName, nodeNames(graph.nodes)));
    const GraphNode& node = graph.nodes[std::size_t(index)];
    const Wire wire = dot == name.npos ? onlyOutput(node, where) : anyWire(node, name.substr(dot + 1), where);
    std::vector<Source> sources;
    for (int i = 0; i < wire.count; ++i) sources.push_back(madeAt(graph, {index, wire.first + i}, name, wire.bundle != nullptr, where));
    return sources;
}

Source findSource(const Graph& graph, const std::string& name, const Where& where) {
    const std::vector<Source> sources = findSources(graph, name, where);
    if (sources.size() == 1) return sources.front();
    std::vector<std::string> names;
    for (const Source& source : sources) names.push_back(graph.nameOf(source));
    throw Error(where, fmt::format("\"{}\" is a bundle of {} ports", name, names.size()), fmt::format("name one: {}", fmt::join(names, ", ")));
}

}  // namespace lodestir
