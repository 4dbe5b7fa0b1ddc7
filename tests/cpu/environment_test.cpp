// SPDX-License-Identifier: MIT
// Environment maps: the direction rule, solid angles, the sky and its sun.
#include "../temporary_folder.h"

#include <framework/core/error.h>
#include <framework/image/exr.h>
#include <framework/scene/atmosphere.h>
#include <framework/scene/environment.h>
#include <framework/scene/sky.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace lodestir {
namespace {

using std::numbers::pi;

/// Sum of radiance * solid angle over the texels whose direction is within `angle` of `direction`, and their mean direction.
std::pair<glm::dvec3, glm::dvec3> gather(const Environment& map, glm::vec3 direction, float angle) {
    glm::dvec3 energy(0), mean(0);
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            const glm::vec3 d =
                environmentDirection({(float(x) + 0.5f) / float(map.width), (float(y) + 0.5f) / float(map.height)}, map.rotation);
            if (glm::dot(d, direction) < std::cos(angle)) continue;
            const glm::dvec3 light = glm::dvec3(map.radiance[std::size_t(y) * std::size_t(map.width) + std::size_t(x)]) *
                                     texelSolidAngle(y, map.width, map.height);
            energy += light;
            mean += glm::dvec3(d) * light.g;
        }
    }
    return {energy, glm::normalize(mean)};
}

Sky sunAt(double elevationDegrees) {
    const double e = elevationDegrees * pi / 180;
    return {.sunDirection = {float(0.6 * std::cos(e)), float(std::sin(e)), float(-0.8 * std::cos(e))}};
}

// If this fails, maps are turned, mirrored or upside down. The rule of environment.h, by hand.
TEST(Environment, KnowsWhereDirectionsAre) {
    const auto expectUv = [](glm::vec3 d, double u, double v) {
        const glm::vec2 uv = environmentUv(d, 0);
        EXPECT_NEAR(uv.x, u, 1e-6);
        EXPECT_NEAR(uv.y, v, 1e-6);
    };
    expectUv({0, 0, -1}, 0.5, 0.5);
    expectUv({1, 0, 0}, 0.75, 0.5);
    expectUv({-1, 0, 0}, 0.25, 0.5);
    EXPECT_NEAR(environmentUv({0, 1, 0}, 0).y, 0, 1e-6);
    EXPECT_NEAR(environmentUv({0, -1, 0}, 0).y, 1, 1e-6);
    // A quarter turn by the right hand about +Y takes what was at -Z to -X.
    EXPECT_NEAR(environmentUv({-1, 0, 0}, float(pi / 2)).x, 0.5, 1e-6);
}

// If this fails, what a file has beside its colours is taken for one of them.
TEST(Environment, MapsAreColourOrGrey) {
    const test::TemporaryFolder temporary;
    const Path& folder = temporary.path;
    const auto radiance = [&](const ImageData& image, const std::vector<std::string>& channels) {
        writeExr(folder / "map.exr", image, {.channels = channels});
        std::vector<std::string> notes;
        const Environment map = loadEnvironmentMap(folder / "map.exr", notes);
        EXPECT_EQ(notes, std::vector<std::string>{});
        return map.radiance;
    };
    const glm::vec3 color(1, 2, 3);
    EXPECT_EQ(radiance({2, 1, 4, {1, 2, 3, 0.5f, 4, 5, 6, 0.5f}}, {"sky.R", "sky.G", "sky.B", "sky.A"})[0], color);
    EXPECT_EQ(radiance({2, 1, 4, {1, 2, 3, 9, 4, 5, 6, 9}}, {"r", "g", "b", "Z"})[0], color);
    EXPECT_EQ(radiance({2, 1, 2, {7, 0.5f, 8, 0.5f}}, {"Y", "A"})[1], glm::vec3(8));
    EXPECT_THROW(radiance({2, 1, 2, {1, 2, 3, 4}}, {"R", "G"}), Error);
}

// If this fails, sampling a texel looks up another one.
TEST(Environment, DirectionsRoundTrip) {
    for (float rotation : {0.0f, 1.0f, -2.5f}) {
        for (int i = 0; i < 200; ++i) {
            const glm::vec2 uv((float(i * 37 % 200) + 0.5f) / 200, (float(i) + 0.5f) / 200);
            const glm::vec3 d = environmentDirection(uv, rotation);
            EXPECT_NEAR(glm::length(d), 1, 1e-6);
            const glm::vec2 back = environmentUv(d, rotation);
            EXPECT_NEAR(back.x, uv.x, 2e-5);  // single precision near the poles
            EXPECT_NEAR(back.y, uv.y, 1e-5);
        }
    }
}

// If this fails, the sky has too much or too little light in total: a sphere has 4 pi, constant radiance 1 gives irradiance pi.
TEST(Environment, SolidAnglesAndIrradianceAreExact) {
    double sum = 0;
    for (int y = 0; y < 64; ++y) sum += 128 * texelSolidAngle(y, 128, 64);
    EXPECT_NEAR(sum, 4 * pi, 1e-9);
    const Environment white{
        .type = EnvironmentType::map, .width = 128, .height = 64, .radiance = std::vector<glm::vec3>(128 * 64, glm::vec3(1))};
    EXPECT_NEAR(environmentIrradiance(white, {0, 1, 0}).g, pi, 2e-3);
    EXPECT_NEAR(environmentIrradiance(white, glm::normalize(glm::vec3(1, 2, -3))).g, pi, 4e-3);
}

