// SPDX-License-Identifier: MIT
// Runners that wait for their next run: to bring one up takes as long as many small frames, and techniques take turns.
#pragma once
#include <framework/graph/runner.h>

#include <functional>
#include <list>
#include <memory>
#include <string>

namespace lodestir {

/// A graph for one scene, checked, and what is measured of it.
struct StagedGraph {
    Graph graph;
    Source port;  ///< an image in linear radiance
    std::vector<Source> counters;  ///< of the study's counters, in their order; none of a reference
};

struct KeptRunner {
    std::string key;
    StagedGraph staged;
    std::unique_ptr<Runner> runner;
};

/// As many of them as a small share of the device's memory holds, and at least the last one.
class KeptRunners {
public:
    /// The one of that key, else a new one of the graph that `build` makes. Its history is void.
    KeptRunner& get(const gpu::Device& device, const std::string& key, const std::function<StagedGraph()>& build,
                    const std::function<std::unique_ptr<Runner>(StagedGraph&)>& bringUp);
    void clear() { kept_.clear(); }

private:
    std::list<KeptRunner> kept_;  ///< the one used last comes first
};

}  // namespace lodestir
