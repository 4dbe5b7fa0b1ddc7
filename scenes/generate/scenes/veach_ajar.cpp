// SPDX-License-Identifier: MIT
// Three teapots in a room lit through a door ajar, plaster walls.
#include "kit/ajar_room.h"
#include "kit/scene.h"

namespace lodestir::generate {

namespace {

Glb makeVeachAjar() { return ajarRoom(false); }

}  // namespace

LODESTIR_SCENE(makeVeachAjar)

}  // namespace lodestir::generate
