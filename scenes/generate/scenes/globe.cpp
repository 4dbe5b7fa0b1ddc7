// SPDX-License-Identifier: MIT
// A globe whose levels were charted apart: the finest has one chart from pole to pole, the next is a cube blown up to a ball, with a chart a face. They look
// alike, but a coordinate of one is another place on the other, and the seams run elsewhere.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

#include "kit/backdrop.h"
#include "kit/metals.h"
#include "kit/noise.h"
#include "kit/scene.h"
#include "kit/shapes.h"
#include "kit/wood.h"

namespace lodestir::generate {

namespace {

constexpr float pi = std::numbers::pi_v<float>, radius = 0.5f;
constexpr int columns = 128, rows = 64, cells = 14;  ///< 16,128 triangles and 2,352
constexpr glm::ivec2 faces{3, 2};                    ///< of the atlas of the coarser level
constexpr float margin = 0.02f;                      ///< around each face's chart, as a share of it

/// Face of the cube to a turn of +z.
const glm::mat3 turns[] = {
    glm::mat3(1),
    glm::mat3({0, 0, -1}, {0, 1, 0}, {1, 0, 0}),
    glm::mat3({-1, 0, 0}, {0, 1, 0}, {0, 0, -1}),
    glm::mat3({0, 0, 1}, {0, 1, 0}, {-1, 0, 0}),
    glm::mat3({1, 0, 0}, {0, 0, -1}, {0, 1, 0}),
    glm::mat3({1, 0, 0}, {0, 0, 1}, {0, -1, 0}),
};

/// The direction of a point of a face, [-1, 1]^2; cells of equal angles.
glm::vec3 faceDirection(int face, const glm::vec2& p) { return glm::normalize(turns[face] * glm::vec3(glm::tan(p * (pi / 4)), 1)); }

/// Sea, land, ice and a graticule, as a mapmaker tints them.
Surface map(const glm::vec3& d) {
    static const Noise noise{11};
    const float land = noise.fractal(d * 1.7f + 3.1f, 6, 0.55f) - 0.03f, coast = std::exp(-land * land / 0.00035f);
    const float latitude = std::asin(glm::clamp(d.y, -1.0f, 1.0f)), longitude = std::atan2(d.x, d.z), girth = std::cos(latitude);
    const auto line = [](float angle, float every, float width) {
        const float off = std::abs(angle / every - std::round(angle / every)) * every;
        return std::exp(-off * off / (width * width));
    };
    const float graticule =
        std::max(line(latitude, pi / 12, 0.004f), line(longitude, pi / 12, 0.004f / std::max(girth, 0.05f)) * glm::smoothstep(0.12f, 0.2f, girth));
    const float height = glm::smoothstep(0.0f, 0.35f, land), dry = glm::smoothstep(-0.2f, 0.3f, noise.fractal(d * 3.0f + 9.0f, 3));
    const glm::vec3 lowland = glm::mix(glm::vec3(0.30f, 0.40f, 0.15f), glm::vec3(0.70f, 0.56f, 0.28f), dry), highland(0.46f, 0.25f, 0.12f);
    Surface s;
    s.color = land > 0 ? glm::mix(lowland, highland, height)
                       : glm::mix(glm::vec3(0.30f, 0.52f, 0.56f), glm::vec3(0.10f, 0.27f, 0.38f), glm::smoothstep(0.0f, -0.3f, land));
    s.color = glm::mix(s.color, glm::vec3(0.80f, 0.78f, 0.72f), glm::smoothstep(1.25f, 1.35f, std::abs(latitude) + 0.15f * noise.fractal(d * 5.0f, 3)));
    s.color = glm::mix(s.color, glm::vec3(0.10f, 0.06f, 0.03f), 0.75f * std::max(coast, 0.6f * graticule));
    s.color *= 1 + 0.05f * noise.fractal(d * 30.0f, 3);  // the grain of the paper
    s.roughness = 0.22f;
    return s;
}

Mesh charted(int face) {
    Mesh mesh = grid(cells, cells, [&](float u, float v) { return radius * faceDirection(face, glm::vec2(2 * u - 1, 1 - 2 * v)); });
    for (Vertex& v : mesh.vertices) {
        v.normal = glm::normalize(v.position);
        v.uv = (glm::vec2(face % faces.x, face / faces.x) + margin + (1 - 2 * margin) * v.uv) / glm::vec2(faces);
    }
    return mesh;
}

/// How far the planes of a mesh whose vertices lie on the ball cut into it.
float deepest(const Mesh& mesh) {
    float nearest = radius;
    for (size_t t = 0; t < mesh.indices.size(); t += 3) {
        const auto corner = [&](size_t k) { return mesh.vertices[mesh.indices[t + k]].position; };
        nearest = std::min(nearest, std::abs(glm::dot(glm::normalize(glm::cross(corner(1) - corner(0), corner(2) - corner(0))), corner(0))));
    }
    return radius - nearest;
}

Textures paintFaces() {
    return paint({.width = 1536, .height = 1024, .metres = glm::vec2(faces), .repeats = false, .smooth = true}, [](const glm::vec2& m) {
        const glm::ivec2 cell = glm::min(glm::ivec2(m), faces - 1);
        const glm::vec2 uv = (m - glm::vec2(cell) - margin) / (1 - 2 * margin);
        return map(faceDirection(cell.y * faces.x + cell.x, glm::vec2(2 * uv.x - 1, 1 - 2 * uv.y)));
    });
}

/// The circles of a globe's stand: a band about +y, square in section.
Mesh ring(float inner, float outer, float thick) {
    const float h = thick / 2;
    const glm::vec2 profile[] = {{inner, h}, {outer, h}, {outer, -h}, {inner, -h}, {inner, h}};
    return turned(profile, 72, 30);
}

Glb makeGlobe() {
    Glb glb;
    const float centre = 0.86f;
    Mesh ball = sphere(columns, rows);
    for (Vertex& v : ball.vertices) v.normal = glm::normalize(v.position), v.position *= radius;
    Mesh cube;
    for (int face = 0; face < 6; ++face) append(cube, charted(face));
    const int world = glb.addMaterial(glb.dressed({.name = "map"}, paintSphere(1536, 768, map))),
              atlas = glb.addMaterial(glb.dressed({.name = "atlas"}, paintFaces()));
    const int globe = glb.addNode("globe", glb.addMesh("globe", ball, world),
                                  {.translation = {0, centre, 0}, .rotation = glm::angleAxis(glm::radians(-23.4f), glm::vec3(0, 0, 1)) * turnY(-40)});
    glb.addLevels(globe, {{glb.addMesh("globe_cube", cube, atlas), deepest(cube)}});

    const int brass = glb.addMaterial({.name = "brass", .color = {0.80f, 0.58f, 0.26f}, .roughness = 0.2f, .metalness = 1}),
              stand = glb.addMaterial({.name = "mahogany", .color = {0.17f, 0.055f, 0.028f}, .roughness = 0.2f});
    const glm::mat4 tilt = glm::rotate(glm::translate(glm::mat4(1), {0, centre, 0}), glm::radians(-23.4f), {0, 0, 1});
    Model meridian{"meridian", {}};
    meridian.add(brass, placed(ring(0.525f, 0.565f, 0.022f), tilt * glm::rotate(glm::mat4(1), pi / 2, {1, 0, 0})));
    for (float sign : {-1.0f, 1.0f}) meridian.add(brass, placed(bar({0, 0.49f * sign, 0}, {0, 0.59f * sign, 0}, 0.014f, 12), tilt));
    glb.addNode(meridian);
    Model foot{"foot", {}};
    const glm::vec2 control[] = {{0.02f, 0.32f},  {0.05f, 0.30f},  {0.035f, 0.26f}, {0.03f, 0.2f},  {0.055f, 0.14f},
                                 {0.035f, 0.10f}, {0.10f, 0.075f}, {0.24f, 0.05f},  {0.27f, 0.02f}, {0.27f, 0}};
    foot.add(stand, turned(smoothCurve(control, 5), 48));
    foot.add(brass, placed(roundedBox({0.06f, 0.05f, 0.05f}, 0.01f, 2), {0, 0.31f, 0}));
    glb.addNode(foot);
    addTable(glb, {.size = {4.2f, 0.08f, 2.6f}, .edge = 0.02f, .centre = {0, -0.04f, -0.1f}, .grain = 0.6f, .material = "oak", .wood = oak(), .seed = 9});
    addWall(glb, {.name = "plaster", .color = {0.40f, 0.46f, 0.44f}, .roughness = 0.95f}, {-7, 5, -1.7f}, {14, 0, 0}, {0, -7, 0});
    return glb;
}

}  // namespace

LODESTIR_SCENE(makeGlobe)

}  // namespace lodestir::generate
