// SPDX-License-Identifier: MIT
// Levels of detail: what may move and what must stay, and errors with known answers.
#include "lod_surface.h"

#include <framework/scene/lod/chain.h>
#include <framework/scene/lod/vertex_fit.h>
#include <framework/scene/lod/simplify.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace lodestir {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// A sphere with the usual chart: a seam and two poles of many wedges.
MeshLevel charted(int columns, int rows) {
    return gridSurface(columns, rows, [&](float u, float v) {
        const float phi = u == 1 ? 0 : u * 2 * pi, theta = v * pi, r = v == 0 || v == 1 ? 0 : std::sin(theta);
        return glm::vec3(r * std::sin(phi), v == 0 ? 1 : v == 1 ? -1 : std::cos(theta), r * std::cos(phi));
    });
}

/// A hilly sheet: the steepest slope is about 0.5.
MeshLevel hills(int cells) {
    return gridSurface(cells, cells, [](float u, float v) {
        return glm::vec3(4 * u, 0.15f * std::sin(9 * u) * std::cos(7 * v) + 0.03f * std::sin(40 * u + 3 * v), 4 * v);
    });
}

/// Where the finest level has this UV; nothing when it has not.
std::vector<glm::vec3> pointsAt(const MeshLevel& level, glm::dvec2 uv) {
    std::vector<glm::vec3> points;
    for (const glm::uvec3& t : level.triangles) {
        const glm::dvec2 a(level.uv0[t.x]), e = glm::dvec2(level.uv0[t.y]) - a, f = glm::dvec2(level.uv0[t.z]) - a, p = uv - a;
        const double area = e.x * f.y - e.y * f.x, x = (p.x * f.y - p.y * f.x) / area, y = (e.x * p.y - e.y * p.x) / area;
        if (area != 0 && x >= -1e-6 && y >= -1e-6 && x + y <= 1 + 1e-6)
            points.push_back(level.positions[t.x] * float(1 - x - y) + level.positions[t.y] * float(x) + level.positions[t.z] * float(y));
    }
    return points;
}

// If this fails, what is flat costs triangles, or its texture slides.
TEST(LodChain, APlaneKeepsItsShapeAndItsTexture) {
    const MeshLevel plane = gridSurface(32, 32, [](float u, float v) { return glm::vec3(3 * u + v, 2 * v, u - v); });
    const LodChain chain = buildLodChain(plane, {.levels = 5, .ratio = 4});
    ASSERT_EQ(chain.coarser.size(), 4u) << chain.end;
    EXPECT_TRUE(chain.hasUvs);
    for (std::size_t k = 0; k < 4; ++k) {
        const LodLevel& level = chain.coarser[k];
        EXPECT_LE(level.triangles.size(), 2048u >> (2 * k + 2));
        EXPECT_LT(level.error, 2e-6f);
        EXPECT_LT(level.measured.uvLargest, 2e-6f);
        EXPECT_EQ(level.measured.uvLostFinest, 0);
        EXPECT_EQ(level.measured.uvLostCoarse, 0);
    }
}

// If this fails, errors are not what they say: an octahedron's faces are 1 / sqrt(3) from the middle of its sphere.
TEST(LodError, OfAnOctahedronInItsSphere) {
    const MeshLevel sphere = octahedralSphere(5);
    const LodError error = LodReference(sphere).measure(octahedralSphere(0).triangles);
    const float expected = 1 - 1 / std::sqrt(3.0f);
    EXPECT_NEAR(error.toFinest, expected, 0.01f * expected);
    EXPECT_NEAR(error.fromFinest, expected, 0.01f * expected);
}

