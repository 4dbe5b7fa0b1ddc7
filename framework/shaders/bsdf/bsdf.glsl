// SPDX-License-Identifier: MIT
// The scattering of a glTF metallic-roughness surface as four lobes: diffuse reflection, specular reflection, specular transmission
// and, for alpha BLEND, passage straight on.
//
// glTF 2.0 appendix B with KHR_materials_transmission, _ior and _volume, with these choices:
// - The dielectric Fresnel term is exact; metals use Schlick's. Specular reflection is their mixture by `metallic`.
// - What lies under the dielectric layer is reached through it twice, (1 - F(o)) (1 - F(i)) / (1 - mean F) (Ashikhmin and Shirley 2000's
//   coupling with Kelemen and Szirmay-Kalos 2001's norm), instead of appendix B's 1 - F(half): reciprocal as well, and a white
//   diffuse surface then returns all light under a smooth layer, where appendix B's returns more than it got at grazing angles.
// - Thin walls: the microfacet reflection turned over to the far side, tinted by the base colour. Solids refract (Walter et al. 2007).
//   Radiance grows or shrinks by the square of the indices' ratio when it is refracted, so the lobe carries 1 / eta^2.
// - Scattering between microfacets is left out, as in appendix B: rough metals and rough glass lose some energy.
// - Lobes narrower than alpha = 1e-3 are delta lobes.
//
// Light is refused where the shading normal and the triangle disagree about its side. All directions point away from the surface.
#include "base/sampling.glsl"
#include "bsdf/fresnel.glsl"
#include "bsdf/ggx.glsl"

const uint LOBE_DIFFUSE = 0u;
const uint LOBE_REFLECTION = 1u;
const uint LOBE_TRANSMISSION = 2u;
const uint LOBE_THROUGH = 3u;
const uint LOBE_COUNT = 4u;
const uint LOBE_ALL = 0xffffffffu;

const float ALPHA_DELTA = 1e-3;  // narrower lobes are delta lobes: at 1e-3 a lobe is 0.1 degrees wide, a 20th of a pixel's reflection
const float ETA_MATCHED = 1e-3;  // indices closer than this bend no light: the half vector of refraction would be lost in rounding
const float LOBE_SHARE = 0.05;   // least probability of a lobe that sends light: its samples weigh at most 20 times its reflectance

struct Bsdf {
    vec3 normal;         // shading normal, unit, towards the viewer
    vec3 geometric;      // of the triangle, likewise
    vec3 base;           // base colour
    float metallic;      // share of metal
    float transmission;  // share of the dielectric's base that transmits instead of scattering diffusely
    float alpha;         // GGX width, roughness squared
    float eta;           // index of refraction beyond the surface / before it, as the viewer sees it
    float coverage;      // the rest goes straight on
    bool solid;          // refracts; else a thin wall
};

struct BsdfSample {
    vec3 wi;
    vec3 weight;      // f |cos| / pdf, over all lobes that are not delta lobes; for a delta lobe f |cos| / its probability
    float pdf;        // solid angle, over all lobes that are not delta lobes; for a delta lobe its probability. 0: absorbed or refused
    vec3 lobeWeight;  // the sampled lobe alone: f_l |cos| / (P(l) p_l)
    float lobePdf;    // P(l) p_l; for a delta lobe P(l)
    uint lobe;
    bool delta;
};

/// f |cos| and densities, of all lobes that are not delta lobes and of one of them. Densities hold the lobes' probabilities.
struct BsdfValue {
    vec3 all, one;
    float pdf, onePdf;
};

bool reflectionDelta(Bsdf b) { return b.alpha < ALPHA_DELTA; }
bool transmissionDelta(Bsdf b) { return b.alpha < ALPHA_DELTA || (b.solid && abs(b.eta - 1.0) < ETA_MATCHED); }

bool lobeDelta(Bsdf b, uint lobe) {
    return lobe == LOBE_REFLECTION ? reflectionDelta(b) : lobe == LOBE_TRANSMISSION ? transmissionDelta(b) : lobe == LOBE_THROUGH;
}

/// Perceptual roughness: 1 for the diffuse lobe, 0 for delta lobes.
float lobeRoughness(Bsdf b, uint lobe) { return lobe == LOBE_DIFFUSE ? 1.0 : lobeDelta(b, lobe) ? 0.0 : sqrt(b.alpha); }

/// Reflectance of a facet seen under `cosine`, given the dielectric's reflectance there.
vec3 specularColor(Bsdf b, float cosine, float dielectric) {
    return mix(vec3(dielectric), fresnelSchlick(b.base, cosine), b.metallic);
}

