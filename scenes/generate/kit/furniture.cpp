// SPDX-License-Identifier: MIT
// Furniture: see furniture.h.
#include "furniture.h"

#include <array>
#include <cmath>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

#include "cloth.h"
#include "joinery.h"
#include "random.h"
#include "shapes.h"

namespace lodestir::generate {

namespace {

/// A padded block: rounded, its top swollen by `bulge` and its faces eased; UVs on the weave.
Mesh padded(const glm::vec3& size, float radius, float bulge) {
    Mesh mesh = bent(
        roundedBox(size, radius, 3, Axis::x, 7),
        [&](const glm::vec3& p) {
            const glm::vec3 t = glm::clamp(2.0f * p / size, -1.0f, 1.0f);
            const glm::vec3 fall = 1.0f - t * t;
            return p + bulge * glm::vec3(t.x * fall.y * fall.z * 0.5f, t.y * fall.x * fall.z, t.z * fall.x * fall.y * 0.7f);
        },
        70);
    scaleUv(mesh, glm::vec2(1 / weaveSize));
    return mesh;
}

/// A thin roll of cloth along an edge.
Mesh piping(const std::vector<glm::vec3>& path) {
    std::vector<Station> stations;
    for (const glm::vec3& p : path) stations.push_back({p, 0.0045f});
    Mesh mesh = tube(stations, 8);
    scaleUv(mesh, glm::vec2(1 / weaveSize));
    return mesh;
}

glm::mat4 tilted(const glm::vec3& at, float degrees, const glm::vec3& axis) {
    return glm::rotate(glm::translate(glm::mat4(1), at), glm::radians(degrees), axis);
}

}  // namespace

Model diningTable(const Palette& palette, const glm::vec2& size) {
    constexpr float height = 0.74f, thickness = 0.030f;
    Model table{"dining_table", {}};
    // Five boards along z, glued edge to edge with the faintest joints.
    constexpr int boards = 5;
    const float width = size.x / boards;
    for (int i = 0; i < boards; ++i) {
        const float x = (float(i) + 0.5f) * width - size.x / 2;
        table.add(palette.oak,
                  placed(plank({width - 0.0006f, thickness, size.y}, Axis::z, uint32_t(900 + i), 0.0022f), {x, height - thickness / 2, 0}));
    }
    const float inX = size.x / 2 - 0.10f, inZ = size.y / 2 - 0.16f;
    for (float x : {-1.0f, 1.0f}) {
        table.add(palette.oak,
                  placed(plank({0.022f, 0.075f, 2 * inZ}, Axis::z, 911, 0.004f), {x * (inX - 0.005f), height - thickness - 0.0375f, 0}));
        for (float z : {-1.0f, 1.0f})
            table.add(palette.oak, rod({x * (inX + 0.035f), 0, z * (inZ + 0.045f)}, {x * (inX - 0.005f), height - thickness, z * inZ},
                                       0.017f, 0.030f, uint32_t(920 + x + 3 * z)));
    }
    for (float z : {-1.0f, 1.0f})
        table.add(palette.oak, placed(plank({2 * inX, 0.075f, 0.022f}, Axis::x, 913, 0.004f), {0, height - thickness - 0.0375f, z * inZ}));
    return table;
}

Model chair(const Palette& palette) {
    Model chair{"chair", {}};
    constexpr float seat = 0.45f;
    const auto bar = [&](const glm::vec3& from, const glm::vec3& to, float r0, float r1, uint32_t seed) {
        chair.add(palette.oak, rod(from, to, r0, r1, seed));
    };

    for (float x : {-1.0f, 1.0f}) {
        bar({x * 0.215f, 0, -0.215f}, {x * 0.185f, seat - 0.012f, -0.175f}, 0.0115f, 0.018f, uint32_t(30 + x));
        // A back leg and its post are one piece: they lean apart from the seat on.
        bar({x * 0.205f, 0, 0.235f}, {x * 0.178f, seat, 0.185f}, 0.0115f, 0.018f, uint32_t(33 + x));
        bar({x * 0.178f, seat - 0.01f, 0.185f}, {x * 0.200f, 0.79f, 0.262f}, 0.018f, 0.0115f, uint32_t(36 + x));
        bar({x * 0.203f, 0.20f, -0.196f}, {x * 0.194f, 0.24f, 0.208f}, 0.0085f, 0.0085f, uint32_t(39 + x));
    }
    bar({-0.198f, 0.22f, 0.01f}, {0.198f, 0.22f, 0.01f}, 0.0085f, 0.0085f, 42);
    for (float z : {-0.172f, 0.182f})
        chair.add(palette.oak, placed(plank({0.36f, 0.045f, 0.018f}, Axis::x, 43, 0.004f), {0, seat - 0.036f, z}));
    for (float x : {-0.18f, 0.18f})
        chair.add(palette.oak, placed(plank({0.018f, 0.045f, 0.34f}, Axis::z, 44, 0.004f), {x, seat - 0.036f, 0.005f}));

    // Seat: narrower at the back, dished where one sits, its front edge rolled down.
    const Mesh board = bent(
        plank({0.45f, 0.024f, 0.43f}, Axis::z, 45, 0.009f, 9),
        [](const glm::vec3& p) {
            const float x = p.x / 0.225f, z = p.z / 0.215f;
            const float dish = 0.013f * (1 - x * x) * (1 - z * z) + 0.010f * std::max(-z - 0.55f, 0.0f);
            return glm::vec3(p.x * (1 - 0.09f * (z + 1) * 0.5f), p.y - dish, p.z);
        },
        60);
    chair.add(palette.oak, placed(board, {0, seat, -0.005f}));

    // Backrest: one steamed board, curved around the sitter.
    const auto curved = [](float depth, float width) {
        return [=](const glm::vec3& p) {
            const float x = p.x / (width * 0.5f);
            return glm::vec3(p.x, p.y * (1 - 0.12f * x * x), p.z + depth * (1 - x * x));
        };
    };
    chair.add(palette.oak, placed(bent(plank({0.47f, 0.135f, 0.016f}, Axis::x, 46, 0.0075f, 10), curved(0.045f, 0.47f), 60),
                                  tilted({0, 0.735f, 0.236f}, 15, {1, 0, 0})));
    chair.add(palette.oak, placed(bent(plank({0.40f, 0.045f, 0.013f}, Axis::x, 47, 0.006f, 10), curved(0.028f, 0.40f), 60),
                                  tilted({0, 0.580f, 0.205f}, 13, {1, 0, 0})));
    return chair;
}

Model armchair(const Palette& palette) {
    Model chair{"armchair", {}};
    const auto pad = [&](const glm::vec3& size, float radius, float bulge, const glm::mat4& where) {
        chair.add(palette.upholstery, placed(padded(size, radius, bulge), where));
    };
    const auto still = [](const glm::vec3& at) { return glm::translate(glm::mat4(1), at); };
    pad({0.66f, 0.17f, 0.68f}, 0.02f, 0.004f, still({0, 0.245f, 0.0f}));                      // frame
    pad({0.60f, 0.15f, 0.64f}, 0.055f, 0.035f, tilted({0, 0.385f, 0.055f}, -3, {1, 0, 0}));   // seat cushion
    pad({0.76f, 0.58f, 0.15f}, 0.06f, 0.018f, tilted({0, 0.555f, -0.315f}, -13, {1, 0, 0}));  // back
    pad({0.57f, 0.42f, 0.15f}, 0.06f, 0.040f, tilted({0, 0.625f, -0.205f}, -15, {1, 0, 0}));  // back cushion
    for (float x : {-1.0f, 1.0f}) {
        pad({0.115f, 0.30f, 0.70f}, 0.045f, 0.012f, tilted({x * 0.355f, 0.43f, 0.005f}, -x * 3, {0, 0, 1}));  // arms
        chair.add(palette.walnut, rod({x * 0.33f, 0, 0.33f}, {x * 0.295f, 0.18f, 0.295f}, 0.012f, 0.021f, uint32_t(70 + x)));
        chair.add(palette.walnut, rod({x * 0.33f, 0, -0.36f}, {x * 0.295f, 0.18f, -0.30f}, 0.012f, 0.021f, uint32_t(73 + x)));
    }
    const float y = 0.462f, z = 0.368f;
    chair.add(palette.upholstery, piping({{-0.28f, y - 0.045f, z},
                                          {-0.15f, y - 0.041f, z + 0.012f},
                                          {0, y - 0.040f, z + 0.016f},
                                          {0.15f, y - 0.041f, z + 0.012f},
                                          {0.28f, y - 0.045f, z}}));

    Mesh pillow = cushion({0.42f, 0.15f, 0.42f}, 22);
    scaleUv(pillow, glm::vec2(0.42f / weaveSize));
    chair.add(palette.cushion,
              placed(pillow, glm::rotate(tilted({0.10f, 0.625f, -0.075f}, 66, {1, 0, 0}), glm::radians(9.0f), glm::vec3(0, 1, 0))));
    return chair;
}

Model sideTable(const Palette& palette, float radius, float height) {
    Model table{"side_table", {}};
    std::vector<glm::vec2> profile{{0, height}, {radius - 0.012f, height}};
    for (int i = 1; i <= 8; ++i) {
        const float a = 3.14159265f * float(i) / 8;
        profile.push_back({radius - 0.012f + 0.012f * std::sin(a), height - 0.012f + 0.012f * std::cos(a)});
    }
    profile.push_back({radius * 0.9f, height - 0.030f});
    profile.push_back({0, height - 0.030f});
    Mesh top = turned(profile, 72);
    // Planar UVs: the top is cut from boards, not wrapped.
    for (Vertex& v : top.vertices) v.uv = glm::vec2(v.position.x, v.position.z) / glm::vec2(1.2f, 0.6f) + glm::vec2(0.1f, 0.2f);
    table.add(palette.walnut, top);
    for (int i = 0; i < 3; ++i) {
        const float a = 6.2831853f * (float(i) + 0.15f) / 3;
        const glm::vec3 out(std::cos(a), 0, std::sin(a));
        table.add(palette.walnut,
                  rod(out * radius * 0.88f, out * radius * 0.52f + glm::vec3(0, height - 0.025f, 0), 0.011f, 0.019f, uint32_t(80 + i)));
    }
    return table;
}

Model pendantLamp(const Palette& palette, float drop) {
    Model lamp{"pendant_lamp", {}};
    const Station cord[] = {{{0, -0.01f, 0}, 0.003f}, {{0, -drop * 0.5f, 0}, 0.003f}, {{0, -drop + 0.02f, 0}, 0.003f}};
    lamp.add(palette.blackMetal, tube(cord, 8));
    const glm::vec2 rose[] = {{0, 0}, {0.05f, 0}, {0.05f, -0.012f}, {0.042f, -0.024f}, {0.008f, -0.030f}, {0.004f, -0.034f}, {0, -0.034f}};
    lamp.add(palette.blackMetal, turned(rose, 40));

    // Spun dome: outside in black, inside enamelled white, a hair apart so that neither shows through.
    const glm::vec2 dome[] = {{0.016f, 0.050f},  {0.022f, 0.030f},  {0.040f, 0.012f}, {0.100f, -0.020f},
                              {0.165f, -0.085f}, {0.198f, -0.165f}, {0.205f, -0.200f}};
    std::vector<glm::vec2> outer = smoothCurve(dome, 5), inner;
    for (auto p = outer.rbegin(); p != outer.rend(); ++p)
        if (p->y < 0.006f) inner.push_back({std::max(p->x - 0.003f, 0.0f), p->y - 0.002f});
    inner.front() = {0.2025f, -0.2015f};
    inner.push_back({0, 0.0f});
    outer.push_back({0.2045f, -0.2018f});
    outer.push_back(inner.front());
    outer.insert(outer.begin(), {0, 0.052f});
    const glm::mat4 hang = glm::translate(glm::mat4(1), glm::vec3(0, -drop, 0));
    lamp.add(palette.blackMetal, placed(turned(outer, 72, 60), hang));
    lamp.add(palette.enamel, placed(turned(inner, 72, 60), hang));
    const glm::vec2 socket[] = {{0, 0.0f}, {0.020f, -0.001f}, {0.020f, -0.055f}, {0.014f, -0.060f}, {0, -0.060f}};
    lamp.add(palette.brass, placed(turned(socket, 28), hang));
    lamp.add(palette.bulb, placed(sphere(24, 14), glm::scale(glm::translate(hang, glm::vec3(0, -0.092f, 0)), glm::vec3(0.036f))));
    return lamp;
}

Model floorLamp(const Palette& palette) {
    Model lamp{"floor_lamp", {}};
    const glm::vec2 base[] = {{0, 0.026f},      {0.012f, 0.026f}, {0.016f, 0.022f}, {0.118f, 0.014f},
                              {0.128f, 0.009f}, {0.130f, 0.003f}, {0.128f, 0},      {0, 0}};
    lamp.add(palette.brass, turned(base, 56));
    const Station pole[] = {{{0, 0.02f, 0}, 0.008f}, {{0, 0.7f, 0}, 0.008f}, {{0, 1.32f, 0}, 0.008f}};
    lamp.add(palette.brass, tube(pole, 16));
    const glm::vec2 socket[] = {{0, 1.36f}, {0.016f, 1.36f}, {0.016f, 1.31f}, {0, 1.31f}};
    lamp.add(palette.brass, turned(socket, 24));
    lamp.add(palette.bulb, placed(sphere(24, 14), glm::scale(glm::translate(glm::mat4(1), glm::vec3(0, 1.395f, 0)), glm::vec3(0.036f))));

    // The drum is open above and below; its wall is a thin sleeve of cloth with wire rims.
    const glm::vec2 sleeve[] = {{0.165f, 1.55f}, {0.205f, 1.25f}, {0.2035f, 1.2495f}, {0.1635f, 1.5495f}, {0.165f, 1.55f}};
    Mesh drum = turned(sleeve, 72, 30);
    scaleUv(drum, {1.16f / weaveSize, 0.61f / weaveSize});
    lamp.add(palette.shade, drum);
    for (const auto& [radius, y] : {std::pair{0.1643f, 1.55f}, std::pair{0.2043f, 1.25f}}) {
        std::vector<glm::vec2> wire;
        for (int i = 0; i <= 8; ++i)
            wire.push_back(
                {radius + 0.0025f * std::sin(6.2831853f * float(i % 8) / 8), y + 0.0025f * std::cos(6.2831853f * float(i % 8) / 8)});
        lamp.add(palette.brass, turned(wire, 72, 180));
    }
    for (int i = 0; i < 3; ++i) {
        const float a = 6.2831853f * float(i) / 3;
        const Station spoke[] = {{{0, 1.34f, 0}, 0.002f}, {{0.188f * std::cos(a), 1.36f, 0.188f * std::sin(a)}, 0.002f}};
        lamp.add(palette.brass, tube(spoke, 6));
    }
    return lamp;
}

Model pictureFrame(const std::string& name, const Palette& palette, const glm::vec2& size, float mat, int frame, int art) {
    constexpr float moulding = 0.024f, depth = 0.026f;
    Model picture{name, {}};
    for (float side : {-1.0f, 1.0f}) {
        picture.add(frame, placed(plank({size.x, moulding, depth}, Axis::x, 50, 0.003f), {0, side * (size.y - moulding) / 2, depth / 2}));
        picture.add(frame, placed(plank({moulding, size.y - 2 * moulding, depth}, Axis::y, 51, 0.003f),
                                  {side * (size.x - moulding) / 2, 0, depth / 2}));
    }
    const glm::vec2 inner = size - 2 * moulding + 0.002f, window = inner - 2 * mat;
    if (mat > 0) {
        // A bevel-cut mat: four boards around the window, a millimetre before the art.
        const float z = 0.012f;
        const auto strip = [&](const glm::vec2& centre, const glm::vec2& extent) {
            picture.add(palette.paper, placed(roundedBox({extent.x, extent.y, 0.0016f}, 0.0006f, 1), {centre.x, centre.y, z}));
        };
        for (float side : {-1.0f, 1.0f}) {
            strip({0, side * (inner.y - mat) / 2}, {inner.x, mat});
            strip({side * (inner.x - mat) / 2, 0}, {mat, window.y});
        }
    }
    picture.add(art, rectangle({-window.x / 2, window.y / 2, 0.0105f}, {window.x, 0, 0}, {0, -window.y, 0}));
    return picture;
}

}  // namespace lodestir::generate
