// SPDX-License-Identifier: MIT
// Preloaded into a program, makes lavapipe compile for the CPU that CPU_NAME names: what the compiler, LLVM, believes of the CPU is the
// answer of one exported function, and a preloaded one is found first. An older CPU's name is safe, a newer one's is not.
#include <cstddef>
#include <cstdlib>
#include <cstring>

#include <unistd.h>

namespace {

struct Text {  // laid out as llvm::StringRef
    const char* begin;
    std::size_t length;
};

}  // namespace

extern "C" __attribute__((visibility("default"))) Text hostCpuName() asm("_ZN4llvm3sys14getHostCPUNameEv");

extern "C" Text hostCpuName() {
    const char* name = std::getenv("CPU_NAME");
    if (!name) name = "x86-64";
    // Said once, so that a test can tell whether the driver asks for the name here at all.
    static const bool said = ::write(STDERR_FILENO, "cpu_name: asked\n", 16) == 16;
    (void)said;
    return {name, std::strlen(name)};
}
