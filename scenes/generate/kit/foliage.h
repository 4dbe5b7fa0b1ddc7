// SPDX-License-Identifier: MIT
// Plants of leaves cut out of a picture, on stems.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "glb.h"
#include "picture.h"

namespace lodestir::generate {

/// Colours of a leaf; the rubber fig's.
struct LeafPaint {
    glm::vec3 shade{0.030f, 0.105f, 0.026f}, light{0.060f, 0.155f, 0.034f};  ///< mottled from one to the other
    glm::vec3 vein{0.17f, 0.27f, 0.085f};
};

/// One leaf filling the picture, stalk at the bottom, tip at the top; alpha cuts its outline.
Textures paintLeaf(uint32_t seed, int width, const LeafPaint& paint = {});

/// What a plant is made of: material indices.
struct PlantMaterials {
    int leaf, stem;
};

/// A rubber fig about `height` metres tall, growing from y = 0.
Model rubberFig(const std::string& name, uint32_t seed, float height, int leaves, const PlantMaterials& materials);

/// A few leafy twigs for a vase, spreading from the origin.
Model twigs(const std::string& name, uint32_t seed, float length, int count, const PlantMaterials& materials);

/// What a bush is made of: its leaves take turns with `leaves`.
struct BushMaterials {
    std::vector<int> leaves;
    int bark;
};

/// A round bush about `height` metres tall and as wide, growing from y = 0: some 1,300 leaves of 16 triangles.
Model bush(const std::string& name, uint32_t seed, float height, const BushMaterials& materials);

}  // namespace lodestir::generate