/// Chances of the lobes, from the light that each sends under the Fresnel terms of the view angle. Their sum is 1, or 0 where the surface
/// is black. A lobe that can send light has LOBE_SHARE at least (before the sum is made 1).
vec4 lobeProbabilities(Bsdf b, vec3 wo) {
    float cosine = clamp(dot(b.normal, wo), 0.0, 1.0), dielectric = 1.0 - b.metallic;
    float fresnel = fresnelDielectric(cosine, b.eta), base = luminance(b.base);
    vec4 share = vec4(dielectric * (1.0 - b.transmission) * (1.0 - fresnel) * base,   // diffuse
                      luminance(specularColor(b, cosine, fresnel)),                   // specular reflection
                      dielectric * b.transmission * (1.0 - fresnel) * base, 0.0);     // specular transmission
    // Facets of a rough surface are met under other angles: they may send light where the mean surface sends none.
    bvec4 possible = greaterThan(share, vec4(0.0));
    if (b.alpha >= ALPHA_DELTA) {
        possible.y = possible.y || b.metallic > 0.0;
        possible.z = possible.z || dielectric * b.transmission * base > 0.0;
    }
    share *= b.coverage;
    share.w = 1.0 - b.coverage;
    if (b.coverage <= 0.0) possible = bvec4(false);
    possible.w = share.w > 0.0;
    float sum = max(dot(share, vec4(1.0)), 1e-20);
    share = mix(vec4(0.0), max(share / sum, vec4(LOBE_SHARE)), possible);
    return share / max(dot(share, vec4(1.0)), 1e-20);
}

/// f |cos| and densities for light from wi seen from wo; `one` is the given lobe. Zero where a side is wrong.
BsdfValue bsdfValue(Bsdf b, uint lobe, vec3 wo, vec3 wi) {
    BsdfValue value = BsdfValue(vec3(0.0), vec3(0.0), 0.0, 0.0);
    float cosO = dot(b.normal, wo), cosI = dot(b.normal, wi), side = dot(b.geometric, wi);
    bool reflected = cosI > 0.0 && side > 0.0, transmitted = cosI < 0.0 && side < 0.0;
    if (!(cosO > 0.0 && (reflected || transmitted))) return value;
    vec4 chance = lobeProbabilities(b, wo);
    float dielectric = 1.0 - b.metallic;

    if (reflected && chance.x > 0.0) {
        float through = (1.0 - fresnelDielectric(min(cosO, 1.0), b.eta)) * (1.0 - fresnelDielectric(min(cosI, 1.0), b.eta)) /
                        (1.0 - fresnelDielectricMean(b.eta));
        vec3 f = b.base * (b.coverage * dielectric * (1.0 - b.transmission) * through * INV_PI * cosI);
        float pdf = chance.x * INV_PI * cosI;
        value.all += f;
        value.pdf += pdf;
        if (lobe == LOBE_DIFFUSE) {
            value.one = f;
            value.onePdf = pdf;
        }
    }

    // Both specular lobes share the half vector h and the distribution at it. Through a thin wall wi is seen mirrored at the wall.
    bool refracted = transmitted && b.solid;
    uint specular = reflected ? LOBE_REFLECTION : LOBE_TRANSMISSION;
    float specularChance = reflected ? chance.y : chance.z;
    if (specularChance <= 0.0 || lobeDelta(b, specular)) return value;
    vec3 sum = wo + (refracted ? b.eta * wi : reflected ? wi : wi - 2.0 * cosI * b.normal);
    vec3 h = safeNormalize(sum, b.normal);
    h = dot(h, b.normal) < 0.0 ? -h : h;
    float cosH = min(dot(wo, h), 1.0), cosHI = dot(wi, h);
    if (cosH <= 0.0 || (refracted && cosHI >= 0.0)) return value;
    cosI = abs(cosI);
    float distribution = ggxDistribution(b.normal, h, b.alpha), fresnel = fresnelDielectric(cosH, b.eta);
    // Walter et al. 2007, eq. 17, 21: f |cosI| = G2 D |o.h| |i.h| / (cosO (eta i.h + o.h)^2) with the squared length of `sum` below; half
    // vectors become directions with the density's factor eta^2 |i.h| / (eta i.h + o.h)^2. For reflection it is 1 / (4 o.h), eq. 14.
    float jacobian = refracted ? abs(cosHI) / dot(sum, sum) : 0.25;
    float f = distribution * ggxVisibility(cosO, cosI, b.alpha) * cosI * (refracted ? 4.0 * cosH * jacobian : 1.0);
    float pdf = ggxVisibleDensity(cosO, distribution, b.alpha) * (refracted ? cosH * b.eta * b.eta * jacobian : jacobian);
    vec3 color = reflected ? specularColor(b, cosH, fresnel) : b.base * (dielectric * b.transmission * (1.0 - fresnel));
    vec3 scattered = color * (b.coverage * f);
    value.all += scattered;
    value.pdf += specularChance * pdf;
    if (lobe == specular) {
        value.one = scattered;
        value.onePdf = specularChance * pdf;
    }
    return value;
}

/// f |cos| over all lobes that are not delta lobes, and the density with which bsdfSample finds wi by them.
vec3 bsdfEval(Bsdf b, vec3 wo, vec3 wi, out float pdf) {
    BsdfValue value = bsdfValue(b, LOBE_ALL, wo, wi);
    pdf = value.pdf;
    return value.all;
}

