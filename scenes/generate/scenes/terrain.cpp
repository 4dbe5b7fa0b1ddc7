// SPDX-License-Identifier: MIT
// A valley in high mountains, seen from the air in the morning: snow and rock, a lake, woods of spruces, boulders on the meadows.
#include <cmath>
#include <string>

#include "kit/conifer.h"
#include "kit/mountains.h"
#include "kit/random.h"
#include "kit/scene.h"
#include "kit/stone.h"
#include "kit/water.h"

namespace lodestir::generate {

namespace {

constexpr int spruces = 9000, boulders = 300;

/// What is in view is strewn denser than what lies far off.
glm::vec2 somewhere(Random& random) {
    const float far = random.next(), z = glm::mix(1500.0f, -1500.0f, std::pow(far, 1.4f));
    return {(random.next() - 0.5f) * (900 + 1900 * far), z};
}

void addTrees(Glb& glb, const Mountains& mountains) {
    const int needle = glb.addMaterial({.name = "needles", .ior = 1, .doubleSided = true});
    const int kinds[] = {glb.addMesh("spruce_0", spruce(1), needle), glb.addMesh("spruce_1", spruce(2), needle), glb.addMesh("spruce_2", spruce(3), needle)};
    Random random(21);
    for (int i = 0; i < spruces;) {
        const glm::vec2 xz = somewhere(random);
        const float chance = random.next(), tall = random.between(11, 26), turn = random.between(0, 360);
        if (chance > mountains.forest(xz)) continue;
        glb.addNode("spruce_" + std::to_string(i), kinds[i % 3],
                    {.translation = {xz.x, mountains.height(xz) - 0.3f, xz.y}, .rotation = turnY(turn), .scale = glm::vec3(tall)});
        ++i;
    }
}

void addBoulders(Glb& glb, const Mountains& mountains) {
    const Stone stone(33, {.size = {1, 0.8f, 0.9f}, .facets = 14, .sharpness = 14, .relief = 1});
    const Mesh mesh = stone.mesh(14);
    const int boulder = glb.addMesh("boulder", mesh, glb.addMaterial(glb.dressed({.name = "boulder"}, stone.bake(mesh, 128))));
    Random random(22);
    for (int i = 0; i < boulders;) {
        const glm::vec2 xz = somewhere(random);
        const float large = 1.2f * std::pow(6.0f, std::pow(random.next(), 2.5f)), h = mountains.height(xz), turn = random.between(0, 360);
        if (h < Mountains::lake || h > Mountains::treeLine || mountains.forest(xz) > 0.5f) continue;
        glb.addNode("boulder_" + std::to_string(i++), boulder, {.translation = {xz.x, h, xz.y}, .rotation = turnY(turn), .scale = glm::vec3(large)});
    }
}

Glb makeTerrain() {
    Glb glb;
    const Mountains mountains(14);
    glb.addNode(mountains.model(glb, "terrain", 300, 1536));
    Model lake{"lake", {}};
    lake.add(glb.addMaterial({.name = "lake", .color = {0.012f, 0.05f, 0.055f}, .roughness = 0.08f, .ior = 1.333f}),
             placed(waterSheet({-700, -1500}, {700, 1900}, 17, {.length = 70, .height = 0.12f}), glm::vec3(0, Mountains::lake, 0)));
    glb.addNode(lake);
    addTrees(glb, mountains);
    addBoulders(glb, mountains);
    return glb;
}

}  // namespace

LODESTIR_SCENE(makeTerrain, "--levels 3 --ratio 4 --mesh terrain")

}  // namespace lodestir::generate
