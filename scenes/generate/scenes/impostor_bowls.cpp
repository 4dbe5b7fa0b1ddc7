// SPDX-License-Identifier: MIT
// Bowls in bowls, each of another colour: what lies behind a rim must not show through it.
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "kit/backdrop.h"
#include "kit/scene.h"
#include "kit/shapes.h"

namespace lodestir::generate {

namespace {

/// A thin bowl around the origin, open above: down its inner side from the rim, out again below. Heights are shares of the radius.
Mesh bowl(float radius, float thickness) {
    constexpr int steps = 40;
    std::vector<glm::vec2> profile;
    const auto arc = [&](float r, bool isDown) {
        for (int i = 0; i <= steps; ++i) {
            const float t = float(isDown ? i : steps - i) / steps, a = t * std::numbers::pi_v<float> / 2;
            profile.emplace_back(i == (isDown ? steps : 0) ? 0.0f : r * std::cos(a), -r * std::sin(a));
        }
    };
    // turned() wants the outer side downwards: seen from its own axis, a bowl's inner side runs upwards.
    arc(radius - thickness, false);
    for (int i = 1; i < 6; ++i) {  // the rim is round
        const float a = float(i) / 6 * std::numbers::pi_v<float>;
        profile.emplace_back(radius - thickness * 0.5f * (1 + std::cos(a)), thickness * 0.5f * std::sin(a));
    }
    arc(radius, true);
    return turned(profile, 160, 180);
}

Glb makeBowls() {
    Glb glb;
    Model model{"bowls", {}};
    const glm::vec3 colors[] = {{0.05f, 0.16f, 0.34f}, {0.62f, 0.13f, 0.06f}, {0.78f, 0.62f, 0.36f}, {0.09f, 0.30f, 0.20f}, {0.70f, 0.66f, 0.60f}};
    for (int i = 0; i < int(std::size(colors)); ++i) {
        const int glaze = glb.addMaterial({.name = "glaze_" + std::to_string(i), .color = colors[i], .roughness = 0.3f});
        model.add(glaze, placed(bowl(0.95f - 0.17f * float(i), 0.035f), {0, 0.45f + 0.035f * float(i), 0}));
    }
    glb.addNode(model);
    addLamp(glb, {0, 0, 0}, 1, {11, 10.2f, 9});
    return glb;
}

}  // namespace

LODESTIR_SCENE(makeBowls, "--levels 4 --mesh bowls")

}  // namespace lodestir::generate
