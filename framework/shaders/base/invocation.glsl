// SPDX-License-Identifier: MIT
// Where an invocation stands, what it may ask about the frame, and what it reports: rays and accesses out of bounds.
// Included by pass.glsl, which defines passBlock() and params.
#include "base/probe.glsl"

#ifndef TRACE_DRIVER  // trace/driver.glsl owns main() and spreads the pixels itself
layout(local_size_x = 8, local_size_y = 8) in;

// The pixel of this invocation: 8x8 tiles, or rows of 64 where the dispatch is one pixel high.
ivec2 pixel() {
    if (push.extent.y == 1u) return ivec2(push.base.x + gl_WorkGroupID.x * 64u + gl_LocalInvocationIndex, 0);
    return ivec2(push.base + gl_GlobalInvocationID.xy);
}
#endif

// Does p lie in the extent of this dispatch?
bool inside(ivec2 p) { return all(lessThan(uvec2(p), push.extent)); }
// Index of a pixel in a buffer with one element per pixel of the frame.
uint pixelIndex(ivec2 p) { return uint(p.y) * passBlock().frame.size.x + uint(p.x); }
// Word i (0 to 3) that execute() gave to this dispatch.
uint argument(int i) { return push.arguments[i]; }
// Only compiling: main() must return at once.
bool warming() { return push.warm != 0u; }

#ifndef TRACE_DRIVER
// main() of a shader without a driver starts with: if (skip()) return;
bool skip() { return warming() || !inside(pixel()); }
#endif

uint frameIndex() { return passBlock().frame.index; }
uvec2 frameSize() { return passBlock().frame.size; }
uint runSeed() { return passBlock().frame.seed; }
// Differs from node to node, so that two nodes of one type don't draw the same resampling numbers: a stage for resamplingSeed.
uint passSalt() { return passBlock().frame.salt; }
// False in the first frame and after resize, cut and reset: @prev and State hold zeros.
bool historyValid() { return passBlock().frame.historyValid != 0u; }
bool validating() { return passBlock().frame.validate != 0u; }

layout(buffer_reference, scalar, buffer_reference_align = 8) buffer LedgerMemory { uint64_t at[]; };

// Adds n rays (or steps) of a purpose, RAYS_*, to the ledger of this pass.
void countRays(uint purpose, uint n) {
    LedgerMemory ledger = LedgerMemory(passBlock().frame.ledger);
    if (!subgroupAllEqual(purpose)) {
        atomicAdd(ledger.at[purpose], uint64_t(n));
        return;
    }
    const uint sum = subgroupAdd(n);
    if (subgroupElect() && sum != 0u) atomicAdd(ledger.at[purpose], uint64_t(sum));
}

// With CHECK_BOUNDS an access outside a port is counted, and the first one kept; reads then give zero and writes are dropped.
// Without it such an access reaches foreign memory: device addresses have no robustness.
#ifdef CHECK_BOUNDS
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FaultMemory { FaultRecord record; };

bool isOutside(uint port, ivec2 index, uvec2 size) {
    if (all(lessThan(uvec2(index), size))) return false;
    FaultMemory faults = FaultMemory(passBlock().frame.faults);
    if (atomicAdd(faults.record.count, 1u) == 0u) {
        faults.record.port = port;
        faults.record.index = index;
    }
    return true;
}
#else
bool isOutside(uint port, ivec2 index, uvec2 size) { return false; }
#endif
