// SPDX-License-Identifier: MIT
// How full a device's memory is.
#pragma once
#include <framework/gpu/device.h>

namespace lodestir::gpu {

/// The share that this process has taken of the heap that is fullest of it, from 0 to 1.
LODESTIR_API double memoryShare(const Device& device);

}  // namespace lodestir::gpu
