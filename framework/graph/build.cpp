// SPDX-License-Identifier: MIT
// Description -> Graph: constructs the passes, binds their inputs, sets their parameters, and finds everything that is wrong.
#include <framework/gpu/shader.h>
#include <framework/graph/cycles.h>
#include <framework/graph/graph.h>
#include <framework/graph/header.h>
#include <framework/graph/source.h>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <span>

namespace lodestir {
namespace {

constexpr const char* sceneName = "scene";  // the node, and its type, that stand for the scene file

bool isWorld(const Port& port) { return port.type.isSame(PortTypeOf<World>::value); }  // what the scene makes

class GraphBuilder {
public:
    GraphBuilder(Description description, PluginLibraries& libraries) : libraries_(libraries) {
        graph_.description = std::move(description);
    }

    Graph build() {
        makeNodes();
        if (needsScene()) addScene();
        for (std::size_t i = 0; i < nodes().size(); ++i) {
            if (!nodes()[i].pass) continue;
            setParameters(i);
            bindEdges(i);
        }
        bindChained();
        bindSingleHandles();
        for (std::size_t i = 0; i < nodes().size(); ++i) checkInputs(i);
        bypassOffNodes();
        bindShow();
        problems_.raise();  // the rest takes every binding for granted
        for (const std::vector<int>& cycle : findCycles(graph_)) reportCycle(cycle);
        checkSizes();
        problems_.raise();
        return std::move(graph_);
    }

private:
    std::vector<GraphNode>& nodes() { return graph_.nodes; }

    void makeNode(const std::string& name, const std::string& type, const Where& where, const Where& typeWhere, GraphNode& node) {
        node.name = name;
        node.type = type;
        node.where = where;
        problems_.attempt([&] {
            node.plugin = &libraries_.find(type, typeWhere);
            node.code = libraries_.codeOf(type);
            node.pass.reset(node.plugin->create());
            node.pass->shader = node.plugin->shader;
            node.inputs.resize(node.pass->ports.size());
            checkDeclaration(*node.pass, type, typeWhere, problems_);
        });
    }

    void makeNodes() {
        for (const NodeDescription& described : graph_.description.nodes) {
            GraphNode node;
            makeNode(described.name, described.type, described.where, described.typeWhere, node);
            node.off = described.off;
            if (node.off && node.pass && node.pass->bypasses.empty()) {
                problems_.add(described.offWhere, fmt::format("pass \"{}\" can't be off: {} hands nothing through", node.name, node.type));
                node.off = false;
            }
            nodes().push_back(std::move(node));
            descriptions_.push_back(&described);
            places_.emplace_back();
        }
    }

    /// The scene is asked for by name, or a World input that nobody wires finds no pass that could give it one.
    bool needsScene() {
        if (graph_.find(sceneName) >= 0) return false;
        const auto namesScene = [](const EdgeDescription& edge) { return edge.fromNode == sceneName; };
        for (const NodeDescription* described : descriptions_) {
            if (std::ranges::any_of(described->edges, namesScene)) return true;
        }
        const auto makesWorld = [](const GraphNode& node) { return makes(node, PortTypeOf<World>::value); };
        bool produced = false;  // by a pass further up
        const bool producedAnywhere = std::ranges::any_of(nodes(), makesWorld);
        for (std::size_t i = 0; i < nodes().size(); ++i) {
            const bool served = makesWorld(nodes()[i]) ? produced : producedAnywhere;
            if (!served && hasFreeWorldInput(i)) return true;
            produced = produced || makesWorld(nodes()[i]);
        }
        return false;
    }

    static bool makes(const GraphNode& node, const PortType& type) {
        return node.pass && std::ranges::any_of(node.pass->ports, [&](const Port* port) { return isMade(*port) && port->type.isSame(type); });
    }

    bool hasFreeWorldInput(std::size_t i) {
        const auto isFree = [&](const Port* port) {
            return isWorld(*port) && port->isInput() && !port->optional &&
                   std::ranges::find(descriptions_[i]->edges, port->name, &EdgeDescription::port) == descriptions_[i]->edges.end();
        };
        return nodes()[i].pass && std::ranges::any_of(nodes()[i].pass->ports, isFree);
    }

    void addScene() {
        GraphNode node;
        makeNode(sceneName, sceneName, {}, {}, node);
        node.implied = true;
        nodes().insert(nodes().begin(), std::move(node));
        descriptions_.insert(descriptions_.begin(), nullptr);
        places_.insert(places_.begin(), std::map<int, Where>());
    }

