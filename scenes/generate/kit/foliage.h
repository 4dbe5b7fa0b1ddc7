// SPDX-License-Identifier: MIT
// House plants: leaves cut out of a picture, on stems.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "glb.h"
#include "picture.h"

namespace lodestir::generate {

/// One leaf filling the picture, stalk at the bottom, tip at the top; alpha cuts its outline.
Textures paintLeaf(uint32_t seed, int width);

/// What a plant is made of: material indices.
struct PlantMaterials {
    int leaf, stem;
};

/// A rubber fig about `height` metres tall, growing from y = 0.
Model rubberFig(const std::string& name, uint32_t seed, float height, int leaves, const PlantMaterials& materials);

/// A few leafy twigs for a vase, spreading from the origin.
Model twigs(const std::string& name, uint32_t seed, float length, int count, const PlantMaterials& materials);

}  // namespace lodestir::generate
