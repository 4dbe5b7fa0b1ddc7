// SPDX-License-Identifier: MIT
// Ten thousand things on a heath in the evening, from four metres to four hundred away: herds of deer, rabbits, bushes, trees and boulders, of one mesh each.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "kit/deer.h"
#include "kit/foliage.h"
#include "kit/noise.h"
#include "kit/rabbit.h"
#include "kit/random.h"
#include "kit/scene.h"
#include "kit/shapes.h"
#include "kit/spline.h"
#include "kit/stone.h"
#include "kit/terrain.h"

namespace lodestir::generate {

namespace {

constexpr int rows = 100;                        ///< of the grid that things are shaken out of; as many a row
constexpr float nearest = 4.5f, farthest = 390;  ///< metres from where a viewer stands, at (0, 4)

/// A crown of bushes on a forked trunk.
Model tree(const std::string& name, const BushMaterials& materials) {
    Model model{name, {}};
    const Model crown = bush(name, 9, 2.2f, materials);
    struct Bough {
        glm::vec3 end;
        float turn, scale;
    };
    const Bough boughs[] = {{{0, 3.3f, 0}, 0, 1.15f},
                            {{1.15f, 2.7f, 0.2f}, 100, 0.95f},
                            {{-1.0f, 2.8f, 0.5f}, 200, 1.0f},
                            {{0.1f, 2.5f, 1.15f}, 290, 0.9f},
                            {{-0.2f, 2.6f, -1.1f}, 40, 0.95f}};
    for (const Bough& b : boughs) {
        const Station wood[] = {{{0, -0.2f, 0}, 0.17f}, {{0.04f, 0.8f, 0}, 0.13f}, {glm::mix(glm::vec3(0, 1.4f, 0), b.end, 0.25f), 0.085f}, {b.end, 0.045f}};
        model.add(materials.bark, limb(wood, 6, 10));
        const glm::mat4 place = glm::rotate(glm::translate(glm::mat4(1), b.end - glm::vec3(0, 0.35f, 0)), glm::radians(b.turn), glm::vec3(0, 1, 0)) *
                                glm::scale(glm::mat4(1), glm::vec3(b.scale));
        for (const auto& [material, mesh] : crown.parts) model.add(material, placed(mesh, place));
    }
    return model;
}

/// What may stand somewhere.
struct Kind {
    const char* name;
    int mesh;
    float room;  ///< metres around its middle that it keeps free of others, at a scale of 1
};

class Field {
public:
    Field(Glb& to, const Terrain& ground) : glb(to), terrain(ground) {}

