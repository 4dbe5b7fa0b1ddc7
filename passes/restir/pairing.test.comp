// SPDX-License-Identifier: MIT
// If these fail, a pixel is not its partner's partner: what it takes for its own path shifted there is another pixel's.
// groups: 256
#version 460
#include "base/test.glsl"
#include "restir/pairing.glsl"
layout(local_size_x = 64) in;

// A table by formula: on the torus of `size` pixels p and centre - p are partners, with the shortest step between them.
ivec2 reflected(uvec2 p, uvec2 centre, uint size) {
    ivec2 step = ivec2((centre + size - p) % size) - ivec2(p);
    int side = int(size);
    if (step.x > side / 2) step.x -= side;
    if (step.y > side / 2) step.y -= side;
    if (step.x < -side / 2) step.x += side;
    if (step.y < -side / 2) step.y += side;
    return step;
}

void main() {
    uint id = gl_GlobalInvocationID.x;
    uvec3 bits = randomBits3(uvec2(id, 5), 0u, 0u);
    bits.z = id << 29;  // each of the 8 transforms
    PairingDraw d = drawPairing(bits);
    uvec3 more = randomBits3(uvec2(id, 5), 1u, 0u);
    uint size = id % 3u == 0u ? 254u : id % 3u == 1u ? 230u : 210u;
    // Far enough from the edge that the partner is no negative pixel.
    ivec2 pixel = ivec2(128u + more.xy % 3840u);
    uvec2 centre = uvec2(more.z & 0xffffu, more.z >> 16) % size;
    ivec2 partner = pixel + pairingStep(d, reflected(pairingPlace(d, size, pixel), centre, size));
    ivec2 back = partner + pairingStep(d, reflected(pairingPlace(d, size, partner), centre, size));
    EXPECT_TRUE(back == pixel);
    EXPECT_TRUE(all(lessThan(pairingPlace(d, size, pixel), uvec2(size))));

    // Each transform is a bijection that keeps neighbours neighbours: the place one pixel further differs in one coordinate by one, on the torus.
    ivec2 change = ivec2(pairingPlace(d, size, pixel + ivec2(1, 0))) - ivec2(pairingPlace(d, size, pixel));
    ivec2 wrapped = min(abs(change), int(size) - abs(change));
    EXPECT_TRUE(wrapped == (d.transpose ? ivec2(0, 1) : ivec2(1, 0)));
}
