// SPDX-License-Identifier: MIT
// Boxes that lie on each other can't be read, and an edge that runs through a box seems to end there.
#include "../end_to_end/source_folder.h"

#include <framework/app/view/graph_edit.h>
#include <framework/app/view/graph_layout.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace lodestir {
namespace {

struct Sketch {
    std::vector<LayoutBox> boxes;
    std::vector<LayoutEdge> edges;
};

/// A box whose ports stand below each other, inputs first.
LayoutBox box(std::size_t inputs, std::size_t outputs, float width = 120) {
    LayoutBox made{.size = {width, 60}};
    for (auto [ports, count] : {std::pair(&made.inputs, inputs), std::pair(&made.outputs, outputs)})
        for (std::size_t i = 0; i < count; ++i) {
            ports->push_back(made.size.y + 8);
            made.size.y += 17;
        }
    return made;
}

Sketch sketchOf(const Graph& graph) {
    Sketch sketch;
    const auto isInput = [](const Port& port) { return port.isInput(); };
    for (std::size_t n = 0; n < graph.nodes.size(); ++n) {
        const GraphNode& node = graph.nodes[n];
        const std::vector<Wire> inputs = wiresOf(*node.pass, isInput);
        sketch.boxes.push_back(box(inputs.size(), wiresOf(*node.pass, isMade).size(), 40 + 7 * float(node.type.size())));
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            const std::optional<Feed> feed = feedOf(graph, int(n), inputs[i]);
            if (!feed) continue;
            const Pass& maker = *graph.nodes[std::size_t(feed->node)].pass;
            const std::vector<Wire> outputs = wiresOf(maker, isMade);
            const auto output = std::ranges::find(outputs, wireOf(maker, feed->output.first).first, &Wire::first);
            sketch.edges.push_back({feed->node, int(output - outputs.begin()), int(n), int(i), feed->prev});
        }
    }
    return sketch;
}

bool meet(const GraphLayout::Box& a, const GraphLayout::Box& b) {
    return a.corner.x < b.corner.x + b.size.x && b.corner.x < a.corner.x + a.size.x && a.corner.y < b.corner.y + b.size.y &&
           b.corner.y < a.corner.y + a.size.y;
}

void expectReadable(const Sketch& sketch, const std::string& what) {
    const GraphLayout layout = layOut(sketch.boxes, sketch.edges);
    ASSERT_EQ(layout.boxes.size(), sketch.boxes.size()) << what;
    ASSERT_EQ(layout.routes.size(), sketch.edges.size()) << what;
    for (std::size_t a = 0; a < layout.boxes.size(); ++a) {
        EXPECT_GE(layout.boxes[a].size.x, sketch.boxes[a].size.x) << what;
        EXPECT_TRUE(glm::all(glm::greaterThanEqual(layout.boxes[a].corner, glm::vec2(0)))) << what << ": box " << a;
        EXPECT_TRUE(glm::all(glm::lessThanEqual(layout.boxes[a].corner + layout.boxes[a].size, layout.size + 0.01f))) << what << ": box " << a;
        for (std::size_t b = 0; b < a; ++b) EXPECT_FALSE(meet(layout.boxes[a], layout.boxes[b])) << what << ": boxes " << a << " and " << b;
    }
    for (std::size_t e = 0; e < sketch.edges.size(); ++e) {
        const LayoutEdge& edge = sketch.edges[e];
        const GraphLayout::Route& route = layout.routes[e];
        const GraphLayout::Box &from = layout.boxes[std::size_t(edge.from)], &to = layout.boxes[std::size_t(edge.to)];
        EXPECT_EQ(route.points.front(), from.corner + glm::vec2(from.size.x, sketch.boxes[std::size_t(edge.from)].outputs[std::size_t(edge.output)])) << what;
        EXPECT_EQ(route.points.back(), to.corner + glm::vec2(0, sketch.boxes[std::size_t(edge.to)].inputs[std::size_t(edge.input)])) << what;
        EXPECT_EQ(route.back, edge.prev) << what << ": edge " << e;
        for (std::size_t i = 1; i < route.points.size(); ++i) {
            const glm::vec2 start = route.points[i - 1], end = route.points[i];
            EXPECT_TRUE(route.back || start.x < end.x) << what << ": edge " << e << " runs to the left";
            if (!route.back && i % 2 == 1) continue;  // a curve between two columns, where no box is
            // A line, made as small as a box, meets none but where it begins and ends.
            const GraphLayout::Box line{glm::min(start, end), glm::max(glm::abs(end - start), glm::vec2(0.01f))};
            for (std::size_t b = 0; b < layout.boxes.size(); ++b) {
                const bool isEnd = (i == 1 && int(b) == edge.from) || (i + 1 == route.points.size() && int(b) == edge.to);
                EXPECT_FALSE(!isEnd && meet(line, layout.boxes[b])) << what << ": edge " << e << " runs through box " << b;
            }
        }
    }
}

TEST(GraphLayout, OfEveryShippedGraphAndVariantCanBeRead) {
    PluginLibraries libraries;
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(test::sourceFolder / "graphs")) {
        if (entry.path().extension() != ".json") continue;
        const Graph graph = buildGraph(loadDescription(entry.path()), libraries);
        expectReadable(sketchOf(graph), entry.path().filename().string());
        for (const std::string& variant : graph.description.variants) {
            const Graph other = buildGraph(loadDescription(entry.path(), {.variant = variant}), libraries);
            expectReadable(sketchOf(other), entry.path().filename().string() + ", " + variant);
        }
        ++count;
    }
    EXPECT_GT(count, 10);
}

TEST(GraphLayout, PutsWhatIsNeededOnceBesideWhoNeedsIt) {
    // 0 -> 1 -> 2 -> 3, and 4 -> 3: in the column before 3, not in the first.
    const Sketch sketch{{box(0, 1), box(1, 1), box(1, 1), box(2, 0), box(0, 1)}, {{0, 0, 1, 0}, {1, 0, 2, 0}, {2, 0, 3, 0}, {4, 0, 3, 1}}};
    const GraphLayout layout = layOut(sketch.boxes, sketch.edges);
    EXPECT_EQ(layout.boxes[4].corner.x, layout.boxes[2].corner.x);
    expectReadable(sketch, "a chain");
}

TEST(GraphLayout, HasNoCrossingsWhereNoneAreNeeded) {
    // Two chains whose boxes are listed crosswise.
    const Sketch sketch{{box(0, 1), box(0, 1), box(1, 1), box(1, 1), box(1, 0), box(1, 0)},
                        {{0, 0, 3, 0}, {1, 0, 2, 0}, {2, 0, 5, 0}, {3, 0, 4, 0}}};
    const GraphLayout layout = layOut(sketch.boxes, sketch.edges);
    const auto above = [&](std::size_t a, std::size_t b) { return layout.boxes[a].corner.y < layout.boxes[b].corner.y; };
    EXPECT_EQ(above(0, 1), above(3, 2));
    EXPECT_EQ(above(0, 1), above(4, 5));
}

TEST(GraphLayout, LivesWithCirclesAndWithNothing) {
    const Sketch circle{{box(1, 1), box(1, 1)}, {{0, 0, 1, 0}, {1, 0, 0, 0}}};  // through a pass that is off
    const GraphLayout layout = layOut(circle.boxes, circle.edges);
    EXPECT_FALSE(meet(layout.boxes[0], layout.boxes[1]));
    EXPECT_NE(layout.routes[0].back, layout.routes[1].back);
    EXPECT_TRUE(layOut({}, {}).boxes.empty());
}

}  // namespace
}  // namespace lodestir
