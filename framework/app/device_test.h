// SPDX-License-Identifier: MIT
// Does a device do what it says? Two small tasks, each in a process of its own, because a driver that is broken crashes or never ends.
#pragma once
#include <framework/core/json.h>

#include <string>

namespace lodestir {

struct DeviceTestOptions {
    std::string device;  ///< see gpu::DeviceOptions::choice
    std::string rays;    ///< see chooseRayBody
    double limit = 120;  ///< seconds that each task may take
    bool json = false;
};

/// Tries the tasks, prints a line for each (or JSON), and returns the exit status: 0 when all work, else 1. Like runInChild it is to be
/// called before this process has opened a driver.
int testDevice(const DeviceTestOptions& options);

}  // namespace lodestir
