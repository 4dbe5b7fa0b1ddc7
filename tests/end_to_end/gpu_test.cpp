// SPDX-License-Identifier: MIT
// The GPU layer on a real device: memory there and back, addresses, specialization, 64-bit atomics, timestamps, errors.
#include <framework/core/error.h>
#include <framework/gpu/commands.h>
#include <framework/gpu/heap.h>
#include <framework/gpu/pipeline_cache.h>
#include <framework/graph/kernel_source.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <numeric>
#include <optional>
#include <unistd.h>

namespace lodestir::gpu {
namespace {

class GpuTest : public ::testing::Test {
protected:
    void SetUp() override {
        if (std::ranges::none_of(listDevices(), &DeviceFacts::usable)) GTEST_SKIP() << "no usable Vulkan device";
        DeviceOptions options;
        options.validation = true;
        device_.emplace(options);
        folder_ = std::filesystem::temp_directory_path() / ("lodestir_gpu_test_" + std::to_string(getpid()));
    }
    void TearDown() override {
        if (!device_) return;
        EXPECT_EQ(device_->validationMessages(), std::vector<std::string>{});
        std::filesystem::remove_all(folder_);
    }
    Spirv compile(const std::string& text) {
        writeFile(folder_ / "test.comp", text);
        return compileShader({folder_ / "test.comp", {}, {}, {}});
    }

    std::optional<Device> device_;
    Path folder_;
};

struct Push {
    std::uint64_t out;
    std::uint32_t count;
};
constexpr std::size_t pushBytes = 12;
std::span<const std::byte> bytesOf(const Push& push) { return std::as_bytes(std::span(&push, 1)).first(pushBytes); }

const char* const sums = R"(#version 460
layout(local_size_x = 64) in;
layout(buffer_reference, scalar) buffer Out { uint64_t sum, least; uint words[]; };
layout(push_constant, scalar) uniform Push { Out result; uint count; } push;
layout(constant_id = 3) const uint FACTOR = 1;
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    push.result.words[i] = i * FACTOR;
    atomicAdd(push.result.sum, uint64_t(i) << 20);
    atomicMin(push.result.least, (uint64_t(~i) << 32) | i);
}
)";

// If this fails, graphs that follow one another compile again what they share, or hold all that was ever compiled.
TEST_F(GpuTest, PipelinesAskedForLateAreKept) {
    const Spirv spirv = compile("#version 460\nvoid main() {}\n");
    const auto hash = [](int i) { return Hash().addValue(i); };
    PipelineCache& cache = device_->pipelines();
    EXPECT_EQ(cache.find(hash(0)), nullptr);
    std::vector<std::shared_ptr<const Pipeline>> made;
    for (int i = 0; i < 256; ++i) made.push_back(cache.keep(hash(i), Pipeline(*device_, spirv, {}, 0, "kept")));
    for (int i = 0; i < 256; ++i) EXPECT_EQ(cache.find(hash(i)), made[std::size_t(i)]) << i;
    EXPECT_EQ(cache.find(hash(0)), made[0]);
    cache.keep(hash(256), Pipeline(*device_, spirv, {}, 0, "one more"));
    EXPECT_EQ(cache.find(hash(0)), made[0]) << "it was asked for just now";
    EXPECT_EQ(cache.find(hash(1)), nullptr) << "nobody has asked for it for longest";
    EXPECT_NE(cache.find(hash(256)), nullptr);
}

TEST_F(GpuTest, ShadersReachMemoryByAddress) {
    constexpr std::uint32_t count = 100'000;
    const Specialization factor{3, 7};
    const Pipeline pipeline(*device_, compile(sums), std::span(&factor, 1), pushBytes, "sums");
    const Buffer out(*device_, 16 + 4 * count, Memory::device, "out");
    EXPECT_EQ(out.address() % 256, 0u);
    Commands commands(*device_);
    const auto start = std::chrono::steady_clock::now();
    commands.begin();
    commands.fill(out, 0, 8, 0);
    commands.fill(out, 8, 8, ~0u);
    commands.barrier();
    const std::uint32_t before = commands.timestamp();
    commands.beginLabel("sums");
    commands.dispatch(pipeline, bytesOf({out.address(), count}), (count + 63) / 64);
    commands.endLabel();
    const std::uint32_t after = commands.timestamp();
    commands.submit();
    commands.wait();
    const double wall = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();

    std::vector<std::uint32_t> words(4 + count);
    readBuffer(*device_, out, 0, std::as_writable_bytes(std::span(words)));
    for (std::uint32_t i = 0; i < count; ++i) ASSERT_EQ(words[4 + i], i * 7);
    std::uint64_t sum = 0, least = 0;
    std::memcpy(&sum, &words[0], 8);
    std::memcpy(&least, &words[2], 8);
    EXPECT_EQ(sum, std::uint64_t{count} * (count - 1) / 2 << 20);
    EXPECT_EQ(least, std::uint64_t{~(count - 1)} << 32 | (count - 1));
    if (device_->facts().timestampBits == 0) return;
    EXPECT_GT(commands.milliseconds(before, after), 0);
    EXPECT_LE(commands.milliseconds(before, after), wall);
}

