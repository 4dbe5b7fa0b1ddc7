// SPDX-License-Identifier: MIT
// Resampling MIS weights m_i: how candidates that several pixels or frames could have made share one sample, summing to 1 (Lin et al. 2022,
// Generalized Resampled Importance Sampling, Eq. 20).
//
// All of them compare "the target from i": pHatFrom = p^_i(T_i^-1 y) |dT_i^-1/dy|, 0 where y has no preimage in i (Eq. 35).
// c are confidences. Confidence and validity of a neighbour must not depend on samples: a failed shift sets pHatFrom to 0, it does not
// take the neighbour's c out of S.

#include "base/probe.glsl"

/// Eq. 35 for the candidate's own sample x, y = T x: no reverse shift is needed. pHat = p^_i(x), jacobian = |dT/dx|; 0: the shift failed.
float pHatFromForward(float pHat, float jacobian) { return jacobian > 0.0 ? pHat / jacobian : 0.0; }

/// Eq. 35 for another's sample, shifted back: pHat = p^_i(T^-1 y), jacobian = |dT^-1/dy|; 0: the reverse shift failed.
float pHatFromReverse(float pHat, float jacobian) { return jacobian > 0.0 ? pHat * jacobian : 0.0; }

/// Generalised balance heuristic, Eq. 36 with confidences: m = mine / (mine + others), where mine = c_i pHatFrom_i and others is the sum of
/// these products over all other techniques. 0 where mine is 0. Written so that large numbers don't overflow.
float balanceMis(float mine, float others) { return mine > 0.0 ? 1.0 / (1.0 + others / mine) : 0.0; }

/// Pairwise MIS: the canonical sample is compared with one neighbour at a time, so that K neighbours cost 2 K shifts, not K (K + 1).
/// Confidences enter as in Wyman et al. 2023, A Gentle Introduction to ReSTIR, Eq. 7.8.
struct PairwiseMis {
    float canonical;   // confidence of the canonical sample; 0: nobody has tried to make one, and its share is lost
    float neighbours;  // S: sum over all valid neighbours, with failed shifts or not
    float total;       // divides a neighbour's confidence: S, or C = S + canonical
    float start;       // share the canonical sample has before any comparison
};

/// Eq. 37 with confidences: all of it is shared out by comparison.
PairwiseMis pairwiseMis(float canonical, float neighbours) {
    return PairwiseMis(canonical, neighbours, neighbours, neighbours > 0.0 ? 0.0 : 1.0);
}

/// Eq. 38 with confidences: a share canonical / C is the canonical sample's whatever the neighbours say, which bounds the weight of its
/// sample from below where a neighbour's target is far too large.
PairwiseMis defensivePairwiseMis(float canonical, float neighbours) {
    float total = canonical + neighbours;
    return PairwiseMis(canonical, neighbours, total, total > 0.0 ? canonical / total : 1.0);
}

/// m_i(y) of neighbour i with confidence c. pHat: canonical target of y.
float neighbourMis(PairwiseMis p, float c, float pHat, float pHatFrom) {
    PROBE(confidence, c);
    PROBE(targetFrom, pHatFrom);
    return c > 0.0 ? c / p.total * balanceMis(p.neighbours * pHatFrom, p.canonical * pHat) : 0.0;
}

/// The term that neighbour i adds to the canonical sample's weight, which begins with p.start. pHat: canonical target of the canonical
/// sample x; pHatFrom = 0 (no preimage in i) gives the whole share c / total: the canonical sample covers what i can't.
float canonicalMis(PairwiseMis p, float c, float pHat, float pHatFrom) {
    float theirs = p.neighbours * pHatFrom;
    PROBE(confidence, c);
    PROBE(targetFrom, pHatFrom);
    return c > 0.0 ? c / p.total * (theirs > 0.0 ? balanceMis(p.canonical * pHat, theirs) : 1.0) : 0.0;
}
