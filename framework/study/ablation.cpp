// SPDX-License-Identifier: MIT
#include <framework/core/error.h>
#include <framework/core/log.h>
#include <framework/graph/source.h>
#include <framework/study/ablation.h>
#include <framework/study/measured_port.h>
#include <framework/study/pixel_filter.h>
#include <framework/study/run_list.h>

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace lodestir {
namespace {

/// One thing that can be taken away, and how: merge patches of the graph.
struct Part {
    std::string name;  ///< "pass" or "pass.parameter"
    Json patch;
};

/// The nodes that a port depends on, last frame's values included.
void addSources(const Graph& graph, int node, std::vector<bool>& seen) {
    if (seen[std::size_t(node)]) return;
    seen[std::size_t(node)] = true;
    for (const auto& input : graph.nodes[std::size_t(node)].inputs)
        if (input) addSources(graph, input->node, seen);
}

/// Turns a pass off: what it hands through stands for it, and optional inputs that nothing stands for are unwired.
Json offPatch(const Graph& graph, std::size_t off) {
    Json patch = Json::object();
    patch["passes"][graph.nodes[off].name]["off"] = Json(true);
    for (const GraphNode& node : graph.nodes)
        for (std::size_t port = 0; port < node.inputs.size(); ++port) {
            const auto& source = node.inputs[port];
            if (!source || std::size_t(source->node) != off || bypassOf(*graph.nodes[off].pass, source->port) >= 0) continue;
            if (node.pass->ports[port]->optional) patch["passes"][node.name]["in"][node.pass->ports[port]->name] = Json();
        }
    return patch;
}

std::vector<Part> partsOf(const Graph& graph, const Source& measured) {
    std::vector<bool> counts(graph.nodes.size());
    addSources(graph, measured.node, counts);
    std::vector<Part> parts;
    for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
        const GraphNode& node = graph.nodes[i];
        if (!counts[i] || node.off || node.type == "scene") continue;  // what is looked at is no part of how
        if (!node.pass->bypasses.empty()) parts.push_back({node.name, offPatch(graph, i)});
        for (const Parameter* parameter : node.pass->parameters) {
            const bool* isOn = std::get_if<bool>(&parameter->value);
            if (!isOn || !*isOn) continue;
            Json patch = Json::object();
            patch["passes"][node.name]["set"][parameter->name] = Json(false);
            parts.push_back({fmt::format("{}.{}", node.name, parameter->name), std::move(patch)});
        }
    }
    return parts;
}

class Ablator {
public:
    Ablator(Study& study, Renderer& renderer, std::size_t whole) : study_(study), renderer_(renderer), whole_(whole) {}

    void expand() {
        const Technique technique = study_.techniques[whole_];
        const Graph graph = build(technique.graph);
        const Source measured = measuredPort(graph, technique.graph);
        filters_ = filtersOf(graph, measured);
        std::vector<Part> parts;
        for (Part& part : partsOf(graph, measured))
            if (add(technique, {&part})) parts.push_back(std::move(part));
        if (parts.empty()) throw Error(technique.graph.where, fmt::format("technique \"{}\" has no part that can be taken away", technique.name));
        if (technique.ablate != Ablate::pairs) return;
        for (std::size_t a = 0; a < parts.size(); ++a)
            for (std::size_t b = a + 1; b < parts.size(); ++b) add(technique, {&parts[a], &parts[b]});
    }

private:
    Graph build(const StudyGraph& choice) {
        const StudyScene& scene = study_.scenes.front();
        return renderer_.build(choice.graph, {.scene = std::filesystem::absolute(scene.file), .size = scene.size, .set = settingsOf(choice, {}),
                                              .variant = choice.variant, .variantWhere = choice.variantWhere, .patches = choice.patches});
    }

    /// The technique without these parts, unless that can't be.
    bool add(const Technique& technique, const std::vector<const Part*>& parts) {
        Technique less = technique;
        less.ablate = Ablate::nothing;
        less.ablation = Ablation{.whole = whole_, .parts = {}};
        std::string names;
        for (const Part* part : parts) {
            less.graph.patches.push_back(part->patch);
            names += (names.empty() ? "" : " and ") + part->name;
            less.ablation->parts.push_back(part->name);
            // What is set by the study comes behind the patch, and would turn it on again; what takes its value goes with it.
            for (Setting& setting : less.graph.set)
                if (setting.name == part->name) setting.value = Json(false);
            std::erase_if(less.graph.alike, [&](const Alike& alike) { return alike.name == part->name; });
        }
        less.name = technique.name + " without " + names;
        const auto refuse = [&](const std::string& why) {
            log::note("\"{}\" is left out: {}", less.name, why);
            return false;
        };
        try {
            const Graph graph = build(less.graph);
            if (!technique.otherFilter && filtersOf(graph, measuredPort(graph, less.graph)) != filters_)
                return refuse("it would see through other places of the pixel or lens");
            for (const Counter& counter : study_.counters) counterPort(graph, counter);
        } catch (const Error& error) {
            return refuse(error.problems().front().what);
        }
        study_.techniques.push_back(std::move(less));
        return true;
    }

    Study& study_;
    Renderer& renderer_;
    std::size_t whole_;
    std::set<PixelFilter> filters_;
};

}  // namespace

void expandAblations(Study& study, Renderer& renderer) {
    const std::size_t count = study.techniques.size();
    for (std::size_t i = 0; i < count; ++i)
        if (study.techniques[i].ablate != Ablate::nothing) Ablator(study, renderer, i).expand();
}

}  // namespace lodestir
