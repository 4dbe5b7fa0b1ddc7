// SPDX-License-Identifier: MIT
// Environment maps: directions, solid angles, reading.
#include <framework/core/error.h>
#include <framework/image/image_file.h>
#include <framework/scene/environment.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lodestir {

using std::numbers::pi;

glm::vec2 environmentUv(glm::vec3 direction, float rotation) {
    const double u = (std::atan2(direction.x, -direction.z) + rotation) / (2 * pi) + 0.5;
    return {u - std::floor(u), std::acos(std::clamp(direction.y, -1.0f, 1.0f)) / pi};
}

glm::vec3 environmentDirection(glm::vec2 uv, float rotation) {
    const double azimuth = (uv.x - 0.5) * 2 * pi - rotation, polar = uv.y * pi;
    return {std::sin(azimuth) * std::sin(polar), std::cos(polar), -std::cos(azimuth) * std::sin(polar)};
}

double texelSolidAngle(int row, int width, int height) {
    return 2 * pi / width * (std::cos(pi * row / height) - std::cos(pi * (row + 1) / height));
}

glm::vec3 environmentIrradiance(const Environment& environment, glm::vec3 normal) {
    glm::dvec3 sum(0);
    for (int y = 0; y < environment.height; ++y) {
        const double solidAngle = texelSolidAngle(y, environment.width, environment.height);
        for (int x = 0; x < environment.width; ++x) {
            const glm::vec2 uv((float(x) + 0.5f) / float(environment.width), (float(y) + 0.5f) / float(environment.height));
            const double cosine = glm::dot(glm::dvec3(normal), glm::dvec3(environmentDirection(uv, environment.rotation)));
            if (cosine > 0)
                sum += glm::dvec3(environment.radiance[std::size_t(y) * std::size_t(environment.width) + std::size_t(x)]) *
                       (cosine * solidAngle);
        }
    }
    return glm::vec3(sum);
}

Environment loadEnvironmentMap(const Path& path, std::vector<std::string>& notes) {
    const ImageData image = withoutOpacity(readImage(path));
    if (image.channels != 3 && image.channels != 1)
        throw Error(Where{path.string()},
                    fmt::format("an environment map needs red, green and blue, or grey; this image has {} channels", image.channels));
    Environment environment{.type = EnvironmentType::map, .width = image.width, .height = image.height};
    const std::size_t count = std::size_t(image.width) * std::size_t(image.height), channels = std::size_t(image.channels);
    environment.radiance.resize(count);
    std::size_t bad = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const float* texel = image.values.data() + i * channels;
        const glm::vec3 radiance = channels == 3 ? glm::vec3(texel[0], texel[1], texel[2]) : glm::vec3(texel[0]);
        const bool good = std::isfinite(radiance.r + radiance.g + radiance.b) && std::min({radiance.r, radiance.g, radiance.b}) >= 0;
        if (!good) ++bad;
        environment.radiance[i] = good ? radiance : glm::vec3(0);
    }
    const std::string name = path.filename().string();
    if (bad > 0) notes.push_back(fmt::format("{}: {} texels that are negative or not finite are black", name, bad));
    if (image.width != 2 * image.height)
        notes.push_back(
            fmt::format("{}: {}x{} is not twice as wide as high; it is read as a full sphere", name, image.width, image.height));
    return environment;
}

}  // namespace lodestir
