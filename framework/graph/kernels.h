// SPDX-License-Identifier: MIT
// The shaders of a running graph: compiled against the pass.glsl of their node, turned into pipelines, warmed by a dispatch that returns at once.
#pragma once
#include <framework/gpu/pipeline.h>
#include <framework/graph/kernel_source.h>

#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace lodestir {

struct Kernel {
    std::shared_ptr<const gpu::Pipeline> pipeline;
    bool traces = false;        ///< includes trace/driver.glsl
    bool readsTexels = false;   ///< right only while all memory lies in the device's heap
    std::vector<Path> files;    ///< include closure, for watching
    std::shared_ptr<const ProbeSites> probes;  ///< with RunnerOptions::probe
};

class Kernels {
public:
    Kernels(const gpu::Device& device, const Graph& graph, const Plan& plan, const Scene& scene, const RunnerOptions& options)
        : device_(device), graph_(graph), plan_(plan), scene_(scene), options_(options) {}
    /// Makes what the nodes may ask for, several kernels at once where the driver compiles on the CPU; `progress` is told how many of how many
    /// are ready. Shaders that don't compile are left to be told of when they are asked for.
    void prepare(const std::vector<int>& nodes, const std::function<void(std::size_t, std::size_t)>& progress);
    /// The kernel of a node's shader; made ready when it is first asked for. Error with the compiler's messages.
    const Kernel& of(int node, std::string_view shader);
    /// Makes anew, against the files as they are now, those that read one of `changed`; returns how many. On Error all stay as they were.
    int reload(std::span<const Path> changed);
    std::vector<Path> files() const;  ///< that the kernels made so far were read from, each once
    const std::vector<ShaderReport>& reports() const { return reports_; }

private:
    using Key = std::pair<int, std::string>;  ///< node, shader
    Kernel make(int node, std::string_view shader);
    Kernel finish(const Key& key, const KernelSource& source, std::shared_ptr<const gpu::Pipeline> pipeline, double milliseconds);

    const gpu::Device& device_;
    const Graph& graph_;
    const Plan& plan_;
    const Scene& scene_;
    const RunnerOptions& options_;
    std::map<Key, Kernel> kernels_;
    std::vector<ShaderReport> reports_;
};

}  // namespace lodestir