// The farthest that a chord gets from a sphere is one less the distance of its nearest point from the middle.
TEST(LodChain, ErrorsOfASphereAreThoseOfItsChords) {
    const MeshLevel sphere = octahedralSphere(5);
    const LodChain chain = buildLodChain(sphere, {.levels = 4, .ratio = 4});
    ASSERT_EQ(chain.coarser.size(), 3u) << chain.end;
    EXPECT_FALSE(chain.hasUvs);
    EXPECT_NEAR(chain.radius, 1, 1e-6f);
    for (const LodLevel& level : chain.coarser) {
        const auto analytic = 1 - float(TriangleTree(sphere.positions, level.triangles).distance(glm::dvec3(0)));
        EXPECT_NEAR(level.error, analytic, 0.04f * analytic + 1e-3f) << level.triangles.size();
    }
    for (const auto& [edge, uses] : edgeUses(sphere, chain.coarser.back().triangles)) EXPECT_EQ(uses, 2);
}

// If this fails, one side is not looked at: a hole is far from the finest level alone, a spike from the coarse one alone.
TEST(LodError, SeesHolesAndSpikesFromTheRightSide) {
    MeshLevel sheet = gridSurface(16, 16, [](float u, float v) { return glm::vec3(16 * u, 0, 16 * v); });
    sheet.positions.push_back({8, 3, 8});
    sheet.uv0.push_back({0.5f, 0.5f});
    const LodReference reference(sheet);
    EXPECT_NEAR(reference.measure(sheet.triangles).largest(), 0, 1e-6f);

    std::vector<glm::uvec3> holed;
    for (const glm::uvec3& t : sheet.triangles) {
        const glm::vec3 middle = (sheet.positions[t.x] + sheet.positions[t.y] + sheet.positions[t.z]) / 3.0f;
        if (std::abs(middle.x - 8) > 2 || std::abs(middle.z - 8) > 2) holed.push_back(t);
    }
    const LodError hole = reference.measure(holed);
    EXPECT_NEAR(hole.fromFinest, 2, 1e-5f);
    EXPECT_NEAR(hole.toFinest, 0, 1e-6f);
    EXPECT_NEAR(hole.uvLostFinest, 16.0f / 256, 0.003f);
    EXPECT_EQ(hole.uvLostCoarse, 0);

    std::vector<glm::uvec3> spiked = sheet.triangles;
    spiked.push_back({spiked[0].x, spiked[0].y, std::uint32_t(sheet.positions.size() - 1)});
    const LodError spike = reference.measure(spiked);
    EXPECT_NEAR(spike.toFinest, 3, 1e-5f);
    EXPECT_NEAR(spike.fromFinest, 0, 1e-6f);
}

// If this fails, paths that are mapped by UV arrive elsewhere.
TEST(LodChain, PointsOfOneUvStayTogether) {
    const MeshLevel finest = hills(64);
    const LodChain chain = buildLodChain(finest, {.levels = 5, .ratio = 2});
    ASSERT_EQ(chain.coarser.size(), 4u) << chain.end;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit;
    for (const LodLevel& level : chain.coarser) {
        for (int i = 0; i < 300; ++i) {
            const glm::uvec3 t = level.triangles[random() % level.triangles.size()];
            double x = unit(random), y = unit(random);
            if (x + y > 1) x = 1 - x, y = 1 - y;
            const auto mix = [&](const auto& values) {
                return values[t.x] * float(1 - x - y) + values[t.y] * float(x) + values[t.z] * float(y);
            };
            const std::vector<glm::vec3> matches = pointsAt(finest, glm::dvec2(mix(finest.uv0)));
            ASSERT_FALSE(matches.empty()) << "a UV of the coarse level that the finest does not have";
            EXPECT_LE(glm::distance(matches[0], mix(finest.positions)), 1.05f * level.measured.uvLargest);
        }
        EXPECT_LT(level.measured.uvLargest, 1.5f * level.error + 1e-6f) << "the texture moves farther than the surface";
        EXPECT_EQ(level.measured.uvLostCoarse, 0);
        EXPECT_EQ(level.measured.uvLostFinest, 0);
        for (const glm::uvec3& t : level.triangles) EXPECT_LT(uvAreaOf(finest, t), 0) << "a fold";
    }
}

