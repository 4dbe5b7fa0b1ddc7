// SPDX-License-Identifier: MIT
#include <framework/graph/kernels.h>

#include <framework/core/tasks.h>
#include <framework/gpu/heap.h>
#include <framework/graph/compile_ahead.h>

#include <algorithm>
#include <optional>
#include <set>

namespace lodestir {
const Kernel& Kernels::of(int node, std::string_view shader) {
    const Key key{node, shader};
    const auto found = kernels_.find(key);
    if (found != kernels_.end() && (!found->second.readsTexels || device_.heap()->isWhole())) return found->second;
    return kernels_.insert_or_assign(key, make(node, shader)).first->second;
}

int Kernels::reload(std::span<const Path> changed) {
    std::map<Key, Kernel> fresh;
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

void Kernels::prepare(const std::vector<int>& nodes, const std::function<void(std::size_t, std::size_t)>& progress) {
    std::vector<Key> keys;
    for (const int node : nodes)
        for (const Path& shader : shadersOf(*graph_.nodes[std::size_t(node)].plugin))
            if (const Key key{node, shader.filename()}; !kernels_.contains(key)) keys.push_back(key);
    std::vector<std::optional<KernelSource>> read(keys.size());
    parallelFor(keys.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            try {
                read[i] = kernelSource(device_, graph_, plan_, scene_, keys[i].first, keys[i].second, options_);
            } catch (const Error&) {}  // told when it is asked for, if it is
        }
    });
    std::vector<KernelSource> sources;
    std::size_t good = 0;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        if (!read[i]) continue;
        sources.push_back(std::move(*read[i]));
        keys[good++] = keys[i];
    }
    keys.resize(good);
    std::size_t done = 0;
    progress(done, keys.size());
    compileAhead(device_, sources, [&](std::size_t i, std::shared_ptr<const gpu::Pipeline> pipeline, double milliseconds) {
        kernels_.insert_or_assign(keys[i], finish(keys[i], sources[i], std::move(pipeline), milliseconds));
        progress(++done, keys.size());
    });
}

Kernel Kernels::make(int node, std::string_view shader) {
    const KernelSource source = kernelSource(device_, graph_, plan_, scene_, node, shader, options_);
    Kernel kernel;
    compileAhead(device_, std::span(&source, 1), [&](std::size_t, std::shared_ptr<const gpu::Pipeline> pipeline, double milliseconds) {
        kernel = finish({node, std::string(shader)}, source, std::move(pipeline), milliseconds);
    });
    return kernel;
}

Kernel Kernels::finish(const Key& key, const KernelSource& source, std::shared_ptr<const gpu::Pipeline> pipeline, double milliseconds) {
    reports_.push_back({graph_.nodes[std::size_t(key.first)].name, key.second, source.spirv.cached, source.milliseconds, milliseconds});
    return {std::move(pipeline), source.traces, source.readsTexels, source.spirv.files, source.probes};
}

}  // namespace lodestir