    void setParameters(std::size_t i) {
        if (!descriptions_[i]) return;
        for (const Setting& setting : descriptions_[i]->settings) {
            problems_.attempt([&] { setParameter(graph_, nodes()[i].name + "." + setting.name, setting.value); });
        }
    }

    void bindEdges(std::size_t i) {
        if (!descriptions_[i]) return;
        for (const EdgeDescription& edge : descriptions_[i]->edges) problems_.attempt([&] { bindEdge(i, edge); });
    }

    void bindEdge(std::size_t i, const EdgeDescription& edge) {
        GraphNode& node = nodes()[i];
        const std::vector<Wire> inputs = wiresOf(*node.pass, isInput);
        const auto input = std::ranges::find(inputs, edge.port, &Wire::name);
        if (input != inputs.end()) {
            wired_.push_back({int(i), input->first});  // even if its source turns out wrong: one mistake, one message
        } else {
            const std::string what = fmt::format("pass \"{}\": no input \"{}\" on {}", node.name, edge.port, node.type);
            if (const BundlePort* bundle = bundleMeant(edge.port, inputs)) {
                wired_.push_back({int(i), std::ranges::find(inputs, bundle, &Wire::bundle)->first});
                throw Error(edge.portWhere, what, hintOf(*bundle));
            }
            problems_.add(edge.portWhere, what, inputs.empty() ? "it has none" : didYouMean(edge.port, namesOf(inputs)));
        }
        const int from = graph_.find(edge.fromNode);
        if (from < 0) throw Error(edge.where, "no pass \"" + edge.fromNode + "\"", didYouMean(edge.fromNode, nodeNames(nodes())));
        const GraphNode& fromNode = nodes()[std::size_t(from)];
        if (!fromNode.pass) return;  // its type is wrong, which was said
        if (input == inputs.end()) {
            if (!edge.fromPort.empty()) outputNamed(fromNode, edge.fromPort, edge.where);  // is there such a one?
            return;
        }
        const Wire output = edge.fromPort.empty() ? onlyOutputFor(*input, fromNode, edge.where) : outputNamed(fromNode, edge.fromPort, edge.where);
        const std::string start = fmt::format("pass \"{}\": \"{}\" takes {}, but {}.{}{} is ", node.name, input->name(), input->typeText(),
                                              fromNode.name, output.name(), edge.prev ? "@prev" : "");
        if (!input->fits(output)) throw Error(edge.where, start + output.typeText());
        if (input->membersText() != output.membersText()) {
            throw Error(edge.where, start + fmt::format("a {} of other members: {}, not {}", output.typeText(), output.membersText(), input->membersText()),
                        "let both passes include the same header");
        }
        for (int p = 0; p < input->count; ++p) checkTypes({int(i), input->first + p}, {from, output.first + p, edge.prev}, start, edge.where);
        for (int p = 0; p < input->count; ++p) node.inputs[std::size_t(input->first + p)] = Source{from, output.first + p, edge.prev};
        places_[i][input->first] = edge.where;
    }

    /// Two ports whose types have one name: is it one type?
    void checkTypes(const Source& to, const Source& from, const std::string& start, const Where& where) {
        const PortType &wanted = graph_.port(to).type, &given = graph_.port(from).type;
        if (wanted.size != given.size) {
            throw Error(where, start + fmt::format("a {} of another size: {} bytes, not {}", given.text(), given.size, wanted.size),
                        "build both passes against the same header");
        }
        if (wanted.header.empty() && given.header.empty()) return;
        const Path wantedFile = headerFile(to, where), givenFile = headerFile(from, where);
        if (wantedFile == givenFile || hashOf(to, wantedFile) == hashOf(from, givenFile)) return;
        throw Error(
            where,
            start + fmt::format("a {} declared otherwise: {} differs from {}", given.text(), givenFile.string(), wantedFile.string()),
            "let both passes include the same header");
    }

    Path headerFile(const Source& source, const Where& where) {
        const Port& port = graph_.port(source);
        for (const Path& folder : includeFolders(*nodes()[std::size_t(source.node)].plugin)) {
            std::error_code none;
            if (std::filesystem::is_regular_file(folder / port.type.header, none))
                return std::filesystem::weakly_canonical(folder / port.type.header, none);
        }
        throw Error(where, fmt::format("header \"{}\" of {} ({}) is not found", port.type.header, graph_.nameOf(source), port.type.text()));
    }

