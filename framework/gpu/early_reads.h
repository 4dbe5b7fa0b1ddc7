// SPDX-License-Identifier: MIT
// What a kernel does before its main() can return.
#pragma once
#include <cstdint>
#include <span>

namespace lodestir::gpu {

/// Whether a shader reads or writes memory by address before main's first branch: in main, in the initialisers of its globals, which run first, or
/// in a function that either calls. A dispatch that only makes the driver compile has no memory.
bool touchesMemoryEarly(std::span<const std::uint32_t> spirv);

}  // namespace lodestir::gpu
