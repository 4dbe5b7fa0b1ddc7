// SPDX-License-Identifier: MIT
#include <framework/app/view/graph_edit.h>

#include <fmt/format.h>

#include <algorithm>

namespace lodestir {
namespace {

constexpr const char* sceneType = "scene";

bool isHandle(const Wire& wire) { return !wire.bundle && wire.port().type.kind == PortType::Kind::handle; }
bool isWorld(const Wire& wire) { return isHandle(wire) && wire.port().type.isSame(PortTypeOf<World>::value); }
bool isPrevious(std::string_view input) { return input.ends_with("Prev"); }

const GraphNode& nodeAt(const Graph& graph, int node) { return graph.nodes[std::size_t(node)]; }

/// Of a pass that the file names; null for the scene that it doesn't.
const NodeDescription* describedAs(const Graph& graph, std::string_view name) {
    const auto& nodes = graph.description.nodes;
    const auto found = std::ranges::find(nodes, name, &NodeDescription::name);
    return found == nodes.end() ? nullptr : &*found;
}

std::string textOf(const std::string& pass, std::string_view output, bool prev) { return fmt::format("{}.{}{}", pass, output, prev ? "@prev" : ""); }
std::string textOf(const EdgeDescription& edge) { return edge.fromNode + (edge.fromPort.empty() ? "" : "." + edge.fromPort) + (edge.prev ? "@prev" : ""); }

/// What a pass keeps for itself is asked for by name where it has an output to give.
std::vector<Wire> preferred(std::vector<Wire> outputs) {
    const auto isOut = [](const Wire& wire) { return wire.port().role == Port::Role::out; };
    if (std::ranges::any_of(outputs, isOut)) std::erase_if(outputs, [&](const Wire& wire) { return !isOut(wire); });
    return outputs;
}

Wire outputOf(const GraphNode& from, const EdgeDescription& edge, const Wire& input) {
    return edge.fromPort.empty() ? onlyOutputFor(input, from, edge.where) : outputNamed(from, edge.fromPort, edge.where);
}

/// For each node, whether it needs in the same frame what `node` makes; it itself does, too.
std::vector<bool> dependentsOf(const Graph& graph, int node) {
    std::vector<std::pair<int, int>> edges;
    for (std::size_t n = 0; n < graph.nodes.size(); ++n)
        for (const Wire& input : wiresOf(*graph.nodes[n].pass, isInput)) {
            const std::optional<Feed> feed = feedOf(graph, int(n), input);
            if (feed && !feed->prev) edges.emplace_back(feed->node, int(n));
        }
    std::vector<bool> dependents(graph.nodes.size());
    std::vector<int> open{node};
    while (!open.empty()) {
        const int at = open.back();
        open.pop_back();
        if (dependents[std::size_t(at)]) continue;
        dependents[std::size_t(at)] = true;
        for (const auto& [from, to] : edges)
            if (from == at) open.push_back(to);
    }
    return dependents;
}

/// An edge that the file has from a pass to another one, or to itself.
struct Use {
    int consumer = -1;
    Wire input, output;
    const EdgeDescription* edge = nullptr;
};
std::vector<Use> usesOf(const Graph& graph, int node) {
    std::vector<Use> uses;
    const GraphNode& from = nodeAt(graph, node);
    for (const NodeDescription& consumer : graph.description.nodes)
        for (const EdgeDescription& edge : consumer.edges) {
            if (edge.fromNode != from.name) continue;
            const int c = graph.find(consumer.name);
            const std::vector<Wire> inputs = wiresOf(*nodeAt(graph, c).pass, isInput);
            const Wire input = *std::ranges::find(inputs, edge.port, &Wire::name);
            uses.push_back({c, input, outputOf(from, edge, input), &edge});
        }
    return uses;
}

/// What a pass hands through as `output` when it is off, in words; empty: nothing, or the value of two frames ago.
std::string handedThrough(const Graph& graph, int node, const Wire& output, bool prev) {
    const Pass& pass = *nodeAt(graph, node).pass;
    const int in = bypassOf(pass, output.first);
    if (in < 0) return {};
    const Wire input = wireOf(pass, in);
    const std::optional<Feed> feed = feedOf(graph, node, input);
    if (!feed || feed->node == node || (feed->prev && prev)) return {};
    const bool member = input.bundle && !output.bundle;
    const Wire from = member ? Wire{feed->output.pass, feed->output.first + in - input.first} : feed->output;
    return textOf(nodeAt(graph, feed->node).name, from.name(), feed->prev || prev);
}

bool isAlike(const Parameter& a, const Parameter& b) {
    return a.name == b.name && a.initial.index() == b.initial.index() && a.low == b.low && a.high == b.high && a.choices == b.choices && a.isFile == b.isFile;
}

/// The output of another pass that takes the place of one: of the same name, or the only one of its type.
std::optional<Wire> counterpart(const Wire& output, const Pass& other) {
    const std::vector<Wire> fitting = preferred(outputsFitting(output, other));
    const auto named = std::ranges::find(fitting, output.name(), &Wire::name);
    if (named != fitting.end()) return *named;
    return fitting.size() == 1 ? std::optional(fitting.front()) : std::nullopt;
}

/// Is there one without the pass for a handle that the graph binds by itself?
bool isMadeElsewhere(const Graph& graph, int node, const Wire& handle) {
    if (isWorld(handle)) return true;  // the scene's
    std::size_t made = 0;
    const std::vector<bool> dependents = dependentsOf(graph, node);
    for (std::size_t n = 0; n < graph.nodes.size(); ++n)
        if (!dependents[n]) made += outputsFitting(handle, *graph.nodes[n].pass).size();
    return handle.port().type.chained ? made > 0 : made == 1;
}

/// The wiring of a pass of another type at the place of a node.
class Rewiring {
public:
    Rewiring(const Graph& graph, int node, const PassType& type) : graph_(graph), node_(node), type_(type) {}