    const Hash& hashOf(const Source& source, const Path& file) {
        const auto found = hashes_.find(file);
        if (found != hashes_.end()) return found->second;
        return hashes_.emplace(file, gpu::includeClosure(file, includeFolders(*nodes()[std::size_t(source.node)].plugin))).first->second;
    }

    /// Does `node` need, in the same frame, what `other` makes?
    bool dependsOn(int node, int other) const {
        std::vector<bool> seen(graph_.nodes.size());
        std::vector<int> open{node};
        while (!open.empty()) {
            const int at = open.back();
            open.pop_back();
            if (at == other) return true;
            if (seen[std::size_t(at)]) continue;
            seen[std::size_t(at)] = true;
            for (const auto& input : graph_.nodes[std::size_t(at)].inputs) {
                if (input && !input->prev) open.push_back(input->node);
            }
        }
        return false;
    }

    /// An input that has to be wired and that the file doesn't wire, rightly or wrongly.
    bool isFree(std::size_t i, const Wire& wire) const {
        return wire.port().isInput() && !wire.port().optional && std::ranges::find(wired_, Source{int(i), wire.first}) == wired_.end();
    }

    /// Unwired inputs of handles that passes hand on (World) take the last of the file that doesn't depend on them, a pass that makes one itself the one
    /// before itself. "...Prev" inputs take last frame's.
    void bindChained() {
        for (const bool producers : {true, false}) {
            for (std::size_t i = 0; i < nodes().size(); ++i) {
                if (!nodes()[i].pass) continue;
                for (const Wire& wire : wiresOf(*nodes()[i].pass, isInput)) {
                    const PortType& type = wire.port().type;
                    if (type.chained && makes(nodes()[i], type) == producers && isFree(i, wire))
                        nodes()[i].inputs[std::size_t(wire.first)] = lastMade(type, i, wire.name().ends_with("Prev"));
                }
            }
        }
    }

    std::optional<Source> lastMade(const PortType& type, std::size_t consumer, bool prev) {
        const std::size_t end = makes(nodes()[consumer], type) && !prev ? consumer : nodes().size();
        for (std::size_t i = end; i-- > 0;) {
            if (!makes(nodes()[i], type) || (!prev && dependsOn(int(i), int(consumer)))) continue;
            const auto& ports = nodes()[i].pass->ports;
            for (std::size_t p = 0; p < ports.size(); ++p) {
                if (isMade(*ports[p]) && ports[p]->type.isSame(type)) return Source{int(i), int(p), prev};
            }
        }
        return std::nullopt;
    }

    /// Any other unwired struct takes the graph's only output of its type; where there are several, the file has to say which.
    void bindSingleHandles() {
        for (std::size_t i = 0; i < nodes().size(); ++i) {
            if (!nodes()[i].pass) continue;
            for (const Wire& wire : wiresOf(*nodes()[i].pass, isInput)) {
                const PortType& type = wire.port().type;
                if (!isFree(i, wire) || type.kind != PortType::Kind::handle || type.chained) continue;
                const std::vector<Made> made = outputsFor(i, wire);
                if (made.size() == 1) nodes()[i].inputs[std::size_t(wire.first)] = Source{made.front().node, made.front().wire.first};
            }
        }
    }

    void checkInputs(std::size_t i) {
        const GraphNode& node = nodes()[i];
        if (!node.pass || node.off) return;
        for (const Wire& wire : wiresOf(*node.pass, isInput)) {
            if (node.inputs[std::size_t(wire.first)] || !isFree(i, wire)) continue;  // what the file wires wrongly was said
            const std::string candidates = textOf(outputsFor(i, wire));
            problems_.add(node.where,
                          fmt::format("pass \"{}\": input \"{}\" ({}: {}) is not wired", node.name, wire.name(), wire.typeText(), wire.doc()),
                          candidates.empty() ? "no pass of the graph makes one" : "made by: " + candidates);
        }
    }

    struct Made {
        int node;
        Wire wire;
    };

    /// The outputs that would fit.
    std::vector<Made> outputsFor(std::size_t consumer, const Wire& wanted) const {
        std::vector<Made> found;
        for (std::size_t i = 0; i < graph_.nodes.size(); ++i) {
            if (!graph_.nodes[i].pass || dependsOn(int(i), int(consumer))) continue;
            for (const Wire& output : outputsFitting(wanted, *graph_.nodes[i].pass)) found.push_back({int(i), output});
        }
        return found;
    }

