// SPDX-License-Identifier: MIT
// Four texels of an impostor as one, of the level above (RiLoD: depth by minimum, normals by a von Mises-Fisher mean, texture
// coordinates and alpha by average, materials by count). What the paper leaves open is decided here; README.md says how.
#include "impostor/texel.glsl"

/// The place with the largest count; of equal ones the first from `first` on, which whoever asks for many texels turns from one to the next, so that no
/// material wins all draws.
uint commonestPlace(uint counts, uint first) {
    uint best = first % PALETTE;
    for (uint i = 1u; i < PALETTE; ++i) {
        uint place = (first + i) % PALETTE;
        best = countOf(counts, place) > countOf(counts, best) ? place : best;
    }
    return best;
}
uint commonestPlace(uint counts) { return commonestPlace(counts, 0u); }

/// Shares, which sum to 1, as 15ths that sum to 15: the largest remainders are rounded up, of equal ones the first from `first` on, and no share of half a
/// 15th or more is lost.
uint roundShares(float shares[PALETTE], uint first) {
    int counts[PALETTE], sum = 0;
    for (uint i = 0u; i < PALETTE; ++i) {
        float ideal = 15.0 * shares[i];
        counts[i] = int(ideal + 1e-4);  // what are whole 15ths but for rounding are whole
        if (counts[i] == 0 && ideal >= 0.5) counts[i] = 1;
        sum += counts[i];
    }
    while (sum != 15) {
        int change = sum < 15 ? 1 : -1;
        uint best = PALETTE;
        float most = -1e30;
        for (uint i = 0u; i < PALETTE; ++i) {
            uint place = (first + i) % PALETTE;
            float excess = float(change) * (15.0 * shares[place] - float(counts[place]));
            bool may = shares[place] > 0.0 && (change > 0 || counts[place] > 1);
            if (may && excess > most) {
                most = excess;
                best = place;
            }
        }
        if (best == PALETTE) break;
        counts[best] += change;
        sum += change;
    }
    uint bits = 0u;
    for (uint i = 0u; i < PALETTE; ++i) bits |= uint(counts[i]) << (4u * i);
    return bits;
}

uint roundShares(float shares[PALETTE]) { return roundShares(shares, 0u); }

/// `resolution`: of the level that the four are of, texels a side. `first`: of commonestPlace and roundShares.
ImpostorTexel reduceTexels(ImpostorTexel t[4], uint resolution, uint first) {
    ImpostorTexel made = emptyTexel();
    for (int i = 0; i < 4; ++i)
        if (isSeen(t[i])) made.depth = min(made.depth, t[i].depth);

    // Attributes are those of the nearest surface alone, or silhouettes would take on what lies behind them.
    float weights[4], sum = 0.0, shares[PALETTE];
    for (uint p = 0u; p < PALETTE; ++p) shares[p] = 0.0;
    for (int i = 0; i < 4; ++i) {
        made.alpha += 0.25 * t[i].alpha;
        bool kept = isSeen(t[i]) && t[i].depth - made.depth <= SAME_LAYER / float(resolution);
        weights[i] = kept ? t[i].alpha : 0.0;
        sum += weights[i];
        made.normal += weights[i] * t[i].normal;
        made.flags |= kept ? t[i].flags : 0u;
        for (uint p = 0u; p < PALETTE; ++p) shares[p] += weights[i] * float(countOf(t[i].counts, p));
    }
    if (sum == 0.0) return emptyTexel();
    made.normal /= sum;  // not made unit again: lengths multiply up only as long as nobody does
    for (uint p = 0u; p < PALETTE; ++p) shares[p] /= 15.0 * sum;
    made.counts = roundShares(shares, first);

    // Texture coordinates are those of the material that most of it has, where it is nearest, with what lies beside it on the same chart.
    uint place = commonestPlace(made.counts, first);
    int nearest = -1;
    bool found = false;
    for (int i = 0; i < 4; ++i) {
        if (weights[i] == 0.0) continue;
        bool mine = commonestPlace(t[i].counts) == place;
        if (nearest < 0 || (mine && !found) || (mine == found && t[i].depth < t[nearest].depth)) nearest = i;
        found = found || mine;
    }
    vec2 anchor = t[nearest].uv, uvSum = vec2(0.0);
    float uvWeight = 0.0, area = 0.0;  // of the texture
    for (int i = 0; i < 4; ++i) {
        if (weights[i] == 0.0 || (commonestPlace(t[i].counts) == place) != found) continue;
        vec2 apart = t[i].uv - anchor;
        apart -= floor(apart + 0.5);
        if (max(abs(apart.x), abs(apart.y)) >= SAME_CHART) continue;
        uvSum += weights[i] * apart;
        uvWeight += weights[i];
        if (t[i].density != DENSITY_NONE) area += exp2(2.0 * t[i].density);
    }
    made.uv = anchor + uvSum / uvWeight;
    made.uv -= floor(made.uv);
    // As much of the texture as it shows, on that chart: four times what a child does, but at outlines and seams. More would mix in what lies beside the chart.
    if (area > 0.0) made.density = 0.5 * log2(area);
    made.material = t[nearest].material;
    return made;
}
ImpostorTexel reduceTexels(ImpostorTexel t[4], uint resolution) { return reduceTexels(t, resolution, 0u); }
