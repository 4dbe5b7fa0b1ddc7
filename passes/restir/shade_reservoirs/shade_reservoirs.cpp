// SPDX-License-Identifier: MIT
// From reservoirs to an image.
#include <framework/pass/pass.h>
#include <passes/restir/paths.h>

using namespace lodestir;

enum class View { radiance, confidence, segments, reconnection, technique, place };

struct ShadeReservoirs final : Pass {
    In<World>              world{this, "world", "the scene"};
    In<Buffer<PrimaryHit>> hits{this, "hits", "camera hits, for `emission`", Need::optional};
    In<Paths>              paths{this, "paths", "a path of each pixel"};
    In<Image>              resampled{this, "color", "radiance from the weights of all candidates, taken instead of the kept path's", Need::optional};
    In<Image>              more{this, "add", "light that the reservoirs leave out, added", Need::optional};
    Out<Image>             color{this, "color", "radiance, linear Rec. 709; or what `view` asks for", Format::rgba32f};
    Param<bool>            emission{this, "emission", false,
                                    "adds light that the camera sees directly at `hits`, for reservoirs that leave it out "
                                    "(initial_sampling.segmentsMin above 1)"};
    Param<View>            view{this, "view", View::radiance, {"radiance", "confidence", "segments", "reconnection", "technique", "place"},
                                "what to look at: radiance; confidence / 20; segments / 8; reconnection vertex / 8 (black: replayed); "
                                "light sampling (red), BSDF sampling (green), environment (with blue); place of the path inside its pixel"};
    InPlace                over{this, resampled, color};
};
LODESTIR_PASS(ShadeReservoirs, "shade_reservoirs.comp", "Turns each reservoir into the radiance of its pixel, F(Y) W, or shows what it holds.")
