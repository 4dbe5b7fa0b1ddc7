// SPDX-License-Identifier: MIT
// If these fail, paths are splatted to times that they can't be splatted back from, and parts of an exposure get more of the history than others.
// groups: 64
#version 460
#include "base/test.glsl"
#include "lod/partitions.glsl"
layout(local_size_x = 64) in;

void main() {
    uint id = gl_GlobalInvocationID.x, last = uint(1.0 / TIME_STEP) - 1u;
    // Evenly over the exposure, and so near to its ends that sums are rounded across them.
    float times[3] = float[](float(id * 4096u + id) * TIME_STEP, float(id) * TIME_STEP, float(last - id) * TIME_STEP);
    for (uint i = 0u; i < 3u; ++i) {
        float time = times[i];
        // An exposure in one part: nothing changes, not a bit.
        EXPECT_EQ(timeInPart(time, 0u, 1u), time);
        EXPECT_EQ(timeOfOriginal(time, 1u), time);
        for (uint parts = 1u; parts <= 8u; ++parts)
            for (uint part = 0u; part < parts; ++part) {
                float copied = timeInPart(time, part, parts);
                EXPECT_TRUE(copied >= 0.0 && copied < 1.0);
                EXPECT_EQ(partOf(copied, parts), part);
                EXPECT_NEAR(copied, (time + float(part)) / float(parts), 2.0 * TIME_STEP);
                EXPECT_NEAR(timeOfOriginal(copied, parts), time, 16.0 * TIME_STEP);
                // d (copy) / d (original), by differences; the parts side by side fill the exposure.
                float other = timeInPart(time < 0.5 ? time + 0.25 : time - 0.25, part, parts);
                EXPECT_NEAR(abs(other - copied) * float(parts), 0.25, 16.0 * TIME_STEP);
            }
    }
}