    /// Writes what changes into `patch`; false where it can't be done.
    bool into(Json& patch) {
        for (const Use& use : usesOf(graph_, node_)) {
            if (use.consumer != node_ && !moveUse(use, patch)) return false;
        }
        return keepsHandles() && moveShow(patch) && feed(patch["passes"][name()]["in"]);
    }

private:
    const std::string& name() const { return nodeAt(graph_, node_).name; }

    bool moveUse(const Use& use, Json& patch) const {
        const std::optional<Wire> output = counterpart(use.output, *type_.pass);
        if (!output) return false;
        const bool stays = use.edge->fromPort.empty() ? preferred(outputsFitting(use.input, *type_.pass)).size() == 1 : output->name() == use.output.name();
        if (!stays) patch["passes"][nodeAt(graph_, use.consumer).name]["in"][use.edge->port] = textOf(name(), output->name(), use.edge->prev);
        return true;
    }

    /// What others take by itself, because there is one of it, there is one of after it.
    bool keepsHandles() const {
        for (std::size_t n = 0; n < graph_.nodes.size(); ++n)
            for (const Wire& input : wiresOf(*graph_.nodes[n].pass, isInput)) {
                if (int(n) == node_ || !isHandle(input) || input.port().type.chained) continue;
                const std::optional<Feed> feed = feedOf(graph_, int(n), input);
                if (!feed || feed->written) continue;
                if (outputsFitting(input, *type_.pass).size() != (feed->node == node_ ? 1u : 0u)) return false;
            }
        return true;
    }

    bool moveShow(Json& patch) const {
        const Description& d = graph_.description;
        if (d.showNode != name()) return true;
        const Wire shown = d.showPort.empty() ? onlyOutput(nodeAt(graph_, node_), d.showWhere) : outputNamed(nodeAt(graph_, node_), d.showPort, d.showWhere);
        const std::optional<Wire> output = counterpart(shown, *type_.pass);
        if (output) patch["show"] = textOf(name(), output->name(), false);
        return output.has_value();
    }

    bool feed(Json& in) {
        const NodeDescription& described = *describedAs(graph_, name());
        const std::vector<Wire> before = wiresOf(*nodeAt(graph_, node_).pass, isInput);
        for (const EdgeDescription& edge : described.edges) {
            in[edge.port] = Json();  // unless it is taken below
            const Wire input = *std::ranges::find(before, edge.port, &Wire::name);
            std::string text = textOf(edge);
            if (edge.fromNode == name()) {
                const std::optional<Wire> own = counterpart(outputOf(nodeAt(graph_, node_), edge, input), *type_.pass);
                if (!own) continue;
                text = textOf(name(), own->name(), edge.prev);
            }
            given_.push_back({input, text});
        }
        const std::vector<Wire> inputs = wiresOf(*type_.pass, isInput);
        for (const Wire& input : inputs) {
            const auto same = std::ranges::find_if(given_, [&](const Given& g) { return g.input.name() == input.name() && input.fits(g.input); });
            if (same != given_.end()) take(*same, input, in);
        }
        for (const Wire& input : inputs) {
            if (input.port().optional || taken_.contains(input.name())) continue;
            const auto fits = [&](const Given& g) { return !g.isTaken && input.fits(g.input); };
            const auto free = std::ranges::find_if(given_, fits);
            if (free != given_.end())
                take(*free, input, in);
            else if (!(isHandle(input) && isMadeElsewhere(graph_, node_, input)) && !takeLastFrames(input, in))
                return false;
        }
        return true;
    }

