// SPDX-License-Identifier: MIT
// Shares light out between the sampling techniques that could have found it, by the parameter of light_technique.h. pdfLight: density of light sampling,
// times the number of its samples; 0: it never finds this light (an unlit surface), or the light has no extent. pdf: density of the BSDF, all lobes;
// 0: a delta lobe, or the camera.
#include "light/light.glsl"

const uint TECHNIQUE_BOTH = 0u;   // light sampling and BSDF sampling, weighed by the balance heuristic
const uint TECHNIQUE_LIGHT = 1u;  // light sampling alone, but behind delta lobes
const uint TECHNIQUE_BSDF = 2u;   // BSDF sampling alone, but for lights without extent

/// Weight of light that a path ran into.
float foundShare(uint technique, float pdf, float pdfLight) {
    if (pdf == 0.0 || pdfLight == 0.0 || technique == TECHNIQUE_BSDF) return 1.0;
    return technique == TECHNIQUE_LIGHT ? 0.0 : misWeight(pdf, pdfLight);
}

/// Weight of a light sample.
float sampledShare(uint technique, float pdfLight, float pdf) {
    if (pdfLight == 0.0 || technique == TECHNIQUE_LIGHT) return 1.0;
    return technique == TECHNIQUE_BSDF ? 0.0 : misWeight(pdfLight, pdf);
}
