// SPDX-License-Identifier: MIT
// A photographer's table: two rows of spheres in many materials on slate and walnut, before a curved backdrop, lit by soft boxes.
#include <algorithm>
#include <cmath>
#include <vector>

#include "kit/glb.h"
#include "kit/masonry.h"
#include "kit/metals.h"
#include "kit/noise.h"
#include "kit/random.h"
#include "kit/scene.h"
#include "kit/shapes.h"
#include "kit/wood.h"

namespace lodestir::generate {

namespace {

constexpr float radius = 0.5f;  ///< of every sphere, metres
constexpr float spacing = 1.11f;
constexpr float platformTop = 0.14f;  ///< slate table the front row stands on
constexpr float stepTop = 0.95f;      ///< walnut bench of the back row
constexpr float frontRow = 1.0f, backRow = -0.45f;

// The ring below each sphere: its tube touches the sphere where the radii add up.
constexpr float ringRadius = 0.27f, ringTube = 0.045f;

/// Floor sweeping up into a wall, open towards the camera.
Mesh backdrop() {
    constexpr float halfWidth = 16, front = 13, bend = 3.2f, wall = -4.5f, height = 10;
    std::vector<glm::vec2> profile;  // (z, y) from the top of the wall to the front edge
    profile.push_back({wall, height});
    constexpr int steps = 32;
    for (int i = 0; i <= steps; ++i) {
        const float a = 1.57079633f * float(i) / float(steps);
        profile.push_back({wall + bend * (1 - std::cos(a)), bend * (1 - std::sin(a))});
    }
    profile.push_back({front, 0});
    const int rows = int(profile.size()) - 1;
    return grid(24, rows, [&](float u, float v) {
        const glm::vec2 p = profile[size_t(std::lround(v * float(rows)))];
        return glm::vec3((2 * u - 1) * halfWidth, p.y, p.x);
    });
}

/// A soft box: a glowing sheet in a dark tray, facing `target`.
Model softBox(const std::string& name, const glm::vec3& position, const glm::vec3& target, const glm::vec2& size, int glow, int tray) {
    const glm::vec3 facing = glm::normalize(target - position);
    const glm::vec3 right = glm::normalize(glm::cross(glm::vec3(0, 1, 0), facing)), up = glm::cross(facing, right);
    Model box{name, {}};
    const glm::vec3 corner = position - right * (size.x / 2) + up * (size.y / 2);
    box.add(glow, rectangle(corner, right * size.x, -up * size.y));
    const glm::mat4 stand(glm::vec4(right, 0), glm::vec4(up, 0), glm::vec4(facing, 0), glm::vec4(position - facing * 0.12f, 1));
    box.add(tray, placed(roundedBox({size.x + 0.12f, size.y + 0.12f, 0.2f}, 0.04f), stand));
    return box;
}

Mesh ring() {
    std::vector<glm::vec2> profile;
    constexpr int steps = 20;
    for (int i = 0; i <= steps; ++i) {
        const float a = 6.2831853f * float(i % steps) / float(steps);
        profile.push_back({ringRadius + ringTube * std::sin(a), ringTube * (1 + std::cos(a))});
    }
    return turned(profile, 64, 180);
}

/// Centre height of a sphere whose ring stands at `ground`.
float centreHeight(float ground) {
    const float reach = radius + ringTube;
    return ground + ringTube + std::sqrt(reach * reach - ringRadius * ringRadius);
}

/// Marbled inks in the vertices alone.
Mesh inkedSphere() {
    Mesh mesh = sphere(256, 128);
    const Noise noise{71};
    const glm::vec3 inks[] = {
        {0.02f, 0.10f, 0.30f}, {0.05f, 0.42f, 0.45f}, {0.85f, 0.75f, 0.55f}, {0.85f, 0.28f, 0.08f}, {0.35f, 0.02f, 0.06f}};
    for (Vertex& v : mesh.vertices) {
        const glm::vec3 p = v.position * 1.3f;
        const glm::vec3 warp(noise.fractal(p, 3), noise.fractal(p + 13.7f, 3), noise.fractal(p + 31.3f, 3));
        const float t = glm::clamp(0.5f + 1.25f * noise.fractal(p + 1.6f * warp, 3), 0.0f, 0.999f) * 4;
        const int ink = int(t);
        v.color = glm::mix(inks[ink], inks[ink + 1], glm::smoothstep(0.25f, 0.75f, t - float(ink)));
    }
    mesh.hasColors = true;
    return mesh;
}

/// Sheet metal with round holes, evenly spread by a Fibonacci lattice so that no pole shows.
Textures paintPerforation() {
    constexpr int count = 460;
    std::vector<glm::vec3> holes;
    for (int i = 0; i < count; ++i) {
        const float y = 1 - (2 * float(i) + 1) / float(count), r = std::sqrt(1 - y * y), phi = float(i) * 2.39996323f;
        holes.push_back({r * std::cos(phi), y, r * std::sin(phi)});
    }
    const Noise noise{5};
    return paintSphere(1024, 512, [&](const glm::vec3& d) {
        // The lattice is sorted by height, so only the holes of a band around the point can be near.
        const int middle = int((1 - d.y) * 0.5f * float(count)), reach = 36;
        float nearest = -1;
        for (int i = std::max(middle - reach, 0); i < std::min(middle + reach, count); ++i)
            nearest = std::max(nearest, glm::dot(holes[size_t(i)], d));
        const float distance = std::acos(std::min(nearest, 1.0f));
        constexpr float hole = 0.056f, softness = 0.006f;  // the ramp is a texel wide, so that the cut follows the circle
        Surface s;
        s.color = glm::vec3(0.92f, 0.86f, 0.72f);
        s.metalness = 1;
        s.roughness = 0.30f + 0.05f * noise.fractal(d * 9.0f, 3);
        s.alpha = glm::clamp(0.5f + (distance - hole) / (2 * softness), 0.0f, 1.0f);
        s.height = -0.006f * std::exp(-std::max(distance - hole, 0.0f) / 0.012f);
        return s;
    });
}

/// Steel beaten with a round hammer.
Textures paintHammered() {
    const Noise noise{23};
    return paintSphere(1024, 512, [&](const glm::vec3& d) {
        const Cell cell = noise.cell(d * 6.5f + 0.12f * noise.at(d * 4.0f));
        Surface s;
        s.color = steel * (0.96f + 0.08f * unit(cell.id));
        s.metalness = 1;
        s.roughness = 0.20f + 0.12f * unit(hash(cell.id, 3));
        s.height = 0.030f * cell.nearest * cell.nearest;
        return s;
    });
}

/// Things shared by all spheres of the scene.
struct Stand {
    Glb& glb;
    int ball;  ///< geometry of the plain sphere
    int ringMesh;

