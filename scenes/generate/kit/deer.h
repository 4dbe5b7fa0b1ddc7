// SPDX-License-Identifier: MIT
// A fallow buck that walks along +x on y = 0 and looks about: modelled body, forked antlers, spotted coat. 1.8 m from nose to tail, 2.1 m to its antlers' tips.
#pragma once

#include <string>

#include "glb.h"

namespace lodestir::generate {

/// All of one mesh and one material, whose pictures are `texels` a side.
Model deer(Glb& glb, const std::string& name, int texels);

}  // namespace lodestir::generate
