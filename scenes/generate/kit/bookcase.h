// SPDX-License-Identifier: MIT
// A bookcase and what stands in it.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "furniture.h"
#include "glb.h"

namespace lodestir::generate {

/// Size of a closed book standing upright: thickness (x), height (y), depth from spine to fore-edge (z).
struct Book {
    glm::vec3 size;
    glm::vec3 cloth;  ///< linear colour of the cover
    bool gilded = false;
};

/// Adds a book standing on `where`'s origin, spine towards +z, centred in x; `where` may lean or lay it down.
void addBook(Model& model, const Palette& palette, const Book& book, const glm::mat4& where);

/// A book drawn by a random hand.
Book anyBook(uint32_t seed);

/// Open shelves with their back to z = 0, facing +z, filled with books and a few objects.
Model bookcase(const Palette& palette, uint32_t seed, float width, float height);

}  // namespace lodestir::generate
