// SPDX-License-Identifier: MIT
// Surfaces as if washed with watercolour: nearly white pictures whose tones gather at edges and in the grain of the paper, to be tinted by the
// material's colour or the mesh's.
#pragma once

#include <cstdint>
#include <string>

#include <glm/glm.hpp>

#include "glb.h"
#include "picture.h"

namespace lodestir::generate {

/// A matt paint, no gloss at all: an index of refraction of 1. `picture`: a material that wears one of these.
Material wash(const Material& picture, const std::string& name, const glm::vec3& color);

/// A wash that dried in patches; repeats after washSize metres.
Textures paintWash(uint32_t seed, int width);
constexpr float washSize = 4.0f;

/// Courses of roof tiles, each a stroke of the brush; u along the ridge, repeats after roofSize metres.
Textures paintRoof(uint32_t seed, int width);
constexpr float roofSize = 3.0f;

}  // namespace lodestir::generate
