// SPDX-License-Identifier: MIT
// Any JSON as a graph file: read, built with the passes of the tests, planned, with each of its variants.
#include "input_file.h"
#include "json_mutator.h"

#include <framework/graph/hazards.h>
#include <framework/graph/plan.h>
#include <tests/cpu/fake_passes.h>

LODESTIR_MUTATE_JSON

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace lodestir;
    static fake::Workshop workshop;
    const std::string text(reinterpret_cast<const char*>(data), size);
    std::vector<std::string> variants;
    const auto plan = [&](const GraphOptions& options) {
        fuzz::expectErrorOrResult([&] {
            Description description = readDescription(Json::parse(text, "graph.json"), "graph.json", options);
            if (!options.variant) variants = description.variants;
            const Graph graph = buildGraph(std::move(description), workshop.libraries());
            const Plan made = makePlan(graph, {}, {});
            facts(made, graph).dump();
            lodestir::text(made, graph);
            // What it says of itself must give the same graph.
            const Json resolved = graph.resolved();
            buildGraph(readDescription(Json::parse(resolved.dump(), "resolved.json"), "graph.json"), workshop.libraries());
        });
    };
    plan({});
    for (std::size_t i = 0; i < variants.size() && i < 4; ++i) {
        GraphOptions options;
        options.variant = variants[i];
        plan(options);
    }
    return 0;
}
