// SPDX-License-Identifier: MIT
// A Gothic tower: see gothic_tower.h.
#include "gothic_tower.h"

#include <array>

#include <glm/gtc/matrix_transform.hpp>

#include "arcade.h"
#include "marble.h"
#include "random.h"
#include "shapes.h"

namespace lodestir::generate {

namespace {

Mesh inBlocks(Mesh mesh) {
    scaleUv(mesh, glm::vec2(1 / ashlarSize));
    return mesh;
}

Mesh boxAt(const glm::vec3& size, const glm::vec3& centre, float radius = 0.08f) { return placed(inBlocks(roundedBox(size, radius, 1)), centre); }

/// A four-sided roof from a rectangle to a smaller one, flat on top. Metres as UVs over the size of blocks.
Mesh hippedRoof(const glm::vec2& foot, const glm::vec2& head, float height) {
    Mesh mesh;
    for (float side : {1.0f, -1.0f}) {
        const auto sideFace = [&](float w0, float d0, float w1, float d1, bool alongX) {
            const auto at = [&](float across, float out, float y) {
                return alongX ? glm::vec3(side * across, y, side * out) : glm::vec3(side * out, y, -side * across);
            };
            const glm::vec3 p[] = {at(-w0, d0, 0), at(w0, d0, 0), at(w1, d1, height), at(-w1, d1, height)};
            uint32_t id[4];
            for (int k = 0; k < 4; ++k)
                id[k] = mesh.add({.position = p[k], .uv = glm::vec2(k == 0 ? -w0 : k == 1 ? w0 : k == 2 ? w1 : -w1, k < 2 ? 0 : -height) / ashlarSize});
            mesh.quad(id[0], id[1], id[2], id[3]);
        };
        sideFace(foot.x / 2, foot.y / 2, head.x / 2, head.y / 2, true);
        sideFace(foot.y / 2, foot.x / 2, head.y / 2, head.x / 2, false);
    }
    append(mesh, rectangle({-head.x / 2, height, -head.y / 2}, {head.x, 0, 0}, {0, 0, head.y}));
    computeNormals(mesh, 10);
    return mesh;
}

/// An octagonal corner turret with its spire.
void addTurret(Model& model, const TowerPaints& paints, const glm::vec3& at, float radius, float height) {
    const float r = radius, spire = 5.2f * r;
    const glm::vec2 shaft[] = {{1.22f * r, height + 0.9f * r},
                               {1.22f * r, height + 0.2f * r},
                               {1.0f * r, height - 0.3f * r},
                               {r, height * 0.74f + 0.2f},
                               {1.1f * r, height * 0.74f},
                               {1.1f * r, height * 0.74f - 0.4f},
                               {r, height * 0.74f - 0.6f},
                               {r, height * 0.5f},
                               {1.08f * r, height * 0.5f - 0.2f},
                               {r, height * 0.5f - 0.4f},
                               {r, 0}};
    Mesh body = turned(shaft, 8, 20);
    scaleUv(body, glm::vec2(6.3f * r, height) / ashlarSize);
    model.add(paints.stone, placed(body, at));
    const glm::vec2 cone[] = {{0.08f * r, height + 0.9f * r + spire}, {0.98f * r, height + 0.9f * r}, {1.22f * r, height + 0.9f * r}};
    Mesh roof = turned(cone, 8, 20);
    scaleUv(roof, glm::vec2(6.3f * r, spire) / ashlarSize);
    model.add(paints.roof, placed(roof, at));
    const float top = height + 0.9f * r + spire;
    const glm::vec2 finial[] = {{0, top + 1.0f * r}, {0.05f * r, top + 0.5f * r}, {0.2f * r, top + 0.25f * r}, {0.05f * r, top}, {0.08f * r, top - 0.2f * r}};
    model.add(paints.gilt, placed(turned(finial, 8), at));
}

}  // namespace

Mesh lancet(float width, float height) {
    const float w = width / 2, spring = height - 0.85f * width;
    Mesh mesh;
    for (const glm::vec2& p :
         {glm::vec2(-w, 0), {w, 0}, {w, spring}, {0.62f * w, spring + 0.55f * width}, {0, height}, {-0.62f * w, spring + 0.55f * width}, {-w, spring}})
        mesh.add({.position = {p.x, p.y, 0}, .normal = {0, 0, 1}, .uv = {p.x, -p.y}});
    for (uint32_t i = 1; i + 1 < 7; ++i) mesh.triangle(0, i, i + 1);
    return mesh;
}

Model gothicTower(const std::string& name, const TowerPaints& paints, const TowerForm& form) {
    Model model{name, {}};
    Random random(form.seed);
    const glm::vec3 s = form.size;
    const float gate = form.passage * 1.55f;  // height of the storey with the passage

    // The passage: pierced walls at both ends of x, closed sides, a ceiling.
    const ArchBay bay{.width = s.z, .height = gate, .opening = form.passage, .spring = form.passage * 0.82f, .depth = 1.6f};
    for (float side : {1.0f, -1.0f}) {
        const glm::mat4 turn = glm::translate(glm::rotate(glm::mat4(1), glm::radians(90 * side), {0, 1, 0}), {0, 0, s.x / 2 - 0.8f});
        model.add(paints.stone, placed(inBlocks(archBay(bay)), turn));
        model.add(paints.trim, placed(inBlocks(archivolt(bay, 0.28f)), turn));
        model.add(paints.stone, boxAt({s.x, gate, (s.z - form.passage) / 2}, {0, gate / 2, side * (s.z + form.passage) / 4}));
    }
    model.add(paints.stone, boxAt({s.x, s.y - gate, s.z}, {0, (s.y + gate) / 2, 0}));

    const float storey = (s.y - gate) / float(form.storeys);
    const std::array<float, 4> turns{0, 90, 180, 270};
    for (int level = 0; level <= form.storeys; ++level) {
        const float y = gate + storey * float(level);
        model.add(paints.trim, boxAt({s.x + 0.7f, 0.55f, s.z + 0.7f}, {0, y, 0}, 0.2f));
        if (level == form.storeys) break;
        for (float turn : turns) {
            const bool alongX = turn == 0 || turn == 180;
            const float width = (alongX ? s.x : s.z) - 2 * form.turret, out = (alongX ? s.z : s.x) / 2;
            for (int i = 0; i < 3; ++i) {
                const glm::mat4 at =
                    glm::translate(glm::rotate(glm::mat4(1), glm::radians(turn), {0, 1, 0}), {(float(i) - 1) * width * 0.30f, y + 0.16f * storey, out});
                const float w = width * (i == 1 ? 0.20f : 0.15f), h = storey * (i == 1 ? 0.74f : 0.62f);
                // Hood and jambs stand out; the glass lies behind them.
                for (float side : {-1.0f, 1.0f}) {
                    model.add(paints.trim, placed(bar({side * (w / 2 + 0.1f), 0, 0.05f}, {side * (w / 2 + 0.1f), h - 0.85f * w, 0.05f}, 0.16f, 6), at));
                    model.add(paints.trim, placed(bar({side * (w / 2 + 0.1f), h - 0.85f * w, 0.05f}, {side * 0.31f * w, h - 0.28f * w, 0.05f}, 0.16f, 6), at));
                    model.add(paints.trim, placed(bar({side * 0.33f * w, h - 0.30f * w, 0.05f}, {0, h + 0.1f, 0.05f}, 0.16f, 6), at));
                }
                model.add(paints.trim, placed(bar({0, 0, 0.06f}, {0, h - 0.1f, 0.06f}, 0.07f, 5), at));
                for (float t : {0.33f, 0.6f}) model.add(paints.trim, placed(bar({-w / 2, t * h, 0.06f}, {w / 2, t * h, 0.06f}, 0.05f, 5), at));
                model.add(random.next() < 0.6f ? paints.lit : paints.glass, placed(placed(lancet(w, h), glm::vec3(0, 0, 0.03f)), at));
            }
        }
    }
    // The parapet, its merlons, the roof behind it with a gable over each face.
    for (float turn : turns) {
        const bool alongX = turn == 0 || turn == 180;
        const float width = alongX ? s.x : s.z, out = (alongX ? s.z : s.x) / 2;
        const glm::mat4 face = glm::rotate(glm::mat4(1), glm::radians(turn), {0, 1, 0});
        for (float x = -width / 2 + 2.2f; x < width / 2 - 2; x += 1.5f)
            model.add(paints.stone, placed(boxAt({0.85f, 1.5f, 0.5f}, {x, s.y + 0.9f, out - 0.1f}), face));
        model.add(paints.stone, placed(boxAt({width, 0.9f, 0.45f}, {0, s.y + 0.6f, out - 0.1f}), face));
        const float wide = 0.42f * width, tall = 0.62f * form.roofHeight;
        Mesh gable;
        const glm::vec3 p[] = {{-wide / 2, 0, 0}, {wide / 2, 0, 0}, {wide / 2, 0.45f * tall, 0}, {0, tall, 0}, {-wide / 2, 0.45f * tall, 0}};
        for (float depth : {0.0f, -3.2f})
            for (const glm::vec3& q : p) gable.add({.position = q + glm::vec3(0, 0, depth), .uv = glm::vec2(q.x, -q.y + depth) / ashlarSize});
        gable.quad(0, 1, 2, 4), gable.triangle(4, 2, 3);
        for (uint32_t k = 0; k < 5; ++k) gable.quad(k, k + 5, (k + 1) % 5 + 5, (k + 1) % 5);
        computeNormals(gable, 10);
        const glm::mat4 at = glm::translate(face, {0, s.y + 0.3f, out - 0.7f});
        model.add(paints.stone, placed(gable, at));
        model.add(random.next() < 0.7f ? paints.lit : paints.glass, placed(placed(lancet(0.34f * wide, 0.52f * tall), glm::vec3(0, 0.14f * tall, 0.04f)), at));
        model.add(paints.gilt, placed(placed(bar({0, tall, -0.1f}, {0, tall + 1.6f, -0.1f}, 0.12f, 6), glm::vec3(0)), at));
    }
    model.add(paints.roof, placed(hippedRoof({s.x - 1.6f, s.z - 1.6f}, {0.22f * s.x, 0.26f * s.z}, form.roofHeight), {0, s.y + 0.3f, 0}));
    const glm::vec3 crest(0, s.y + form.roofHeight + 0.3f, 0);
    model.add(paints.gilt, placed(boxAt({0.24f * s.x, 0.5f, 0.28f * s.z}, {0, 0.2f, 0}), crest));
    model.add(paints.gilt, bar(crest, crest + glm::vec3(0, 5, 0), 0.12f, 6));
    for (float x : {-1.0f, 1.0f})
        for (float z : {-1.0f, 1.0f}) addTurret(model, paints, {x * (s.x / 2 - 0.2f), 0, z * (s.z / 2 - 0.2f)}, form.turret, s.y + 3);
    return model;
}

}  // namespace lodestir::generate
