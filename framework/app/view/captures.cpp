// SPDX-License-Identifier: MIT
#include <framework/app/view/captures.h>

#include <framework/gpu/commands.h>

#include <fmt/format.h>

namespace lodestir {

std::string pictureName(const Path& graph, const std::string& variant, const Picture& picture) {
    return fmt::format("{}{}  {}  frame {}", graph.stem().string(), variant.empty() ? "" : " (" + variant + ")", picture.port, picture.frame);
}

Picture Captures::take(const Runner& runner, const PortInfo& port, const CameraKey& camera) {
    if (!port.runs || port.extent.x == 0) return {};
    const std::shared_ptr<gpu::Buffer> buffer = spareBuffer(port.bytes);
    gpu::runOnce(*device_, [&](gpu::Commands& commands) {
        commands.barrier();
        commands.copy(runner.memoryOf(port.source), 0, *buffer, 0, port.bytes);
    });
    return {.texels = buffer, .port = port.name, .extent = port.extent, .camera = camera, .frame = runner.nextFrame() - 1, .number = ++pictures_};
}

Picture Captures::upload(const ImageData& image, const std::string& name) {
    auto buffer = std::make_shared<gpu::Buffer>(gpu::makeBuffer(*device_, std::span<const float>(image.values), "picture from a file"));
    return {.texels = std::move(buffer), .port = name, .extent = {image.width, image.height}, .camera = {}, .frame = 0, .number = ++pictures_};
}

std::span<const std::byte> Captures::bytesOf(const Picture& picture) {
    const gpu::Buffer& buffer = *picture.texels;
    if (buffer.mapped()) return {buffer.mapped(), buffer.size()};
    copy_.resize(buffer.size());
    gpu::readBuffer(*device_, buffer, 0, copy_);
    return copy_;
}

std::shared_ptr<gpu::Buffer> Captures::spareBuffer(std::size_t bytes) {
    std::erase_if(buffers_, [&](const auto& buffer) { return buffer.use_count() == 1 && buffer->size() < bytes; });
    for (const auto& buffer : buffers_)
        if (buffer.use_count() == 1) return buffer;
    buffers_.push_back(std::make_shared<gpu::Buffer>(*device_, bytes, gpu::Memory::device, "captured port"));
    return buffers_.back();
}

}  // namespace lodestir
