// SPDX-License-Identifier: MIT
// Asking the driver's compiler what CPU it makes code for, while another thread loads libraries.

#include <framework/gpu/jit_cpu.h>

#include <gtest/gtest.h>

#include <atomic>
#include <dlfcn.h>
#include <thread>
#include <unistd.h>

namespace {

struct Name {
    const char* data;
    std::size_t size;
};
extern "C" Name cpuName() asm("_ZN4llvm3sys14getHostCPUNameEv");

// If this fails (SIGALRM), a viewer that compiles while it loads a pass hangs once in some fifty starts.
TEST(JitCpu, AnswersWhileLibrariesAreLoaded) {
    void* driver = dlopen("libvulkan_lvp.so", RTLD_LAZY);
    if (!driver) GTEST_SKIP() << "needs lavapipe, whose LLVM is asked";
    constexpr const char* library = LODESTIR_BUILD_DIR "/passes/basic/accumulate/libaccumulate.so";
    ::alarm(60);
    std::atomic<bool> ends = false;
    std::jthread loader([&] {
        while (!ends) {
            void* handle = dlopen(library, RTLD_LAZY);
            if (handle) dlclose(handle);
        }
    });
    std::string name;
    for (int i = 0; i < 1000; ++i) {
        const Name said = cpuName();
        name.assign(said.data, said.size);
        lodestir::gpu::gathersOfCpu();
    }
    ends = true;
    ::alarm(0);
    EXPECT_FALSE(name.empty());
}

}  // namespace
