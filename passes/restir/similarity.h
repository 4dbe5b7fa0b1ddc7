// SPDX-License-Identifier: MIT
// Parameters of passes that ask which pixels are alike (restir/similar_pixels.glsl asks by them) and which pixels are neighbours.
#pragma once
#include <framework/pass/parameter.h>

namespace lodestir {

struct Similarity {
    Param<float> normal, depth;
    explicit Similarity(Pass* pass, float leastCosine = 0.5f, float mostDifference = 0.1f)
        : normal{pass, "normal", leastCosine, {-1, 1}, "least cosine between the normals of pixels that are alike; -1 asks nothing"},
          depth{pass, "depth", mostDifference, {0, 1e6f}, "most difference of depth between pixels that are alike, relative; 1e6 asks nothing"} {}
};

/// Neighbours are similar pixels of a disk.
struct Neighbourhood {
    Param<float> radius;
    Similarity similarity;
    explicit Neighbourhood(Pass* pass) : radius{pass, "radius", 20, {1, 200}, "of the disk that neighbours are drawn from, pixels"}, similarity{pass} {}
};

}  // namespace lodestir
