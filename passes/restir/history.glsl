// SPDX-License-Identifier: MIT
// How much of last frame's confidence counts, by the parameters of the pass (history.h). After pass.glsl, in a pass with an input `motion`.
#include "restir/neighbours.glsl"

/// Most confidence, in frames, that last frame's paths have in pixel p of this frame, whichever of its pixels they come from. One number for all of them:
/// paths that arrive in p and the own path, which is asked what last frame would have made of it, have to be weighed alike.
float historyCap(ivec2 p) {
#if HAS_duplication
    ivec2 before = pixelBefore(p, motion(p));
    // Lin et al. 2026, ReSTIR PT Enhanced, section 5.
    bool known = historyValid() && all(lessThan(uvec2(before), frameSize()));
    if (known) return mix(params.cap, min(params.leastCap, params.cap), pow(duplication(before), params.alpha));
#endif
    return params.cap;
}
