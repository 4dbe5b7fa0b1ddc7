// SPDX-License-Identifier: MIT
// Kernels of a CPU driver compiled on several cores at once.
#include <framework/graph/compile_ahead.h>

#include <framework/core/files.h>
#include <framework/core/is_file.h>
#include <framework/core/tasks.h>
#include <framework/gpu/pipeline_cache.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace lodestir {
namespace {

std::string environmentOf(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

bool hasDriverCache() {
    const std::string off = environmentOf("MESA_SHADER_CACHE_DISABLE");
    return off.empty() || off == "0" || off == "false";
}

/// An empty file that says: this driver has compiled this kernel, and its cache should have it.
Path markOf(const gpu::Device& device, const KernelSource& source) {
    Hash hash = source.hash();
    for (const std::string& part : {device.facts().name, device.facts().driverVersion, environmentOf("MESA_SHADER_CACHE_DIR"), environmentOf("XDG_CACHE_HOME"),
                                    environmentOf("HOME"), environmentOf("GALLIUM_OVERRIDE_CPU_CAPS"), environmentOf("LP_NATIVE_VECTOR_WIDTH")})
        hash.add(part).add("\n");
    return cacheFolder("compiled") / hash.hex();
}

void mark(const Path& path) {
    try {
        writeFile(path, std::span<const std::byte>{});
    } catch (const Error&) {}  // it will be taken for not compiled yet, no more
}

/// Hands out what is to be compiled, each once: to this thread from the front, where the largest are.
class Queue {
public:
    explicit Queue(std::vector<std::size_t> items) : items_(std::move(items)) {}
    std::optional<std::size_t> front() { return take([this] { const std::size_t item = items_.front(); items_.erase(items_.begin()); return item; }); }
    std::optional<std::size_t> back() { return take([this] { const std::size_t item = items_.back(); items_.pop_back(); return item; }); }

private:
    template <class F> std::optional<std::size_t> take(const F& which) {
        const std::lock_guard lock(mutex_);
        if (items_.empty()) return std::nullopt;
        return which();
    }
    std::mutex mutex_;
    std::vector<std::size_t> items_;
};

}  // namespace

void compileAhead(const gpu::Device& device, std::span<const KernelSource> sources,
                  const std::function<void(std::size_t, std::shared_ptr<const gpu::Pipeline>, double)>& made) {
    const PipelineMaker maker(device);
    const auto make = [&](std::size_t i) {
        const auto start = std::chrono::steady_clock::now();
        const Hash hash = sources[i].hash();
        std::shared_ptr<const gpu::Pipeline> pipeline = device.pipelines().find(hash);
        if (!pipeline) pipeline = device.pipelines().keep(hash, maker.make(sources[i]));
        made(i, std::move(pipeline), std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    };

    std::vector<std::size_t> cold;
    std::vector<Path> marks;
    const bool spreads = device.facts().isLavapipe && hasDriverCache();
    for (std::size_t i = 0; i < sources.size(); ++i) {
        marks.push_back(spreads ? markOf(device, sources[i]) : Path());
        if (spreads && !isFile(marks[i]) && !device.pipelines().find(sources[i].hash())) cold.push_back(i);
    }
    std::ranges::stable_sort(cold, std::ranges::greater(), [&](std::size_t i) { return sources[i].spirv.words.size(); });
    std::vector<bool> done(sources.size());
    if (cold.size() > 1) {
        Queue queue(cold);
        std::vector<std::jthread> others;
        for (std::size_t n = 1; n < std::min(workerCount(), cold.size()); ++n)
            others.emplace_back([&] {
                try {
                    // An instance of its own: the driver writes its cache on disk at the latest when the instance goes.
                    const gpu::Device own({.choice = std::to_string(device.facts().index), .validation = false});
                    const PipelineMaker theirs(own);
                    while (const auto i = queue.back()) theirs.make(sources[*i]);
                } catch (const std::exception&) {}  // what it hasn't compiled is compiled below; out of this thread nothing may come
            });
        while (const auto i = queue.front()) {
            make(*i);
            done[*i] = true;
        }
    }
    for (std::size_t i = 0; i < sources.size(); ++i)
        if (!done[i]) make(i);
    for (const std::size_t i : cold) mark(marks[i]);
}

}  // namespace lodestir