// UVs that run unevenly over a plane: shape alone would let them slide freely.
TEST(LodChain, TextureHoldsWhatShapeWouldLetGo) {
    MeshLevel sheet = gridSurface(48, 48, [](float u, float v) { return glm::vec3(u, 0, v); });
    for (glm::vec2& uv : sheet.uv0) uv = {uv.x + 0.1f * std::sin(6 * uv.y), uv.y * uv.y * 0.7f + 0.3f * uv.y};
    const LodChain chain = buildLodChain(sheet, {.levels = 3, .ratio = 4});
    ASSERT_EQ(chain.coarser.size(), 2u);
    EXPECT_LT(chain.coarser[0].measured.distance(), 1e-6f);
    EXPECT_LT(chain.coarser[0].measured.uvLargest, 0.01f);
    EXPECT_GT(chain.coarser[0].error, 0) << "a texture that slides is seen";
    EXPECT_LE(chain.coarser[0].error, 1.05f * chain.coarser[0].measured.uvLargest);
    EXPECT_LT(chain.coarser[1].measured.uvLargest, 0.03f);
    EXPECT_LT(chain.coarser[1].measured.uvLostFinest, 0.01f);
}

// If this fails, charts tear apart, or a border of a chart wanders into another's texture.
TEST(LodChain, SeamsAndPolesStayClosed) {
    const MeshLevel sphere = charted(64, 32);
    const LodChain chain = buildLodChain(sphere, {.levels = 4, .ratio = 2});
    ASSERT_EQ(chain.coarser.size(), 3u) << chain.end;
    for (const LodLevel& level : chain.coarser) {
        for (const auto& [edge, uses] : edgeUses(sphere, level.triangles)) EXPECT_EQ(uses, 2);
        for (const glm::uvec3& t : level.triangles) EXPECT_LT(uvAreaOf(sphere, t), 0);
        EXPECT_LT(level.measured.uvLostFinest, 0.02f) << "the chart's corners at the poles";
    }
}

// Two halves that wear the same half of a texture, joined by vertices that they share.
TEST(LodChain, MirroredHalvesMeetOnTheirLine) {
    MeshLevel body = gridSurface(32, 32, [](float u, float v) {
        const float x = 2 * u - 1;
        return glm::vec3(x, 0.6f * (1 - x * x) * std::sin(3 * v) + 0.05f * std::cos(9 * x * x + 8 * v), 2 * v);
    });
    for (glm::vec2& uv : body.uv0) uv.x = std::abs(2 * uv.x - 1);
    const auto outer = [](const std::vector<float>& e) {
        return (std::abs(e[0]) == 1 && e[0] == e[3]) || (e[2] == 0 && e[5] == 0) || (e[2] == 2 && e[5] == 2);
    };
    const LodChain chain = buildLodChain(body, {.levels = 4, .ratio = 2});
    ASSERT_EQ(chain.coarser.size(), 3u) << chain.end;
    for (const LodLevel& level : chain.coarser) {
        for (const glm::uvec3& t : level.triangles) {
            float low = 1, high = -1;
            for (int k = 0; k < 3; ++k) low = std::min(low, body.positions[t[k]].x), high = std::max(high, body.positions[t[k]].x);
            EXPECT_GE(low * high, 0) << "a triangle across the line";
            EXPECT_EQ(uvAreaOf(body, t) > 0, high <= 0) << "mirrored the wrong way";
        }
        for (const auto& [edge, uses] : edgeUses(body, level.triangles)) EXPECT_EQ(uses, outer(edge) ? 1 : 2);
        EXPECT_EQ(level.measured.uvLostFinest, 0);
    }
}

