// SPDX-License-Identifier: MIT
// Copies of ports as a frame left them, to be looked at while the next one is made. Their memory is used again once nobody looks any more.
#pragma once
#include <framework/app/view/view_state.h>

#include <memory>
#include <span>
#include <vector>

namespace lodestir {

/// Graph, variant, port, frame: what tells one picture from another.
std::string pictureName(const Path& graph, const std::string& variant, const Picture& picture);

class Captures {
public:
    explicit Captures(std::shared_ptr<const gpu::Device> device) : device_(std::move(device)) {}

    /// What a port holds after the frame that `runner` has made last; nothing where it runs not or is no picture.
    Picture take(const Runner& runner, const PortInfo& port, const CameraKey& camera);
    /// An image of floats, from elsewhere.
    Picture upload(const ImageData& image, const std::string& name);
    /// The memory of a picture; valid until this is asked again.
    std::span<const std::byte> bytesOf(const Picture& picture);

private:
    std::shared_ptr<gpu::Buffer> spareBuffer(std::size_t bytes);

    std::shared_ptr<const gpu::Device> device_;
    std::vector<std::shared_ptr<gpu::Buffer>> buffers_;
    std::vector<std::byte> copy_;
    std::uint64_t pictures_ = 0;
};

}  // namespace lodestir
