// SPDX-License-Identifier: MIT
// Kernels of a CPU driver compiled on several cores at once.
#pragma once
#include <framework/graph/kernel_source.h>

#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace lodestir {

/// Makes a pipeline of each source that the device keeps none of; `made(i, pipeline, milliseconds)` is told as each is ready. Kernels that this
/// machine's driver hasn't compiled before are compiled by several devices at once, each of which has one thread for it: what the others compile comes
/// back through the driver's cache on disk.
void compileAhead(const gpu::Device& device, std::span<const KernelSource> sources,
                  const std::function<void(std::size_t, std::shared_ptr<const gpu::Pipeline>, double)>& made);

}  // namespace lodestir
