// SPDX-License-Identifier: MIT
// The Cornell box with its two blocks.
#include <utility>

#include "kit/cornell_box.h"
#include "kit/scene.h"

namespace lodestir::generate {

namespace {

Glb makeCornell() {
    CornellBox box;
    box.put("short_block", box.white, shortBlock());
    box.put("tall_block", box.white, tallBlock());
    return std::move(box.glb);
}

}  // namespace

LODESTIR_SCENE(makeCornell)

}  // namespace lodestir::generate
