// SPDX-License-Identifier: MIT
// Direct light by resampling light points: the separate first stage beside a ReSTIR PT that leaves direct light out.
#include <framework/pass/pass.h>
#include <framework/shaders/world/primary_hit.h>
#include <passes/restir/history.h>
#include <passes/restir/similarity.h>

#include "light_reservoir.h"

using namespace lodestir;

struct RestirDi final : Pass {
    In<World>                       world{this, "world", "the scene"};
    In<World>                       worldPrev{this, "worldPrev", "last frame's scene"};
    In<Buffer<PrimaryHit>>          hits{this, "hits", "camera hits: the surfaces that are lit"};
    In<Buffer<PrimaryHit>>          hitsPrev{this, "hitsPrev", "last frame's"};
    In<Image>                       motion{this, "motion", "to last frame's position, pixels"};
    In<Buffer<LightReservoir>>      history{this, "history", "last frame's light point of each pixel: this pass's own reservoirs@prev"};
    Out<Buffer<LightReservoir>>     reservoirs{this, "reservoirs", "the light point of each pixel after reuse", Count::perPixel()};
    Out<Image>                      color{this, "color", "light seen directly and after one scattering, linear Rec. 709", Format::rgba32f};
    Scratch<Buffer<LightReservoir>> merged{this, "merged", "after temporal reuse, before spatial reuse", Count::perPixel()};
    Scratch<Image>                  mirrored{this, "mirrored", "light that a delta lobe found, which no light sample can compete with", Format::rgba32f};
    Param<int>                      candidates{this, "candidates", 32, {1, 256}, "light samples a pixel and frame, beside one BSDF sample"};
    History                         reused{this};
    Param<int>                      neighbours{this, "neighbours", 3, {0, 16}, "neighbours whose points are reused; 0: no spatial reuse"};
    Neighbourhood                   around{this};

    void execute(Frame& frame) override {
        frame.dispatch("candidates.comp", frame.size());
        frame.dispatch(shader, frame.size());
    }
};
LODESTIR_PASS(RestirDi, "restir_di.comp", "Direct light by spatiotemporal resampling of light points, one shadow ray a pixel at the end (ReSTIR DI).")
