// SPDX-License-Identifier: MIT
// What a kernel is compiled from: SPIR-V and constants.
#include <framework/graph/kernel_source.h>

#include <framework/core/error.h>
#include <framework/gpu/commands.h>
#include <framework/gpu/early_reads.h>
#include <framework/gpu/heap.h>
#include <framework/gpu/include_closure.h>
#include <framework/graph/header.h>
#include <framework/scene/upload/scene_facts.h>
#include <framework/shaders/base/frame.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <iterator>

namespace lodestir {
namespace {

bool isDriver(const Path& file) { return file.filename() == "driver.glsl" && file.parent_path().filename() == "trace"; }

bool holds(const GraphNode& node, const Pass::MacroOfGraph& fact, const Scene& scene) {
    if (!fact.in) return fact.holds(scene);
    return bool(node.inputs[std::size_t(std::ranges::find(node.pass->ports, fact.in) - node.pass->ports.begin())]);
}

}  // namespace

std::set<std::string> graphFacts(const Graph& graph, const Scene& scene) {
    std::set<std::string> facts;
    for (const GraphNode& node : graph.nodes)
        for (const Pass::MacroOfGraph& fact : node.pass->facts)
            if (!node.off && holds(node, fact, scene)) facts.emplace(fact.macro);
    return facts;
}

Hash KernelSource::hash() const {
    Hash hash;
    hash.add(std::as_bytes(std::span(spirv.words))).add(std::as_bytes(std::span(constants)));
    return hash;
}

std::vector<Path> shadersIn(const Path& folder) {
    std::vector<Path> shaders;
    std::error_code absent;
    for (const auto& entry : std::filesystem::directory_iterator(folder, absent))
        if (entry.path().extension() == ".comp" && entry.path().stem().extension() != ".test") shaders.push_back(entry.path());
    std::ranges::sort(shaders);
    return shaders;
}

std::vector<Path> shadersOf(const Plugin& plugin) {
    return *plugin.shader ? shadersIn(shaderOf(plugin, plugin.shader).parent_path()) : std::vector<Path>();
}

Hash contentOf(const std::vector<Path>& shaders, const std::vector<Path>& includes) {
    Hash hash;
    for (const Path& shader : shaders) gpu::IncludeClosure(shader, includes, {}).addTo(hash);
    return hash;
}

KernelSource kernelSource(const gpu::Device& device, const Graph& graph, const Plan& plan, const Scene& scene, int node, std::string_view shader,
                          const RunnerOptions& options) {
    const GraphNode& n = graph.nodes[std::size_t(node)];
    const auto start = std::chrono::steady_clock::now();
    gpu::ShaderSource source;
    source.file = shaderOf(*n.plugin, shader);
    source.folders = includeFolders(*n.plugin);
    source.generated["pass.glsl"] = passHeader(graph, plan, node);
    source.texelReads = device.heap() && device.heap()->isWhole();
    constexpr const char* bodies[] = {"TRACE_PACKET", "TRACE_LANE", "TRACE_RAY_QUERY"};
    source.defines.emplace_back(bodies[std::size_t(options.rays)], "1");
    std::ranges::move(sceneFacts(scene), std::back_inserter(source.defines));
    for (const std::string& fact : graphFacts(graph, scene)) source.defines.emplace_back(fact, "1");
    if (usesPersistentGroups(device)) source.defines.emplace_back("TRACE_PERSISTENT", "1");
    if (options.checkBounds) source.defines.emplace_back("CHECK_BOUNDS", "1");
    if (options.probe) source.defines.emplace_back("PROBING", "1");
    if (options.countSteps) source.defines.emplace_back("COUNT_STEPS", "1");

    KernelSource kernel{.name = n.name + ": " + std::string(shader)};
    const gpu::IncludeClosure closure(source.file, source.folders, source.generated);
    kernel.traces = std::ranges::any_of(closure.files(), isDriver);
    if (kernel.traces) source.defines.emplace_back("TRACE_DRIVER", "1");
    if (options.probe) kernel.probes = std::make_shared<const ProbeSites>(probeSites(closure));
    kernel.readsTexels = source.texelReads;
    kernel.spirv = gpu::compileShader(source);
    if (gpu::touchesMemoryEarly(kernel.spirv.words))
        throw Error({source.file.string(), 0, 0}, "the shader reads or writes memory before main() can return while the driver only compiles",
                    "begin main() with `if (skip()) return;`, and let no global's initialiser read a port");
    const BlockLayout layout = blockLayout(*n.pass);
    for (std::size_t i = 0; i < n.pass->parameters.size(); ++i)
        if (layout.constants[i]) kernel.constants.push_back({*layout.constants[i], bitsOf(*n.pass->parameters[i])});
    kernel.milliseconds = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return kernel;
}

gpu::Pipeline PipelineMaker::make(const KernelSource& source) const {
    gpu::Pipeline pipeline(device_, source.spirv, source.constants, sizeof(Push), source.name);
    Push push{};
    push.warm = 1;
    gpu::runOnce(device_, [&](gpu::Commands& commands) { commands.dispatch(pipeline, std::as_bytes(std::span(&push, 1)), 1); });
    return pipeline;
}

}  // namespace lodestir
