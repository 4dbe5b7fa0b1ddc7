// SPDX-License-Identifier: MIT
// A long table of skittles from near to far, and lamps that blur into discs behind it.
// One of the still lifes that bias is judged by (kit/still_life.h).
#include <string>
#include <utility>

#include "kit/random.h"
#include "kit/scene.h"
#include "kit/shapes.h"
#include "kit/still_life.h"

namespace lodestir::generate {

namespace {

Glb makeEnsembleLens() {
    Composition c;
    const Chamber hall{.halfWidth = 2.2f, .height = 2.4f, .back = -6, .front = 3.4f};
    const int wall = c.paint("wall", {0.26f, 0.32f, 0.40f}), ceiling = c.paint("ceiling", {0.66f, 0.64f, 0.60f}),
              back = c.paint("back", {0.16f, 0.18f, 0.26f}), light = c.paint("light tile", {0.70f, 0.64f, 0.54f}),
              dark = c.paint("dark tile", {0.13f, 0.09f, 0.07f});
    c.glb.addNode(chamber(hall, {dark, ceiling, back, wall, wall, wall}));
    Model tiles{"tiles", {}};  // a hair above the dark floor
    constexpr float side = 0.44f;
    for (int x = 0; x < 10; ++x)
        for (int z = (x & 1); z < 20; z += 2)
            tiles.add(light, rectangle({-2.2f + side * float(x), 0.002f, -5.4f + side * float(z)}, {side, 0, 0}, {0, 0, side}));
    c.glb.addNode(tiles);
    c.glb.addNode(areaLamp("key", c.lamp("key light", {7.5f, 7.0f, 6.2f}), ceiling, {0.2f, 2.3f, 0.6f}, {0, -1, 0}, {1.8f, 1.6f}));

    const glm::vec2 skittle[] = {{0, 1},         {0.1f, 0.96f},  {0.135f, 0.87f}, {0.07f, 0.72f},
                                 {0.11f, 0.55f}, {0.19f, 0.28f}, {0.13f, 0},      {0, 0}};
    const Mesh pin = lathe(skittle, 2, 16);
    const glm::vec3 colors[] = {
        {0.72f, 0.12f, 0.07f}, {0.80f, 0.52f, 0.08f}, {0.10f, 0.42f, 0.38f}, {0.70f, 0.66f, 0.58f}, {0.42f, 0.12f, 0.30f}};
    const glm::vec3 places[] = {{-0.42f, 0, 1.45f}, {0.42f, 0, 0.75f}, {-0.30f, 0, -0.1f}, {0.62f, 0, -1.3f}, {-0.62f, 0, -2.9f}};
    for (int i = 0; i < 5; ++i)
        c.put("skittle", c.gloss("skittle_" + std::to_string(i), colors[i], 0.3f + 0.05f * float(i)), pin,
              {.translation = places[i], .scale = glm::vec3(0.85f)});

    const glm::vec3 hues[] = {{1, 0.55f, 0.2f}, {1, 0.8f, 0.5f}, {0.9f, 0.3f, 0.25f}, {0.45f, 0.7f, 1}};
    Random random(3);
    int lamps[4];
    for (int i = 0; i < 4; ++i) lamps[i] = c.lamp("bulb_" + std::to_string(i), hues[i] * 7.0f);
    for (int i = 0; i < 12; ++i)
        c.put("bulb", lamps[i % 4], sphere(8, 4),
              {.translation = {-1.75f + 0.32f * float(i), 1.15f + random.between(-0.35f, 0.75f), random.between(-5.2f, -4.4f)},
               .scale = glm::vec3(0.065f)});
    c.put("floor_bulb", lamps[1], sphere(10, 6), {.translation = {0.1f, 0.07f, 0.5f}, .scale = glm::vec3(0.07f)});
    return std::move(c.glb);
}

}  // namespace

LODESTIR_SCENE(makeEnsembleLens)

}  // namespace lodestir::generate
