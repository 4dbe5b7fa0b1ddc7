// SPDX-License-Identifier: MIT
// The scattering of a glTF metallic-roughness surface as five lobes: diffuse reflection (cloth's sheen with it), specular reflection, specular
// transmission, specular reflection by a clear coat and, for alpha BLEND, passage straight on.
//
// glTF 2.0 appendix B with KHR_materials_transmission, _ior, _volume, _specular, _anisotropy, _sheen and _clearcoat, with these choices:
// - The dielectric Fresnel term is exact; metals use Schlick's. Specular reflection is their mixture by `metallic`. KHR_materials_specular
//   takes the exact term's place between normal and grazing incidence over to its own colours.
// - What lies under the dielectric layer is reached through it twice, (1 - F(o)) (1 - F(i)) / (1 - mean F) (Ashikhmin and Shirley 2000's
//   coupling with Kelemen and Szirmay-Kalos 2001's norm), instead of appendix B's 1 - F(half): reciprocal as well, and a white
//   diffuse surface then returns all light under a smooth layer, where appendix B's returns more than it got at grazing angles.
//   F is here the largest of its channels, as KHR_materials_specular asks: what is left has no complementary tint.
// - What lies under a coat or sheen gets min(T(o), T(i)), T being what that layer leaves of light along a direction: KHR_materials_sheen's
//   rule, for the coat too, whose 1 - F(o) alone would not be reciprocal. A mirror under a coat so returns all light, a diffuse base some
//   percent less.
// - Thin walls: the microfacet reflection turned over to the far side, tinted by the base colour. Solids refract (Walter et al. 2007).
//   Radiance grows or shrinks by the square of the indices' ratio when it is refracted, so the lobe carries 1 / eta^2. Coat and sheen of
//   a solid are outside.
// - Scattering between microfacets is left out, as in appendix B: rough metals and rough glass lose some energy.
// - Lobes narrower than alpha = 1e-3 are delta lobes.
//
// Light is refused where the shading normal and the triangle disagree about its side. All directions point away from the surface.
#include "base/sampling.glsl"
#include "bsdf/fresnel.glsl"
#include "bsdf/ggx.glsl"
#include "bsdf/sheen.glsl"

const uint LOBE_DIFFUSE = 0u;
const uint LOBE_REFLECTION = 1u;
const uint LOBE_TRANSMISSION = 2u;
const uint LOBE_COAT = 3u;
const uint LOBE_THROUGH = 4u;  // the only one that a Reservoir can't name: paths are never connected at a delta lobe
const uint LOBE_COUNT = 5u;
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
    float alpha;         // GGX width, roughness squared; across the tangent
    float eta;           // index of refraction beyond the surface / before it, as the viewer sees it
    float coverage;      // the rest goes straight on
    bool solid;          // refracts; else a thin wall

    // Neutral for most materials (plainBsdf).
    float along;             // GGX width along the tangent, >= alpha
    vec3 tangent;            // unit, at right angles to the normal; without meaning where both widths are equal
    float specular;          // the dielectric's reflectance at grazing incidence
    vec3 specularShift;      // specularShiftOf
    vec3 sheen;              // colour; black: none
    float sheenRoughness;    // perceptual
    float coat, coatAlpha;   // how much of a clear coat there is, and its GGX width
    vec3 coatNormal;         // unit, towards the viewer
};

/// A surface without layers, isotropic.
Bsdf plainBsdf(vec3 normal, vec3 geometric, vec3 base, float metallic, float transmission, float alpha, float eta, float coverage, bool solid) {
    return Bsdf(normal, geometric, base, metallic, transmission, alpha, eta, coverage, solid, alpha, vec3(0.0), 1.0, vec3(0.0), vec3(0.0), 1.0,
                0.0, 1.0, normal);
}

const float COAT_ETA = 1.5;  // KHR_materials_clearcoat: F0 = 0.04

