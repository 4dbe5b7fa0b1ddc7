// SPDX-License-Identifier: MIT
#include <framework/graph/kernels.h>

#include <framework/gpu/commands.h>
#include <framework/gpu/heap.h>
#include <framework/gpu/include_closure.h>
#include <framework/graph/header.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <set>

namespace lodestir {
namespace {

double millisecondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

/// Memory for the block, the ports and the handles of a dispatch that only warms: whatever address is read there leads back to it. The
/// initialisers of a shader's globals run before its main() can return.
gpu::Buffer idleMemory(const gpu::Device& device) {
    constexpr std::size_t bytes = 1 << 16;  // more than any block or handle takes
    gpu::Buffer memory(device, bytes, gpu::Memory::upload, "idle block");
    const std::vector<std::uint64_t> words(bytes / sizeof(std::uint64_t), memory.address());
    std::memcpy(memory.mapped(), words.data(), bytes);
    return memory;
}

}  // namespace

Kernels::Kernels(const gpu::Device& device, const Graph& graph, const RunnerOptions& options)
    : device_(device), graph_(graph), options_(options), idle_(idleMemory(device)) {}

const Kernel& Kernels::of(int node, std::string_view shader) {
    const std::pair<int, std::string> key{node, shader};
    const auto found = kernels_.find(key);
    if (found != kernels_.end() && (!found->second.readsTexels || device_.heap()->isWhole())) return found->second;
    return kernels_.insert_or_assign(key, make(node, shader)).first->second;
}

int Kernels::reload(std::span<const Path> changed) {
    std::map<std::pair<int, std::string>, Kernel, std::less<>> fresh;
    Problems problems;
    for (const auto& [key, kernel] : kernels_) {
        if (!std::ranges::any_of(kernel.files, [&](const Path& file) { return std::ranges::find(changed, file) != changed.end(); })) continue;
        try {
            fresh.emplace(key, make(key.first, key.second));
        } catch (const Error& error) {
            problems.add(error);
        }
    }
    problems.raise();
    for (auto& [key, kernel] : fresh) kernels_[key] = std::move(kernel);
    return int(fresh.size());
}

std::vector<Path> Kernels::files() const {
    std::set<Path> files;
    for (const auto& [key, kernel] : kernels_) files.insert(kernel.files.begin(), kernel.files.end());
    return {files.begin(), files.end()};
}

Kernel Kernels::make(int node, std::string_view shader) {
    const GraphNode& n = graph_.nodes[std::size_t(node)];
    const auto start = std::chrono::steady_clock::now();
    gpu::ShaderSource source;
    source.file = shaderOf(*n.plugin, shader);
    source.folders = includeFolders(*n.plugin);
    source.generated["pass.glsl"] = passHeader(graph_, node);
    source.texelReads = device_.heap() && device_.heap()->isWhole();
    constexpr const char* bodies[] = {"TRACE_PACKET", "TRACE_LANE", "TRACE_RAY_QUERY"};
    source.defines.emplace_back(bodies[std::size_t(options_.rays)], "1");
    if (persistent()) source.defines.emplace_back("TRACE_PERSISTENT", "1");
    if (options_.checkBounds) source.defines.emplace_back("CHECK_BOUNDS", "1");
    if (options_.countSteps) source.defines.emplace_back("COUNT_STEPS", "1");

    Kernel kernel;
    kernel.readsTexels = source.texelReads;
    const gpu::IncludeClosure closure(source.file, source.folders, source.generated);
    kernel.traces = std::ranges::any_of(closure.files(), [](const Path& file) { return file.filename() == "driver.glsl" && file.parent_path().filename() == "trace"; });
    if (kernel.traces) source.defines.emplace_back("TRACE_DRIVER", "1");
    const gpu::Spirv spirv = gpu::compileShader(source);
    kernel.files = spirv.files;
    const double compile = millisecondsSince(start);

    std::vector<gpu::Specialization> constants;
    const BlockLayout layout = blockLayout(*n.pass);
    for (std::size_t i = 0; i < n.pass->parameters.size(); ++i)
        if (layout.constants[i]) constants.push_back({*layout.constants[i], bitsOf(*n.pass->parameters[i])});
    const auto driver = std::chrono::steady_clock::now();
    kernel.pipeline = gpu::Pipeline(device_, spirv, constants, sizeof(Push), n.name + ": " + std::string(shader));
    // CPU drivers compile at the first dispatch: let that be one that does nothing.
    Push push{};
    push.warm = 1;
    push.block = idle_.address();
    gpu::runOnce(device_, [&](gpu::Commands& commands) { commands.dispatch(kernel.pipeline, std::as_bytes(std::span(&push, 1)), 1); });
    reports_.push_back({n.name, std::string(shader), spirv.cached, compile, millisecondsSince(driver)});
    return kernel;
}

}  // namespace lodestir
