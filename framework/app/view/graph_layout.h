// SPDX-License-Identifier: MIT
// Where the boxes of a graph go, and the edges between them: columns by depth, from left to right, rows with few crossings. No window.
//
// After Sugiyama et al. 1981, Methods for Visual Understanding of Hierarchical System Structures: an edge over several columns gets a place of its own in
// each, rows are ordered by where their neighbours are. All edges of one output are one trunk that branches. Last frame's values run back to the left below
// all boxes, a lane for each.
#pragma once
#include <framework/core/api.h>

#include <glm/glm.hpp>

#include <span>
#include <vector>

namespace lodestir {

struct LayoutBox {
    glm::vec2 size;                      ///< at least; all of one column get the same width
    std::vector<float> inputs, outputs;  ///< heights of the ports below the box's top; inputs are at its left side, outputs at its right
};
struct LayoutEdge {
    int from, output, to, input;
    bool prev;
};

struct GraphLayout {
    struct Box {
        glm::vec2 corner, size;
    };
    /// From port to port. Forward: curves from points 0 to 1, 2 to 3, ... that start and end level, straight in between. Back: corners of one line.
    struct Route {
        bool back = false;
        std::vector<glm::vec2> points;
    };
    std::vector<Box> boxes;
    std::vector<Route> routes;  ///< of each edge
    glm::vec2 size{0};          ///< of it all, from {0, 0}
};

LODESTIR_API GraphLayout layOut(std::span<const LayoutBox> boxes, std::span<const LayoutEdge> edges);

}  // namespace lodestir
