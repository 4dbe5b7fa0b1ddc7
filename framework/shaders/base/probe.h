// SPDX-License-Identifier: MIT
// What a shader that is probed hands to the host (base/probe.glsl). Shared by C++ and GLSL (scalar layout).
#ifndef LODESTIR_PROBE_H
#define LODESTIR_PROBE_H
#include "base/shared.h"

LODESTIR_SHARED_BEGIN

struct ProbeRecord {
    uint place;       // of the macro: text of the shader's include closure << 16 | line
    uint kind;        // PROBE_*
    uint count;       // of numbers
    uint invocation;  // its pixel: x | y << 16
    uvec4 numbers;    // or their bits
};

const uint PROBE_FLOAT = 0u;
const uint PROBE_INT = 1u;
const uint PROBE_UINT = 2u;
const uint PROBE_BOOL = 3u;
const uint PROBE_CHOICE_OF = 4u;    // number of a word in the macro's line
const uint PROBE_WORDS = 5u;        // the text in the macro's line
const uint PROBE_SCOPE = 6u;        // a list gets another member, which the following records belong to
const uint PROBE_OBJECT = 7u;       // the same for a member that is there once
const uint PROBE_SCOPE_AGAIN = 8u;  // the list's last member goes on
const uint PROBE_SCOPE_END = 9u;
const uint PROBE_ITEM_END = 10u;    // of all scopes

struct ProbeHead {
    ivec2 pixel;    // that is asked for; negative: none
    uint capacity;  // records that there is room for
    uint count;     // records that were made
};

LODESTIR_SHARED_END
LODESTIR_SHARED(ProbeRecord, "base/probe.h")
LODESTIR_SHARED(ProbeHead, "base/probe.h")
#endif