    struct Given {
        Wire input;  ///< of the old pass
        std::string text;
        bool isTaken = false;
    };
    void take(Given& given, const Wire& input, Json& in) {
        given.isTaken = true;
        taken_[input.name()] = given.text;
        in[input.name()] = given.text;
    }
    /// "hitsPrev" takes last frame's of what "hits" takes.
    bool takeLastFrames(const Wire& input, Json& in) {
        if (!isPrevious(input.name())) return false;
        const auto present = taken_.find(input.name().substr(0, input.name().size() - 4));
        if (present == taken_.end() || present->second.ends_with("@prev")) return false;
        in[input.name()] = present->second + "@prev";
        return true;
    }

    const Graph& graph_;
    int node_;
    const PassType& type_;
    std::vector<Given> given_;
    std::map<std::string_view, std::string> taken_;  ///< by input of the new pass
};

/// What a parameter is set to passes to the other pass where that has the same one.
void keepSettings(const GraphNode& node, const NodeDescription& described, const Pass& next, Json& set) {
    for (const Setting& setting : described.settings) set[setting.name] = Json();
    for (const Parameter* parameter : node.pass->parameters) {
        const bool isSet =
            parameter->value != parameter->initial || std::ranges::find(described.settings, parameter->name, &Setting::name) != described.settings.end();
        if (isSet && std::ranges::any_of(next.parameters, [&](const Parameter* other) { return isAlike(*parameter, *other); }))
            set[parameter->name] = writeValue(*parameter, parameter->value);
    }
}

/// All outputs of the graph that fit an input of a pass that isn't in it yet.
std::vector<std::string> candidatesFor(const Graph& graph, const Wire& input) {
    std::vector<std::string> texts;
    for (const GraphNode& node : graph.nodes)
        for (const Wire& output : preferred(outputsFitting(input, *node.pass))) texts.push_back(textOf(node.name, output.name(), isPrevious(input.name())));
    return texts;
}

/// Images are alike and mean everything: one that needn't be wired stays unwired, as do handles that the graph binds by itself.
bool isWiredWhenAdded(const Wire& input) {
    if (isHandle(input)) return input.port().optional && !input.port().type.chained;
    return !input.port().optional || input.bundle || input.port().type.kind == PortType::Kind::buffer;
}

}  // namespace

std::optional<Feed> feedOf(const Graph& graph, int node, const Wire& input) {
    const GraphNode& consumer = nodeAt(graph, node);
    if (const NodeDescription* described = describedAs(graph, consumer.name)) {
        const auto edge = std::ranges::find(described->edges, input.name(), &EdgeDescription::port);
        if (edge != described->edges.end()) {
            const int from = graph.find(edge->fromNode);
            return Feed{from, outputOf(nodeAt(graph, from), *edge, input), edge->prev, true};
        }
    }
    const std::optional<Source>& source = consumer.inputs[std::size_t(input.first)];
    if (!source) return std::nullopt;
    return Feed{source->node, wireOf(*nodeAt(graph, source->node).pass, source->port), source->prev, false};
}

std::vector<Offer> offersFor(const Graph& graph, int node, const Wire& input) {
    std::vector<Offer> offers;
    const std::optional<Feed> before = feedOf(graph, node, input);
    const std::vector<bool> dependents = dependentsOf(graph, node);
    for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
        const Pass& pass = *graph.nodes[n].pass;
        const std::vector<Wire> fitting = outputsFitting(input, pass);
        if (fitting.empty()) continue;
        const bool prev = isPrevious(input.name()) || (before && before->prev) || dependents[n];
        for (const Wire& output : fitting) {
            const int whole = wireOf(pass, output.first).first;
            if (std::ranges::any_of(offers, [&](const Offer& o) { return o.node == int(n) && o.port == whole; })) continue;  // its first member will do
            offers.push_back({int(n), whole, textOf(graph.nodes[n].name, output.name(), prev)});
        }
    }
    return offers;
}

std::vector<Question> questionsOf(const Graph& graph, const PassType& type) {
    std::vector<Question> questions;
    for (const Wire& input : wiresOf(*type.pass, isInput)) {
        if (input.port().optional || !isWiredWhenAdded(input)) continue;
        std::vector<std::string> answers = candidatesFor(graph, input);
        if (answers.size() > 1) questions.push_back({std::string(input.name()), std::move(answers)});
    }
    return questions;
}

Json turnPatch(const std::string& pass, bool off) {
    Json patch;
    patch["passes"][pass]["off"] = off ? Json(true) : Json();
    return patch;
}

