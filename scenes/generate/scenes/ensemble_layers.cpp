// SPDX-License-Identifier: MIT
// Surfaces in layers: lacquered boards, a coat as clear as glass on rough metal, brushed metal, velvet and a tinted gloss.
// One of the still lifes that bias is judged by (kit/still_life.h).
#include <utility>

#include "kit/metals.h"
#include "kit/scene.h"
#include "kit/still_life.h"

namespace lodestir::generate {

namespace {

Glb makeEnsembleLayers() {
    Composition c;
    const int wall =
                  c.glb.addMaterial({.name = "damask", .color = {0.45f, 0.42f, 0.38f}, .roughness = 0.8f, .sheen = {0.5f, 0.5f, 0.6f}, .sheenRoughness = 0.5f}),
              floor = c.glb.addMaterial({.name = "boards", .color = {0.30f, 0.17f, 0.09f}, .roughness = 0.6f, .coat = 0.8f, .coatRoughness = 0.3f}),
              side = c.glb.addMaterial({.name = "side", .color = {0.13f, 0.25f, 0.36f}, .roughness = 0.42f, .specular = 0.7f, .specularColor = {4, 2, 1}}),
              ceiling = c.paint("ceiling", {0.7f, 0.68f, 0.64f}), tray = c.paint("tray", glm::vec3(0.1f));
    c.glb.addNode(chamber({}, {floor, ceiling, wall, wall, side, side}));
    c.glb.addNode(
        areaLamp("warm", c.lamp("warm light", {4.6f, 3.6f, 2.5f}), tray, {-1.1f, 1.62f, 0.7f}, {0.75f, -0.9f, -0.35f}, {1.2f, 1.15f}));
    c.glb.addNode(
        areaLamp("cool", c.lamp("cool light", {2.3f, 3.1f, 4.3f}), tray, {1.2f, 1.5f, 0.5f}, {-0.9f, -0.8f, -0.2f}, {1.1f, 1.2f}));
    const int brushed =
                  c.glb.addMaterial({.name = "brushed", .color = gold, .roughness = 0.3f, .metalness = 1, .anisotropy = 0.7f, .anisotropyRotation = 0.4f}),
              velvet = c.glb.addMaterial(
                  {.name = "velvet", .color = {0.10f, 0.01f, 0.03f}, .roughness = 0.9f, .sheen = {0.9f, 0.25f, 0.35f}, .sheenRoughness = 0.35f}),
              glazed = c.glb.addMaterial({.name = "glazed", .color = steel, .roughness = 0.45f, .metalness = 1, .coat = 1}),
              lacquer = c.glb.addMaterial({.name = "lacquer", .color = {0.62f, 0.03f, 0.03f}, .roughness = 0.5f, .coat = 1, .coatRoughness = 0.06f}),
              pearl = c.glb.addMaterial({.name = "pearl",
                                         .color = {0.6f, 0.58f, 0.5f},
                                         .roughness = 0.35f,
                                         .coat = 0.6f,
                                         .coatRoughness = 0.15f,
                                         .sheen = {0.2f, 0.3f, 0.4f},
                                         .sheenRoughness = 0.6f,
                                         .anisotropy = 0.5f,
                                         .specularColor = {1, 3, 5}});
    c.put("jug", brushed, jug(18), {.translation = {-0.62f, 0, -0.25f}, .scale = glm::vec3(0.95f)});
    c.put("knot", velvet, knot(48, 8, 0.17f),
          {.translation = {0.62f, 0.44f, -0.4f}, .rotation = glm::angleAxis(1.15f, glm::vec3(1, 0, 0.2f)), .scale = glm::vec3(0.46f)});
    c.put("dish", glazed, dish(16), {.translation = {0.12f, 0, 0.32f}, .scale = glm::vec3(0.22f)});
    c.ball("lacquer", lacquer, 0.135f, {0.1f, 0.05f, 0.32f}, 18);
    c.ball("pearl", pearl, 0.15f, {-0.42f, 0, 0.55f}, 18);
    c.ball("brass", brushed, 0.12f, {0.68f, 0, 0.52f}, 18);
    return std::move(c.glb);
}

}  // namespace

LODESTIR_SCENE(makeEnsembleLayers)

}  // namespace lodestir::generate
