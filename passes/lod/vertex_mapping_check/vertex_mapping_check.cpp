// SPDX-License-Identifier: MIT
// How much of a mesh is found again on another of its levels, and how well.
#include "vertex_mapping_check.h"

#include <framework/pass/pass.h>
#include <passes/lod/uv_index.h>
#include <framework/shaders/world/primary_hit.h>

using namespace lodestir;

struct VertexMappingCheck final : Pass {
    In<World>                 world{this, "world", "the scene"};
    In<UvIndex>               uv{this, "uv", "triangles by texture coordinate"};
    In<Buffer<PrimaryHit>>    hits{this, "hits",
                                   "camera hits: the points are what each pixel sees, on the level it sees; unwired: points all over the mesh", Need::optional};
    Out<Buffer<MappingCheck>> checks{this, "checks", "one point of each pixel: mapped to level `to` and back", Count::perPixel()};
    Out<Image>                color{this, "color",
                                    "what became of the point: tau is not defined (red), leads back to another triangle (magenta) or place (orange), its "
                                    "Jacobian is wrong (yellow), it led past a nearer point (blue); else it is well (green); hit on an edge (grey), nothing "
                                    "to map (black)",
                                    Format::rgba16f};
    Param<int>                instance{this, "instance", 0, {0, 1 << 24}, "whose mesh the points lie on; without `hits`"};
    Param<int>                from{this, "from", 0, {0, 7}, "level that the points lie on; without `hits`"};
    Param<int>                to{this, "to", 1, {0, 7}, "level that they are mapped to"};
    Param<bool>               matching{this, "matching", true, "triangles that share a coordinate are paired; else such points are not mapped"};
    Param<float>              step{this, "step", 0.1f, {1e-4f, 1}, "of finite differences, in sides of the smaller triangle in UV"};
    Param<float>              tolerance{this, "tolerance", 0.01f, {0, 1},
                                        "relative errors of the Jacobian above it are shown, and a hundredth of it in radii for places"};
};
LODESTIR_PASS(VertexMappingCheck, "vertex_mapping_check.comp",
              "Maps points of a mesh to another level and back and measures what is lost on the way: a diagnostic for models with levels of detail.")
