// SPDX-License-Identifier: MIT
// What the runner hands to every shader: facts of the frame, ports as addresses, the push constants. Shared by C++ and GLSL (scalar layout).
#ifndef LODESTIR_FRAME_H
#define LODESTIR_FRAME_H
#include "base/shared.h"

LODESTIR_SHARED_BEGIN

struct FrameInfo {
    uint index;         // frame number, from 0
    uint seed;          // of the run
    uvec2 size;         // pixels
    uint historyValid;  // 0 at start and after resize, cut and reset
    uint validate;      // 1: shaders may check what costs time
    uint salt;          // tells the nodes of a graph apart: of the node's name, below 2^31
    uint pad;
    uint64_t ledger;    // uint64_t[RAYS_PURPOSES], counts of this pass in this frame
    uint64_t faults;    // FaultRecord of this pass
};

// One port of a pass. Of an image: size in pixels; of a buffer: size.x elements; of a handle: the struct's address.
struct PortRecord {
    uint64_t address;   // 0: unwired
    uvec2 size;
};

// Accesses outside a port, counted where CHECK_BOUNDS is defined.
struct FaultRecord {
    uint count;
    uint port;          // of the first one: its number in order of declaration
    ivec2 index;        // of the first one: pixel, or (element, 0)
};

struct Push {
    uint64_t block;        // PassBlock
    uint64_t tileCounter;  // uint, 0 at the start of a dispatch: the tiles that persistent workgroups have taken
    uvec2 base;            // first pixel of this dispatch: a large one may be split
    uvec2 extent;          // end of the whole dispatch, pixels
    uvec4 arguments;       // of Frame::dispatch
    uint warm;             // 1: return at once; the dispatch only makes the driver compile
    uint rows;             // of pixels from base on that this dispatch does (pixels, where the extent is one row); 0: all that are left
};

// Purposes of rays in the ledger.
const uint RAYS_PRIMARY = 0u;
const uint RAYS_NEE = 1u;         // to a light, by next-event estimation
const uint RAYS_CONTINUE = 2u;    // continues a path
const uint RAYS_REPLAY = 3u;      // random replay of a shift
const uint RAYS_CONNECT = 4u;     // reconnection of a shift
const uint RAYS_VISIBILITY = 5u;  // any other question of visibility
const uint RAYS_STEPS = 6u;       // no ray: nodes that traversal visited
const uint RAYS_PURPOSES = 7u;

LODESTIR_SHARED_END
LODESTIR_SHARED(FrameInfo, "base/frame.h")
LODESTIR_SHARED(PortRecord, "base/frame.h")
LODESTIR_SHARED(FaultRecord, "base/frame.h")
LODESTIR_SHARED(Push, "base/frame.h")
#endif