// If this fails, a flat-shaded box cannot be simplified at all, or is shaded round.
TEST(LodChain, HardEdgesMoveAndKeepTheirNormals) {
    MeshLevel box;
    for (int face = 0; face < 6; ++face) {
        const auto turned = [&](glm::vec3 p) {
            if (face & 1) p = {-p.x, p.y, -p.z};
            return face < 2 ? p : face < 4 ? glm::vec3(p.y, p.z, p.x) : glm::vec3(p.z, p.x, p.y);
        };
        const MeshLevel side = gridSurface(8, 8, [&](float u, float v) { return turned({2 * u - 1, 1 - 2 * v, 1}); });
        const auto base = std::uint32_t(box.positions.size());
        for (const glm::uvec3& t : side.triangles) box.triangles.push_back(t + base);
        box.positions.insert(box.positions.end(), side.positions.begin(), side.positions.end());
        box.uv0.insert(box.uv0.end(), side.uv0.begin(), side.uv0.end());  // all six faces wear the whole picture
        box.normals.insert(box.normals.end(), side.positions.size(), turned({0, 0, 1}));
    }
    box.materials.assign(box.triangles.size(), 0);
    Simplifier simplifier(box);
    simplifier.reduce(0);
    const Simplified smallest = simplifier.result();
    EXPECT_EQ(smallest.triangles.size(), 12u);
    for (const glm::uvec3& t : smallest.triangles) {
        EXPECT_EQ(box.normals[t.x], box.normals[t.y]);
        EXPECT_EQ(box.normals[t.x], box.normals[t.z]);
    }
    const LodError error = LodReference(box).measure(smallest.triangles);
    EXPECT_LT(error.largest(), 1e-6f);
    EXPECT_LT(error.uvLargest, 1e-5f) << "of six points of one UV the nearest counts";
}

// If this fails, one material spreads over another's part.
TEST(LodChain, MaterialsKeepTheirParts) {
    MeshLevel sheet = gridSurface(24, 24, [](float u, float v) { return glm::vec3(u, 0.1f * std::sin(12 * u * v), v); });
    for (std::size_t t = 0; t < sheet.triangles.size(); ++t) {
        const glm::vec3 middle =
            (sheet.positions[sheet.triangles[t].x] + sheet.positions[sheet.triangles[t].y] + sheet.positions[sheet.triangles[t].z]) / 3.0f;
        sheet.materials[t] = middle.x < 0.5f ? 3 : 8;
    }
    const LodChain chain = buildLodChain(sheet, {.levels = 3, .ratio = 4});
    ASSERT_EQ(chain.coarser.size(), 2u);
    const LodLevel& level = chain.coarser.back();
    for (std::size_t t = 0; t < level.triangles.size(); ++t)
        for (int k = 0; k < 3; ++k) {
            const float x = sheet.positions[level.triangles[t][k]].x;
            EXPECT_TRUE(level.groups[t] == 3 ? x <= 0.5f : x >= 0.5f);
        }
}

// Separate little squares, far apart: a triangle for each is half the picture, though it is close enough in space.
TEST(LodChain, ALevelThatLosesUvsIsNotMade) {
    MeshLevel labels;
    for (int i = 0; i < 40; ++i) {
        const MeshLevel label = gridSurface(1, 1, [&](float u, float v) { return glm::vec3(20 * i + u, v, 0); });
        for (const glm::uvec3& t : label.triangles) labels.triangles.push_back(t + std::uint32_t(labels.positions.size()));
        labels.positions.insert(labels.positions.end(), label.positions.begin(), label.positions.end());
        for (const glm::vec2& uv : label.uv0) labels.uv0.push_back({(float(i) + uv.x) / 40, uv.y});
    }
    labels.materials.assign(labels.triangles.size(), 0);
    const LodChain chain = buildLodChain(labels, {});
    EXPECT_EQ(chain.coarser.size(), 0u);
    EXPECT_NE(chain.end.find("50 % of its UVs would have no partner"), std::string::npos) << chain.end;
}

