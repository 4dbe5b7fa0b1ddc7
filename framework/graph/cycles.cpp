// SPDX-License-Identifier: MIT
// Depth-first search for edges that lead back.
#include <framework/graph/cycles.h>

#include <algorithm>

namespace lodestir {
namespace {

class CycleSearch {
public:
    explicit CycleSearch(const Graph& graph) : graph_(graph), state_(graph.nodes.size()) {}

    std::vector<std::vector<int>> run() {
        for (std::size_t i = 0; i < state_.size(); ++i) visit(int(i));
        return std::move(cycles_);
    }

private:
    enum class State { fresh, onTheWay, done };

    /// Goes along what each node needs; an edge to a node on the way closes a cycle.
    void visit(int index) {
        if (state_[std::size_t(index)] != State::fresh) return;
        state_[std::size_t(index)] = State::onTheWay;
        way_.push_back(index);
        for (const int needed : neededBy(index)) {
            if (state_[std::size_t(needed)] == State::onTheWay) {
                keep({std::ranges::find(way_, needed), way_.end()});
            } else {
                visit(needed);
            }
        }
        way_.pop_back();
        state_[std::size_t(index)] = State::done;
    }

    /// `cycle`: each node needs the next, and the last needs the first.
    void keep(std::vector<int> cycle) {
        std::ranges::reverse(cycle);
        std::rotate(cycle.begin(), std::ranges::min_element(cycle), cycle.end());
        cycles_.push_back(std::move(cycle));
    }

    std::vector<int> neededBy(int index) const {
        std::vector<int> needed;
        const GraphNode& node = graph_.nodes[std::size_t(index)];
        if (node.off) return needed;
        for (const auto& input : node.inputs) {
            if (input && !input->prev) needed.push_back(input->node);
        }
        for (std::size_t i = 0; i < graph_.nodes.size(); ++i) {
            if (!graph_.nodes[i].off && int(i) != index && readsState(graph_.nodes[i], index)) needed.push_back(int(i));
        }
        std::ranges::sort(needed);
        needed.erase(std::unique(needed.begin(), needed.end()), needed.end());
        return needed;
    }

    bool readsState(const GraphNode& node, int owner) const {
        return std::ranges::any_of(node.inputs, [&](const auto& input) {
            return input && input->prev && input->node == owner && graph_.port(*input).role == Port::Role::state;
        });
    }

    const Graph& graph_;
    std::vector<State> state_;
    std::vector<int> way_;
    std::vector<std::vector<int>> cycles_;
};

}  // namespace

std::vector<std::vector<int>> findCycles(const Graph& graph) { return CycleSearch(graph).run(); }

}  // namespace lodestir
