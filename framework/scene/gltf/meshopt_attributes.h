// SPDX-License-Identifier: MIT
// Version 1 of meshoptimizer's attribute format, which KHR_meshopt_compression adds and older libraries do not know.
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace lodestir {

/// Is the stream of version 1? Version 0 is left to the library.
bool isMeshoptVersion1(std::span<const std::byte> stream);

/// `count` elements of `stride` bytes (a multiple of 4 up to 256) from a stream of version 1 (KHR_meshopt_compression, appendix A, mode 0).
/// Nothing when the stream is too short, too long or names a mode that doesn't exist.
std::optional<std::vector<std::byte>> decodeMeshoptVersion1(std::span<const std::byte> stream, std::size_t count, std::size_t stride);

}  // namespace lodestir
