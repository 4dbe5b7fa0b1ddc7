// SPDX-License-Identifier: MIT
// Brings graphs up: the libraries that their passes come from, and the device that they run on. Whatever renders starts here.
#pragma once
#include <framework/graph/runner.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace lodestir {

struct RendererOptions {
    std::vector<Path> passes;  ///< extra folders of pass libraries
    std::string device;        ///< name or index; empty: the best
    std::string rays;          ///< ray body; empty: the fastest
};

class Renderer {
public:
    /// Without a device it opens one when first asked for it, because much can be found wrong without.
    explicit Renderer(RendererOptions options = {}, std::shared_ptr<const gpu::Device> device = {});

    PluginLibraries& libraries() { return libraries_; }
    const gpu::Device& device();
    RayBody rays();  ///< of the device; Error when it has not the one asked for

    /// Reads and checks a graph, which must not outlive this.
    Graph build(const Path& file, const GraphOptions& changes) { return buildGraph(loadDescription(file, changes), libraries_); }
    /// A runner whose shaders are ready; graph and scene must outlive it, as must this. The rays in `options` are those of this; `progress`, if any,
    /// is told how many of how many shaders are ready.
    std::unique_ptr<Runner> bringUp(Graph& graph, const Scene& scene, RunnerOptions options = {},
                                    const std::function<void(std::size_t done, std::size_t all)>& progress = {});

private:
    RendererOptions options_;
    std::shared_ptr<const gpu::Device> device_;
    PluginLibraries libraries_;
};

}  // namespace lodestir
