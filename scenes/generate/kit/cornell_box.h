// SPDX-License-Identifier: MIT
// The Cornell box, from the measured data of the Cornell University Program of Computer Graphics ("Cornell Box Data", geometry in
// millimetres), about 5.5 scene units wide.
#pragma once

#include <string>

#include "glb.h"

namespace lodestir::generate {

/// A model file under way that holds the empty box and its lamp.
struct CornellBox {
    Glb glb;
    int white;  ///< material of the blocks

    CornellBox();
    void put(const std::string& name, int material, const Mesh& mesh, const Placement& placement = {});
};

/// The blocks where they stand.
Mesh shortBlock();
Mesh tallBlock();

}  // namespace lodestir::generate