/// Index of refraction to reflectance at normal incidence.
float normalReflectance(float eta) { return square((eta - 1.0) / (eta + 1.0)); }

/// KHR_materials_specular: F0' = min(F0 color, 1) specular and F90' = specular. With the exact F between F0 and 1 that is
/// specular F + shift (1 - F), shift = specular (min(F0 color, 1) - F0) / (1 - F0).
vec3 specularShiftOf(float eta, float specular, vec3 color) {
    float f0 = normalReflectance(eta);
    return specular * (min(f0 * color, 1.0) - f0) / max(1.0 - f0, 1e-6);
}

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
bool coatDelta(Bsdf b) { return b.coatAlpha < ALPHA_DELTA; }

bool lobeDelta(Bsdf b, uint lobe) {
    return lobe == LOBE_REFLECTION ? reflectionDelta(b) : lobe == LOBE_TRANSMISSION ? transmissionDelta(b)
         : lobe == LOBE_COAT ? coatDelta(b) : lobe == LOBE_THROUGH;
}

/// Perceptual roughness, of anisotropic lobes across: 1 for the diffuse lobe, 0 for delta lobes.
float lobeRoughness(Bsdf b, uint lobe) {
    return lobe == LOBE_DIFFUSE ? 1.0 : lobeDelta(b, lobe) ? 0.0 : sqrt(lobe == LOBE_COAT ? b.coatAlpha : b.alpha);
}

/// Share of the dielectric's light that is reflected in the channel that reflects most, for exact reflectance `fresnel` (or its mean).
float dielectricShare(Bsdf b, float fresnel) {
    return clamp(b.specular * fresnel + maxComponent(b.specularShift) * (1.0 - fresnel), 0.0, 1.0);  // dense media dip below F0 on the way
}

/// Reflectance of a facet seen under `cosine`, given the dielectric's exact reflectance there.
vec3 specularColor(Bsdf b, float cosine, float fresnel) {
    return mix(max(b.specular * fresnel + b.specularShift * (1.0 - fresnel), 0.0), fresnelSchlick(b.base, cosine), b.metallic);
}

/// Coat and sheen of a solid are seen from outside only.
bool insideSolid(Bsdf b) { return b.solid && b.eta < 1.0; }
bool hasCoat(Bsdf b) { return b.coat > 0.0 && !insideSolid(b); }
bool hasSheen(Bsdf b) { return maxComponent(b.sheen) > 0.0 && !insideSolid(b); }

/// What coat and sheen do to light along two directions, seen from either side: x for o, y for i.
struct LayerShares {
    vec2 underCoat;  // what reaches the sheen
    vec2 sheen;      // albedo of a white sheen
    vec2 lambda;     // its shadowing
    float leave;     // what is left of the base's light between the two: the smaller share, but of a solid only what is outside counts
};

/// The length of the loop is not known to compilers, which so keep one copy of its body. Without wi (any vector) ask for x alone.
LayerShares layerShares(Bsdf b, vec3 wo, vec3 wi) {
    LayerShares shares = LayerShares(vec2(1.0), vec2(0.0), vec2(0.0), 1.0);
    float sheen = maxComponent(b.sheen);
    bool inside = insideSolid(b), crosses = dot(b.normal, wi) < 0.0;
    for (uint k = 0u; k < (b.coat > 0.0 || sheen > 0.0 ? 2u : 0u); ++k) {
        vec3 w = k == 0u ? wo : wi;
        float cosine = min(abs(dot(b.normal, w)), 1.0), underCoat = 1.0, albedo = 0.0, lambda = 0.0;
        if (b.coat > 0.0) underCoat = 1.0 - b.coat * fresnelDielectric(min(abs(dot(b.coatNormal, w)), 1.0), COAT_ETA);
        if (sheen > 0.0) {
            albedo = sheenAlbedo(cosine, b.sheenRoughness);
            lambda = sheenLambda(cosine, b.sheenRoughness);
        }
        shares.underCoat[k] = underCoat;
        shares.sheen[k] = albedo;
        shares.lambda[k] = lambda;
        bool counts = !b.solid || (k == 0u ? !inside : inside == crosses);
        if (counts) shares.leave = min(shares.leave, underCoat * (1.0 - sheen * min(albedo, 1.0)));
    }
    return shares;
}

