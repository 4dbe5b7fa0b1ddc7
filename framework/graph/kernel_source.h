// SPDX-License-Identifier: MIT
// What a kernel is compiled from: SPIR-V and constants. The driver makes a pipeline of it, and a CPU driver compiles at the first dispatch.
#pragma once
#include <framework/gpu/pipeline.h>
#include <framework/graph/graph.h>
#include <framework/graph/probe.h>
#include <framework/graph/runner.h>

#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace lodestir {

struct KernelSource {
    std::string name;           ///< pass and shader
    gpu::Spirv spirv;
    std::vector<gpu::Specialization> constants;
    bool traces = false;        ///< includes trace/driver.glsl
    bool readsTexels = false;   ///< right only while all memory lies in the device's heap
    double milliseconds = 0;    ///< from GLSL
    std::shared_ptr<const ProbeSites> probes;  ///< with RunnerOptions::probe

    Hash hash() const;  ///< of what the driver sees
};

/// Reads and compiles a shader of a node for a device and a scene. Error with the compiler's messages.
KernelSource kernelSource(const gpu::Device& device, const Graph& graph, const Plan& plan, const Scene& scene, int node, std::string_view shader,
                          const RunnerOptions& options);

/// Macros of what some pass of the graph does, by its wires and its parameters as they are (Fact).
std::set<std::string> graphFacts(const Graph& graph, const Scene& scene);

/// The shaders of a folder, in order of their names; tests are none.
std::vector<Path> shadersIn(const Path& folder);
/// Those in the folder of a pass's own one. Which of them it dispatches, only its execute() knows.
std::vector<Path> shadersOf(const Plugin& plugin);
/// Of shaders as their files are now, and of all that these include.
Hash contentOf(const std::vector<Path>& shaders, const std::vector<Path>& includes);

/// Persistent workgroups: a few that fetch tiles from a counter, because a CPU driver spreads workgroups over its threads beforehand.
inline bool usesPersistentGroups(const gpu::Device& device) { return device.facts().type == "cpu"; }

/// Makes pipelines ready on one device: by a dispatch that returns at once, before which nothing of the graph is there yet.
class PipelineMaker {
public:
    explicit PipelineMaker(const gpu::Device& device) : device_(device) {}
    gpu::Pipeline make(const KernelSource& source) const;

private:
    const gpu::Device& device_;
};

}  // namespace lodestir
