// SPDX-License-Identifier: MIT
// What a kernel does before its main() can return.
#pragma once
#include <cstdint>
#include <span>

namespace lodestir::gpu {

/// Whether a shader reads an array by address, or writes memory at all, before main's first branch: in main, in the initialisers of its
/// globals, which run first, or in a function that either calls. A dispatch that only makes the driver compile has a block, and handles, but
/// no arrays.
bool touchesMemoryEarly(std::span<const std::uint32_t> spirv);

}  // namespace lodestir::gpu
