// SPDX-License-Identifier: MIT
// Motion for pixels that have just come into sight.
#include <framework/pass/pass.h>
#include <framework/shaders/world/primary_hit.h>

using namespace lodestir;

struct DualMotion final : Pass {
    In<World>              world{this, "world", "the scene"};
    In<World>              worldPrev{this, "worldPrev", "last frame's scene"};
    In<Buffer<PrimaryHit>> hits{this, "hits", "the camera hit of each pixel"};
    In<Buffer<PrimaryHit>> hitsPrev{this, "hitsPrev", "last frame's"};
    In<Image>              motion{this, "motion", "to last frame's position, pixels (visibility)"};
    Out<Image>             motionOut{this, "motion",
                                     "the same, but where something was in the way last frame, or the image ended, to a place that saw the surroundings",
                                     Format::rg32f};
    Param<float>           depth{this, "depth", 0.1f, {0, 1},
                                 "what lay nearer to the camera than the pixel's surface by so much of its depth was in its way (Lin et al. 2026, "
                                 "section 6.4)"};
    PassThrough            off{this, motion, motionOut};
    InPlace                over{this, motion, motionOut};
};
LODESTIR_PASS(DualMotion, "dual_motion.comp", "Gives pixels that were hidden last frame the motion of what hid them (dual motion vectors).")
