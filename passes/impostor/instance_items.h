// SPDX-License-Identifier: MIT
// What instances are drawn by, numbered through the frame: tiles of texels, or blocks of pixels. How many there are only the device knows.
#pragma once
#include <framework/pass/pass.h>

namespace lodestir {

struct InstanceItems {
    Scratch<Buffer<uint>> items, sums, total;

    /// Shaders find them by these names (impostor/instance_items.glsl).
    explicit InstanceItems(Pass* pass)
        : items{pass, "items", "of each instance how many, then the number of its first", Count::reserved()},
          sums{pass, "sums", "items of 64 instances each, then of all before them", Count::reserved()},
          total{pass, "total", "items of the frame", Count::fixed(1)} {}

    void reserve(Frame& frame, std::uint32_t instances) const {
        frame.reserve(items, instances);
        frame.reserve(sums, groupsOf(instances));
    }
    /// After `items` has been given how many each instance has. The pass's number.comp calls numberItems.
    static void number(Frame& frame, std::uint32_t instances) {
        frame.dispatch("number.comp", {groupsOf(instances), 1}, {0});
        frame.dispatch("number.comp", {1, 1}, {1});
        frame.dispatch("number.comp", {groupsOf(instances), 1}, {2});
    }

    static constexpr std::uint32_t lanes = 1 << 15;  ///< that walk through all items

private:
    static std::uint32_t groupsOf(std::uint32_t instances) { return (instances + 63) / 64; }
};

}  // namespace lodestir
