// SPDX-License-Identifier: MIT
#include <framework/scene/upload/environment_table.h>

#include <framework/scene/upload/alias_table.h>

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>

namespace lodestir {

std::vector<EnvironmentTexel> environmentTable(const Environment& environment) {
    const int width = environment.width, height = environment.height;
    const auto at = [&](int x, int y) {
        return environment.radiance[std::size_t(std::clamp(y, 0, height - 1)) * std::size_t(width) + std::size_t((x + width) % width)];
    };
    const auto luminance = [](glm::vec3 c) { return double(glm::dot(c, glm::vec3(0.2126f, 0.7152f, 0.0722f))); };
    std::vector<double> weights;
    weights.reserve(environment.radiance.size());
    for (int y = 0; y < height; ++y) {
        const double theta = glm::pi<double>() * (y + 0.5) / height;
        for (int x = 0; x < width; ++x) {
            double sum = 0;
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx) sum += (2 - std::abs(dx)) * (2 - std::abs(dy)) * luminance(at(x + dx, y + dy)) / 16;
            weights.push_back(sum * std::sin(theta));
        }
    }
    const std::vector<AliasEntry> table = makeAliasTable(weights);
    std::vector<EnvironmentTexel> texels(table.size());
    for (std::size_t i = 0; i < table.size(); ++i)
        texels[i] = {environment.radiance[i], table[i].pmf * float(table.size()), table[i].aliasProbability, table[i].alias};
    return texels;
}

}  // namespace lodestir
