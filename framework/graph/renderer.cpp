// SPDX-License-Identifier: MIT
#include <framework/graph/renderer.h>

namespace lodestir {

Renderer::Renderer(RendererOptions options, std::shared_ptr<const gpu::Device> device)
    : options_(std::move(options)), device_(std::move(device)), libraries_(options_.passes) {}

const gpu::Device& Renderer::device() {
    if (!device_) device_ = std::make_shared<const gpu::Device>(gpu::DeviceOptions{.choice = options_.device});
    return *device_;
}

RayBody Renderer::rays() { return chooseRayBody(device().facts(), options_.rays); }

std::unique_ptr<Runner> Renderer::bringUp(Graph& graph, const Scene& scene, RunnerOptions options,
                                          const std::function<void(std::size_t, std::size_t)>& progress) {
    options.rays = rays();
    auto runner = std::make_unique<Runner>(device(), graph, scene, std::move(options));
    runner->prepare(progress ? progress : [](std::size_t, std::size_t) {});
    return runner;
}

}  // namespace lodestir
