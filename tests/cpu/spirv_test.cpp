// SPDX-License-Identifier: MIT
// What is read off SPIR-V and changed in it: arrays read as texels, and memory touched before main() can return.
#include <framework/core/error.h>
#include <framework/gpu/early_reads.h>
#include <framework/gpu/shader.h>
#include <framework/gpu/spirv_module.h>
#include <framework/gpu/texel_reads.h>

#include <gtest/gtest.h>
#include <spirv-tools/libspirv.hpp>

#include <algorithm>
#include <unistd.h>

namespace lodestir::gpu {
namespace {

const std::string head = R"(#version 460
layout(local_size_x = 64) in;
struct Record { vec4 a; uint64_t b; uint c, d; };
layout(buffer_reference, scalar) readonly buffer Records { Record at[]; };
layout(buffer_reference, scalar) buffer Numbers { uint at[]; };
layout(buffer_reference, scalar) readonly buffer Block { Records records; Numbers numbers; float factor; };
layout(push_constant, scalar) uniform Push { Block block; uint warm; } push;
)";

std::vector<std::uint32_t> compile(const std::string& text) {
    const Path file = Path(testing::TempDir()) / ("spirv_test_" + std::to_string(getpid()) + ".comp");
    writeFile(file, head + text);
    return compileShader({file, {}, {}, {}}).words;
}

std::size_t count(const std::vector<std::uint32_t>& words, spv::Op op) {
    const SpirvModule module(words);
    return std::size_t(std::ranges::count(module.instructions, op, &Instruction::op));
}

void expectValid(const std::vector<std::uint32_t>& words) {
    spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_3);
    std::string said;
    tools.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&, const char* message) { said += message; });
    spvtools::ValidatorOptions options;
    options.SetScalarBlockLayout(true);
    EXPECT_TRUE(tools.Validate(words.data(), words.size(), options)) << said;
}

TEST(TexelReads, FetchArraysThatAreOnlyRead) {
    const auto words =
        compile("void main() { Record r = push.block.records.at[gl_GlobalInvocationID.x]; push.block.numbers.at[r.c] = uint(r.b) + floatBitsToUint(r.a.y); }");
    const auto texels = readByTexels(words);
    expectValid(texels);
    EXPECT_EQ(count(words, spv::OpImageRead), 0u);
    EXPECT_EQ(count(texels, spv::OpImageRead), 2u);  // 32 bytes
}

TEST(TexelReads, LeaveWhatTheShaderWrites) {
    const auto words = compile("void main() { uint i = gl_GlobalInvocationID.x; push.block.numbers.at[i] = push.block.numbers.at[i + 1u]; }");
    EXPECT_EQ(readByTexels(words), words);
    const auto atomic = compile("void main() { atomicAdd(push.block.numbers.at[push.block.numbers.at[0]], 1u); }");
    EXPECT_EQ(readByTexels(atomic), atomic);
}

TEST(TexelReads, FetchFromThisShaderWhatAnotherWrites) {
    const auto words = compile("layout(buffer_reference, scalar) buffer Out { uint at[]; };\n"
                               "void main() { uint i = gl_GlobalInvocationID.x; Out(push.block.numbers).at[i] = push.block.numbers.at[i + 1u]; }");
    const auto texels = readByTexels(words);
    expectValid(texels);
    EXPECT_EQ(count(texels, spv::OpImageRead), 1u);
}

TEST(TexelReads, LeaveSingleStructsAndVolatileArrays) {
    const auto words = compile("layout(buffer_reference, scalar) volatile buffer Changing { uint at[]; };\n"
                               "void main() { if (Changing(push.block.numbers).at[1] == 0u) push.block.numbers.at[0] = uint(push.block.factor); }");
    EXPECT_EQ(readByTexels(words), words);
}

TEST(TexelReads, RefuseWhatIsNoSpirv) {
    EXPECT_THROW(readByTexels(std::vector<std::uint32_t>{1, 2, 3}), Error);
    std::vector<std::uint32_t> words = compile("void main() { push.block.numbers.at[0] = push.block.records.at[1].c; }");
    words.back() = 100u << 16 | spv::OpFunctionEnd;  // longer than the module
    EXPECT_THROW(readByTexels(words), Error);
}

// A dispatch that only makes the driver compile has no memory.
TEST(EarlyReads, ComeAfterTheGuard) {
    EXPECT_FALSE(
        touchesMemoryEarly(compile("void main() { if (push.warm != 0u) return; push.block.numbers.at[0] = uint(push.block.factor); }")));
}
TEST(EarlyReads, AreSeenInGlobals) {
    EXPECT_TRUE(touchesMemoryEarly(
        compile("float factor = push.block.factor;\nvoid main() { if (push.warm != 0u) return; push.block.numbers.at[0] = uint(factor); }")));
    EXPECT_TRUE(touchesMemoryEarly(
        compile("uint first = push.block.records.at[3].c;\nvoid main() { if (push.warm != 0u) return; push.block.numbers.at[0] = first; }")));
    EXPECT_TRUE(touchesMemoryEarly(compile("uint third() { return push.block.records.at[3].c; }\nuint first = third();\n"
                                           "void main() { if (push.warm != 0u) return; push.block.numbers.at[0] = first; }")));
}
TEST(EarlyReads, NothingIsWrittenOrCounted) {
    EXPECT_TRUE(touchesMemoryEarly(
        compile("uint ticket = atomicAdd(push.block.numbers.at[0], 1u);\nvoid main() { if (push.warm != 0u) return; push.block.numbers.at[ticket] = 1u; }")));
    EXPECT_TRUE(touchesMemoryEarly(compile("void main() { push.block.numbers.at[0] = 1u; if (push.warm != 0u) return; }")));
}
TEST(EarlyReads, AreSeenWhereAShaderHasNoGuard) {
    EXPECT_TRUE(touchesMemoryEarly(compile("void main() { push.block.numbers.at[0] = push.block.records.at[1].c; }")));
}

}  // namespace
}  // namespace lodestir::gpu
