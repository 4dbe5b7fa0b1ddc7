// SPDX-License-Identifier: MIT
// Paper lanterns in the corner of a room at night, the only light but for a dusky sky: a bench with a bronze cat, a teapot and fruit, a fig.
#include <string>
#include <vector>

#include "kit/cat.h"
#include "kit/cloth.h"
#include "kit/foliage.h"
#include "kit/joinery.h"
#include "kit/lantern.h"
#include "kit/masonry.h"
#include "kit/scene.h"
#include "kit/shapes.h"
#include "kit/slab.h"
#include "kit/still_life.h"
#include "kit/tableware.h"
#include "kit/teapot.h"
#include "kit/wood.h"

namespace lodestir::generate {

namespace {

constexpr float back = -1.3f, left = -1.65f, ceiling = 2.7f, bench = 0.44f;

/// Lanterns of one paper in two dyes. The paper emits its colour without being in the list of lights, for it is of a hundred thousand triangles; most light
/// leaves by their mouths, which are in that list.
void addLanterns(Glb& glb) {
    const int paper = glb.addGeometry(lanternPaper());
    struct Dye {
        glm::vec3 tint, ink;
    };
    const Dye dyes[] = {{{1.0f, 0.64f, 0.32f}, {0.03f, 0.02f, 0.02f}}, {{1.0f, 0.25f, 0.075f}, {0.03f, 0.03f, 0.06f}}};
    std::vector<int> dyed, flames;
    for (const Dye& dye : dyes) {
        const auto number = uint32_t(dyed.size());
        const Material material =
            glb.dressed({.name = "paper_" + std::to_string(number), .unlit = true}, paintLanternPaper(dye.tint, dye.ink, 70 + number, 768));
        flames.push_back(glb.addMaterial(glow("flame_" + std::to_string(number), 26.0f * dye.tint)));
        dyed.push_back(glb.addMesh("lantern", {{paper, glb.addMaterial(material)}}));
    }
    const int lacquer = glb.addMaterial({.name = "lacquer", .color = {0.015f, 0.012f, 0.012f}, .roughness = 0.18f}),
              silk = glb.addMaterial({.name = "silk", .color = {0.45f, 0.03f, 0.03f}, .roughness = 0.6f});
    struct Hung {
        glm::vec3 at;
        float radius, turn;
        size_t dye;
    };
    const Hung lanterns[] = {{{-0.36f, 1.50f, -0.45f}, 0.36f, -22, 0},
                             {{-1.14f, 1.72f, -0.25f}, 0.24f, 20, 1},
                             {{0.42f, 1.22f, -0.80f}, 0.20f, 5, 0},
                             {{-1.12f, 1.30f, -0.85f}, 0.19f, 40, 0},
                             {{0.60f, 1.76f, -0.35f}, 0.24f, -35, 1}};
    int number = 0;
    for (const Hung& l : lanterns) {
        const std::string name = "lantern_" + std::to_string(number++);
        const Placement place{.translation = l.at, .rotation = turnY(l.turn), .scale = glm::vec3(l.radius)};
        glb.addNode(name, dyed[l.dye], place);
        const LanternFittings fittings = lanternFittings((ceiling - l.at.y) / l.radius);
        Model model{name + "_fittings", {}};
        model.add(lacquer, fittings.lacquer), model.add(silk, fittings.silk), model.add(flames[l.dye], fittings.flame);
        glb.addNode(model, place);
    }
}

void addRoom(Glb& glb) {
    const int plaster = glb.addMaterial(glb.dressed({.name = "plaster"}, paintPlaster({0.76f, 0.70f, 0.62f}, 4, 384))),
              oak = glb.addMaterial(glb.dressed({.name = "oak"}, paintPanel(lodestir::generate::oak(), 6, 512))),
              walnut = glb.addMaterial(glb.dressed({.name = "walnut"}, paintPanel(lodestir::generate::walnut(), 8, 512))),
              parquet = glb.addMaterial(glb.dressed({.name = "parquet"}, paintHerringbone(lodestir::generate::oak(), 3, 512)));
    Model room{"room", {}};
    room.add(plaster, slab({left - 0.2f, 0, back - 0.2f}, {left, ceiling, 3.5f}, plasterSize));
    room.add(plaster, slab({left, 0, back - 0.2f}, {3.2f, ceiling, back}, plasterSize));
    room.add(parquet, slab({left, -0.1f, back}, {3.2f, 0, 3.5f}, herringboneSize));
    // Boards of a ceiling between beams, slats along the back wall.
    for (int i = 0; i < 16; ++i)
        room.add(oak, placed(plank({4.85f, 0.03f, 0.29f}, Axis::x, 30 + uint32_t(i)), glm::vec3(0.775f, ceiling + 0.015f, back + 0.15f + 0.3f * float(i))));
    for (int i = 0; i < 5; ++i)
        room.add(walnut, placed(plank({0.12f, 0.14f, 4.8f}, Axis::z, 60 + uint32_t(i)), glm::vec3(left + 0.4f + 1.0f * float(i), ceiling - 0.07f, 1.1f)));
    for (int i = 0; i < 60; ++i)
        room.add(walnut, placed(plank({0.035f, 1.05f, 0.03f}, Axis::y, 80 + uint32_t(i)), glm::vec3(left + 0.05f + 0.08f * float(i), 0.525f, back + 0.015f)));
    room.add(walnut, placed(plank({4.85f, 0.05f, 0.06f}, Axis::x, 150), glm::vec3(0.775f, 1.075f, back + 0.03f)));
    // A bench on blocks.
    room.add(oak, placed(plank({2.7f, 0.06f, 0.52f}, Axis::x, 160), glm::vec3(left + 1.37f, bench - 0.03f, back + 0.30f)));
    for (float x : {0.12f, 1.35f, 2.6f})
        room.add(walnut, placed(plank({0.09f, bench - 0.06f, 0.44f}, Axis::y, 170), glm::vec3(left + x, (bench - 0.06f) / 2, back + 0.30f)));
    glb.addNode(room);

    Model carpet{"carpet", {}};
    const glm::vec2 size(2.2f, 1.45f);
    carpet.add(glb.addMaterial(glb.dressed({.name = "carpet"}, paintRug(7, 640, size))), rug(7, size));
    glb.addNode(carpet, {.translation = {0.05f, 0, 0.15f}, .rotation = turnY(4)});
}

void addThings(Glb& glb) {
    const auto glazed = [&](const char* name, const glm::vec3& color, uint32_t seed) {
        return glb.addMaterial(glb.dressed({.name = name}, paintEarthenware(color, seed, 256)));
    };
    const int celadon = glazed("celadon", {0.30f, 0.42f, 0.34f}, 3), cream = glazed("cream", {0.66f, 0.58f, 0.45f}, 5),
              rust = glazed("rust", {0.36f, 0.13f, 0.06f}, 9),
              iron = glb.addMaterial({.name = "cast_iron", .color = {0.05f, 0.045f, 0.042f}, .roughness = 0.42f}),
              skin = glb.addMaterial({.name = "fruit", .roughness = 0.4f}), soil = glb.addMaterial({.name = "soil", .color = {0.05f, 0.035f, 0.025f}});
    const PlantMaterials fig{glb.addMaterial(glb.dressed({.name = "leaf", .mask = true, .doubleSided = true}, paintLeaf(2, 256))),
                             glb.addMaterial({.name = "stem", .color = {0.16f, 0.12f, 0.07f}})};
    const auto stand = [&](const Model& model, const glm::vec3& at, float turn = 0, float scale = 1) {
        glb.addNode(model, {.translation = at, .rotation = turnY(turn), .scale = glm::vec3(scale)});
    };
    stand(cat(glb, "cat", 0.009f), {-1.08f, bench, back + 0.30f}, -62, 0.62f);
    stand(teapot("teapot", iron, 0.20f), {-0.42f, bench, back + 0.32f}, -25);
    stand(mug("mug_0", cream), {-0.13f, bench, back + 0.42f}, 40);
    stand(mug("mug_1", celadon), {-0.02f, bench, back + 0.30f}, 200);
    stand(bowl("bowl", celadon, 0.17f), {0.36f, bench, back + 0.31f});
    stand(fruit("fruit", skin, 4, 0.17f), {0.36f, bench, back + 0.31f});
    stand(vase("vase", rust, 0.62f, 0.17f), {0.82f, bench, back + 0.28f});
    stand(twigs("twigs", 6, 0.8f, 5, fig), {0.82f, bench + 0.55f, back + 0.28f});
    stand(pot("fig_pot", rust, soil, 0.36f), {1.45f, 0, -0.75f});
    stand(rubberFig("fig", 3, 1.25f, 26, fig), {1.45f, 0.31f, -0.75f}, 30);
}

Glb makeLantern() {
    Glb glb;
    addLanterns(glb);
    addRoom(glb);
    addThings(glb);
    return glb;
}

}  // namespace

LODESTIR_SCENE(makeLantern, "--levels 4 --ratio 4 --mesh lantern")

}  // namespace lodestir::generate
