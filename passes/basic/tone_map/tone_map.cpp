// SPDX-License-Identifier: MIT
// From scene-linear radiance to what a display shows.
#include <framework/pass/pass.h>
#include <framework/pass/scene.h>

#include <bit>

using namespace lodestir;

enum class Curve { neutral, aces, reinhard, linear };

struct ToneMap final : Pass {
    In<Image>    color{this, "color", "scene-linear radiance"};
    Out<Image>   display{this, "display", "display-linear colour in [0, 1] (files and windows encode it to sRGB)", Format::rgba32f};
    Param<float> exposure{this, "exposure", 0.0f, {-20, 20}, "stops, added to the scene file's"};
    Param<Curve> curve{this, "curve", Curve::neutral, {"neutral", "aces", "reinhard", "linear"},
                       "neutral: Khronos PBR Neutral (keeps hues and mid-tones); aces: Narkowicz' fit of the ACES curve; reinhard: of luminance; "
                       "linear: clamp"};
    PassThrough  off{this, color, display};
    InPlace      over{this, color, display};

    ToneMap() { forDisplay = true; }
    void execute(Frame& frame) override { frame.dispatch(shader, frame.sizeOf(display), {std::bit_cast<std::uint32_t>(frame.scene().exposure)}); }
};
LODESTIR_PASS(ToneMap, "tone_map.comp", "Exposes and compresses an image for display.")
