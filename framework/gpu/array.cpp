// SPDX-License-Identifier: MIT
#include <framework/gpu/array.h>

#include <framework/gpu/commands.h>

#include <cstring>

namespace lodestir::gpu {

void fillBuffer(const Device& device, const Buffer& buffer, std::span<const std::byte> bytes) {
    if (bytes.empty()) return;
    if (buffer.mapped()) {
        std::memcpy(buffer.mapped(), bytes.data(), bytes.size());
        return;
    }
    const Buffer staging(device, bytes.size(), Memory::upload, "staging");
    std::memcpy(staging.mapped(), bytes.data(), bytes.size());
    runOnce(device, [&](Commands& commands) { commands.copy(staging, 0, buffer, 0, bytes.size()); });
}

}  // namespace lodestir::gpu
