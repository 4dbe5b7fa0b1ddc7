// SPDX-License-Identifier: MIT
// Paints the clear sky, the ground and the sun's disc into an equirectangular map.
#include <framework/core/tasks.h>
#include <framework/scene/atmosphere.h>
#include <framework/scene/environment.h>
#include <framework/scene/sky.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lodestir {
namespace {

using glm::dvec3;
using std::numbers::pi;

constexpr int azimuths = 64;  // air light is smooth in azimuth once the phase functions are taken out

glm::dvec3 texelDirection(int x, int y, const Environment& map) {
    return dvec3(environmentDirection({(float(x) + 0.5f) / float(map.width), (float(y) + 0.5f) / float(map.height)}, 0));
}

dvec3 unitSun(const Sky& sky) { return glm::normalize(dvec3(sky.sunDirection)); }

/// Radiance of the air along each texel; the ground is left black, its share is written to `groundShare` (0 in the sky).
void paintAir(const Atmosphere& air, const dvec3& sun, Environment& map, std::vector<glm::vec3>& groundShare) {
    const double flat = std::sqrt(std::max(0.0, 1 - sun.y * sun.y));
    parallelFor(static_cast<std::size_t>(map.height), 8, [&](std::size_t begin, std::size_t end) {
        std::vector<AirLight> around(azimuths + 1);
        for (std::size_t y = begin; y < end; ++y) {
            const double viewSine = std::cos(pi * (double(y) + 0.5) / map.height), viewFlat = std::sqrt(1 - viewSine * viewSine);
            for (int a = 0; a <= azimuths; ++a)
                around[static_cast<std::size_t>(a)] = air.look(viewSine, sun.y, std::cos(pi * a / azimuths));
            for (int x = 0; x < map.width; ++x) {
                const dvec3 view = texelDirection(x, static_cast<int>(y), map);
                const double cosine = std::clamp(glm::dot(view, sun), -1.0, 1.0);
                const double azimuth =
                    flat > 0 && viewFlat > 0 ? std::acos(std::clamp((cosine - viewSine * sun.y) / (flat * viewFlat), -1.0, 1.0)) : 0;
                const double position = azimuth / pi * azimuths;
                const auto a = static_cast<std::size_t>(std::min(static_cast<int>(position), azimuths - 1));
                const double t = position - double(a);
                const auto mixed = [&](dvec3 AirLight::*part) { return glm::mix(around[a].*part, around[a + 1].*part, t); };
                const dvec3 light = mixed(&AirLight::rayleigh) * Atmosphere::rayleighPhase(cosine) +
                                    mixed(&AirLight::mie) * air.miePhase(cosine) + mixed(&AirLight::multiple);
                const std::size_t texel = y * static_cast<std::size_t>(map.width) + static_cast<std::size_t>(x);
                map.radiance[texel] = glm::vec3(light * double(solarIrradiance));
                if (around[a].ground) groundShare[texel] = glm::vec3(around[a].transmittance);
            }
        }
    });
}

/// Share of a disc of angular radius `radius` that is above the horizon, its centre at elevation `elevation` (flat sky around it).
double shareAboveHorizon(double elevation, double radius) {
    const double h = std::clamp(elevation / radius, -1.0, 1.0);
    return 1 - (std::acos(h) - h * std::sqrt(1 - h * h)) / pi;
}

/// Adds the disc to the texels it covers, each by the solid angle covered; the sum over solid angles is exactly `energy`.
void paintSun(const dvec3& sun, double radius, const dvec3& energy, Environment& map) {
    constexpr int samples = 16;  // per texel and axis
    const double texel = pi / map.height, polar = std::acos(std::clamp(sun.y, -1.0, 1.0)), edge = std::cos(radius);
    const int first = std::max(0, static_cast<int>((polar - radius) / texel) - 1),
              last = std::min(map.height - 1, static_cast<int>((polar + radius) / texel) + 1);
    std::vector<std::pair<std::size_t, double>> covered;
    double total = 0;
    for (int y = first; y <= last; ++y) {
        for (int x = 0; x < map.width; ++x) {
            double solidAngle = 0;
            if (glm::dot(texelDirection(x, y, map), sun) < std::cos(std::min(radius + 2 * texel, pi))) continue;
            for (int s = 0; s < samples * samples; ++s) {
                const glm::dvec2 uv((x + (s % samples + 0.5) / samples) / map.width, (y + (s / samples + 0.5) / samples) / map.height);
                const double azimuth = (uv.x - 0.5) * 2 * pi, theta = uv.y * pi;
                const dvec3 d(std::sin(azimuth) * std::sin(theta), std::cos(theta), -std::cos(azimuth) * std::sin(theta));
                if (d.y > 0 && glm::dot(d, sun) >= edge) solidAngle += std::sin(theta);
            }
            if (solidAngle == 0) continue;
            covered.emplace_back(std::size_t(y) * std::size_t(map.width) + std::size_t(x), solidAngle);
            total += solidAngle;
        }
    }
    if (covered.empty()) {  // a disc between the samples: all of it is in the texel of its centre
        const glm::vec2 uv = environmentUv(glm::vec3(sun), 0);
        const auto x = std::size_t(std::min(int(uv.x * float(map.width)), map.width - 1)),
                   y = std::size_t(std::min(int(uv.y * float(map.height)), map.height - 1));
        covered.emplace_back(y * std::size_t(map.width) + x, 1.0);
        total = 1;
    }
    for (const auto& [index, solidAngle] : covered) {
        const int row = static_cast<int>(index / std::size_t(map.width));
        map.radiance[index] += glm::vec3(energy * (solidAngle / total / texelSolidAngle(row, map.width, map.height)));
    }
}

dvec3 irradianceAtGround(const Sky& sky, const Atmosphere& air) {
    const double elevation = std::asin(unitSun(sky).y), radius = glm::radians(double(sky.sunAngle)) / 2;
    return air.sunTransmittance(0, std::max(unitSun(sky).y, 0.0)) * shareAboveHorizon(elevation, radius) * double(solarIrradiance) *
           double(sky.sunStrength);
}

}  // namespace

glm::vec3 sunIrradiance(const Sky& sky) { return glm::vec3(irradianceAtGround(sky, Atmosphere(sky.turbidity, dvec3(sky.ground)))); }

Environment makeSky(const Sky& sky, int width, int height) {
    const Atmosphere air(sky.turbidity, dvec3(sky.ground));
    const dvec3 sun = unitSun(sky), energy = irradianceAtGround(sky, air);
    Environment map{.type = EnvironmentType::sky, .width = width, .height = height};
    map.radiance.assign(std::size_t(width) * std::size_t(height), glm::vec3(0));
    std::vector<glm::vec3> groundShare(map.radiance.size(), glm::vec3(0));
    paintAir(air, sun, map, groundShare);

    // The plain reflects the sky it sees and the sun.
    const glm::vec3 ground = sky.ground * (environmentIrradiance(map, {0, 1, 0}) + glm::vec3(energy * std::max(sun.y, 0.0))) / float(pi);
    for (std::size_t i = 0; i < map.radiance.size(); ++i) map.radiance[i] += groundShare[i] * ground;
    if (energy.g > 0) paintSun(sun, glm::radians(double(sky.sunAngle)) / 2, energy, map);
    return map;
}

}  // namespace lodestir
