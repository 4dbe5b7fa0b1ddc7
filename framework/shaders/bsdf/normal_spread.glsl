// SPDX-License-Identifier: MIT
// How wide highlights are over many normals, of which only the mean is known.
#include "base/math.glsl"

/// Mean cosine of a von Mises-Fisher lobe whose concentration is k, given 1/k: coth k - k^-1.
float meanCosine(float inverse) {
    if (inverse < 0.1) return 1.0 - inverse;  // coth k is 1 to 4e-9
    float e = exp(-2.0 / inverse);
    return inverse > 10.0 ? 1.0 / (3.0 * inverse) : (1.0 + e) / (1.0 - e) - inverse;
}

/// 1/k of the lobe with a mean of that length (Banerjee et al. 2005, Clustering on the Unit Hypersphere using von Mises-Fisher Distributions, Eq. 4.4).
float inverseConcentration(float size) {
    float squared = clamp(square(size), 1e-8, 1.0);
    return (1.0 - squared) / (sqrt(squared) * (3.0 - squared));
}

/// GGX width of a lobe whose normals differ as those within a texel do, by the length of their mean. Widths stand for lobes by 2 / alpha^2 = k, and means
/// of lobes of lobes multiply, so that one material over many normals comes out as if each had been asked (Han et al. 2007, Frequency Domain Normal
/// Map Filtering, section 4).
float spreadWidth(float alpha, float size) {
    return max(alpha, min(1.0, sqrt(2.0 * inverseConcentration(size * meanCosine(0.5 * square(alpha))))));
}
