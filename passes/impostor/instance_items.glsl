// SPDX-License-Identifier: MIT
// Items of all instances by number (impostor/instance_items.h). After pass.glsl.

/// Each instance's first item: sums of 64 instances each (turn 0), sums of these (1), and sums inside each (2). In this order, whoever runs when, so that an
/// item has the same number in each frame that shows the same.
void numberItems(uint turn, uint group) {
    uint first = group * 64u, end = min(first + 64u, itemsCount()), sum = 0u;
    if (turn == 0u) {
        for (uint i = first; i < end; ++i) sum += items(i);
        storeSums(group, sum);
    } else if (turn == 1u) {
        for (uint i = 0u; i < sumsCount(); ++i) {
            uint own = sums(i);
            storeSums(i, sum);
            sum += own;
        }
        storeTotal(0u, sum);
    } else {
        sum = sums(group);
        for (uint i = first; i < end; ++i) {
            uint own = items(i);
            storeItems(i, sum);
            sum += own;
        }
    }
}

/// The last instance whose first item is not after this one: by bisection.
uint instanceOfItem(uint item) {
    uint low = 0u, high = itemsCount() - 1u;
    while (low < high) {
        uint middle = (low + high + 1u) / 2u;
        if (items(middle) <= item) low = middle;
        else high = middle - 1u;
    }
    return low;
}
