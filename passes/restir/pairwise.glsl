// SPDX-License-Identifier: MIT
// Weights of a pixel's path and its neighbours', by the parameter of the pass (pairwise.h). After pass.glsl.
#include "restir/mis.glsl"

/// `canonical`: confidence of the pixel's own path; `neighbours`: sum of all valid neighbours'.
PairwiseMis pairwiseOf(float canonical, float neighbours) {
    if (params.mis == mis_pairwise) return pairwiseMis(canonical, neighbours);
    return defensivePairwiseMis(canonical, neighbours);
}
