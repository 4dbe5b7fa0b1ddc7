// SPDX-License-Identifier: MIT
// Three teapots in a room lit through a door ajar, walls of rough metal.
#include "kit/ajar_room.h"
#include "kit/scene.h"

namespace lodestir::generate {

namespace {

Glb makeVeachAjarMetal() { return ajarRoom(true); }

}  // namespace

LODESTIR_SCENE(makeVeachAjarMetal)

}  // namespace lodestir::generate
