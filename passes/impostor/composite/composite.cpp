// SPDX-License-Identifier: MIT
// One picture before another, by depth.
#include <framework/pass/pass.h>

using namespace lodestir;

struct Composite final : Pass {
    In<World>  world{this, "world", "the scene, whose environment is behind everything"};
    In<Image>  color{this, "color", "radiance of what is laid over; alpha: the share of the pixel that it covers"};
    In<Image>  depth{this, "depth", "its distance along the view direction, scene units; 0 where there is nothing"};
    In<Image>  behind{this, "behind", "radiance of the rest; unwired: the environment", Need::optional};
    In<Image>  behindDepth{this, "behindDepth", "its distance along the view direction; 0: infinite; unwired: infinite everywhere", Need::optional};
    Out<Image> colorOut{this, "color", "radiance of both, linear Rec. 709", Format::rgba32f};
};
LODESTIR_PASS(Composite, "composite.comp", "Lays a picture over another where it is nearer, by the share of each pixel that it covers.")
