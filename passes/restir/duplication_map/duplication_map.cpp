// SPDX-License-Identifier: MIT
// How alike neighbours have become.
#include <framework/pass/pass.h>
#include <passes/restir/paths.h>

using namespace lodestir;

struct DuplicationMap final : Pass {
    In<Paths>  paths{this, "paths", "a path of each pixel, after all reuse"};
    Out<Image> duplication{this, "duplication", "share of the pixels around that hold a copy of the pixel's path, 0 to 1; 0 where it holds none", Format::r32f};
    Param<int> radius{this, "radius", 8, {1, 16}, "of the square that is searched, pixels: 2 radius + 1 wide (Lin et al. 2026, section 5)"};
};
LODESTIR_PASS(DuplicationMap, "duplication_map.comp", "Counts copies of each pixel's path among its neighbours: where resampling has run out of paths.")