/// Mean colour over the area of triangles.
glm::dvec4 meanColor(const MeshLevel& level, const std::vector<glm::uvec3>& triangles, const std::vector<glm::vec4>& colors) {
    glm::dvec4 sum(0);
    double total = 0;
    for (const glm::uvec3& t : triangles) {
        const glm::dvec3 a(level.positions[t.x]);
        const double area = glm::length(glm::cross(glm::dvec3(level.positions[t.y]) - a, glm::dvec3(level.positions[t.z]) - a));
        sum += area / 3 * (glm::dvec4(colors[t.x]) + glm::dvec4(colors[t.y]) + glm::dvec4(colors[t.z]));
        total += area;
    }
    return sum / total;
}

/// A flat sheet of side 1 with vertex colours.
MeshLevel painted(int cells, const std::function<glm::vec4(float u, float v)>& color) {
    MeshLevel sheet = gridSurface(cells, cells, [](float u, float v) { return glm::vec3(u, 0, v); });
    for (const glm::vec2& uv : sheet.uv0) sheet.colors.push_back(color(uv.x, uv.y));
    sheet.uv0.clear();
    return sheet;
}

// If this fails, a difference that is seen is no error: black for white is a 32nd of the diagonal off, a turn of normals by 60 degrees a 3000th.
TEST(LodError, CountsColoursAndNormalsAsLengths) {
    MeshLevel sheet = painted(8, [](float, float) { return glm::vec4(0, 0, 0, 1); });
    const auto diagonal = std::sqrt(2.0f);
    const LodReference black(sheet);
    EXPECT_LT(black.measure(sheet.triangles, {sheet.colors, {}}).largest(), 1e-6f);
    EXPECT_NEAR(black.measure(sheet.triangles, {std::vector(sheet.colors.size(), glm::vec4(1, 0, 0, 1)), {}}).largest(), diagonal / 32, 1e-6f);
    EXPECT_NEAR(black.measure(sheet.triangles, {std::vector(sheet.colors.size(), glm::vec4(0, 0, 0, 0.5f)), {}}).appearance, diagonal / 64, 1e-6f);
    EXPECT_EQ(black.measure(sheet.triangles, {std::vector(sheet.colors.size(), glm::vec4(1)), {}}).distance(), 0);

    // The same sheet a second time, with other normals, is not of the finest level.
    sheet.colors.clear();
    const auto count = std::uint32_t(sheet.positions.size());
    std::vector<glm::uvec3> turned;
    for (const glm::uvec3& t : sheet.triangles) turned.push_back(t + count);
    sheet.positions.insert(sheet.positions.end(), sheet.positions.begin(), sheet.positions.begin() + count);
    sheet.normals.assign(count, {0, 1, 0});
    sheet.normals.resize(2 * count, {std::sin(pi / 3), std::cos(pi / 3), 0});
    EXPECT_NEAR(LodReference(sheet).measure(turned).largest(), diagonal / 3000, 1e-6f);
}

// What lies elsewhere is as far as it is: a line between black and white that moved by a hundredth is no more wrong than that.
TEST(LodError, APatternThatMovedIsAsFarAsItMoved) {
    const MeshLevel sheet = painted(200, [](float u, float) { return glm::vec4(glm::vec3(u < 0.5f ? 0 : 1), 1); });
    std::vector<glm::vec4> moved = sheet.colors;
    for (std::size_t v = 0; v < moved.size(); ++v) moved[v] = glm::vec4(glm::vec3(sheet.positions[v].x < 0.51f ? 0 : 1), 1);
    const float appearance = LodReference(sheet).measure(sheet.triangles, {moved, {}}).appearance;
    EXPECT_LT(appearance, 0.0101f);
    EXPECT_GT(appearance, 0.005f);
}

