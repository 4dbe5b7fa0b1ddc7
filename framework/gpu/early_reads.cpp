// SPDX-License-Identifier: MIT
// What a kernel does before its main() can return.
#include <framework/gpu/early_reads.h>

#include <framework/gpu/spirv_module.h>

#include <map>
#include <set>

namespace lodestir::gpu {

namespace {

using Id = std::uint32_t;

class Search {
public:
    explicit Search(const SpirvModule& module) : m_(module) {
        for (std::size_t i = 0; i < m_.instructions.size(); ++i) {
            if (m_.instructions[i].op() == spv::OpFunction) bodies_[m_.instructions[i][2]] = i + 1;
            if (m_.instructions[i].op() == spv::OpEntryPoint) entry_ = m_.instructions[i][2];
        }
    }
    bool run() { return touches(entry_, true); }

private:
    bool isMemory(Id pointer) const {
        const Id type = m_.typeOf(pointer);
        return type && m_.definition(type).op() == spv::OpTypePointer && m_.definition(type)[2] == spv::StorageClassPhysicalStorageBuffer;
    }
    bool touches(Id function, bool upToBranch) {
        if (!seen_.insert(function).second) return false;
        for (std::size_t i = bodies_.at(function); m_.instructions[i].op() != spv::OpFunctionEnd; ++i) {
            const Instruction& at = m_.instructions[i];
            if (upToBranch && (at.op() == spv::OpBranchConditional || at.op() == spv::OpSwitch || at.op() == spv::OpLoopMerge)) return false;
            if (at.op() == spv::OpFunctionCall && touches(at[3], false)) return true;
            if (at.op() == spv::OpLoad && isMemory(at[3])) return true;
            if (at.op() == spv::OpStore && isMemory(at[1])) return true;
            if (at.op() >= spv::OpAtomicLoad && at.op() <= spv::OpAtomicXor && isMemory(at.op() == spv::OpAtomicStore ? at[1] : at[3])) return true;
        }
        return false;
    }

    const SpirvModule& m_;
    std::map<Id, std::size_t> bodies_;  ///< first instruction of each function
    std::set<Id> seen_;
    Id entry_ = 0;
};

}  // namespace

bool touchesMemoryEarly(std::span<const std::uint32_t> spirv) { return Search(SpirvModule(spirv)).run(); }

}  // namespace lodestir::gpu
