// SPDX-License-Identifier: MIT
// If these fail, what an impostor keeps is not what was seen, by more than its bits say.
// groups: 256
#version 460
#include "base/test.glsl"
#include "base/math.glsl"
#include "impostor/texel.glsl"
layout(local_size_x = 64) in;

const uint COUNT = 256u * 64u;

void main() {
    uint id = gl_GlobalInvocationID.x;
    float z = 1.0 - (float(id) + 0.5) / float(COUNT), turn = 2.39996323 * float(id);
    vec3 n = vec3(sqrt(1.0 - z * z) * vec2(cos(turn), sin(turn)), z);

    vec2 p = hemiOctahedral(n);
    EXPECT_TRUE(max(abs(p.x), abs(p.y)) <= 1.0);
    EXPECT_NEAR(fromHemiOctahedral(p), n, 1e-6);
    EXPECT_NEAR(fromHemiOctahedral(hemiOctahedral(vec3(normalize(n.xy), 0))), vec3(normalize(n.xy), 0), 1e-6);
    EXPECT_NEAR(fromHemiOctahedral(vec2(0)), vec3(0, 0, 1), 0.0);

    float size = 0.1 + 0.9 * fract(0.618 * float(id));
    ImpostorTexel t = emptyTexel();
    t.normal = size * n;
    t.depth = fract(0.755 * float(id));
    t.alpha = float(id) / float(COUNT);
    t.density = -20.0 + 25.0 * fract(0.569 * float(id));
    t.flags = id & 7u;
    t.uv = vec2(fract(0.414 * float(id)), fract(0.732 * float(id)));
    ImpostorTexel back = unpackShape(packShape(t));
    back.uv = unpackUv(packUv(t.uv));
    // Steps of 1/32767 on a square of side 2 make at most sqrt(2) 2^-16 at its middle, and up to twice that at the rim; rounding of floats beside it.
    EXPECT_NEAR(length(back.normal), size, 1e-5);
    EXPECT_NEAR(normalize(back.normal), n, 5e-5);
    EXPECT_EQ(back.depth, t.depth);
    EXPECT_EQ(back.alpha, t.alpha);
    EXPECT_NEAR(back.density, t.density, 0.0626);
    EXPECT_EQ(back.flags, t.flags);
    EXPECT_NEAR(back.uv, t.uv, 0.51 / 65536.0 + 1e-6);
    // What was packed once stays what it is.
    EXPECT_EQ(packUv(back.uv), packUv(t.uv));
    EXPECT_EQ(packDensity(back.density), packDensity(t.density));

    // Coordinates wrap; the last half step is the next repeat's first.
    EXPECT_EQ(packUv(vec2(-0.25, 3.5)), packUv(vec2(0.75, 0.5)));
    EXPECT_EQ(packUv(vec2(0.999999, 1.0)), 0u);
    EXPECT_EQ(unpackDensity(packDensity(DENSITY_NONE)), DENSITY_NONE);
    EXPECT_EQ(unpackDensity(packDensity(100.0)), 7.875);
    EXPECT_EQ(unpackDensity(packDensity(-100.0)), -23.875);

    // An empty texel is one after packing, too.
    ImpostorTexel nothing = unpackShape(packShape(emptyTexel()));
    EXPECT_TRUE(!isSeen(nothing) && nothing.depth == 1.0 && nothing.normal == vec3(0.0));
    EXPECT_EQ(nothing.density, DENSITY_NONE);
}