// If this fails, what is flat loses its picture: shape alone would let any vertex go.
TEST(LodChain, ColoursHoldWhatShapeWouldLetGo) {
    const auto shade = [](float u, float v) {
        const float spot = std::hypot(u - 0.3f, v - 0.6f) < 0.2f ? 1.0f : 0.0f;
        return glm::vec4(spot, 0.2f, 1 - spot, 1);
    };
    const MeshLevel sheet = painted(48, shade);
    const LodChain chain = buildLodChain(sheet, {.levels = 4, .ratio = 2});
    ASSERT_EQ(chain.coarser.size(), 3u) << chain.end;
    const glm::dvec4 mean = meanColor(sheet, sheet.triangles, sheet.colors);
    for (const LodLevel& level : chain.coarser) {
        EXPECT_LT(level.measured.distance(), 1e-6f);
        EXPECT_GE(level.error, level.measured.appearance);
        EXPECT_LT(level.measured.appearance, 0.005f) << "a ninth of what losing the spot costs";
        for (int c = 0; c < 4; ++c) EXPECT_NEAR(meanColor(sheet, level.triangles, level.looks.colors)[c], mean[c], 2e-3) << level.triangles.size();
    }
}

// Where colours are linear there is nothing to average: each vertex keeps its own.
TEST(LodColors, KeepWhatIsLinear) {
    const MeshLevel sheet = painted(32, [](float u, float v) { return glm::vec4(u, 0.5f * v + 0.25f, 0.3f * u + 0.4f * v, 1 - u); });
    const LodChain chain = buildLodChain(sheet, {.levels = 3, .ratio = 4});
    ASSERT_EQ(chain.coarser.size(), 2u) << chain.end;
    for (const LodLevel& level : chain.coarser) {
        EXPECT_LT(level.error, 1e-5f);
        for (const glm::uvec3& t : level.triangles)
            for (int k = 0; k < 3; ++k)
                for (int c = 0; c < 4; ++c) EXPECT_NEAR(level.looks.colors[t[k]][c], sheet.colors[t[k]][c], 1e-4f);
    }
}

// If this fails, levels drift in colour: vertices that happen to be left speak for all that went.
TEST(LodColors, AverageNoise) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit;
    const MeshLevel sheet = painted(64, [&](float u, float) { return glm::vec4(unit(random) < 0.3f + 0.4f * u ? 0.9f : 0.1f, unit(random), 0.5f, 1); });
    std::vector<glm::uvec3> coarse;  // every eighth vertex
    for (std::uint32_t y = 0; y < 64; y += 8)
        for (std::uint32_t x = 0; x < 64; x += 8) {
            const std::uint32_t a = y * 65 + x;
            coarse.push_back({a, a + 8 * 65 + 8, a + 8});
            coarse.push_back({a, a + 8 * 65, a + 8 * 65 + 8});
        }
    const std::vector<glm::vec4> colors = fitVertices(sheet, coarse, std::vector<std::uint32_t>(coarse.size(), 0)).colors;
    const glm::dvec4 mean = meanColor(sheet, sheet.triangles, sheet.colors), kept = meanColor(sheet, coarse, colors);
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(kept[c], mean[c], 1e-3);
    EXPECT_GT(std::abs(meanColor(sheet, coarse, sheet.colors)[0] - mean[0]), 5e-3) << "the vertices that are left would do, and the test asks nothing";
    double spread = 0;
    for (const glm::uvec3& t : coarse) spread = std::max<double>(spread, std::abs(colors[t.x].r - (0.34f + 0.32f * sheet.positions[t.x].x)));
    EXPECT_LT(spread, 0.25) << "the mean of 0.1 and 0.9 by their chances, from some 100 vertices";
}

