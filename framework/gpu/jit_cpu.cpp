// SPDX-License-Identifier: MIT
// Which CPU lavapipe's compiler takes this one for.
//
// LLVM turns a read that differs from lane to lane into the CPU's gather instruction where it believes that instruction to be fast: with
// AVX-512, and of the CPUs with AVX2 alone on Intel's from Skylake on. Elsewhere (Zen 1 to 3, Haswell) it writes a branch for each lane and
// word. A kernel then has tens of thousands of branches, takes minutes to compile, and is slower, too: gathers pay there as well
// (docs/rays.md has what was measured). There is no option for it; but LLVM asks a function of its own for the CPU's name, and a program
// that has a function of that name is asked instead. The name only tunes: which instructions may be used is told to LLVM apart, by the driver.
#include <framework/gpu/jit_cpu.h>

#include <framework/core/api.h>

#if defined(__x86_64__)
#include <cpuid.h>
#endif
#include <dlfcn.h>
#include <link.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace lodestir::gpu {

/// Like llvm::StringRef.
struct Name {
    const char* data;
    std::size_t size;
};

namespace {

constexpr std::string_view gatheringCpu = "skylake";
constexpr const char* symbol = "_ZN4llvm3sys14getHostCPUNameEv";

#if defined(__x86_64__)
/// Mesa's drivers can be told to use less than the CPU has; "avx": all but AVX-512.
std::string_view overriddenCaps() {
    const char* caps = std::getenv("GALLIUM_OVERRIDE_CPU_CAPS");
    return caps ? caps : "";
}
bool hasAvx512() { return overriddenCaps().empty() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl"); }
/// By CPUID itself: not every compiler's __builtin_cpu_supports knows their names.
bool hasLzcntAndMovbe() {
    unsigned a = 0, b = 0, plain = 0, extended = 0, d = 0;
    return __get_cpuid(1, &a, &b, &plain, &d) && (plain & bit_MOVBE) && __get_cpuid(0x80000001, &a, &b, &extended, &d) && (extended & bit_LZCNT);
}
/// AVX2 and all else that a Skylake client has of instructions which compilers use by themselves.
bool hasAvx2() {
    return (overriddenCaps().empty() || overriddenCaps() == "avx") && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
           __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2") && hasLzcntAndMovbe();
}
#else
bool hasAvx512() { return false; }
bool hasAvx2() { return false; }
#endif

/// LLVM's own function, in the library that the driver has brought along; nullptr where there is none. The walk over libraries holds a lock that a dlopen
/// of another thread waits for while it holds the one that dlopen takes: so libraries are opened after it.
Name (*ownFunction())() {
    std::vector<std::string> libraries;
    dl_iterate_phdr(
        [](dl_phdr_info* library, std::size_t, void* found) {
            if (std::strstr(library->dlpi_name, "libLLVM")) static_cast<std::vector<std::string>*>(found)->emplace_back(library->dlpi_name);
            return 0;
        },
        &libraries);
    for (const std::string& library : libraries) {
        void* handle = dlopen(library.c_str(), RTLD_LAZY | RTLD_NOLOAD);
        if (!handle) continue;
        void* function = dlsym(handle, symbol);
        dlclose(handle);  // it was loaded before, and stays
        if (function) return reinterpret_cast<Name (*)()>(function);
    }
    return nullptr;
}

}  // namespace

extern "C" LODESTIR_API Name lodestirCpuName() asm("_ZN4llvm3sys14getHostCPUNameEv");
extern "C" Name lodestirCpuName() {
    if (hasAvx2() && !hasAvx512()) return {gatheringCpu.data(), gatheringCpu.size()};
    const auto own = ownFunction();
    return own ? own() : Name{"", 0};
}

Gathers gathersOfCpu() {
    if (hasAvx512()) return Gathers::fast;
    if (!hasAvx2() || !ownFunction()) return Gathers::none;
    // What LLVM will be told: by the function above, if no other one was loaded before it.
    const auto answering = reinterpret_cast<Name (*)()>(dlsym(RTLD_DEFAULT, symbol));
    const Name answer = answering ? answering() : Name{"", 0};
    return std::string_view(answer.data, answer.size) == gatheringCpu ? Gathers::named : Gathers::none;
}

std::string readsText(bool texels) {
    const Gathers gathers = gathersOfCpu();
    if (texels) return gathers == Gathers::none ? "by texel: this CPU cannot gather" : "by texel, as LODESTIR_RECORDS asks for";
    if (gathers == Gathers::fast) return "by the CPU's gathers";
    if (gathers == Gathers::named) return "by the CPU's gathers, which its compiler had to be told to use";
    return "lane by lane, which is slow and compiles for minutes";
}

}  // namespace lodestir::gpu