    void put(const std::string& name, int mesh, int column, bool back) const {
        const float x = (float(column) - 4) * spacing + (back ? 0.0f : spacing * 0.1f), z = back ? backRow : frontRow,
                    ground = back ? stepTop : platformTop;
        glb.addNode(name, mesh,
                    {.translation = {x, centreHeight(ground), z}, .rotation = turnY(float(column) * 37), .scale = glm::vec3(radius)});
        glb.addNode(name + "_ring", ringMesh, {.translation = {x, ground, z}});
    }
    void put(const Material& material, int column, bool back) const {
        put(material.name, glb.addMesh(material.name, {{ball, glb.addMaterial(material)}}), column, back);
    }
};

void addSpheres(Glb& glb) {
    Mesh plain = sphere(96, 48);
    computeTangents(plain);
    Model stand{"ring", {}};
    stand.add(glb.addMaterial({.name = "ring_steel", .color = {0.10f, 0.10f, 0.11f}, .roughness = 0.35f, .metalness = 1}), ring());
    const Stand row{glb, glb.addGeometry(plain), glb.addMesh(stand)};

    // Back row, against the bright backdrop: glass at the ends, metals from mirror to matt between.
    row.put({.name = "glass_rough",
             .roughness = 0.32f,
             .transmission = 1,
             .ior = 1.5f,
             .thickness = 2 * radius,
             .attenuation = {0.45f, 0.85f, 0.95f},
             .attenuationDistance = 0.9f},
            0, true);
    const float goldRoughness[] = {0.03f, 0.20f, 0.40f, 0.70f}, copperRoughness[] = {0.08f, 0.28f, 0.55f};
    int column = 1;
    for (float roughness : goldRoughness)
        row.put({.name = "gold_" + std::to_string(std::lround(roughness * 100)), .color = gold, .roughness = roughness, .metalness = 1},
                column++, true);
    for (float roughness : copperRoughness)
        row.put({.name = "copper_" + std::to_string(std::lround(roughness * 100)), .color = copper, .roughness = roughness, .metalness = 1},
                column++, true);
    row.put({.name = "glass", .roughness = 0, .transmission = 1, .ior = 1.52f, .thickness = 2 * radius}, 8, true);

    // Front row: paints from lacquer to chalk, then what textures and vertices can do.
    row.put({.name = "paint_lacquer", .color = {0.008f, 0.009f, 0.011f}, .roughness = 0.02f}, 0, false);
    row.put({.name = "paint_gloss", .color = {0.60f, 0.028f, 0.022f}, .roughness = 0.10f}, 1, false);
    row.put({.name = "paint_silk", .color = {0.70f, 0.36f, 0.03f}, .roughness = 0.24f}, 2, false);
    row.put({.name = "paint_satin", .color = {0.016f, 0.20f, 0.22f}, .roughness = 0.45f}, 3, false);

    const int hole = glb.addMaterial(glb.dressed({.name = "perforated", .mask = true, .doubleSided = true}, paintPerforation()));
    row.put("perforated", glb.addMesh("perforated", {{row.ball, hole}}), 4, false);
    const int bulb = glb.addMaterial({.name = "bulb", .emission = {24, 13, 5}});
    glb.addNode("bulb", glb.addMesh("bulb", sphere(24, 12), bulb),
                {.translation = {spacing * 0.1f, centreHeight(platformTop), frontRow}, .scale = glm::vec3(0.11f)});

    row.put({.name = "paint_chalk", .color = {0.76f, 0.70f, 0.58f}, .roughness = 0.95f}, 5, false);
    const int ink = glb.addMaterial({.name = "vertex_inks", .roughness = 0.22f});
    row.put("vertex_inks", glb.addMesh("vertex_inks", inkedSphere(), ink), 6, false);
    const int hammered = glb.addMaterial(glb.dressed({.name = "hammered_steel"}, paintHammered()));
    row.put("hammered_steel", glb.addMesh("hammered_steel", {{row.ball, hammered}}), 7, false);
    // Every triangle of this one is a light; it needs no reflections, so fewer will do.
    const int glow = glb.addMaterial({.name = "glow", .color = glm::vec3(0.8f), .emission = {2.4f, 0.72f, 0.16f}});
    row.put("glow", glb.addMesh("glow", sphere(64, 32), glow), 8, false);
}

Glb makeMaterialSpheres() {
    Glb glb;

    Model sweep{"backdrop", {}};
    sweep.add(glb.addMaterial({.name = "backdrop", .color = {0.40f, 0.43f, 0.48f}, .roughness = 0.95f}), backdrop());
    glb.addNode(sweep);

    Model table{"platform", {}};
    Mesh slab = placed(roundedBox({12.0f, platformTop, 5.2f}, 0.03f, 3), {0, platformTop / 2, 0.55f});
    scaleUv(slab, glm::vec2(1 / slateSize), {0.125f, 0.06f});
    table.add(glb.addMaterial(glb.dressed({.name = "slate"}, paintSlate(11, 1024))), slab);
    glb.addNode(table);

    Model bench{"bench", {}};
    Mesh step = placed(roundedBox({10.6f, stepTop - platformTop, 1.4f}, 0.05f, 4), {0, (stepTop + platformTop) / 2, backRow});
    scaleUv(step, 1.0f / (2.0f * panelSize));  // boards twice as wide: the set is larger than life
    bench.add(glb.addMaterial(glb.dressed({.name = "walnut"}, paintPanel(walnut(), 5, 1024))), step);
    glb.addNode(bench);

    addSpheres(glb);

    const int tray = glb.addMaterial({.name = "tray", .color = glm::vec3(0.02f), .roughness = 0.8f});
    const auto lamp = [&](const std::string& name, const glm::vec3& radiance) {
        return glb.addMaterial({.name = name, .color = glm::vec3(0), .emission = radiance});
    };
    const glm::vec3 centre(0, 0.8f, 0.3f);
    glb.addNode(softBox("key", {-6.5f, 6.2f, 5.5f}, centre, {3.4f, 2.6f}, lamp("key", {15, 13.6f, 11.6f}), tray));
    glb.addNode(softBox("fill", {9.0f, 4.2f, 5.0f}, centre, {2.2f, 4.4f}, lamp("fill", {2.3f, 2.9f, 3.8f}), tray));
    glb.addNode(softBox("rim", {0, 5.6f, -3.6f}, centre, {9, 0.7f}, lamp("rim", {11, 10.4f, 9.8f}), tray));
    glb.addNode(softBox("top", {1.5f, 7.4f, 1.2f}, centre, {6, 2}, lamp("top", {3.4f, 3.3f, 3.2f}), tray));
    // Low behind the bench, out of sight: a glow on the backdrop that lifts the spheres off it.
    glb.addNode(softBox("background", {0, 0.5f, -1.9f}, {0, 3.0f, -4.5f}, {8.5f, 0.6f}, lamp("background", {5.0f, 6.0f, 7.6f}), tray));
    return glb;
}

}  // namespace

LODESTIR_SCENE(makeMaterialSpheres)

}  // namespace lodestir::generate