/// The same for one lobe; the density holds the lobe's probability. Zero for delta lobes.
vec3 lobeEval(Bsdf b, uint lobe, vec3 wo, vec3 wi, out float pdf) {
    BsdfValue value = bsdfValue(b, lobe, wo, wi);
    pdf = value.onePdf;
    return value.one;
}

/// No lobe that light sampling could serve.
bool bsdfAllDelta(Bsdf b, vec3 wo) {
    vec4 chance = lobeProbabilities(b, wo);
    return !(chance.x > 0.0 || (chance.y > 0.0 && !reflectionDelta(b)) || (chance.z > 0.0 && !transmissionDelta(b)));
}

/// The lobe whose share of [0, 1) holds u; LOBE_COUNT where the surface is black.
uint chooseLobe(vec4 chance, float u) {
    uint lobe = LOBE_COUNT;
    for (uint l = 0u; l < LOBE_COUNT; ++l) {
        if (chance[l] <= 0.0) continue;
        lobe = l;
        u -= chance[l];
        if (u < 0.0) break;
    }
    return lobe;
}

/// Direction of the lobe and, for delta lobes, f |cos|. Zero vector under total internal reflection.
vec3 lobeDirection(Bsdf b, uint lobe, vec3 wo, vec2 u, out vec3 deltaValue) {
    deltaValue = vec3(1.0 - b.coverage);
    if (lobe == LOBE_THROUGH) return -wo;
    mat3 frame = basisAround(b.normal);
    if (lobe == LOBE_DIFFUSE) return frame * cosineHemisphere(u);

    vec3 h = lobeDelta(b, lobe) ? b.normal : frame * ggxSampleHalf(wo * frame, b.alpha, u);
    float cosH = clamp(dot(wo, h), 0.0, 1.0);
    vec3 mirrored = 2.0 * cosH * h - wo;
    float fresnel = fresnelDielectric(cosH, b.eta);
    deltaValue = b.coverage * specularColor(b, cosH, fresnel);
    if (lobe == LOBE_REFLECTION) return mirrored;
    deltaValue = b.base * (b.coverage * (1.0 - b.metallic) * b.transmission * (1.0 - fresnel));
    if (!b.solid) return mirrored - 2.0 * dot(mirrored, b.normal) * b.normal;
    deltaValue /= b.eta * b.eta;
    float inner = 1.0 - (1.0 - cosH * cosH) / (b.eta * b.eta);
    return inner <= 0.0 ? vec3(0.0) : (cosH / b.eta - sqrt(inner)) * h - wo / b.eta;
}

/// A direction that light may come from, not yet weighed: whoever stores it with fewer bits weighs what is stored.
struct BsdfDirection {
    vec3 wi;          // unit; zero: none
    uint lobe;
    bool delta;
    float chance;     // of the lobe
    vec3 deltaValue;  // of a delta lobe: f |cos|
};

/// u.x chooses the lobe, u.yz the direction.
BsdfDirection bsdfDirection(Bsdf b, vec3 wo, vec3 u) {
    BsdfDirection result = BsdfDirection(vec3(0.0), LOBE_COUNT, false, 0.0, vec3(0.0));
    vec4 chance = lobeProbabilities(b, wo);
    uint lobe = chooseLobe(chance, u.x);
    if (lobe == LOBE_COUNT || !(dot(b.normal, wo) > 0.0)) return result;
    result.wi = safeNormalize(lobeDirection(b, lobe, wo, u.yz, result.deltaValue), vec3(0.0));
    result.lobe = lobe;
    result.delta = lobeDelta(b, lobe);
    result.chance = chance[lobe];
    return result;
}

/// The delta lobe's sample. pdf = 0 where it is refused.
BsdfSample deltaSample(Bsdf b, BsdfDirection d) {
    float side = dot(b.geometric, d.wi);
    if (d.lobe == LOBE_REFLECTION ? side <= 0.0 : side >= 0.0) return BsdfSample(d.wi, vec3(0.0), 0.0, vec3(0.0), 0.0, d.lobe, true);
    vec3 weight = d.deltaValue / d.chance;
    return BsdfSample(d.wi, weight, d.chance, weight, d.chance, d.lobe, true);
}

/// The sample of a lobe of some width, given bsdfValue of its lobe and direction.
BsdfSample lobeSample(BsdfDirection d, BsdfValue value) {
    if (!(value.onePdf > 0.0)) return BsdfSample(d.wi, vec3(0.0), 0.0, vec3(0.0), 0.0, d.lobe, false);
    return BsdfSample(d.wi, value.all / value.pdf, value.pdf, value.one / value.onePdf, value.onePdf, d.lobe, false);
}

/// Samples a direction that light may come from.
BsdfSample bsdfSample(Bsdf b, vec3 wo, vec3 u) {
    BsdfDirection d = bsdfDirection(b, wo, u);
    if (d.delta || d.lobe == LOBE_COUNT) return deltaSample(b, d);
    return lobeSample(d, bsdfValue(b, d.lobe, wo, d.wi));
}
