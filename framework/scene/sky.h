// SPDX-License-Identifier: MIT
// A clear sky with the sun in it, computed from the scattering of sunlight in the air.
#pragma once
#include <framework/scene/scene.h>

namespace lodestir {

struct Sky {
    glm::vec3 sunDirection{-0.5f, 0.8f, 0.5f};  ///< towards the sun, any length but 0
    float sunAngle = 0.53f;                     ///< diameter of the disc, degrees
    float sunStrength = 1;                      ///< factor on the disc alone, not on the light it scatters
    float turbidity = 3;                   ///< haze: 1 is air without dust, 2 very clear, 3 clear, 6 hazy (Preetham et al. 1999, section 2)
    glm::vec3 ground{0.3f, 0.28f, 0.25f};  ///< albedo of the plain below the horizon
};

/// Irradiance of a surface outside the atmosphere that faces the sun. With it a clear sky has a mean radiance of about 1 when the
/// sun is high. It is white: the camera is balanced for sunlight as it arrives at the air.
inline constexpr float solarIrradiance = 20;

/// Irradiance that arrives at the ground from the sun's disc through the air, facing the sun; 0 when the sun is below the horizon.
LODESTIR_API glm::vec3 sunIrradiance(const Sky& sky);

/// The equirectangular map (environment.h). The disc's energy is exact: its radiance summed over texel solid angles is sunIrradiance,
/// or the part of the disc above the horizon.
LODESTIR_API Environment makeSky(const Sky& sky, int width = 1024, int height = 512);

}  // namespace lodestir
