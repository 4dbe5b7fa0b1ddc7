// SPDX-License-Identifier: MIT
// What one frame of a graph does: order of the steps, lifetimes of the memory, barriers. A pure function of the graph; no GPU.
//
// The model that the runner follows:
// - Each resource is the memory of one output, state or scratch port of a node that runs; an optional output that nobody reads has none. Where
//   something reads @prev after its producer has run there are two copies: at the start of a frame "previous" becomes what "current" was (for all
//   resources, before any step), and a producer that runs this frame writes the other copy, which becomes "current"; one that doesn't run leaves
//   it. So @prev is the same copy all frame long. Where all read it before, one copy does.
// - A step with a barrier is preceded by one global memory barrier (all writes before visible to all accesses after), issued even when
//   the step itself is skipped because it is onChange and nothing changed. The list wraps around: step 0 follows the last step of the
//   frame before.
// - @prev of a State port is the state's own memory, read before its owner changes it; the order of the steps sees to that.
#pragma once
#include <framework/graph/graph.h>

#include <string>
#include <vector>

namespace lodestir {

struct PlanStep {
    int node = -1;
    bool onChange = false;
    std::string barrier;  ///< why a barrier comes before, e.g. "reads trace.color, written by step 2 (trace)"; empty: none does
};

struct PlanResource {
    int node = -1, port = -1;
    bool history = false;  ///< something reads @prev
    int copies = 1;        ///< 2: @prev is read when the producer has run already
    bool pinned = false;   ///< shown or dumped: its content outlives the frame's last step
    bool keeps = false;    ///< content is needed in later frames (state, history, output of an onChange pass)
    int firstStep = 0, lastStep = 0;
    int group = -1;  ///< resources of one group share memory, because one is made in the place of another or by `sharing`; -1: memory of its own
};

struct Plan {
    std::vector<PlanStep> steps;
    std::vector<PlanResource> resources;  ///< by node, then port
    std::vector<int> culled;              ///< nodes that nothing shown or pinned needs, and those that are off
    int groups = 0;

    /// Index of a step or resource, -1: there is none.
    LODESTIR_API int stepOf(int node) const;
    LODESTIR_API int resourceOf(int node, int port) const;
};

struct PlanOptions {
    bool keepAll = false;      ///< any port can be looked at after a frame: optional outputs are made, nothing is written over anything else
    bool sharing = false;      ///< let resources whose lifetimes don't meet share memory
    bool allBarriers = false;  ///< a barrier before every step: the yardstick for finding missing ones by comparing bits
    glm::uvec2 frame{0, 0};    ///< for sharing: the big ones are placed first; {0, 0}: the description's size
};

/// Plans what `graph.show` and `pinned` need.
LODESTIR_API Plan makePlan(const Graph& graph, const std::vector<Source>& pinned = {}, const PlanOptions& options = {});

/// Bytes of all resources, with history copies and sharing taken into account; without scratch that a pass reserves as it runs.
LODESTIR_API std::size_t planBytes(const Plan& plan, const Graph& graph, glm::uvec2 frame);
/// The plan in words, for `lodestir check`.
LODESTIR_API std::string text(const Plan& plan, const Graph& graph);
/// The same as facts, for `lodestir check --json`.
LODESTIR_API Json facts(const Plan& plan, const Graph& graph);

}  // namespace lodestir
