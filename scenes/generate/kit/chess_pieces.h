// SPDX-License-Identifier: MIT
// Turned chess pieces with fine detail, a square being 1 wide. UVs: u around, v down, in the unit square.
#pragma once

#include "mesh.h"

namespace lodestir::generate {

enum class Piece { pawn, rook, knight, bishop, queen, king };

/// A piece that stands on the origin; the knight looks along +x. 30,000 to 60,000 triangles.
Mesh chessPiece(Piece piece);

}  // namespace lodestir::generate
