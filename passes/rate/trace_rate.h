// SPDX-License-Identifier: MIT
// Whether a pixel's path is traced this frame, and how likely that was.
#ifndef LODESTIR_TRACE_RATE_H
#define LODESTIR_TRACE_RATE_H
#include "base/shared.h"

LODESTIR_SHARED_BEGIN

struct TraceRate {
    float chance;  // q: with which the pixel was chosen, given all that was known before; 1: it had to be
    uint source;   // index of the pixel whose path stands for its block: itself where it is traced
};

LODESTIR_SHARED_END
LODESTIR_SHARED(TraceRate, "rate/trace_rate.h")
#endif