Json wirePatch(const std::string& pass, const std::string& input, const std::string& from) {
    Json patch;
    patch["passes"][pass]["in"][input] = from.empty() ? Json() : Json(from);
    return patch;
}

Json removalPatch(const Graph& graph, int node) {
    const GraphNode& removed = nodeAt(graph, node);
    Json patch;
    patch["passes"][removed.name] = Json();
    Problems problems;
    for (const Use& use : usesOf(graph, node)) {
        if (use.consumer == node) continue;
        const std::string& consumer = nodeAt(graph, use.consumer).name;
        const std::string instead = handedThrough(graph, node, use.output, use.edge->prev);
        if (instead.empty() && !use.input.port().optional && !isHandle(use.input))
            problems.add({}, fmt::format("pass \"{}\" needs {} as its \"{}\"", consumer, textOf(*use.edge), use.edge->port), "wire that to another first");
        patch["passes"][consumer]["in"][use.edge->port] = instead.empty() ? Json() : Json(instead);
    }
    const Description& d = graph.description;
    if (d.showNode == removed.name) {
        const Wire shown = d.showPort.empty() ? onlyOutput(removed, d.showWhere) : outputNamed(removed, d.showPort, d.showWhere);
        const std::string instead = handedThrough(graph, node, shown, false);
        if (instead.empty() || instead.ends_with("@prev")) problems.add({}, fmt::format("\"{}\" is what the graph shows", removed.name));
        patch["show"] = instead;
    }
    problems.raise();
    return patch;
}

std::optional<Json> swapPatch(const Graph& graph, int node, const PassType& type) {
    const GraphNode& before = nodeAt(graph, node);
    const NodeDescription* described = describedAs(graph, before.name);
    if (!described || before.type == sceneType || type.type == sceneType || type.type == before.type) return std::nullopt;
    Json patch;
    Json& pass = patch["passes"][before.name];
    pass["type"] = type.type;
    pass["in"] = Json::object();
    pass["set"] = Json::object();
    keepSettings(before, *described, *type.pass, pass["set"]);
    if (before.off && type.pass->bypasses.empty()) pass["off"] = Json();
    if (!Rewiring(graph, node, type).into(patch)) return std::nullopt;
    return patch;
}

Json additionPatch(const Graph& graph, const PassType& type, const std::map<std::string, std::string>& answers) {
    Json patch;
    Json& pass = patch["passes"][nameFor(graph, type.type)];
    pass["type"] = type.type;
    for (const Wire& input : wiresOf(*type.pass, isInput)) {
        if (!isWiredWhenAdded(input)) continue;
        const auto answer = answers.find(std::string(input.name()));
        const std::vector<std::string> candidates = candidatesFor(graph, input);
        if (answer != answers.end())
            pass["in"][input.name()] = answer->second;
        else if (candidates.size() == 1)
            pass["in"][input.name()] = candidates.front();
    }
    return patch;
}

std::string nameFor(const Graph& graph, const std::string& type) {
    const std::string stem = type.substr(type.find('.') + 1);
    std::string name = stem;
    for (int number = 2; graph.find(name) >= 0 || name == "frame"; ++number) name = fmt::format("{}_{}", stem, number);
    return name;
}

Json worldPatch(const Graph& graph, const std::string& name, const WorldPass& pass) {
    const auto scene = std::ranges::find(graph.nodes, sceneType, &GraphNode::type);
    if (scene == graph.nodes.end()) throw Error("no pass of this graph takes the scene's World, so that nobody would see this edit");
    Json patch;
    // What the graph binds by itself is said from here on: the new pass comes last in the file, and unwired inputs would take its World, whosever they took.
    for (std::size_t n = 0; n < graph.nodes.size(); ++n)
        for (const Wire& input : wiresOf(*graph.nodes[n].pass, isInput)) {
            if (!isWorld(input)) continue;
            const std::optional<Feed> feed = feedOf(graph, int(n), input);
            if (!feed) continue;
            const GraphNode& from = nodeAt(graph, feed->node);
            if (from.type == sceneType) patch["passes"][graph.nodes[n].name]["in"][input.name()] = textOf(name, "world", feed->prev);
            else if (!feed->written) patch["passes"][graph.nodes[n].name]["in"][input.name()] = textOf(from.name, feed->output.name(), feed->prev);
        }
    Json& made = patch["passes"][name];
    made["type"] = pass.type;
    made["in"]["world"] = scene->name;
    if (pass.ownPrevious) made["in"]["worldPrev"] = textOf(name, "world", true);
    made["set"] = pass.set;
    return patch;
}

}  // namespace lodestir
