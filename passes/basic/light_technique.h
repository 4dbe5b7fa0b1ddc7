// SPDX-License-Identifier: MIT
// The parameter of passes that make paths: by which sampling techniques these find light.
#pragma once
#include <framework/pass/parameter.h>

namespace lodestir {

enum class Technique { both, light, bsdf };

struct LightTechnique {
    Param<Technique> technique;
    explicit LightTechnique(Pass* pass)
        : technique{pass, "technique", Technique::both, {"both", "light", "bsdf"},
                    "how light is found: light sampling and BSDF sampling joined by the balance heuristic, or one of them alone "
                    "(lights without extent are always sampled, unlit surfaces never)"} {}
};

}  // namespace lodestir
