// SPDX-License-Identifier: MIT
// The device of a test program: graphs that follow one another on it share the kernels that are alike.
#pragma once
#include <framework/gpu/device.h>

#include <memory>

namespace lodestir::test {

/// Opened when first asked for, and kept to the end.
inline const std::shared_ptr<const gpu::Device>& sharedDevice() {
    static const auto device = std::make_shared<const gpu::Device>();
    return device;
}

}  // namespace lodestir::test