// A leaf that is red on one side and green on the other, a thousandth thick: what is near is not all on one side.
TEST(LodColors, SidesKeepTheirOwn) {
    MeshLevel leaf = painted(16, [](float, float) { return glm::vec4(1, 0, 0, 1); });
    const auto count = std::uint32_t(leaf.positions.size());
    leaf.normals.assign(count, {0, -1, 0});
    for (std::size_t t = 0, n = leaf.triangles.size(); t < n; ++t)
        leaf.triangles.push_back(glm::uvec3(leaf.triangles[t].x, leaf.triangles[t].z, leaf.triangles[t].y) + count);
    for (std::uint32_t v = 0; v < count; ++v) leaf.positions.push_back(leaf.positions[v] + glm::vec3(0, 1e-3f, 0));
    leaf.normals.resize(2 * count, {0, 1, 0});
    leaf.colors.resize(2 * count, {0, 1, 0, 1});
    leaf.materials.assign(leaf.triangles.size(), 0);
    const std::vector<glm::vec4> colors = fitVertices(leaf, leaf.triangles, leaf.materials).colors;
    for (std::uint32_t v = 0; v < 2 * count; ++v) EXPECT_NEAR(colors[v].r, v < count ? 1 : 0, 1e-4f);
}

double degreesBetween(const glm::vec3& a, const glm::vec3& b) {
    return glm::degrees(std::acos(std::clamp(double(glm::dot(a, b)) / (glm::length(a) * glm::length(b)), -1.0, 1.0)));
}

// If this fails, smooth things get dents: the mean over what a vertex stands for isn't its normal, unless it lies in the middle of it.
TEST(LodNormals, KeepWhatIsSmooth) {
    MeshLevel bowl = gridSurface(64, 64, [](float u, float v) { return glm::vec3(u, v, (u - 0.5f) * (u - 0.5f) + (v - 0.5f) * (v - 0.5f)); });
    const auto normalOf = [&](std::uint32_t v) {
        return glm::normalize(glm::vec3(1 - 2 * bowl.positions[v].x, 1 - 2 * bowl.positions[v].y, 1));
    };
    for (std::uint32_t v = 0; v < bowl.positions.size(); ++v) bowl.normals.push_back(normalOf(v));
    const LodChain chain = buildLodChain(bowl, {.levels = 4, .ratio = 2});
    ASSERT_EQ(chain.coarser.size(), 3u) << chain.end;
    for (const LodLevel& level : chain.coarser) {
        double largest = 0;
        for (const glm::uvec3& t : level.triangles)
            for (int k = 0; k < 3; ++k) largest = std::max(largest, degreesBetween(level.looks.normals[t[k]], normalOf(t[k])));
        std::printf("bowl, %zu triangles: normals turn by %.2f degrees at most\n", level.triangles.size(), largest);
        EXPECT_LT(largest, 1.5);
    }
}

// If this fails, a bump that isn't there any more still turns a whole slope: vertices that happen to be left speak for all that went.
TEST(LodNormals, AverageBumps) {
    std::mt19937 random(5);
    std::normal_distribution<float> tilt(0, 0.3f);
    MeshLevel sheet = gridSurface(64, 64, [](float u, float v) { return glm::vec3(u, 0, v); });
    for (std::size_t v = 0; v < sheet.positions.size(); ++v) sheet.normals.push_back(glm::normalize(glm::vec3(tilt(random), 1, tilt(random))));
    const auto spread = [&](const LodChain& chain) {
        double sum = 0;
        const auto& [triangles, groups, looks, error, measured] = chain.coarser.back();
        for (const glm::uvec3& t : triangles) sum += std::pow(degreesBetween(looks.normals[t.x], {0, 1, 0}), 2) / double(triangles.size());
        return std::sqrt(sum);
    };
    const double kept = spread(buildLodChain(sheet, {.levels = 4, .ratio = 2, .fitNormals = false}));
    const double fitted = spread(buildLodChain(sheet, {.levels = 4, .ratio = 2}));
    std::printf("bumps: normals lie %.1f degrees about the mean where they are kept, %.1f where they are fitted\n", kept, fitted);
    EXPECT_GT(kept, 15);
    EXPECT_LT(fitted, 0.6 * kept) << "a mean of the eight that went into one would have 0.35 of it, least squares, which keep slopes, about 0.54";
}

