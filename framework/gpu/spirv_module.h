// SPDX-License-Identifier: MIT
// SPIR-V as a list of instructions, with what others ask of it: types, decorations, constants.
#pragma once
#include <glslang/SPIRV/spirv.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace lodestir::gpu {

/// Words of one instruction, the first one with its opcode and length.
struct Instruction {
    std::span<const std::uint32_t> words;
    spv::Op op() const { return spv::Op(words[0] & 0xffffu); }
    std::uint32_t operator[](std::size_t i) const { return words[i]; }
    std::size_t size() const { return words.size(); }
};

class SpirvModule {
public:
    /// `words` must outlive the module. Error when they are no SPIR-V.
    explicit SpirvModule(std::span<const std::uint32_t> words);

    std::span<const std::uint32_t> words;
    std::vector<Instruction> instructions;
    std::uint32_t bound;  ///< all ids are below

    const Instruction& definition(std::uint32_t id) const { return instructions[definitions_[id]]; }
    std::uint32_t typeOf(std::uint32_t id) const { return types_[id]; }  ///< of a value; 0 for what has none
    /// Value of an OpConstant of 32 bits.
    std::optional<std::uint32_t> constant(std::uint32_t id) const;
    std::optional<std::uint32_t> decoration(std::uint32_t id, spv::Decoration which) const { return memberDecoration(id, wholeId, which); }
    /// First literal of a decoration, 0 where it has none; nothing where the member isn't decorated so.
    std::optional<std::uint32_t> memberDecoration(std::uint32_t id, std::uint32_t member, spv::Decoration which) const;

private:
    static constexpr std::uint32_t wholeId = 0xffffffffu;  // instead of a member

    std::vector<std::size_t> definitions_;  ///< of each id: its instruction
    std::vector<std::uint32_t> types_;
    std::map<std::pair<std::uint64_t, spv::Decoration>, std::uint32_t> decorations_;
};

}  // namespace lodestir::gpu
