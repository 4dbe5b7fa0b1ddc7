// SPDX-License-Identifier: MIT
// Scattering of sunlight in the air. Lengths in km.
#include <framework/core/tasks.h>
#include <framework/scene/atmosphere.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lodestir {
namespace {

using glm::dvec3;
using std::numbers::pi;

// Earth and its air at 680, 550 and 440 nm: Hillaire 2020, table 1 (after Bruneton and Neyret 2008).
constexpr double groundRadius = 6360, topRadius = 6460, airHeight = topRadius - groundRadius;
constexpr double rayleighHeight = 8.0, mieHeight = 1.2;  // scale heights
const dvec3 rayleighScattering(5.802e-3, 13.558e-3, 33.1e-3);
const dvec3 ozoneAbsorption(0.650e-3, 1.881e-3, 0.085e-3);  // at its densest, 25 km up
const dvec3 wavelengths(0.680, 0.550, 0.440);               // micrometres
constexpr double mieAlbedo = 0.9, mieAsymmetry = 0.76;      // Bruneton and Neyret 2008, section 2
constexpr double eyeAltitude = 0.002;
constexpr double sunSize = 0.0047;  // angular radius of the real sun: softens the edge of the ground's shadow

constexpr int transmittanceRows = 32, transmittanceColumns = 128, multipleRows = 16, multipleColumns = 48;

dvec3 exponential(const dvec3& v) { return {std::exp(v.x), std::exp(v.y), std::exp(v.z)}; }

/// Sine of the elevation of the horizon seen from an altitude: 0 on the ground, negative above.
double horizonSine(double altitude) {
    const double sine = groundRadius / (groundRadius + altitude);
    return -std::sqrt(std::max(0.0, 1 - sine * sine));
}

/// Altitude after `distance` along a ray that starts at `altitude` with elevation sine `sine`.
double altitudeAlong(double altitude, double sine, double distance) {
    const double r = groundRadius + altitude;
    return std::max(0.0, std::sqrt(r * r + distance * distance + 2 * r * distance * sine) - groundRadius);
}

double distanceToTop(double altitude, double sine) {
    const double r = groundRadius + altitude;
    return -r * sine + std::sqrt(std::max(0.0, r * r * (sine * sine - 1) + topRadius * topRadius));
}

double distanceToGround(double altitude, double sine) {
    const double r = groundRadius + altitude;
    return -r * sine - std::sqrt(std::max(0.0, r * r * (sine * sine - 1) + groundRadius * groundRadius));
}

/// Bilinear reading of a table over the unit square, edges included.
dvec3 interpolate(const std::vector<dvec3>& table, int rows, int columns, double row, double column) {
    const double y = std::clamp(row, 0.0, 1.0) * (rows - 1), x = std::clamp(column, 0.0, 1.0) * (columns - 1);
    const int y0 = std::min(static_cast<int>(y), rows - 2), x0 = std::min(static_cast<int>(x), columns - 2);
    const auto value = [&](int r, int c) { return table[static_cast<std::size_t>(r * columns + c)]; };
    return glm::mix(glm::mix(value(y0, x0), value(y0, x0 + 1), x - x0), glm::mix(value(y0 + 1, x0), value(y0 + 1, x0 + 1), x - x0), y - y0);
}

// Axes of the tables: altitude by its square root (the air is dense below), elevation above the horizon by its square root
// (light changes fastest there).
double rowOf(double altitude) { return std::sqrt(std::clamp(altitude / airHeight, 0.0, 1.0)); }
double altitudeOf(double row) { return row * row * airHeight; }

}  // namespace

Atmosphere::Atmosphere(double turbidity, const dvec3& groundAlbedo) {
    // Angstrom's law for the aerosols' vertical optical depth (Preetham et al. 1999, appendix 1): beta * wavelength^-1.3.
    const double beta = std::max(0.0, 0.04608 * turbidity - 0.04586);
    for (int i = 0; i < 3; ++i) aerosol_[i] = beta * std::pow(wavelengths[i], -1.3) / mieHeight;
    tabulateTransmittance();
    tabulateMultiple(groundAlbedo);
}

Atmosphere::Coefficients Atmosphere::at(double altitude) const {
    const dvec3 rayleigh = rayleighScattering * std::exp(-altitude / rayleighHeight);
    const dvec3 aerosol = aerosol_ * std::exp(-altitude / mieHeight);
    const dvec3 ozone = ozoneAbsorption * std::max(0.0, 1 - std::abs(altitude - 25) / 15);
    return {rayleigh, aerosol * mieAlbedo, rayleigh + aerosol + ozone};
}

void Atmosphere::tabulateTransmittance() {
    constexpr int steps = 64;
    transmittance_.resize(transmittanceRows * transmittanceColumns);
    for (int row = 0; row < transmittanceRows; ++row) {
        for (int column = 0; column < transmittanceColumns; ++column) {
            const double altitude = altitudeOf(row / (transmittanceRows - 1.0)), x = column / (transmittanceColumns - 1.0);
            const double horizon = horizonSine(altitude), sine = horizon + x * x * (1 - horizon);
            const double length = distanceToTop(altitude, sine);
            dvec3 depth(0);
            double from = 0;
            for (int i = 1; i <= steps; ++i) {  // steps grow with the distance, as the air thins out
                const double to = length * (double(i) / steps) * (double(i) / steps);
                depth += at(altitudeAlong(altitude, sine, 0.5 * (from + to))).extinction * (to - from);
                from = to;
            }
            transmittance_[static_cast<std::size_t>(row * transmittanceColumns + column)] = exponential(-depth);
        }
    }
}

