// SPDX-License-Identifier: MIT
// On this CPU made to look like lesser ones, graphs end and their images are those of the plain run.
#include "../end_to_end/program.h"

#include <framework/gpu/device.h>

#include <ostream>

namespace lodestir::test {
namespace {

struct Variant {
    std::string name;
    Environment environment;
    std::uint32_t lanes = 0;  ///< of a subgroup, which the environment brings about; 0: as many as without
    std::string records = {};  ///< how records must be read then, as `lodestir devices` tells it; empty: however
};

/// Vectors of 128 bits, as on ARM and on x86 before AVX; such CPUs have no gathers, so that records are read as texels.
Variant fourLanes() { return {"four_lanes", {{"LP_NATIVE_VECTOR_WIDTH", "128"}, {"LODESTIR_RECORDS", "texels"}}, 4, "by texel"}; }
/// Vectors of 512 bits, which lavapipe takes on request.
Variant sixteenLanes() { return {"sixteen_lanes", {{"LP_NATIVE_VECTOR_WIDTH", "512"}}, 16}; }
/// AVX2 at most: the driver's compiler has to be told to use its gathers (gpu/jit_cpu.h).
Variant withoutAvx512() { return {"without_avx512", {{"GALLIUM_OVERRIDE_CPU_CAPS", "avx"}}, 0, "had to be told"}; }
/// A CPU whose gathers the compiler does not use, and cannot be told to: reads of different addresses become branches, and reads of one
/// address happen where a branch forbids them.
Variant withoutGathers() {
    return {"without_gathers", {{"GALLIUM_OVERRIDE_CPU_CAPS", "avx"}, {"LD_PRELOAD", CPU_NAME_LIBRARY}, {"CPU_NAME", "znver3"}}, 0, "by texel"};
}

struct Case {
    Variant (*variant)();
    const char *graph, *scene, *show;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.variant().name << ", " << c.graph; }

/// What the program finds of the device under a variant.
OrderedJson factsUnder(const Variant& variant) {
    for (const auto& facts : OrderedJson::parse(runProcess({LODESTIR_BINARY, "devices", "--json"}, variant.environment).out))
        if (facts["chosen"] == true) return facts;
    return {};
}

/// Why a variant cannot be had on this machine; empty where it can.
std::string whyNot(const Variant& variant) {
    const auto devices = gpu::listDevices();
    if (std::ranges::none_of(devices, &gpu::DeviceFacts::usable)) return "no usable Vulkan device";
    const gpu::DeviceFacts& device = devices[gpu::chooseDevice(devices, "")];
    if (!device.isLavapipe) return "the device is " + device.name + ", not lavapipe";
    if (variant.lanes != 0) {
        if (device.subgroupSize == variant.lanes) return "this CPU itself has as many lanes a subgroup: all other tests are this one";
        if (factsUnder(variant)["subgroupSize"] == variant.lanes) return {};
        return "the driver does not take its number of lanes from LP_NATIVE_VECTOR_WIDTH";
    }
#if defined(__x86_64__)
    if (!__builtin_cpu_supports("avx2")) return "the CPU itself has no AVX2, which the variant is about";
    return {};
#else
    return "only an x86 CPU can play another";
#endif
}

class CpuVariants : public ProgramTest, public testing::WithParamInterface<Case> {
protected:
    struct Rendered {
        ImageData image;
        double rays = 0;
        std::string said;  ///< on stderr
    };
    /// The second frame, which has a history.
    Rendered secondFrame(const std::string& out, Environment environment) {
        const Case& c = GetParam();
        environment.emplace_back("LODESTIR_VALIDATION", "1");
        const Output output = runProcess({LODESTIR_BINARY, "run", (sourceFolder / "graphs" / (std::string(c.graph) + ".json")).string(), "--scene",
                                          (sourceFolder / "scenes" / (std::string(c.scene) + ".json")).string(), "--size", "32x18", "--frames", "2",
                                          "--show", c.show, "--check-nan", "--out", (folder / out).string()},
                                         environment, std::chrono::seconds(200));
        EXPECT_FALSE(output.timedOut) << "it hangs, or the driver compiles for minutes\n" << output.err;
        EXPECT_EQ(output.exitCode, 0) << "signal " << output.signal << "\n" << output.err;
        EXPECT_EQ(output.err.find("validation"), std::string::npos) << output.err;
        if (HasFailure()) return {};
        Rendered result{readExr(folder / out / (std::string(c.show) + ".1.exr")), 0, output.err};
        const OrderedJson report = readJson(folder / out / "run.json");
        for (const OrderedJson& pass : report["frames"][1]["passes"])
            for (const OrderedJson& count : pass["rays"]) result.rays += count.get<double>();
        return result;
    }
};

// Both runs draw the same random numbers, and rounding, which differs, tips a choice in few pixels. A tile is a twelfth of the image and a
// lane's share a quarter at most, a sixteenth at least: what is left out or wrong shows in the image, what is done twice in the rays.
TEST_P(CpuVariants, ShowThePlainImage) {
    Variant variant = GetParam().variant();
    if (const std::string reason = whyNot(variant); !reason.empty()) GTEST_SKIP() << reason;
    if (!variant.records.empty()) {
        const std::string records = factsUnder(variant)["records"].get<std::string>();
        EXPECT_NE(records.find(variant.records), std::string::npos) << "records are read " << records;
    }
    const Rendered plain = secondFrame("plain", {});
    // A cache of its own, because the driver takes kernels for the same whatever the number of lanes and the name of the CPU.
    const char* cache = std::getenv("MESA_SHADER_CACHE_DIR");
    variant.environment.emplace_back("MESA_SHADER_CACHE_DIR", Path(cache ? cache : LODESTIR_BUILD_DIR) / variant.name);
    const Rendered other = secondFrame("other", variant.environment);
    if (HasFailure()) return;
    if (variant.name == "without_gathers" && other.said.find("cpu_name: asked") == std::string::npos)
        GTEST_SKIP() << "the driver's compiler does not ask for the CPU's name where a preloaded library can answer";

    const std::vector<float>&values = plain.image.values, &others = other.image.values;
    std::size_t differ = 0;
    for (std::size_t i = 0; i < values.size(); ++i) differ += std::abs(values[i] - others[i]) > 1e-3f * (1 + std::abs(values[i]));
    const double energy = meanOf(other.image) / meanOf(plain.image);
    std::printf("energy %.6f and rays %.6f of the plain image's, %zu of %zu values differ\n", energy, other.rays / plain.rays, differ, values.size());
    EXPECT_GT(meanOf(plain.image), 0);
    EXPECT_GT(plain.rays, 0);
    EXPECT_NEAR(energy, 1, 0.02);
    EXPECT_NEAR(other.rays / plain.rays, 1, 0.02);
    EXPECT_LE(differ, values.size() / 20);
}

// One line a graph. Where the driver compiles longest, restir_lod is left out: it reads in the same ways with four lanes.
INSTANTIATE_TEST_SUITE_P(FourLanes, CpuVariants,
                         testing::Values(Case{fourLanes, "path_tracer", "cornell", "trace"},
                                         Case{fourLanes, "restir_pt", "cornell", "shade"},
                                         Case{fourLanes, "restir_lod", "cube", "shade"}));
INSTANTIATE_TEST_SUITE_P(SixteenLanes, CpuVariants,
                         testing::Values(Case{sixteenLanes, "path_tracer", "cornell", "trace"}));
INSTANTIATE_TEST_SUITE_P(WithoutAvx512, CpuVariants,
                         testing::Values(Case{withoutAvx512, "path_tracer", "cornell", "trace"},
                                         Case{withoutAvx512, "restir_pt", "cornell", "shade"},
                                         Case{withoutAvx512, "restir_lod", "cube", "shade"}));
INSTANTIATE_TEST_SUITE_P(WithoutGathers, CpuVariants,
                         testing::Values(Case{withoutGathers, "path_tracer", "cornell", "trace"},
                                         Case{withoutGathers, "restir_pt", "cornell", "shade"}));

}  // namespace
}  // namespace lodestir::test

/// A test of which nothing could be tried is skipped, also for ctest.
int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    const int code = RUN_ALL_TESTS();
    const auto& tests = *testing::UnitTest::GetInstance();
    return code == 0 && tests.skipped_test_count() > 0 && tests.skipped_test_count() == tests.test_to_run_count() ? 77 : code;
}
