// SPDX-License-Identifier: MIT
// Tells what happens to one pixel. `lodestir probe` compiles shaders with PROBING and reads the records; without it these macros are nothing.
//
//   PROBE(name, value);                  a number, a vector, a bool
//   PROBE_CHOICE(name, value, "a|b|c");  a number that stands for a word, from 0 on
//   PROBE_TEXT(name, "words");           what has happened
//   PROBE_TEXT_IF(name, "words", condition);
//   PROBE_OPEN(name);                    a scope: what follows belongs to another member of the list `name` ...
//   PROBE_OBJECT_OPEN(name);             ... or to the object `name`
//   PROBE_REOPEN(name);                  what follows belongs to the list's last member
//   PROBE_CLOSE(name);                   ends it and all scopes inside; so does the next of the same name, and the end of the driver's item
//   PROBE_ABOUT(pixel);                  what follows, up to the end of the driver's item, is about this pixel as well
//   PROBE_START(pixel);                  once main() goes on from skip(): the invocation's pixel; trace/driver.glsl says it for shaders that trace
//
// At most one of them stands in a line: a record holds the line, and the host reads name and words there. A value and its name are not evaluated where
// nothing is probed, so they must do nothing that matters.
#ifdef PROBING
#include "base/probe.h"

layout(buffer_reference, scalar, buffer_reference_align = 16) buffer ProbeMemory {
    ProbeHead head;
    ProbeRecord at[];
};

bool probeOwn = false;  // the invocation's pixel is the one that is asked for
bool probeOn = false;   // what it does is about that pixel
uint probeInvocation = 0u;

void probeAppend(uint place, uint kind, uint count, uvec4 numbers) {
    if (!probeOn) return;
    ProbeMemory memory = ProbeMemory(passBlock().probeMemory);
    uint i = atomicAdd(memory.head.count, 1u);
    if (i < memory.head.capacity) memory.at[i] = ProbeRecord(place, kind, count, probeInvocation, numbers);
}

void probeNumber(uint place, float x) { probeAppend(place, PROBE_FLOAT, 1u, uvec4(floatBitsToUint(x))); }
void probeNumber(uint place, vec2 x) { probeAppend(place, PROBE_FLOAT, 2u, uvec4(floatBitsToUint(x), 0u, 0u)); }
void probeNumber(uint place, vec3 x) { probeAppend(place, PROBE_FLOAT, 3u, uvec4(floatBitsToUint(x), 0u)); }
void probeNumber(uint place, vec4 x) { probeAppend(place, PROBE_FLOAT, 4u, floatBitsToUint(x)); }
void probeNumber(uint place, int x) { probeAppend(place, PROBE_INT, 1u, uvec4(x)); }
void probeNumber(uint place, ivec2 x) { probeAppend(place, PROBE_INT, 2u, uvec4(x, 0, 0)); }
void probeNumber(uint place, uint x) { probeAppend(place, PROBE_UINT, 1u, uvec4(x)); }
void probeNumber(uint place, uvec2 x) { probeAppend(place, PROBE_UINT, 2u, uvec4(x, 0u, 0u)); }
void probeNumber(uint place, bool x) { probeAppend(place, PROBE_BOOL, 1u, uvec4(x)); }
void probeWords(uint place, bool said) {
    if (said) probeAppend(place, PROBE_WORDS, 0u, uvec4(0u));
}

bool probeAsksFor(ivec2 pixel) { return ProbeMemory(passBlock().probeMemory).head.pixel == pixel; }

// An invocation begins, a driver's item ends.
void probeStart(ivec2 pixel) {
    probeInvocation = uint(pixel.x) | uint(pixel.y) << 16;
    probeOn = probeOwn = probeAsksFor(pixel);
}
void probeItemEnd() {
    probeAppend(0u, PROBE_ITEM_END, 0u, uvec4(0u));
    probeOn = probeOwn;
}

#define PROBE_PLACE (uint(__FILE__) << 16 | uint(__LINE__))
#define PROBE(name, value) probeNumber(PROBE_PLACE, value)
#define PROBE_CHOICE(name, value, words) probeAppend(PROBE_PLACE, PROBE_CHOICE_OF, 1u, uvec4(value))
#define PROBE_TEXT(name, words) probeWords(PROBE_PLACE, true)
#define PROBE_TEXT_IF(name, words, condition) probeWords(PROBE_PLACE, condition)
#define PROBE_OPEN(name) probeAppend(PROBE_PLACE, PROBE_SCOPE, 0u, uvec4(0u))
#define PROBE_OBJECT_OPEN(name) probeAppend(PROBE_PLACE, PROBE_OBJECT, 0u, uvec4(0u))
#define PROBE_REOPEN(name) probeAppend(PROBE_PLACE, PROBE_SCOPE_AGAIN, 0u, uvec4(0u))
#define PROBE_CLOSE(name) probeAppend(PROBE_PLACE, PROBE_SCOPE_END, 0u, uvec4(0u))
#define PROBE_ABOUT(pixel) probeOn = probeOn || probeAsksFor(pixel)
#define PROBE_START(pixel) probeStart(pixel)
#define PROBE_ITEM_DONE() probeItemEnd()
#else
#define PROBE(name, value)
#define PROBE_CHOICE(name, value, words)
#define PROBE_TEXT(name, words)
#define PROBE_TEXT_IF(name, words, condition)
#define PROBE_OPEN(name)
#define PROBE_OBJECT_OPEN(name)
#define PROBE_REOPEN(name)
#define PROBE_CLOSE(name)
#define PROBE_ABOUT(pixel)
#define PROBE_START(pixel)
#define PROBE_ITEM_DONE()
#endif
