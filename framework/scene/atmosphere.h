// SPDX-License-Identifier: MIT
// Scattering of sunlight in the air: Rayleigh, aerosols (Mie) and ozone, single scattering integrated along rays, further orders
// by the isotropic closure of Hillaire 2020, "A Scalable and Production Ready Sky and Atmosphere Rendering Technique", section 5.5.
#pragma once
#include <glm/glm.hpp>

#include <vector>

namespace lodestir {

/// What the air between the eye and the end of a ray adds and leaves, for sunlight of irradiance 1 above it.
struct AirLight {
    glm::dvec3 rayleigh{0}, mie{0};  ///< single scattering, still to be multiplied by the phase functions
    glm::dvec3 multiple{0};          ///< second and higher orders
    glm::dvec3 transmittance{1};     ///< of what lies at the end
    bool ground = false;             ///< the ray ends at the ground
};

class Atmosphere {
public:
    /// Density of aerosols from the turbidity; ground albedo for the light it throws back into the air.
    Atmosphere(double turbidity, const glm::dvec3& groundAlbedo);

    /// Light seen from the ground in a direction of elevation sine `viewSine`, for a sun of elevation sine `sunSine` at an azimuth
    /// whose cosine relative to the view is `azimuthCosine`.
    AirLight look(double viewSine, double sunSine, double azimuthCosine) const;

    /// Share of sunlight that arrives at an altitude (km); without the ground's shadow.
    glm::dvec3 sunTransmittance(double altitude, double sunSine) const;

    static double rayleighPhase(double cosine);
    double miePhase(double cosine) const;

private:
    struct Coefficients {
        glm::dvec3 rayleigh, mie, extinction;  ///< scattering of both, total extinction; 1/km
    };
    Coefficients at(double altitude) const;
    double shadow(double altitude, double sunSine) const;
    glm::dvec3 multipleAt(double altitude, double sunSine) const;
    void tabulateTransmittance();
    void tabulateMultiple(const glm::dvec3& groundAlbedo);

    glm::dvec3 aerosol_{0};                  ///< extinction at sea level, 1/km
    std::vector<glm::dvec3> transmittance_;  ///< by altitude and sun elevation
    std::vector<glm::dvec3> multiple_;
};

}  // namespace lodestir