TEST_F(GpuTest, MemoryGoesThereAndBack) {
    std::vector<std::uint32_t> values(1'000'003);
    std::iota(values.begin(), values.end(), 5u);
    // The second time as on a GPU with memory of its own, through staging copies.
    for (const bool staged : {false, true}) {
        if (staged) const_cast<DeviceFacts&>(device_->facts()).unifiedMemory = false;
        const Buffer buffer = makeBuffer<std::uint32_t>(*device_, values, "values");
        EXPECT_EQ(buffer.mapped() == nullptr, staged || !device_->facts().unifiedMemory);
        EXPECT_GE(buffer.size(), values.size() * 4);
        std::vector<std::uint32_t> back(1000);
        readBuffer(*device_, buffer, 4 * 123'456, std::as_writable_bytes(std::span(back)));
        EXPECT_TRUE(std::equal(back.begin(), back.end(), values.begin() + 123'456));

        const Buffer copy(*device_, values.size() * 4, Memory::readback, "copy");
        runOnce(*device_, [&](Commands& commands) {
            commands.copy(buffer, 0, copy, 0, values.size() * 4);
            commands.barrier();
            commands.fill(copy, 8, 4, 99);
        });
        ASSERT_NE(copy.mapped(), nullptr);
        std::memcpy(back.data(), copy.mapped(), back.size() * 4);
        EXPECT_EQ(back[1], values[1]);
        EXPECT_EQ(back[2], 99u);
        EXPECT_EQ(back[3], values[3]);
    }
}

TEST_F(GpuTest, CommandsCanBeUsedAgain) {
    const Pipeline pipeline(*device_, compile(sums), {}, pushBytes, "sums");
    const Buffer out(*device_, 16 + 4 * 64, Memory::device, "out");
    Commands commands(*device_, 2);
    for (int round = 0; round < 3; ++round) {  // no wait: begin() waits
        commands.begin();
        commands.timestamp();
        commands.dispatch(pipeline, bytesOf({out.address(), 0}), 1);
        commands.dispatch(pipeline, bytesOf({out.address(), 0}), 0);  // nothing
        commands.timestamp();
        commands.submit();
    }
}

TEST_F(GpuTest, WrongUseIsToldInWords) {
    const auto errorOf = [](auto&& action) -> std::string {
        try {
            action();
        } catch (const Error& error) {
            return error.what();
        }
        return "no error";
    };
    EXPECT_NE(errorOf([&] { Buffer(*device_, std::size_t{1} << 60, Memory::device, "huge"); }).find("buffer \"huge\" needs"),
              std::string::npos);
    const Pipeline pipeline(*device_, compile(sums), {}, pushBytes, "sums");
    Commands commands(*device_, 1);
    commands.begin();
    EXPECT_NE(errorOf([&] {
                  commands.dispatch(pipeline, bytesOf({0, 0}), 1, 0xffffffffu);
              }).find("workgroups; the device allows"),
              std::string::npos);
    EXPECT_NE(errorOf([&] { Pipeline(*device_, compile(sums), {}, 1u << 20, "greedy"); }).find("greedy"), std::string::npos);
    const Buffer small(*device_, 4, Memory::device, "small");
    std::byte out[512];
    EXPECT_NE(errorOf([&] { readBuffer(*device_, small, 0, out); }).find("512"), std::string::npos);
    commands.submit();
}

const char* const reads = R"(#version 460
#extension GL_EXT_scalar_block_layout : enable
layout(local_size_x = 8) in;
struct Inner { vec2 x; uint y; };
struct Record { uint a; vec3 b; mat3 m; uint64_t c; Inner inner[3]; ivec2 d; uint e[2]; };  // 29 words
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Bytes4 { uint at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer Bytes8 { vec2 at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Bytes12 { vec3 at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer Bytes16 { uvec4 at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer Bytes24 { mat2x3 at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer Bytes32 { Inner at[][2]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Records { Record at[]; };
layout(buffer_reference, scalar) buffer Out { uint at[]; };
layout(push_constant, scalar) uniform Push { Out result; uint64_t data; } push;
uint n = 0u;
void put(uint v) { push.result.at[gl_GlobalInvocationID.x * 256u + n++] = v; }
void put(vec3 v) { put(floatBitsToUint(v.x)); put(floatBitsToUint(v.y)); put(floatBitsToUint(v.z)); }
void main() {
    uint i = gl_GlobalInvocationID.x;
    put(Bytes4(push.data).at[7u * i + 1u]);
    put(floatBitsToUint(Bytes8(push.data).at[3u * i].y));
    put(vec3(Bytes8(push.data).at[i + 1u], 0));
    put(Bytes12(push.data).at[i]);
    put(Bytes16(push.data).at[i][i & 3u]);
    put(Bytes24(push.data).at[i][i & 1u]);
    put(Bytes16(push.data).at[2].z);
    Record r = Records(push.data).at[i + 2u];
    put(r.a);
    put(r.b);
    for (int k = 0; k < 3; ++k) put(r.m[k]);
    put(uint(r.c));
    put(uint(r.c >> 32));
    put(r.inner[i % 3u].y);
    put(floatBitsToUint(Records(push.data).at[i].inner[i % 3u].x.y));
    put(floatBitsToUint(Records(push.data).at[i].m[i % 3u][i % 2u]));
    put(uint(Records(push.data).at[3].d.y));
    put(Records(push.data).at[i].e[i & 1u]);
}
)";

// A device whose kernels read by texel, as on CPUs without gathers.
class TexelReadsTest : public ::testing::Test {
protected:
    void SetUp() override {
        setenv("LODESTIR_RECORDS", "texels", 1);
        const std::vector<DeviceFacts> devices = listDevices();
        const bool can = std::ranges::any_of(devices, [](const DeviceFacts& d) { return d.usable() && d.readsTexels; });
        if (can) device.emplace(DeviceOptions{.choice = "llvmpipe", .validation = true});
        unsetenv("LODESTIR_RECORDS");
        if (!can) GTEST_SKIP() << "no lavapipe with VK_EXT_external_memory_host: nothing is read by texel here";
    }
    void TearDown() override {
        if (!device) return;
        EXPECT_EQ(device->validationMessages(), std::vector<std::string>{});
    }
    std::optional<Device> device;
};

TEST_F(TexelReadsTest, GiveTheNumbersOfReadsByAddressHoweverRecordsLie) {
    const Path file = std::filesystem::temp_directory_path() / ("lodestir_texel_reads_" + std::to_string(getpid()) + ".comp");
    writeFile(file, reads);
    std::vector<std::uint32_t> data(4096);
    for (std::uint32_t i = 0; i < data.size(); ++i) data[i] = 0x3f000000u + 7919u * i;
    const Buffer memory = makeBuffer(*device, std::span<const std::uint32_t>(data), "data");
    std::vector<std::vector<std::uint32_t>> results;
    for (const bool texels : {false, true}) {
        const Pipeline pipeline(*device, compileShader({file, {}, {}, {}, texels}), {}, 16, "reads");
        const std::vector<std::uint32_t> nothing(8 * 256, 0xabcdu);
        const Buffer out = makeBuffer(*device, std::span<const std::uint32_t>(nothing), "out");
        const std::uint64_t push[] = {out.address(), memory.address()};
        runOnce(*device, [&](Commands& commands) { commands.dispatch(pipeline, std::as_bytes(std::span(push)), 1); });
        results.emplace_back(8 * 256);
        readBuffer(*device, out, 0, std::as_writable_bytes(std::span(results.back())));
    }
    std::filesystem::remove(file);
    EXPECT_EQ(results[0][0], data[1]);
    EXPECT_NE(results[0][30], 0xabcdu);
    EXPECT_EQ(results[0], results[1]);
}

// What doesn't fit lies elsewhere, and says so: kernels made from then on read by address. Memory that nothing writes costs none.
TEST_F(TexelReadsTest, EndWhereMemoryLiesElsewhere) {
    constexpr std::size_t much = std::size_t(1) << 30;
    ASSERT_NE(device->heap(), nullptr);
    const Buffer first(*device, much, Memory::device, "first");
    EXPECT_TRUE(device->heap()->isWhole());
    const Buffer second(*device, much, Memory::device, "second");
    EXPECT_FALSE(device->heap()->isWhole());
    EXPECT_NE(second.address(), 0u);
}

// The dispatch that makes a driver compile has no memory at all: what comes after the guard in main() must not be reached, on any CPU, though
// no compiler may leave these reads out.
TEST_F(GpuTest, NoMemoryIsTouchedWhileTheDriverCompiles) {
    const Spirv spirv = compile(R"(#version 460
layout(local_size_x = 64) in;
layout(buffer_reference, scalar) volatile buffer Words { uint64_t word[32]; };
struct FirstPush { uint64_t block, tileCounter; uvec2 base, extent; uvec4 arguments; uint warm, rows; };
layout(push_constant, scalar) uniform Push { FirstPush push; };
void main() {
    if (push.warm != 0u) return;
    uint64_t at = push.block;
    for (uint i = 0u; i < 32u; ++i) at = Words(at).word[i];
    Words(push.block).word[0] = at;
}
)");
    const lodestir::PipelineMaker maker(*device_);
    EXPECT_TRUE(bool(maker.make({.name = "guarded", .spirv = spirv, .constants = {}})));
}

}  // namespace
}  // namespace lodestir::gpu
