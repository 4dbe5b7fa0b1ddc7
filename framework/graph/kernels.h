// SPDX-License-Identifier: MIT
// The shaders of a running graph: compiled against the pass.glsl of their node, turned into pipelines, warmed by a dispatch that returns at once.
#pragma once
#include <framework/gpu/pipeline.h>
#include <framework/graph/graph.h>
#include <framework/graph/runner.h>

#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace lodestir {

struct Kernel {
    gpu::Pipeline pipeline;
    bool traces = false;        ///< includes trace/driver.glsl
    bool readsTexels = false;   ///< right only while all memory lies in the device's heap
    std::vector<Path> files;    ///< include closure, for watching
};

class Kernels {
public:
    Kernels(const gpu::Device& device, const Graph& graph, const RunnerOptions& options);
    /// The kernel of a node's shader; made ready when it is first asked for. Error with the compiler's messages.
    const Kernel& of(int node, std::string_view shader);
    /// Makes anew, against the files as they are now, those that read one of `changed`; returns how many. On Error all stay as they were.
    int reload(std::span<const Path> changed);
    std::vector<Path> files() const;  ///< that the kernels made so far were read from, each once
    const std::vector<ShaderReport>& reports() const { return reports_; }
    /// Persistent workgroups: a few that fetch tiles from a counter, because a CPU driver spreads workgroups over its threads beforehand.
    bool persistent() const { return device_.facts().type == "cpu"; }

private:
    Kernel make(int node, std::string_view shader);

    const gpu::Device& device_;
    const Graph& graph_;
    const RunnerOptions& options_;
    gpu::Buffer idle_;  ///< the block of a dispatch that only warms
    std::map<std::pair<int, std::string>, Kernel, std::less<>> kernels_;
    std::vector<ShaderReport> reports_;
};

}  // namespace lodestir
