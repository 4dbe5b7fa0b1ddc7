// SPDX-License-Identifier: MIT
// Each instance's first tile: sums of 64 instances each (0), sums of these (1), and sums inside each (2). In this order, whoever runs when, so that a texel
// has the same number in each frame that shows the same.
#version 460
#include "pass.glsl"
#include "numbering.glsl"

void main() {
    if (skip()) return;
    uint group = uint(pixel().x), first = group * 64u, end = min(first + 64u, drawnCount()), sum = 0u;
    if (argument(0) == 0u) {
        for (uint i = first; i < end; ++i) sum += drawn(i).count;
        storeSums(group, sum);
    } else if (argument(0) == 1u) {
        for (uint i = 0u; i < sumsCount(); ++i) {
            uint own = sums(i);
            storeSums(i, sum);
            sum += own;
        }
        storeTotals(0u, sum);
        storeTotals(1u, 0u);
    } else {
        sum = sums(group);
        for (uint i = first; i < end; ++i) {
            Drawn d = drawn(i);
            d.first = sum;
            storeDrawn(i, d);
            sum += d.count;
        }
    }
}