/// Chances of the lobes: `scatter` of LOBE_DIFFUSE to LOBE_COAT.
struct LobeChances {
    vec4 scatter;
    float through;
};
float lobeChance(LobeChances c, uint lobe) { return lobe < LOBE_THROUGH ? c.scatter[lobe] : lobe == LOBE_THROUGH ? c.through : 0.0; }
float chanceSum(LobeChances c) { return dot(c.scatter, vec4(1.0)) + c.through; }

/// Chances of the lobes, from the light that each sends under the Fresnel terms of the view angle. Their sum is 1, or 0 where the surface
/// is black. A lobe that can send light has LOBE_SHARE at least (before the sum is made 1).
LobeChances lobeProbabilities(Bsdf b, vec3 wo) {
    float cosine = clamp(dot(b.normal, wo), 0.0, 1.0), dielectric = 1.0 - b.metallic;
    float fresnel = fresnelDielectric(cosine, b.eta), base = luminance(b.base), under = 1.0 - dielectricShare(b, fresnel);
    vec4 share = vec4(dielectric * (1.0 - b.transmission) * under * base,             // diffuse
                      luminance(specularColor(b, cosine, fresnel)),                   // specular reflection
                      dielectric * b.transmission * under * base, 0.0);               // specular transmission
    // Facets of a rough surface are met under other angles: they may send light where the mean surface sends none.
    bvec4 possible = greaterThan(share, vec4(0.0));
    if (b.alpha >= ALPHA_DELTA) {
        possible.y = possible.y || b.metallic > 0.0;
        possible.z = possible.z || dielectric * b.transmission * base > 0.0;
    }
    if (hasCoat(b) || hasSheen(b)) {
        LayerShares layers = layerShares(b, wo, wo);
        float albedo = min(layers.sheen.x, 1.0), sheen = layers.underCoat.x * albedo;
        share.xyz = share.xyz * (layers.underCoat.x - sheen * maxComponent(b.sheen)) + vec3(sheen * luminance(b.sheen), 0.0, 0.0);
        share.w = dot(b.coatNormal, wo) > 0.0 ? 1.0 - layers.underCoat.x : 0.0;
        possible.x = possible.x || hasSheen(b);
        possible.w = share.w > 0.0;
    }
    share *= b.coverage;
    if (b.coverage <= 0.0) possible = bvec4(false);
    LobeChances chance = LobeChances(share, 1.0 - b.coverage);
    float sum = max(chanceSum(chance), 1e-20);
    chance.scatter = mix(vec4(0.0), max(share / sum, vec4(LOBE_SHARE)), possible);
    chance.through = chance.through > 0.0 ? max(chance.through / sum, LOBE_SHARE) : 0.0;
    sum = max(chanceSum(chance), 1e-20);
    chance.scatter /= sum;
    chance.through /= sum;
    return chance;
}

/// Adds one lobe's f |cos| and density to the sums.
void addLobe(inout BsdfValue value, bool isAsked, vec3 f, float pdf) {
    value.all += f;
    value.pdf += pdf;
    if (!isAsked) return;
    value.one = f;
    value.onePdf = pdf;
}

