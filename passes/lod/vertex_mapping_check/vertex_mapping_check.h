// SPDX-License-Identifier: MIT
// What became of one point of a mesh on its way to another level and back.
#ifndef LODESTIR_VERTEX_MAPPING_CHECK_H
#define LODESTIR_VERTEX_MAPPING_CHECK_H
#include "base/shared.h"

LODESTIR_SHARED_BEGIN

struct MappingCheck {
    uint outcome;            // MAPPING_*; 0: there was no point, and the rest means nothing
    uint here, there;        // triangles of both levels that hold the point's coordinate; 0: none, or more than a query holds
    float edge;              // least of the point's three barycentrics: 0 on an edge of its triangle
    float thickness;         // least height in UV of its triangles on both levels, in steps of a float: places are as uncertain as 1 / thickness of a triangle
    float area;              // that the point stands for, so that the mean over points is the level's: object units squared
    float stretch;           // |d tau|: area there per area here, object units; 0 where tau is not defined
    float errorJacobian;     // |J J' - 1| of the ways there and back
    float errorReturn;       // how far from where it set out the point comes back, in radii of the mesh
    float finiteDifference;  // what a small triangle around the point is stretched by; 0: it doesn't fit into both levels' triangles
    vec2 uv;
    vec3 position, image;    // of the point on both levels, object space
};

// Bits of MappingCheck.outcome.
const uint MAPPING_TRIED = 1u;
const uint MAPPING_HELD = 2u;    // by its coordinate the point's own triangle is found; where not, it lies on an edge, or too many have the coordinate
const uint MAPPING_THERE = 4u;    // tau is defined
const uint MAPPING_BACK = 8u;     // and so is its inverse
const uint MAPPING_SAME = 16u;    // which leads to the triangle that the point set out from
const uint MAPPING_PASSED = 32u;  // another point of the same coordinate would have been nearer: it went to somebody else

LODESTIR_SHARED_END
LODESTIR_SHARED(MappingCheck, "vertex_mapping_check.h")
#endif
