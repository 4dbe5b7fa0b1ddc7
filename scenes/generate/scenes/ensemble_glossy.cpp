// SPDX-License-Identifier: MIT
// Lacquer and metal from mirror-like to satin. Reuse decides by roughness 0.2 or alpha 0.2 (roughness 0.447): things lie on both sides.
// One of the still lifes that bias is judged by (kit/still_life.h).
#include <utility>

#include "kit/metals.h"
#include "kit/scene.h"
#include "kit/still_life.h"

namespace lodestir::generate {

namespace {

Glb makeEnsembleGlossy() {
    Composition c;
    const int wall = c.gloss("wall", {0.55f, 0.56f, 0.54f}, 0.5f), floor = c.gloss("floor", {0.16f, 0.10f, 0.07f}, 0.22f),
              side = c.gloss("side", {0.13f, 0.25f, 0.36f}, 0.42f), ceiling = c.gloss("ceiling", {0.7f, 0.68f, 0.64f}, 0.5f),
              tray = c.gloss("tray", glm::vec3(0.1f), 0.5f);
    c.glb.addNode(chamber({}, {floor, ceiling, wall, wall, side, side}));
    c.glb.addNode(
        areaLamp("warm", c.lamp("warm light", {4.6f, 3.6f, 2.5f}), tray, {-1.1f, 1.62f, 0.7f}, {0.75f, -0.9f, -0.35f}, {1.2f, 1.15f}));
    c.glb.addNode(
        areaLamp("cool", c.lamp("cool light", {2.3f, 3.1f, 4.3f}), tray, {1.2f, 1.5f, 0.5f}, {-0.9f, -0.8f, -0.2f}, {1.1f, 1.2f}));
    c.put("jug", c.gloss("gold", gold, 0.18f, 1), jug(18), {.translation = {-0.62f, 0, -0.25f}, .scale = glm::vec3(0.95f)});
    c.put("knot", c.gloss("copper", copper, 0.40f, 1), knot(48, 8, 0.17f),
          {.translation = {0.62f, 0.44f, -0.4f}, .rotation = glm::angleAxis(1.15f, glm::vec3(1, 0, 0.2f)), .scale = glm::vec3(0.46f)});
    c.put("dish", c.gloss("steel", steel, 0.30f, 1), dish(16), {.translation = {0.12f, 0, 0.32f}, .scale = glm::vec3(0.22f)});
    c.ball("lacquer", c.gloss("lacquer", {0.62f, 0.03f, 0.03f}, 0.05f), 0.135f, {0.1f, 0.05f, 0.32f}, 18);
    c.ball("satin", c.gloss("satin", {0.10f, 0.42f, 0.20f}, 0.45f), 0.15f, {-0.42f, 0, 0.55f}, 18);
    c.ball("silk", c.gloss("silk", {0.80f, 0.50f, 0.06f}, 0.21f), 0.12f, {0.68f, 0, 0.52f}, 18);
    return std::move(c.glb);
}

}  // namespace

LODESTIR_SCENE(makeEnsembleGlossy)

}  // namespace lodestir::generate
