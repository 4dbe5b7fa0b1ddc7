// SPDX-License-Identifier: MIT
// Sheen of cloth (KHR_materials_sheen): the "Charlie" distribution of fibres, its shadowing, and the share of light it takes.
// Estevez and Kulla 2017, Production Friendly Microfacet Sheen BRDF, sections 2 to 4. Roughness here is perceptual, its square is theirs.
#include "base/math.glsl"

const float SHEEN_ROUGHNESS_MIN = 0.1;  // less would be a rim of light below one degree

/// D(h), per steradian, for the sine of h to the normal.
float sheenDistribution(float sine, float roughness) {
    float exponent = 1.0 / (roughness * roughness);
    return (2.0 + exponent) * 0.5 * INV_PI * pow(max(sine, 1e-6), exponent);
}

/// Lambda of the Smith term, by Estevez and Kulla's fit (their eq. 3 and table 1, linear between its two rows as there).
float sheenLambda(float cosine, float roughness) {
    float way = square(1.0 - roughness * roughness);
    float a = mix(21.5473, 25.3245, way), b = mix(3.82987, 3.32435, way), c = mix(0.19823, 0.16801, way), d = mix(-1.97760, -1.27393, way),
          e = mix(-4.32054, -4.85967, way);
    float x = cosine < 0.5 ? cosine : 1.0 - cosine, centre = a / (1.0 + b * pow(0.5, c)) + d * 0.5 + e;
    float l = a / (1.0 + b * pow(max(x, 1e-6), c)) + d * x + e;
    return exp(cosine < 0.5 ? l : 2.0 * centre - l);
}

// Directional albedo of D G / (4 cosO cosI) in steps of 1/120, one byte each, lowest byte first: 16 cosines (i / 15)^2 for each of the 8
// roughnesses 0.1 + 0.9 (k / 7)^2. Midpoint quadrature over the hemisphere in double precision; sheen.test.comp makes it anew.
const uint SHEEN_ALBEDO[32] = uint[](
    0x8fcafbfcu, 0x0d1c365cu, 0x00000205u, 0x00000000u, 0x86b5dad8u, 0x11223a5cu, 0x00010308u, 0x00000000u,
    0x718da09bu, 0x1b2b3e56u, 0x02040910u, 0x00000001u, 0x5e6e7771u, 0x24303e4du, 0x070b121au, 0x00010204u,
    0x555f635du, 0x2b343e49u, 0x0e141b22u, 0x0103060au, 0x575f615au, 0x333c444eu, 0x181e252cu, 0x05090e12u,
    0x626a6b63u, 0x3e464f58u, 0x22282f37u, 0x0d12171cu, 0x676f7068u, 0x444c545du, 0x282f363du, 0x14191e23u);

/// Share of light from o that a white sheen sends back, before sheenScale. It is above 1 at grazing angles of low roughness, where the fit of
/// Lambda shadows too little.
float sheenAlbedo(float cosine, float roughness) {
    float x = sqrt(clamp(cosine, 0.0, 1.0)) * 15.0, y = sqrt(clamp((roughness - 0.1) / 0.9, 0.0, 1.0)) * 7.0;
    uint i = min(uint(x), 14u), k = min(uint(y), 6u);
    float sum = 0.0;
    for (uint corner = 0u; corner < 4u; ++corner) {
        uint at = (k + (corner >> 1u)) * 16u + i + (corner & 1u);
        float weight = ((corner & 1u) != 0u ? x - float(i) : 1.0 - (x - float(i))) * ((corner & 2u) != 0u ? y - float(k) : 1.0 - (y - float(k)));
        sum += weight * float(SHEEN_ALBEDO[at >> 2u] >> (8u * (at & 3u)) & 255u);
    }
    return sum * (1.0 / 120.0);
}

/// f of a white sheen, given the albedos and Lambdas of both directions. The larger albedo is brought down to 1.
float sheenValue(float cosO, float cosI, vec2 albedos, vec2 lambdas, float sine, float roughness) {
    float shadowing = 1.0 + lambdas.x + lambdas.y;
    return sheenDistribution(sine, roughness) / max(4.0 * cosO * cosI * shadowing * max(1.0, max(albedos.x, albedos.y)), 1e-20);
}