    std::string textOf(const std::vector<Made>& made) const {
        constexpr std::size_t listed = 5;
        std::vector<std::string> names;
        for (const Made& m : std::span(made).first(std::min(listed, made.size())))
            names.push_back(fmt::format("{}.{}", graph_.nodes[std::size_t(m.node)].name, m.wire.name()));
        return fmt::format("{}", fmt::join(names, ", "));
    }

    void bypassOffNodes() {
        for (std::size_t i = 0; i < nodes().size(); ++i) {
            GraphNode& node = nodes()[i];
            if (!node.pass || node.off) continue;
            for (const Wire& wire : wiresOf(*node.pass, isInput)) {
                problems_.attempt([&] {
                    for (int p = wire.first; p < wire.first + wire.count; ++p) bypassOffSource(node, std::size_t(p), placeOf(int(i), wire.first));
                });
            }
        }
    }

    void bypassOffSource(GraphNode& node, std::size_t p, const Where& where) {
        if (!node.inputs[p]) return;
        const Source before = *node.inputs[p];
        node.inputs[p] = throughBypasses(nodes(), before, where);
        if (node.inputs[p] || node.pass->ports[p]->optional) return;
        throw Error(where, fmt::format("pass \"{}\" is off, and the input that stands for its \"{}\" is not wired",
                                       nodes()[std::size_t(before.node)].name, graph_.port(before).wire()));
    }

    void bindShow() {
        const Description& d = graph_.description;
        const int node = graph_.find(d.showNode);
        if (node >= 0 && !nodes()[std::size_t(node)].pass) return;
        problems_.attempt([&] { graph_.show = findSource(graph_, d.showPort.empty() ? d.showNode : d.showNode + "." + d.showPort, d.showWhere); });
    }

    /// Told at the edge that runs against the order of the file: most likely the one that was meant to be @prev.
    void reportCycle(const std::vector<int>& cycle) {
        std::vector<std::string> names;
        Where place = nodes()[std::size_t(cycle[0])].where;
        std::string hint;
        for (std::size_t i = 0; i < cycle.size(); ++i) {
            const int from = cycle[i], to = cycle[(i + 1) % cycle.size()];
            names.push_back(nodes()[std::size_t(from)].name);
            const int edge = findInput(to, from, false);
            if (edge < 0) {  // `from` reads the state of `to` before it is changed
                const int reading = findInput(from, to, true);
                const std::string state = graph_.wiringOf(from, reading);
                place = placeOf(from, reading);
                hint = fmt::format("\"{}\" reads \"{}\", which \"{}\" changes in place, and so must come before it; wire an output",
                                   names.back(), state, nodes()[std::size_t(to)].name);
            } else if (to <= from && hint.empty()) {
                place = placeOf(to, edge);
                hint = fmt::format("\"{}@prev\" would read last frame's value", graph_.wiringOf(to, edge));
            }
        }
        names.push_back(names.front());
        problems_.add(place, fmt::format("the passes go in a circle: {}", fmt::join(names, " -> ")), hint);
    }

    /// First input of `node` that takes last frame's, or this frame's, value of `from`; -1: none.
    int findInput(int node, int from, bool prev) {
        const auto& inputs = nodes()[std::size_t(node)].inputs;
        const auto found =
            std::ranges::find_if(inputs, [&](const auto& input) { return input && input->node == from && input->prev == prev; });
        return found == inputs.end() ? -1 : int(found - inputs.begin());
    }

    Where placeOf(int node, int port) const {
        const auto found = places_[std::size_t(node)].find(port);
        return found == places_[std::size_t(node)].end() ? graph_.nodes[std::size_t(node)].where : found->second;
    }

    void checkSizes() {
        problems_.attempt([&] {  // the first that is wrong makes its followers wrong, too
            for (std::size_t i = 0; i < nodes().size(); ++i) {
                for (std::size_t p = 0; p < nodes()[i].pass->ports.size(); ++p) countOf(graph_, int(i), int(p), graph_.description.size);
            }
        });
    }

    PluginLibraries& libraries_;
    Graph graph_;
    Problems problems_;
    std::vector<const NodeDescription*> descriptions_;  // of each node; nullptr for the implied scene
    std::vector<std::map<int, Where>> places_;          // of each node's wired inputs, bundles by their first member
    std::vector<Source> wired_;                         // inputs that the file wires, rightly or wrongly, likewise
    std::map<Path, Hash> hashes_;
};

}  // namespace

Graph buildGraph(Description description, PluginLibraries& libraries) { return GraphBuilder(std::move(description), libraries).build(); }

}  // namespace lodestir
