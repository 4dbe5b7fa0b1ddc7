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

bool isOn(const Pass& pass, std::string_view name) {
    const auto found = std::ranges::find(pass.parameters, name, &Parameter::name);
    const bool* value = found == pass.parameters.end() ? nullptr : std::get_if<bool>(&(*found)->value);
    return value && *value;
}

bool isHits(const Port& port) { return port.type.kind == PortType::Kind::buffer && port.type.name == "PrimaryHit"; }

/// Walks from a port to the passes whose camera rays its light comes along. Hits guide reuse as a rule: which pixels are alike, where they were. Light is
/// seen by them where nothing that a pass is given is light already.
class FilterFinder {
public:
    explicit FilterFinder(const Graph& graph) : graph_(graph), lit_(graph.nodes.size()) {}

    std::set<PixelFilter> filters;

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
            filters.insert({"random", "random"});  // of initial_sampling: each path has its own places, whatever hits there are
        else if (!film.empty())
            filters.insert({film, !isOn(*node.pass, "lens") ? "centre" : makesHits(node) ? "frame" : "random"});
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
    static bool makesHits(const GraphNode& node) {
        return std::ranges::any_of(node.pass->ports, [](const Port* p) { return !p->isInput() && isHits(*p); });
    }
    /// Motion, depth, normals: what images tell of hits.
    bool isGuide(const Source& source) const {
        const Port& port = graph_.port(source);
        if (port.type.kind != PortType::Kind::image) return false;
        return factsOf(port.format).channels < 3 || makesHits(graph_.nodes[std::size_t(source.node)]);
    }

    const Graph& graph_;
    std::vector<std::optional<bool>> lit_;
};

std::string textOf(const std::set<PixelFilter>& filters) {
    std::string text;
    for (const PixelFilter& filter : filters) {
        const std::string film = filter.film == "centre"  ? "the centres of pixels"
                                 : filter.film == "frame" ? "one place for all pixels of a frame"
                                                          : "random places of pixels";
        const std::string lens = filter.lens == "centre" ? "the lens' centre" : filter.lens == "frame" ? "one point of the lens a frame" : "all of the lens";
        text += fmt::format("{}{} and {}", text.empty() ? "" : ", and ", film, lens);
    }
    return text;
}

/// What frames of many runs sum up to.
std::set<PixelFilter> overRuns(const std::set<PixelFilter>& filters) {
    const auto mean = [](const std::string& place) { return place == "frame" ? std::string("random") : place; };
    std::set<PixelFilter> means;
    for (const PixelFilter& filter : filters) means.insert({mean(filter.film), mean(filter.lens)});
    return means;
}

}  // namespace

std::set<PixelFilter> filtersOf(const Graph& graph, const Source& measured) {
    FilterFinder finder(graph);
    finder.visit(measured.node);
    return std::move(finder.filters);
}

void expectSameFilter(const Study& study, const Technique& technique, std::set<PixelFilter> filters, std::set<PixelFilter> reference) {
    if (technique.otherFilter || filters.empty() || reference.empty()) return;
    const std::string mine = textOf(filters), other = textOf(reference);
    if (study.kind == StudyKind::ensemble) filters = overRuns(filters);
    const bool isSample = std::ranges::any_of(filters, [](const PixelFilter& f) { return f.film == "frame" || f.lens == "frame"; });
    if (filters == reference && !isSample) return;
    throw Error(technique.graph.where, fmt::format("technique \"{}\" sees through {}, the reference through {}", technique.name, mine, other),
                "give both the same \"film\" and \"lens\", or say \"otherFilter\": true where their difference is meant to count");
}

}  // namespace lodestir