// If this fails, the sun's light depends on the map's resolution or stands elsewhere than its direction.
TEST(Sky, SunEnergyAndPlaceAreExact) {
    for (double elevation : {5.0, 40.0, 89.9}) {
        for (int height : {elevation == 40.0 ? 512 : 100, 128}) {
            Sky sky = sunAt(elevation), without = sky;
            without.sunStrength = 0;
            Environment map = makeSky(sky, 2 * height, height);
            const Environment dark = makeSky(without, 2 * height, height);
            for (std::size_t i = 0; i < map.radiance.size(); ++i)
                map.radiance[i] = glm::max(map.radiance[i] - dark.radiance[i], glm::vec3(0));
            const glm::vec3 direction = glm::normalize(sky.sunDirection), expected = sunIrradiance(sky);
            const auto [energy, mean] = gather(map, direction, 0.06f);
            for (int c = 0; c < 3; ++c) EXPECT_NEAR(energy[c], expected[c], 2e-3 * expected.r) << elevation;
            EXPECT_GT(glm::dot(mean, glm::dvec3(direction)), std::cos(pi / height)) << elevation;  // within a texel
        }
    }
}

// If this fails, a set sun still casts shadows, or a half-set one is whole.
TEST(Sky, HorizonCutsTheSun) {
    Sky low = sunAt(0);
    low.sunAngle = 4;
    Sky risen = sunAt(3);
    risen.sunAngle = 4;
    EXPECT_EQ(sunIrradiance(sunAt(-1)).r, 0);
    const Environment map = makeSky(low, 512, 256);
    Sky without = low;
    without.sunStrength = 0;
    const Environment dark = makeSky(without, 512, 256);
    double below = 0, above = 0;
    for (std::size_t i = 0; i < map.radiance.size(); ++i)
        (i < map.radiance.size() / 2 ? above : below) += map.radiance[i].r - dark.radiance[i].r;
    EXPECT_GT(above, 0);
    EXPECT_NEAR(below, 0, 0.02 * above);
    EXPECT_LT(sunIrradiance(low).r, sunIrradiance(risen).r);
}

// If this fails, the sky isn't one: blue above at noon, warm and dim by evening, the sun some times brighter than the whole sky.
TEST(Sky, LooksLikeASky) {
    Sky noon = sunAt(60);
    noon.sunStrength = 0;
    const Environment day = makeSky(noon, 256, 128);
    const glm::vec3 zenith = day.radiance[0], light = environmentIrradiance(day, {0, 1, 0});
    EXPECT_GT(zenith.b, zenith.g);
    EXPECT_GT(zenith.g, zenith.r);
    double mean = 0;
    for (int y = 0; y < 64; ++y) {
        for (int x = 0; x < 256; ++x) mean += double(day.radiance[std::size_t(256 * y + x)].g) * texelSolidAngle(y, 256, 128) / (2 * pi);
    }
    EXPECT_NEAR(mean, 1, 0.35);
    const float sun = sunIrradiance(sunAt(60)).g * std::sin(float(pi) / 3);
    EXPECT_GT(sun / light.g, 2);  // of clear noon light 10 to 30 % come from the sky
    EXPECT_LT(sun / light.g, 8);
    const glm::vec3 evening = sunIrradiance(sunAt(3)), high = sunIrradiance(sunAt(60));
    EXPECT_GT(evening.r / evening.b, 5 * high.r / high.b);
    EXPECT_LT(evening.g, 0.2f * high.g);
    for (const glm::vec3& radiance : day.radiance) ASSERT_TRUE(std::isfinite(radiance.r + radiance.g + radiance.b) && radiance.b > 0);
}

// If this fails, energy is made in the air: phase functions integrate to 1, air without dust and ground only takes light away.
TEST(Atmosphere, KeepsEnergy) {
    const Atmosphere air(3, glm::dvec3(0.3));
    double rayleigh = 0, mie = 0;
    constexpr int steps = 20000;
    for (int i = 0; i < steps; ++i) {
        const double cosine = 2 * (i + 0.5) / steps - 1;
        rayleigh += Atmosphere::rayleighPhase(cosine) * 4 * pi / steps;
        mie += air.miePhase(cosine) * 4 * pi / steps;
    }
    EXPECT_NEAR(rayleigh, 1, 1e-6);
    EXPECT_NEAR(mie, 1, 1e-3);
    // Straight up, clean air: optical depths 5.802e-3 * 8, 13.558e-3 * 8, 33.1e-3 * 8, and ozone 0.65e-3 * 15, 1.881e-3 * 15, 0.085e-3 * 15.
    const glm::dvec3 clean = Atmosphere(1, glm::dvec3(0)).sunTransmittance(0, 1);
    EXPECT_NEAR(clean.r, std::exp(-0.046416 - 0.00975), 2e-3);
    EXPECT_NEAR(clean.g, std::exp(-0.108464 - 0.028215), 2e-3);
    EXPECT_NEAR(clean.b, std::exp(-0.2648 - 0.001275), 2e-3);
    // Light from the whole sky and what is left of the sun are less than what came in.
    const Sky sky{.sunDirection = {0, 1, 0}, .sunStrength = 1, .turbidity = 1, .ground = {0, 0, 0}};
    const glm::vec3 total = environmentIrradiance(makeSky(sky, 256, 128), {0, 1, 0});
    for (int c = 0; c < 3; ++c) EXPECT_LT(total[c], solarIrradiance);
    EXPECT_GT(total.b, 0.85f * solarIrradiance);  // about half of what air scatters goes down
}

}  // namespace
}  // namespace lodestir
