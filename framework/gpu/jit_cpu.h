// SPDX-License-Identifier: MIT
// How a driver that compiles shaders for the CPU (lavapipe, by LLVM) can make them read memory.
#pragma once
#include <string>

namespace lodestir::gpu {

/// The ways in which the lanes of a vector read from different addresses.
enum class Gathers {
    fast,   ///< by one instruction, which the compiler uses by itself
    named,  ///< by one instruction, which it uses once it is told that this CPU is one of those where that is faster (see jit_cpu.cpp)
    none,   ///< lane by lane, each behind a branch
};
/// Of this process's CPU. To be asked once the driver is loaded (vkEnumeratePhysicalDevices).
Gathers gathersOfCpu();
/// The same as the end of a sentence.
std::string gathersText(Gathers gathers);

}  // namespace lodestir::gpu
