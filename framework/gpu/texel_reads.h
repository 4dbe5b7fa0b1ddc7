// SPDX-License-Identifier: MIT
// Turns reads of arrays through device addresses into fetches from one texel buffer over the same memory (gpu/heap.h).
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace lodestir::gpu {

/// Rewrites SPIR-V. What is read of arrays (`buffer Records { Record at[]; }`) that the shader does not write is fetched as texels of 16
/// bytes; everything else (single structs, what is written, atomics, `volatile` and `coherent` blocks, numbers of less than 32 bits) stays
/// as it is. Texel i is the 16 bytes at device address 16 i, modulo 2^32.
///
/// CPU drivers turn one read that differs from lane to lane into a branch a word and lane, on CPUs that have no fast gathers; a fetch is one
/// call. docs/rays.md has what was measured. An array whose elements take a multiple of 16 (8, 4) bytes must begin at one: then the places
/// of an element's words in their texels are known when the shader is compiled, and nothing has to be shifted.
std::vector<std::uint32_t> readByTexels(std::span<const std::uint32_t> spirv);

}  // namespace lodestir::gpu