/// f |cos| and densities for light from wi seen from wo; `one` is the given lobe, `chance` the chances of all as seen from wo: whoever asks for several
/// directions makes them once. Zero where a side is wrong.
BsdfValue bsdfValue(Bsdf b, LobeChances chance, uint lobe, vec3 wo, vec3 wi) {
    BsdfValue value = BsdfValue(vec3(0.0), vec3(0.0), 0.0, 0.0);
    float cosO = dot(b.normal, wo), cosI = dot(b.normal, wi), side = dot(b.geometric, wi);
    bool reflected = cosI > 0.0 && side > 0.0, transmitted = cosI < 0.0 && side < 0.0, coated = hasCoat(b) && side > 0.0;
    if (!(cosO > 0.0 && (reflected || transmitted || coated))) return value;
    LayerShares layers = layerShares(b, wo, wi);
    float dielectric = 1.0 - b.metallic, scale = b.coverage * layers.leave;

    if (reflected && chance.scatter.x > 0.0) {
        float mean = dielectricShare(b, fresnelDielectricMean(b.eta));
        float through = (1.0 - dielectricShare(b, fresnelDielectric(min(cosO, 1.0), b.eta))) *
                        (1.0 - dielectricShare(b, fresnelDielectric(min(cosI, 1.0), b.eta))) / max(1.0 - mean, 1e-6);
        vec3 f = b.base * (scale * dielectric * (1.0 - b.transmission) * through * INV_PI * cosI);
        if (hasSheen(b)) {
            vec3 h = safeNormalize(wo + wi, b.normal);
            float sheen = sheenValue(min(cosO, 1.0), min(cosI, 1.0), layers.sheen, layers.lambda, length(cross(b.normal, h)), b.sheenRoughness);
            f += b.sheen * (b.coverage * min(layers.underCoat.x, layers.underCoat.y) * sheen * cosI);
        }
        addLobe(value, lobe == LOBE_DIFFUSE, f, chance.scatter.x * INV_PI * cosI);
    }

    // The specular lobes: the base's on this side or the other, and the coat's. Both of the base share the half vector h and the distribution
    // at it. Through a thin wall wi is seen mirrored at the wall.
    for (uint layer = 0u; layer < (coated ? 2u : 1u); ++layer) {
        bool isCoat = layer == 1u, refracted = transmitted && b.solid && !isCoat, mirrored = reflected || isCoat;
        uint specular = isCoat ? LOBE_COAT : reflected ? LOBE_REFLECTION : LOBE_TRANSMISSION;
        float specularChance = chance.scatter[specular];
        Facets facets = isCoat ? Facets(b.coatNormal, vec3(0.0), b.coatAlpha, b.coatAlpha) : Facets(b.normal, b.tangent, b.alpha, b.along);
        float facetO = isCoat ? dot(b.coatNormal, wo) : cosO, facetI = isCoat ? dot(b.coatNormal, wi) : cosI;
        if (specularChance <= 0.0 || lobeDelta(b, specular) || (isCoat ? facetI <= 0.0 : !(reflected || transmitted))) continue;
        vec3 sum = wo + (refracted ? b.eta * wi : mirrored ? wi : wi - 2.0 * cosI * b.normal);
        vec3 h = safeNormalize(sum, facets.normal);
        h = dot(h, facets.normal) < 0.0 ? -h : h;
        float cosH = min(dot(wo, h), 1.0), cosHI = dot(wi, h);
        if (cosH <= 0.0 || (refracted && cosHI >= 0.0)) continue;
        float distribution = ggxDistribution(facets, h), fresnel = fresnelDielectric(cosH, isCoat ? COAT_ETA : b.eta);
        float slopeO = ggxSlope(facets, wo, facetO), slopeI = ggxSlope(facets, wi, facetI);
        facetI = abs(facetI);
        // Walter et al. 2007, eq. 17, 21: f |cosI| = G2 D |o.h| |i.h| / (cosO (eta i.h + o.h)^2) with the squared length of `sum` below; half
        // vectors become directions with the density's factor eta^2 |i.h| / (eta i.h + o.h)^2. For reflection it is 1 / (4 o.h), eq. 14.
        float jacobian = refracted ? abs(cosHI) / dot(sum, sum) : 0.25;
        float f = distribution * ggxVisibility(facetO, slopeO, facetI, slopeI) * facetI * (refracted ? 4.0 * cosH * jacobian : 1.0);
        float pdf = ggxVisibleDensity(facetO, slopeO, distribution) * (refracted ? cosH * b.eta * b.eta * jacobian : jacobian);
        vec3 color = isCoat ? vec3(b.coat * fresnel) : mirrored ? specularColor(b, cosH, fresnel)
                                                                : b.base * (dielectric * b.transmission * (1.0 - dielectricShare(b, fresnel)));
        addLobe(value, lobe == specular, color * ((isCoat ? b.coverage : scale) * f), specularChance * pdf);
    }
    return value;
}