dvec3 Atmosphere::sunTransmittance(double altitude, double sunSine) const {
    const double horizon = horizonSine(altitude);
    const double x = std::sqrt(std::clamp((sunSine - horizon) / (1 - horizon), 0.0, 1.0));
    return interpolate(transmittance_, transmittanceRows, transmittanceColumns, rowOf(altitude), x);
}

/// Share of the sun's disc above the horizon of an altitude.
double Atmosphere::shadow(double altitude, double sunSine) const {
    const double t = std::clamp((sunSine - horizonSine(altitude)) / (2 * sunSize) + 0.5, 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

/// Hillaire 2020, section 5.5: psi = L2 / (1 - f), with L2 the second order under an isotropic phase function and f the share of
/// light that one more scattering keeps.
void Atmosphere::tabulateMultiple(const dvec3& groundAlbedo) {
    constexpr int directions = 8, steps = 20;
    multiple_.resize(multipleRows * multipleColumns);
    parallelFor(multiple_.size(), multipleColumns, [&](std::size_t begin, std::size_t end) {
        for (std::size_t entry = begin; entry < end; ++entry) {
            const int row = static_cast<int>(entry) / multipleColumns, column = static_cast<int>(entry) % multipleColumns;
            const double altitude = std::max(altitudeOf(row / (multipleRows - 1.0)), 0.001),
                         sunSine = 2 * column / (multipleColumns - 1.0) - 1;
            dvec3 second(0), kept(0);
            for (int i = 0; i < directions * directions; ++i) {  // a grid of equal solid angles over the sphere
                const double sine = 1 - 2 * (i / directions + 0.5) / directions, azimuth = 2 * pi * (i % directions + 0.5) / directions;
                const double cosine = sine * sunSine + std::sqrt((1 - sine * sine) * (1 - sunSine * sunSine)) * std::cos(azimuth);
                const bool ground = sine < horizonSine(altitude);
                const double length = ground ? distanceToGround(altitude, sine) : distanceToTop(altitude, sine);
                dvec3 through(1);
                double from = 0;
                for (int k = 1; k <= steps; ++k) {
                    const double to = length * (double(k) / steps) * (double(k) / steps), middle = 0.5 * (from + to);
                    const double height = altitudeAlong(altitude, sine, middle), r = groundRadius + height;
                    const Coefficients air = at(height);
                    const dvec3 step = exponential(-air.extinction * (to - from)),
                                gained = through * (air.rayleigh + air.mie) * (1.0 - step) / air.extinction;
                    const double sunThere = ((groundRadius + altitude) * sunSine + middle * cosine) / r;
                    second += gained * sunTransmittance(height, sunThere) * shadow(height, sunThere) / (4 * pi);
                    kept += gained;
                    through *= step;
                    from = to;
                }
                if (ground) {
                    const double sunThere = ((groundRadius + altitude) * sunSine + length * cosine) / groundRadius;
                    second += through * sunTransmittance(0, sunThere) * shadow(0, sunThere) * std::max(sunThere, 0.0) * groundAlbedo / pi;
                }
            }
            const double share = 1.0 / (directions * directions);
            multiple_[entry] = second * share / (1.0 - kept * share);
        }
    });
}

dvec3 Atmosphere::multipleAt(double altitude, double sunSine) const {
    return interpolate(multiple_, multipleRows, multipleColumns, rowOf(altitude), 0.5 * (sunSine + 1));
}

AirLight Atmosphere::look(double viewSine, double sunSine, double azimuthCosine) const {
    constexpr int steps = 48;
    AirLight light;
    light.ground = viewSine < horizonSine(eyeAltitude);
    const double length = light.ground ? distanceToGround(eyeAltitude, viewSine) : distanceToTop(eyeAltitude, viewSine);
    const double cosine =
        viewSine * sunSine + std::sqrt(std::max(0.0, (1 - viewSine * viewSine) * (1 - sunSine * sunSine))) * azimuthCosine;
    double from = 0;
    for (int i = 1; i <= steps; ++i) {
        const double to = length * (double(i) / steps) * (double(i) / steps), middle = 0.5 * (from + to);
        const double altitude = altitudeAlong(eyeAltitude, viewSine, middle);
        const Coefficients air = at(altitude);
        // Scattering and extinction are constant within a step, so its integral is exact (Hillaire 2015, energy-conserving form).
        const dvec3 step = exponential(-air.extinction * (to - from)), weight = light.transmittance * (1.0 - step) / air.extinction;
        const double sunThere = ((groundRadius + eyeAltitude) * sunSine + middle * cosine) / (groundRadius + altitude);
        const dvec3 sun = weight * sunTransmittance(altitude, sunThere) * shadow(altitude, sunThere);
        light.rayleigh += sun * air.rayleigh;
        light.mie += sun * air.mie;
        light.multiple += weight * (air.rayleigh + air.mie) * multipleAt(altitude, sunThere);
        light.transmittance *= step;
        from = to;
    }
    return light;
}

double Atmosphere::rayleighPhase(double cosine) { return 3 / (16 * pi) * (1 + cosine * cosine); }

/// Cornette and Shanks 1992.
double Atmosphere::miePhase(double cosine) const {
    constexpr double g = mieAsymmetry, g2 = g * g;
    return 3 / (8 * pi) * (1 - g2) * (1 + cosine * cosine) / ((2 + g2) * std::pow(1 + g2 - 2 * g * cosine, 1.5));
}

}  // namespace lodestir
