// SPDX-License-Identifier: MIT
#include <framework/study/pixel_filter.h>

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

namespace lodestir {
namespace {

/// The value of a choice, by its name; empty where the pass has no such parameter.
std::string choiceOf(const Pass& pass, std::string_view name) {
    const auto found = std::ranges::find(pass.parameters, name, &Parameter::name);
    if (found == pass.parameters.end() || !(*found)->isChoice()) return {};
    return std::string((*found)->choices[std::size_t(std::get<int>((*found)->value))]);
}

bool isHits(const Port& port) { return port.type.kind == PortType::Kind::buffer && port.type.name == "PrimaryHit"; }

/// Walks from a port to the passes whose camera rays its light comes along. Hits guide reuse as a rule: which pixels are alike, where they were. Light is
/// seen by them where nothing that a pass is given is light already.
class FilmFinder {
public:
    explicit FilmFinder(const Graph& graph) : graph_(graph), lit_(graph.nodes.size()) {}

    std::set<std::string> films;

    /// Whether any light comes from the node.
    bool visit(int index) {
        std::optional<bool>& lit = lit_[std::size_t(index)];
        if (!lit) lit = isLit(graph_.nodes[std::size_t(index)]);
        return *lit;
    }

private:
    bool isLit(const GraphNode& node) {
        const std::string camera = choiceOf(*node.pass, "camera"), film = choiceOf(*node.pass, "film");
        if (camera == "path")
            films.insert("random");  // of initial_sampling: each path has its own place, whatever hits there are
        else if (!film.empty())
            films.insert(film);
        else
            return follow(node, false) || follow(node, true);
        return true;
    }
    bool follow(const GraphNode& node, bool hits) {
        bool lit = false;
        for (const auto& source : node.inputs)
            if (source && !source->prev && isHits(graph_.port(*source)) == hits && (hits || !isGuide(*source))) lit |= visit(source->node);
        return lit;
    }
    /// Motion, depth, normals: what images tell of hits.
    bool isGuide(const Source& source) const {
        const Port& port = graph_.port(source);
        if (port.type.kind != PortType::Kind::image) return false;
        const auto& ports = graph_.nodes[std::size_t(source.node)].pass->ports;
        return factsOf(port.format).channels < 3 || std::ranges::any_of(ports, [](const Port* p) { return !p->isInput() && isHits(*p); });
    }

    const Graph& graph_;
    std::vector<std::optional<bool>> lit_;
};

std::string textOf(const std::set<std::string>& films) {
    std::string text;
    for (const std::string& film : films) {
        text += text.empty() ? "" : " and ";
        text += film == "centre" ? "the centres of pixels" : film == "frame" ? "one place for all pixels of a frame" : "random places of pixels";
    }
    return text;
}

}  // namespace

std::set<std::string> filmsOf(const Graph& graph, const Source& measured) {
    FilmFinder finder(graph);
    finder.visit(measured.node);
    return std::move(finder.films);
}

void expectSameFilter(const Study& study, const Technique& technique, const std::set<std::string>& films, const std::set<std::string>& reference) {
    if (technique.otherFilter || films.empty() || reference.empty()) return;
    std::set<std::string> filters = films;
    if (study.kind == StudyKind::ensemble && filters.erase("frame") > 0) filters.insert("random");
    if (filters == reference && !filters.contains("frame")) return;
    throw Error(technique.graph.where,
                fmt::format("technique \"{}\" sees through {}, the reference through {}", technique.name, textOf(films), textOf(reference)),
                "give both the same \"film\", or say \"otherFilter\": true where their difference is meant to count");
}

}  // namespace lodestir
