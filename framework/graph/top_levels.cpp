// SPDX-License-Identifier: MIT
#include <framework/graph/top_levels.h>

#include <framework/core/files.h>

#include <array>

namespace lodestir {
namespace {

gpu::Pipeline instanceListPipeline(const gpu::Device& device) {
    const Path shaders = shaderFolder();
    const gpu::ShaderSource source{.file = shaders / "trace/instance_list.comp", .folders = {shaders}, .generated = {}, .defines = {}};
    return {device, gpu::compileShader(source), {}, 2 * sizeof(VkDeviceAddress), "instance list"};
}

}  // namespace

TopLevels::TopLevels(const gpu::Device& device) : device_(device), listInstances_(instanceListPipeline(device)) {}

std::shared_ptr<const void> TopLevels::add(World& world, VkDeviceAddress place) {
    auto made = std::make_shared<Structure>();
    made->world = place;
    made->count = world.instanceCount * (world.dissolves != 0 ? 2 : 1);
    made->instances = gpu::Buffer(device_, made->count * sizeof(VkAccelerationStructureInstanceKHR), gpu::Memory::device, "query instances");
    made->top = gpu::makeTopLevel(device_, made->instances.address(), made->count);
    world.tlas = made->top->address();
    waiting_.push_back(made);
    return made;
}

void TopLevels::record(gpu::Commands& commands) {
    if (waiting_.empty()) return;
    commands.barrier();
    for (const auto& s : waiting_) {
        const std::array<VkDeviceAddress, 2> push{s->world, s->instances.address()};
        commands.dispatch(listInstances_, std::as_bytes(std::span(push)), (s->count + 63) / 64);
    }
    commands.barrier();
    for (const auto& s : waiting_) s->top->build(commands);
    commands.barrier();
    waiting_.clear();
}

}  // namespace lodestir
