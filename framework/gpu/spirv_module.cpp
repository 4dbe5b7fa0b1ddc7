// SPDX-License-Identifier: MIT
// SPIR-V as a list of instructions, with what others ask of it: types, decorations, constants.
#define SPV_ENABLE_UTILITY_CODE
#include <framework/gpu/spirv_module.h>

#include <framework/core/error.h>

namespace lodestir::gpu {

namespace {

std::uint64_t keyOf(std::uint32_t id, std::uint32_t member) { return std::uint64_t(id) << 32 | member; }

}  // namespace

SpirvModule::SpirvModule(std::span<const std::uint32_t> all) : words(all), bound(0) {
    constexpr std::size_t header = 5;
    if (words.size() < header || words[0] != spv::MagicNumber) throw Error("this is no SPIR-V");
    bound = words[3];
    definitions_.resize(bound);
    types_.resize(bound);
    for (std::size_t i = header; i < words.size();) {
        const std::size_t length = words[i] >> 16;
        if (length == 0 || length > words.size() - i) throw Error("SPIR-V with an instruction that does not end");
        const Instruction instruction{words.subspan(i, length)};
        bool hasResult = false, hasType = false;
        spv::HasResultAndType(instruction.op(), &hasResult, &hasType);
        if (hasResult) {
            const std::uint32_t id = instruction[hasType ? 2 : 1];
            definitions_.at(id) = instructions.size();
            if (hasType) types_[id] = instruction[1];
        } else if (instruction.op() == spv::OpDecorate) {
            decorations_[{keyOf(instruction[1], wholeId), spv::Decoration(instruction[2])}] = length > 3 ? instruction[3] : 0;
        } else if (instruction.op() == spv::OpMemberDecorate) {
            decorations_[{keyOf(instruction[1], instruction[2]), spv::Decoration(instruction[3])}] = length > 4 ? instruction[4] : 0;
        }
        instructions.push_back(instruction);
        i += length;
    }
}

std::optional<std::uint32_t> SpirvModule::constant(std::uint32_t id) const {
    const Instruction& definition = this->definition(id);
    if (definition.op() != spv::OpConstant || definition.size() != 4) return std::nullopt;
    return definition[3];
}

std::optional<std::uint32_t> SpirvModule::memberDecoration(std::uint32_t id, std::uint32_t member, spv::Decoration which) const {
    const auto found = decorations_.find({keyOf(id, member), which});
    return found == decorations_.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace lodestir::gpu
