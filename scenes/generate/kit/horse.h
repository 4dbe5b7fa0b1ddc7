// SPDX-License-Identifier: MIT
// A carved horse of a merry-go-round, galloping along +x; its pole goes through the origin. 1.9 m from nose to tail.
#pragma once

#include <string>

#include "glb.h"

namespace lodestir::generate {

/// What it is painted with: material indices.
struct HorsePaints {
    int coat, mane, hoof, saddle, cloth, gilt, eye;
};

Model horse(const std::string& name, const HorsePaints& paints);

}  // namespace lodestir::generate