// A box keeps its edges: what meets there are two normals, and neither is of the other's side.
TEST(LodNormals, HardEdgesStay) {
    MeshLevel roof = gridSurface(32, 32, [](float u, float v) { return glm::vec3(0.5f * u, 0.5f * u, v); });
    const auto count = std::uint32_t(roof.positions.size());
    const MeshLevel other = gridSurface(32, 32, [](float u, float v) { return glm::vec3(0.5f + 0.5f * u, 0.5f - 0.5f * u, v); });
    for (const glm::uvec3& t : other.triangles) roof.triangles.push_back(t + count);
    roof.positions.insert(roof.positions.end(), other.positions.begin(), other.positions.end());
    roof.uv0.clear();
    roof.materials.assign(roof.triangles.size(), 0);
    const glm::vec3 left = glm::normalize(glm::vec3(-1, 1, 0)), right = glm::normalize(glm::vec3(1, 1, 0));
    roof.normals.assign(count, left);
    roof.normals.resize(2 * count, right);
    const LodChain chain = buildLodChain(roof, {.levels = 3, .ratio = 4});
    ASSERT_EQ(chain.coarser.size(), 2u) << chain.end;
    for (const LodLevel& level : chain.coarser)
        for (const glm::uvec3& t : level.triangles)
            for (int k = 0; k < 3; ++k) EXPECT_LT(degreesBetween(level.looks.normals[t[k]], t[k] < count ? left : right), 0.5);
}

// Where triangles meet in one place with other opacities, they are as apart as where colours differ.
TEST(LodWedges, OpacityParts) {
    MeshLevel pair;
    pair.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    pair.colors.assign(6, glm::vec4(1));
    pair.triangles = {{0, 1, 2}, {3, 4, 5}};
    pair.materials = {0, 0};
    EXPECT_EQ(Wedges(pair).positions.size(), 4u);
    for (std::size_t v = 3; v < 6; ++v) pair.colors[v].a = 0.5f;
    EXPECT_EQ(Wedges(pair).positions.size(), 6u);
}

TEST(LodChain, SaysWhyItEndsEarly) {
    const MeshLevel tiny = octahedralSphere(0);
    const LodChain few = buildLodChain(tiny, {.levels = 4, .ratio = 4});
    EXPECT_LT(few.coarser.size(), 3u);
    EXPECT_FALSE(few.end.empty());
    MeshLevel triangle;
    triangle.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    triangle.triangles = {{0, 1, 2}};
    triangle.materials = {0};
    EXPECT_EQ(buildLodChain(triangle, {}).coarser.size(), 0u);
    MeshLevel broken = triangle;
    broken.positions[0].x = std::nanf("");
    EXPECT_EQ(buildLodChain(broken, {}).coarser.size(), 0u);
}

// At coverage c of a 16:9 image of 1080 rows, the sphere is 1080 sqrt(c 16/9 4/pi) rows high; the next level's error is then one row.
TEST(LodChain, CoveragesPutTheNextErrorAtAPixel) {
    LodChain chain{.radius = 2};
    chain.coarser = {{.error = 0}, {.error = 0.01f}, {.error = 0.1f}};
    const std::vector<float> coverages = screenCoverages(chain);
    ASSERT_EQ(coverages.size(), 4u);
    EXPECT_EQ(coverages[0], 1);
    EXPECT_NEAR(1080 * std::sqrt(coverages[1] * 16 / 9 * 4 / pi) * 0.01f / 4, 1, 1e-4f);
    EXPECT_NEAR(1080 * std::sqrt(coverages[2] * 16 / 9 * 4 / pi) * 0.1f / 4, 1, 1e-4f);
    EXPECT_EQ(coverages[3], 0);
}

}  // namespace
}  // namespace lodestir
