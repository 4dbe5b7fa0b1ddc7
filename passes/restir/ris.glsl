// SPDX-License-Identifier: MIT
// Resampled importance sampling as a stream: of all candidates offered, one is kept with a chance proportional to its weight.
//
// Lin et al. 2022, Generalized Resampled Importance Sampling: weights w_i Eq. 19, unbiased contribution weight W Eq. 22, confidence weights
// and their cap section 6.2. Keeping one of a stream: Chao 1982, A General Purpose Unequal Probability Sampling Plan.
// The caller holds the samples themselves: risAdd only says whether to keep the newcomer.

#include "base/probe.glsl"

struct Ris {
    float wSum;  // sum of the weights offered so far
    float M;     // confidence: the sum over the inputs
};

Ris risStart() { return Ris(0.0, 0.0); }

/// w, or 0 where it is NaN, infinite or negative: their bits as an integer are no less than those of infinity.
float finiteWeight(float w) { return floatBitsToUint(w) < 0x7f800000u ? w : 0.0; }

/// Eq. 19: w = m p^(y) W |dT/dx|. 0 for a failed shift (jacobian = 0), which is the candidate's whole contribution: its confidence still
/// counts, because whether a shift fails depends on the sample.
float resamplingWeight(float m, float pHat, float W, float jacobian) {
    PROBE(m, m);
    PROBE(target, pHat);
    PROBE(W, W);
    PROBE(jacobian, jacobian);
    return finiteWeight(m * pHat * W * jacobian);
}

/// Offers a candidate of weight w; true: keep it instead of what was kept before. u in [0, 1) is a fresh number of the resampling stream,
/// never one that made a path. A weight of zero is never kept, and the first that is not zero always is.
bool risAdd(inout Ris r, float w, float u) {
    w = finiteWeight(w);
    r.wSum += w;
    PROBE(w, w);
    PROBE(wSum, r.wSum);
    PROBE(u, u);
    PROBE(taken, u * r.wSum < w);
    return u * r.wSum < w;
}

/// Eq. 22: W = wSum / p^(Y). The kept sample's target must be the one its weight was made of. 0 where nothing was kept.
float contributionWeight(Ris r, float pHat) { return pHat > 0.0 ? finiteWeight(r.wSum / pHat) : 0.0; }

/// Confidence with which last frame's reservoir enters: section 6.2 with the cap on the input instead of the sum (Lin et al. 2026, section
/// 2.2), so that a frame's own samples always count fully. Must not depend on any sample.
float cappedConfidence(float M, float cap) { return min(M, cap); }