BsdfValue bsdfValue(Bsdf b, uint lobe, vec3 wo, vec3 wi) { return bsdfValue(b, lobeProbabilities(b, wo), lobe, wo, wi); }

/// f |cos| over all lobes that are not delta lobes, and the density with which bsdfSample finds wi by them.
vec3 bsdfEval(Bsdf b, LobeChances chance, vec3 wo, vec3 wi, out float pdf) {
    BsdfValue value = bsdfValue(b, chance, LOBE_ALL, wo, wi);
    pdf = value.pdf;
    return value.all;
}
vec3 bsdfEval(Bsdf b, vec3 wo, vec3 wi, out float pdf) { return bsdfEval(b, lobeProbabilities(b, wo), wo, wi, pdf); }

/// The same for one lobe; the density holds the lobe's probability. Zero for delta lobes.
vec3 lobeEval(Bsdf b, uint lobe, vec3 wo, vec3 wi, out float pdf) {
    BsdfValue value = bsdfValue(b, lobe, wo, wi);
    pdf = value.onePdf;
    return value.one;
}

/// No lobe that light sampling could serve.
bool bsdfAllDelta(Bsdf b, LobeChances chances) {
    vec4 chance = chances.scatter;
    return !(chance.x > 0.0 || (chance.y > 0.0 && !reflectionDelta(b)) || (chance.z > 0.0 && !transmissionDelta(b)) ||
             (chance.w > 0.0 && !coatDelta(b)));
}

/// The lobe whose share of [0, 1) holds u; LOBE_COUNT where the surface is black.
uint chooseLobe(LobeChances chances, float u) {
    uint lobe = LOBE_COUNT;
    for (uint l = 0u; l < LOBE_COUNT; ++l) {
        float chance = lobeChance(chances, l);
        if (chance <= 0.0) continue;
        lobe = l;
        u -= chance;
        if (u < 0.0) break;
    }
    return lobe;
}

/// f |cos| of transmission that is a delta lobe, layers and coverage left aside.
vec3 clearTransmission(Bsdf b, float fresnel) { return b.base * ((1.0 - b.metallic) * b.transmission * (1.0 - dielectricShare(b, fresnel))); }

/// Share of light that goes straight on: what is not covered, and what a clear thin wall transmits.
vec3 straightOn(Bsdf b, vec3 wo) {
    vec3 through = vec3(1.0 - b.coverage);
    if (b.solid || !transmissionDelta(b)) return through;
    vec3 clear = clearTransmission(b, fresnelDielectric(clamp(dot(b.normal, wo), 0.0, 1.0), b.eta));
    return through + b.coverage * layerShares(b, wo, -wo).leave * clear;
}

