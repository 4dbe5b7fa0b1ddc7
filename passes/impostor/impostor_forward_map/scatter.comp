// SPDX-License-Identifier: MIT
// Texels into pixels; the least key stays. With pairs of atomics the upper words come first (argument 0), then the lower ones of those that have the least.
#version 460
#include "pass.glsl"
#include "outline.glsl"
#include "splat.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 8) buffer WideKeys { uint64_t at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer PairKeys { SplatKey at[]; };

const uint QUALITY_STEPS = 255u;

/// How near a texel is in a pixel: its depth, of surfaces that lie closer together than the tolerance the same, before how frontally it was seen. What
/// a texel is drawn out over is left to those whose centre lies there.
uint nearness(Splat s, ImpostorTexel t, ivec2 pixel, bool isCenter) {
    float depth = max(depthIn(s, pixel), 1e-30), step = params.tolerance * s.side;
    if (step <= 0.0) return floatBitsToUint(depth);
    float rounded = (floor(depth / step) + (isCenter ? 0.0 : 1.0)) * step;
    uint quality = uint(clamp(s.frontal * t.alpha, 0.0, 1.0) * float(QUALITY_STEPS) + 0.5);
    return (floatBitsToUint(rounded) >> 7) << 8 | (QUALITY_STEPS - quality);
}

void offer(ivec2 pixel, uint number, uint near) {
    uint i = pixelIndex(pixel);
    if (params.atomics == atomics_wide) {
        uint64_t key = packUint2x32(uvec2(number, near));
        WideKeys keys = WideKeys(passBlock().keys.address);
        if (key < keys.at[i]) atomicMin(keys.at[i], key);
        return;
    }
    PairKeys keys = PairKeys(passBlock().keys.address);
    if (argument(0) == 0u) atomicMin(keys.at[i].high, near);
    else if (keys.at[i].high == near) atomicMin(keys.at[i].low, number);
}

/// Levels that take over from each other share the pixels, by a pattern that stays while the share grows (Jimenez 2014, Next Generation Post Processing in Call
/// of Duty: Advanced Warfare: interleaved gradient noise).
bool isShownIn(ivec2 pixel, DrawnTexel x) {
    Drawn d = drawn(x.instance);
    if (d.share >= 1.0) return !x.fades;
    float place = fract(52.9829189 * fract(dot(vec2(pixel), vec2(0.06711056, 0.00583715))));
    return (place < d.share) != x.fades;
}

void draw(World w, Impostors made, uint number) {
    DrawnTexel x;
    if (!texelOfNumber(made, number, x)) return;
    ImpostorTexel t = shapeAt(made, w.instances.at[x.instance].mesh, x.place.level, x.place.view, x.place.texel);
    Splat s;
    if (!splatOf(w, made, x, t, s)) return;
    if (argument(0) == 0u && addTexels(0u, 1u) == 0xffffffffu) addTexels(1u, 1u);
    vec2 reach = OVERLAP * (abs(s.a) + abs(s.b));
    ivec2 middle = centerPixel(s), most = ivec2(params.footprint / 2);
    ivec2 low = max(max(ivec2(ceil(s.center - reach)), middle - most), ivec2(0));
    ivec2 high = min(min(ivec2(floor(s.center + reach)), middle + most), ivec2(frameSize()) - 1);
    if (any(lessThan(high, low))) return;
    vec3 part = WHOLE;
    if (!params.blend) part = coveredPart(made, w.instances.at[x.instance].mesh, x.place, t.alpha, params.cutoff);
    for (int v = low.y; v <= high.y; ++v) {
        for (int u = low.x; u <= high.x; ++u) {
            ivec2 pixel = ivec2(u, v);
            if (covers(s, pixel, part) && isShownIn(pixel, x)) offer(pixel, number, nearness(s, t, pixel, pixel == middle));
        }
    }
}

void main() {
    if (skip()) return;
    World w = world();
    Impostors made = impostors();
    uint count = tilesShown(0u) * TILE_NUMBERS;
    for (uint i = uint(pixel().x); i < count; i += push.extent.x) draw(w, made, shown(i / TILE_NUMBERS) * TILE_NUMBERS + i % TILE_NUMBERS);
}
