// SPDX-License-Identifier: MIT
// A furnace whose answer is known while all in it moves: everything is in balance with a sky of radiance 1, so that nothing can be seen, whatever
// flies, turns, stretches or morphs. What glows and reflects nothing is left of a booth, and beside it two panels are lit by a point, a spot and a directional
// light as well: what the panels show above 1 follows from those lights and from what the two panels reflect to each other, and depends on nothing
// that moves. Yet the chance of each light to be chosen changes in every frame.
//
// The numbers of the panels and their lights are in moving_furnace.h, for those who know the answer.
#include "moving_furnace.h"

#include <functional>
#include <numbers>
#include <utility>

#include "kit/motion.h"
#include "kit/random.h"
#include "kit/scene.h"
#include "kit/shapes.h"
#include "kit/still_life.h"

namespace lodestir::generate {

namespace {

constexpr int second = 24;  ///< pieces of motion

/// A Lambertian surface that reflects `albedo` and glows so that a sky of radiance 1 leaves it at radiance 1.
Material balanced(const std::string& name, float albedo) {
    Material material = matt(name, glm::vec3(albedo));
    material.emission = glm::vec3(1 - albedo);
    material.doubleSided = true;
    return material;
}

/// Positions of `mesh` sent through `bend`.
std::vector<glm::vec3> bentPositions(const Mesh& mesh, const std::function<glm::vec3(const glm::vec3&)>& bend) {
    std::vector<glm::vec3> positions;
    for (const Vertex& v : mesh.vertices) positions.push_back(bend(v.position));
    return positions;
}

int putMorphing(Glb& glb, const std::string& name, int material, const Mesh& mesh, const std::vector<glm::vec3>& morphed, const Placement& placement) {
    return glb.addNode(name, glb.addMesh(name, {{glb.addGeometry(mesh, morphed), material}}), placement);
}

/// Five walls of a box that is open to the front, each a glowing slab that the panels' light ends at, with a lining that reflects.
void addBooth(Composition& c, int lining, int shell) {
    constexpr float left = -3, right = 0, top = 2, back = -1.5f, front = 1.5f, thick = 0.1f, gap = 0.02f;
    const glm::vec3 low(left, 0, back), high(right - thick, top, front), middle = 0.5f * (low + high), size = high - low;
    const auto slab = [&](glm::vec3 at, glm::vec3 extent) { c.put("shell", shell, plainBox(extent), {.translation = at}); };
    slab({middle.x, low.y - thick / 2, middle.z}, {size.x + 2 * thick, thick, size.z});
    slab({middle.x, high.y + thick / 2, middle.z}, {size.x + 2 * thick, thick, size.z});
    slab({low.x - thick / 2, middle.y, middle.z}, {thick, size.y, size.z});
    slab({high.x + thick / 2, middle.y, middle.z}, {thick, size.y, size.z});
    slab({middle.x, middle.y, low.z - thick / 2}, {size.x + 2 * thick, size.y + 2 * thick, thick});
    const glm::vec3 a = low + gap, b = high - gap, extent = b - a;
    Model sheets{"lining", {}};
    sheets.add(lining, rectangle(a, {extent.x, 0, 0}, {0, 0, extent.z}));
    sheets.add(lining, rectangle({a.x, b.y, a.z}, {extent.x, 0, 0}, {0, 0, extent.z}));
    sheets.add(lining, rectangle({a.x, b.y, a.z}, {0, 0, extent.z}, {0, -extent.y, 0}));
    sheets.add(lining, rectangle({b.x, b.y, a.z}, {0, 0, extent.z}, {0, -extent.y, 0}));
    sheets.add(lining, rectangle({a.x, b.y, a.z}, {extent.x, 0, 0}, {0, -extent.y, 0}));
    c.glb.addNode(sheets);
}

/// Things that reflect as they move, where no light without extent reaches them, nor what the panels reflect of it.
void addGuests(Composition& c, int third, int half) {
    constexpr float turn = 2 * std::numbers::pi_v<float>;
    const int crate = c.put("crate", half, plainBox({0.5f, 0.4f, 0.6f}), {.translation = {-2.3f, 0.5f, 0}});
    animate(c.glb, crate, Motion::translation, second,
            [](float t) { return glm::vec4(-2.3f + 0.5f * t, 0.5f + 0.4f * std::sin(turn * t), 0.7f * std::sin(turn * t), 0); });
    animate(c.glb, crate, Motion::rotation, second, [](float t) { return asVector(glm::angleAxis(2 * t, glm::normalize(glm::vec3(0.3f, 1, 0.2f)))); });
    const int slab = c.put("slab", third, plainBox({0.5f, 0.5f, 0.5f}), {.translation = {-1.1f, 1.2f, -0.5f}});
    animate(c.glb, slab, Motion::scale, second, [](float t) { return glm::vec4(1 - 0.7f * t, 0.4f + 1.2f * t, 1 + 0.8f * std::sin(turn * t), 0); });
    animate(c.glb, slab, Motion::rotation, second, [](float t) { return asVector(glm::angleAxis(-1.5f * t, glm::vec3(0, 0, 1))); });
    const Mesh box = plainBox({0.3f, 0.3f, 0.3f});
    const int morphing = putMorphing(c.glb, "bar", half, box, bentPositions(box, [](const glm::vec3& p) { return p * glm::vec3(3, 0.5f, 2); }),
                                     {.translation = {-1, 0.5f, 0.6f}, .rotation = turnY(20)});
    animate(c.glb, morphing, Motion::weight, second, [](float t) { return glm::vec4(0.5f - 0.5f * std::cos(turn * t), 0, 0, 0); });
}

/// Glowing things that keep out of the way between the panels and their lights.
void addLamps(Composition& c, int glowing) {
    constexpr float turn = 2 * std::numbers::pi_v<float>;
    const int comet = c.put("comet", glowing, gem(6), {.translation = {50, 15, 35}, .scale = glm::vec3(0.6f)});
    // The scene shrinks by a tenth a frame, and with it the chance of the sun and the sky.
    animate(c.glb, comet, Motion::translation, second, [](float t) { return glm::vec4(glm::vec3(5, 1.5f, 3.5f) * std::pow(10.0f, 1 - t), 0); });
    const int banner = c.put("banner", glowing, plainBox({0.2f, 1, 1}), {.translation = {4.4f, 1.2f, 0}});
    animate(c.glb, banner, Motion::scale, second, [](float t) { return glm::vec4(1, 0.3f + 2.2f * t, 1.6f - 1.4f * t, 0); });
    animate(c.glb, banner, Motion::rotation, second, [](float t) { return asVector(turnY(80 * t)); });
    Random random(5);
    const Mesh stone = gem(7);
    const int morphing = putMorphing(c.glb, "stone", glowing, stone, bentPositions(stone, [&](const glm::vec3& p) { return p * random.between(1.5f, 3); }),
                                     {.translation = {3.9f, 0.6f, -2.6f}, .scale = glm::vec3(0.35f)});
    animate(c.glb, morphing, Motion::weight, second, [](float t) { return glm::vec4(std::sin(0.5f * turn * t), 0, 0, 0); });
}

Glb makeMovingFurnace() {
    using namespace furnace;
    Composition c;
    const int third = c.glb.addMaterial(balanced("a third", 0.3f)), half = c.glb.addMaterial(balanced("half", 0.5f)),
              panel = c.glb.addMaterial(balanced("panel", albedo)), glowing = c.glb.addMaterial(balanced("glow", 0));
    addBooth(c, third, glowing);
    addGuests(c, third, half);
    addLamps(c, glowing);
    for (const Panel& p : {floorPanel, wallPanel}) c.put("panel", panel, rectangle(p.corner, p.right, p.down));
    using Kind = LightSource::Kind;
    c.glb.addNode(LightSource{.name = "sun", .kind = Kind::directional, .intensity = sun}, {.rotation = turnTo({0, -1, 0})});
    c.glb.addNode(LightSource{.name = "bulb", .kind = Kind::point, .intensity = bulb.intensity}, {.translation = bulb.position});
    c.glb.addNode(LightSource{.name = "spot", .kind = Kind::spot, .intensity = spot.intensity, .innerDegrees = spotInner, .outerDegrees = spotOuter},
                  {.translation = spot.position, .rotation = turnTo(spotTarget - spot.position)});
    return std::move(c.glb);
}

}  // namespace

LODESTIR_SCENE(makeMovingFurnace)

}  // namespace lodestir::generate