/// Direction of the lobe and, for delta lobes, f |cos|. Zero vector under total internal reflection.
vec3 lobeDirection(Bsdf b, uint lobe, vec3 wo, vec2 u, out vec3 deltaValue) {
    deltaValue = vec3(1.0 - b.coverage);
    if (lobe == LOBE_THROUGH) return -wo;
    bool isCoat = lobe == LOBE_COAT;
    vec3 normal = isCoat ? b.coatNormal : b.normal;
    mat3 frame = basisAround(normal);
    if (lobe == LOBE_DIFFUSE) return frame * cosineHemisphere(u);

    vec2 widths = isCoat ? vec2(b.coatAlpha) : vec2(b.along, b.alpha);
    if (widths.x != widths.y) frame = mat3(b.tangent, cross(b.normal, b.tangent), b.normal);
    vec3 h = lobeDelta(b, lobe) ? normal : frame * ggxSampleHalf(wo * frame, widths, u);
    float cosH = clamp(dot(wo, h), 0.0, 1.0);
    vec3 mirrored = 2.0 * cosH * h - wo, direction = mirrored;
    float fresnel = fresnelDielectric(cosH, isCoat ? COAT_ETA : b.eta);
    deltaValue = isCoat ? vec3(b.coat * fresnel) : specularColor(b, cosH, fresnel);
    if (lobe == LOBE_TRANSMISSION) {
        deltaValue = clearTransmission(b, fresnel);
        if (b.solid) {
            deltaValue /= b.eta * b.eta;
            float inner = 1.0 - (1.0 - cosH * cosH) / (b.eta * b.eta);
            direction = inner <= 0.0 ? vec3(0.0) : (cosH / b.eta - sqrt(inner)) * h - wo / b.eta;
        } else {
            direction = mirrored - 2.0 * dot(mirrored, b.normal) * b.normal;
        }
    }
    deltaValue *= isCoat ? b.coverage : b.coverage * layerShares(b, wo, direction).leave;
    return direction;
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
BsdfDirection bsdfDirection(Bsdf b, LobeChances chance, vec3 wo, vec3 u) {
    BsdfDirection result = BsdfDirection(vec3(0.0), LOBE_COUNT, false, 0.0, vec3(0.0));
    uint lobe = chooseLobe(chance, u.x);
    if (lobe == LOBE_COUNT || !(dot(b.normal, wo) > 0.0)) return result;
    result.wi = safeNormalize(lobeDirection(b, lobe, wo, u.yz, result.deltaValue), vec3(0.0));
    result.lobe = lobe;
    result.delta = lobeDelta(b, lobe);
    result.chance = lobeChance(chance, lobe);
    return result;
}

/// The delta lobe's sample. pdf = 0 where it is refused.
BsdfSample deltaSample(Bsdf b, BsdfDirection d) {
    float side = dot(b.geometric, d.wi);
    if (d.lobe == LOBE_REFLECTION || d.lobe == LOBE_COAT ? side <= 0.0 : side >= 0.0) return BsdfSample(d.wi, vec3(0.0), 0.0, vec3(0.0), 0.0, d.lobe, true);
    vec3 weight = d.deltaValue / d.chance;
    return BsdfSample(d.wi, weight, d.chance, weight, d.chance, d.lobe, true);
}

/// The sample of a lobe of some width, given bsdfValue of its lobe and direction.
BsdfSample lobeSample(BsdfDirection d, BsdfValue value) {
    if (!(value.onePdf > 0.0)) return BsdfSample(d.wi, vec3(0.0), 0.0, vec3(0.0), 0.0, d.lobe, false);
    return BsdfSample(d.wi, value.all / value.pdf, value.pdf, value.one / value.onePdf, value.onePdf, d.lobe, false);
}

/// Samples a direction that light may come from.
BsdfSample bsdfSample(Bsdf b, LobeChances chance, vec3 wo, vec3 u) {
    BsdfDirection d = bsdfDirection(b, chance, wo, u);
    if (d.delta || d.lobe == LOBE_COUNT) return deltaSample(b, d);
    return lobeSample(d, bsdfValue(b, chance, d.lobe, wo, d.wi));
}
BsdfSample bsdfSample(Bsdf b, vec3 wo, vec3 u) { return bsdfSample(b, lobeProbabilities(b, wo), wo, u); }