    bool isFree(const glm::vec2& xz, float room) const {
        return std::ranges::none_of(taken, [&](const glm::vec3& t) { return glm::distance(glm::vec2(t), xz) < t.z + room; });
    }
    void put(const Kind& kind, const glm::vec2& xz, float sunk, const glm::quat& rotation, const glm::vec3& scale) {
        taken.emplace_back(xz, kind.room * std::max(scale.x, scale.z));
        glb.addNode(kind.name + ("_" + std::to_string(taken.size() - 1)), kind.mesh,
                    {.translation = {xz.x, terrain.height(xz) - sunk, xz.y}, .rotation = rotation, .scale = scale});
    }

private:
    Glb& glb;
    const Terrain& terrain;
    std::vector<glm::vec3> taken;  ///< x, z, room
};

void addThings(Glb& glb, const Terrain& terrain) {
    const auto leaf = [&](const char* name, uint32_t seed, const LeafPaint& paint) {
        return glb.addMaterial(glb.dressed({.name = name, .mask = true, .doubleSided = true}, paintLeaf(seed, 128, paint)));
    };
    const int dark = leaf("dark_leaf", 1, {{0.035f, 0.085f, 0.022f}, {0.075f, 0.14f, 0.032f}, {0.17f, 0.24f, 0.08f}}),
              pale = leaf("pale_leaf", 2, {{0.12f, 0.17f, 0.035f}, {0.20f, 0.24f, 0.05f}, {0.34f, 0.36f, 0.13f}}),
              rust = leaf("rust_leaf", 3, {{0.24f, 0.075f, 0.02f}, {0.40f, 0.15f, 0.03f}, {0.5f, 0.28f, 0.1f}});
    const int bark = glb.addMaterial({.name = "bark", .color = {0.11f, 0.08f, 0.055f}, .roughness = 0.9f});
    const Stone stone(44, {.size = {1.2f, 0.95f, 1.05f}, .facets = 15, .sharpness = 18, .relief = 1});
    const Mesh rock = stone.mesh(32);
    const Kind boulder{"boulder", glb.addMesh("boulder", {{glb.addGeometry(rock), glb.addMaterial(glb.dressed({.name = "boulder"}, stone.bake(rock, 256)))}}),
                       1.1f},
        buck{"deer", glb.addMesh(deer(glb, "deer", 1024)), 0.95f}, hare{"rabbit", glb.addMesh(rabbit(glb, "rabbit", 0.004f)), 0.24f},
        shrub{"bush", glb.addMesh(bush("bush", 5, 1, {{dark, pale, dark}, bark})), 0.5f},
        wood{"tree", glb.addMesh(tree("tree", {{dark, rust, pale, rust}, bark})), 1.9f};

    Random random(6);
    const Noise herds{5}, woods{8};
    Field field(glb, terrain);
    struct Spot {
        glm::vec2 xz;
        float away, choice, size, turn, any;
    };
    std::vector<Spot> left;
    for (int i = 0; i < rows * rows; ++i) {
        // Rows grow apart as they grow smaller to the eye, so that each distance has its share of the picture.
        const float u = (float(i % rows) + random.next()) / rows, v = (float(i / rows) + random.next()) / rows;
        const float away = nearest * std::pow(farthest / nearest, std::pow(v, 0.7f));
        const Spot spot{{(u - 0.5f) * (4 + 1.15f * away), 4 - away}, away, random.next(), random.between(0.82f, 1.12f), random.bell(), random.between(0, 360)};
        const float herd = herds.fractal(glm::vec3(spot.xz, 0.5f) * 0.055f, 2), grove = woods.fractal(glm::vec3(spot.xz, 3.5f) * 0.022f, 2);
        if (grove > 0.08f && away > 55 && spot.choice < 0.55f && field.isFree(spot.xz, wood.room))
            field.put(wood, spot.xz, 0.05f, turnY(spot.any), spot.size * glm::vec3(1.25f, 1.35f, 1.25f));
        else if (herd > 0.02f && away > 12 && spot.choice < 0.8f && field.isFree(spot.xz, 1.25f * buck.room))
            field.put(buck, spot.xz, 0.01f, turnY(205 + 38 * spot.turn), glm::vec3(spot.size));  // a herd goes one way
        else
            left.push_back(spot);
    }
    // What is small finds room between what is large.
    for (const Spot& spot : left) {
        const float far = 1 + 0.02f * spot.away, low = random.between(0.55f, 0.95f), share = random.next();
        if (share < 0.18f && spot.away < 60 && field.isFree(spot.xz, hare.room)) {
            field.put(hare, spot.xz, 0.005f, turnY(spot.any), glm::vec3(spot.size));
        } else if (share < 0.30f && field.isFree(spot.xz, shrub.room)) {
            field.put(shrub, spot.xz, 0.02f, turnY(spot.any), spot.size * glm::vec3(1, low, 1) * (0.8f + 0.003f * spot.away));
        } else if (share < 0.66f) {
            field.put(shrub, spot.xz, 0.01f, turnY(spot.any), 0.26f * far * spot.size * glm::vec3(1, low, 1));  // heather
        } else {
            // Few large ones, many small; farther off only larger ones are left, or nothing would be seen of them.
            float large = 0.03f * std::pow(15.0f, std::pow(random.next(), 3.0f)) * far;
            while (large > 0.04f && !field.isFree(spot.xz, boulder.room * large)) large *= 0.6f;
            const glm::quat roll = glm::angleAxis(random.between(-1.0f, 1.0f), glm::normalize(glm::vec3(random.bell(), 0.01f, random.bell())));
            field.put(boulder, spot.xz, -0.25f * large, roll * turnY(spot.any), large * glm::vec3(spot.size, random.between(0.7f, 1.1f), spot.size));
        }
    }
}

Glb makeField() {
    Glb glb;
    const Terrain terrain(12);
    addThings(glb, terrain);
    Model ground{"terrain", {}};
    ground.add(glb.addMaterial(glb.dressed({.name = "ground"}, paintGround(3, 768))), terrain.mesh(256));
    glb.addNode(ground);
    return glb;
}

}  // namespace

LODESTIR_SCENE(makeField, "--levels 4 --mesh deer --mesh rabbit --mesh boulder")

}  // namespace lodestir::generate
