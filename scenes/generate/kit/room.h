// SPDX-License-Identifier: MIT
// The shell of the interior: floor, walls with a window and a garden door, ceiling, mouldings, curtains, and the garden outside.
#pragma once

#include <glm/glm.hpp>

#include "furniture.h"
#include "glb.h"

namespace lodestir::generate {

/// The room in metres: x from -halfWidth to halfWidth, z from back to front, y from 0 up. The window is in the wall
/// at -halfWidth.
struct Room {
    float halfWidth = 2.7f;
    float back = -2.4f, front = 2.9f;
    float height = 2.72f;
    float windowBack = -1.62f, windowFront = 0.98f;  ///< z range of the opening
    float sill = 0.62f, lintel = 2.36f;
    float doorLeft = -1.9f, doorRight = 0.7f;  ///< x range of the glazed door in the front wall
    float doorHead = 2.36f;
    float wallThickness = 0.26f;
};

/// Adds all parts of the shell as nodes.
void addRoom(Glb& glb, const Palette& palette, const Room& room);

/// Lawn and hedge before the window.
void addGarden(Glb& glb, const Palette& palette, const Room& room);

}  // namespace lodestir::generate
