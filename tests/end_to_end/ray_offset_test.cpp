// SPDX-License-Identifier: MIT
// Rays that leave surfaces: small things on large ground keep their shadows, and nothing shades itself, at any size, place and transform.
#include "model.h"
#include "program.h"
#include "render.h"

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace lodestir::test {
namespace {

constexpr double albedo = 0.8;

class RayOffsets : public ProgramTest {
protected:
    /// The scene lit by a sun of irradiance 1 that shines along `sun`, by direct light alone.
    ImageData render(const std::string& name, const View& view, const Point& sun, int width, int height) {
        writeScene(folder, name, view, constantEnvironment(Point(0)),
                   OrderedJson::array({OrderedJson{{"type", "directional"}, {"direction", toJson(sun)}, {"intensity", 1}}}));
        const Path graph = writeGraph(folder, name, width, height, {{"spp", 1}, {"bounces", 1}, {"film", "centre"}});
        const std::vector<ImageData> images = test::render(graph, "trace", 1);
        return images.empty() ? ImageData{} : images[0];
    }
};

// A plate one unit above ground, the sun from 45 degrees: its shadow is as black on ground ten million times as wide.
TEST_F(RayOffsets, SmallThingsOnLargeGroundKeepTheirShadows) {
    const Paint paint{.color = Point(albedo)};
    for (const double unit : {1e-3, 0.02, 1.0, 1e3, 1e6}) {
        for (const double width : {20.0, 1e3, 1e5, 1e7}) {
            SCOPED_TRACE(fmt::format("unit {}, ground {} units wide", unit, width));
            const double half = 0.5 * width * unit;
            writeModel(folder, "plate",
                       {{{-half, 0, half}, {2 * half, 0, 0}, {0, 0, -2 * half}, paint},
                        {{-unit, unit, unit}, {unit, 0, 0}, {0, 0, -2 * unit}, paint}});
            // From above, 2.4 units of the ground in 24 pixels.
            const View view{{0.5 * unit, 3 * unit, 0}, {0.5 * unit, 0, 0}, {0, 0, -1}, glm::degrees(2 * std::atan(0.4 / 3))};
            const ImageData image = render("plate", view, {1, -1, 0}, 24, 8);
            ASSERT_EQ(image.width, 24);
            for (int y = 0; y < 8; ++y) {
                for (int x = 0; x < 24; ++x) {
                    const double at = 0.5 + (x + 0.5 - 12) * 0.1;
                    const float value = image.at(x, y, 0);
                    if (std::abs(at) < 0.01 || std::abs(at - 1) < 0.01 || at < 0) continue;
                    EXPECT_NEAR(value, at < 1 ? 0 : albedo * std::sqrt(0.5) / glm::pi<double>(), at < 1 ? 0 : 1e-5) << at;
                }
            }
        }
    }
}

struct Ground {
    std::string name;
    double size = 1;  ///< of the quad in its object
    Point middle{0};  ///< of the quad in its object
    glm::dmat4 toWorld{1};
    double height = 1;  ///< of the camera
    Point place{0};     ///< that it looks at, from the middle of the quad, in shares of its half size
    bool morphs = false;
    double ratio = 1;  ///< length of the quad over its width
};

// All of a plane is lit, however the sun grazes it. What is looked at lies off the edge that its two triangles share: so far from the origin a ray
// along it may pass between them.
TEST_F(RayOffsets, GroundDoesNotShadeItself) {
    const glm::dmat4 turned = glm::rotate(glm::rotate(glm::dmat4(1), 0.4, Point(1, 0, 0)), 0.9, Point(0.3, 1, 0.2));
    glm::dmat4 sheared(1);
    sheared[1] = glm::dvec4(0.7, 1, -0.4, 0);
    sheared[2] = glm::dvec4(0.5, 0.9, 1, 0);
    const auto scaled = [](double x, double y, double z) { return glm::scale(glm::dmat4(1), Point(x, y, z)); };
    const auto moved = [](double x, double y, double z) { return glm::translate(glm::dmat4(1), Point(x, y, z)); };
    const std::vector<Ground> grounds{
        {.name = "200 km", .size = 2e5},
        {.name = "200 km, far from the middle", .size = 2e5, .place = {0.9, 0, -0.8}},
        {.name = "200 km, turned", .size = 2e5, .toWorld = turned},
        {.name = "200 km, turned, far from the middle", .size = 2e5, .toWorld = turned, .height = 10, .place = {0.9, 0, -0.8}},
        {.name = "200 km, sheared", .size = 2e5, .toWorld = sheared, .place = {0.1, 0, 0.3}},
        {.name = "unlike scales", .size = 1, .toWorld = scaled(1e4, 1e-1, 3) * turned, .place = {0.1, 0, 0.3}},
        {.name = "georeferenced by its node", .size = 1e3, .toWorld = moved(8297640, 533512, 412345), .height = 100},
        {.name = "georeferenced by its node, turned", .size = 1e3, .toWorld = moved(8297640, 533512, 412345) * turned, .height = 100, .place = {0.1, 0, 0.3}},
        {.name = "georeferenced by its vertices", .size = 1e3, .middle = {8297640, 533512, 412345}, .height = 100},
        {.name = "a millimetre", .size = 1e-3, .toWorld = turned, .height = 1e-4},
        {.name = "a million", .size = 1e6, .toWorld = turned, .height = 1e5, .place = {0.2, 0, 0.1}},
        {.name = "made of micrometres", .size = 1e6, .toWorld = turned * scaled(1e-6, 1e-6, 1e-6), .height = 0.1},
        {.name = "a sliver", .size = 1, .toWorld = turned, .height = 1e-4, .ratio = 1e3},
        {.name = "morphed", .size = 2e4, .toWorld = turned, .place = {0.3, 0, 0.6}, .morphs = true},
        {.name = "mirrored", .size = 2e4, .toWorld = turned * scaled(-1, 1, 1), .place = {0.3, 0, 0.6}},
    };
    for (const Ground& g : grounds) {
        SCOPED_TRACE(g.name);
        const double half = 0.5 * g.size, across = half / g.ratio;
        writeModel(folder, "ground",
                   {{g.middle + Point(-half, 0, across), {2 * half, 0, 0}, {0, 0, -2 * across}, {.color = Point(albedo)}}});
        OrderedJson gltf = OrderedJson::parse(readText(folder / "ground.gltf"));
        std::vector<double> matrix;
        for (int i = 0; i < 16; ++i) matrix.push_back(double(float(g.toWorld[i / 4][i % 4])));
        gltf["nodes"][0]["matrix"] = matrix;
        if (g.morphs) {  // by half of where each vertex is
            gltf["meshes"][0]["primitives"][0]["targets"] = OrderedJson::array({OrderedJson{{"POSITION", 0}}});
            gltf["meshes"][0]["weights"] = {0.5};
        }
        writeFile(folder / "ground.gltf", gltf.dump());

        const glm::dmat3 linear(g.toWorld);
        const Point normal = glm::normalize(glm::cross(linear[2], linear[0]) * (glm::determinant(linear) < 0 ? -1.0 : 1.0));
        const Point along = glm::normalize(linear[0]),
                    at(g.toWorld * glm::dvec4(g.middle + g.place * Point(half, 0, across) * (g.morphs ? 1.5 : 1.0), 1));
        const View view{at + normal * g.height, at, along, 20};
        for (const double elevation : {1.2, 0.1, 0.01}) {  // radians
            for (const double azimuth : {0.3, 2.5}) {
                const Point side = std::cos(azimuth) * along + std::sin(azimuth) * glm::cross(normal, along);
                const ImageData image = render("ground", view, -(std::sin(elevation) * normal + std::cos(elevation) * side), 16, 16);
                ASSERT_EQ(image.width, 16);
                // Normals are stored in 32 bits: to 7e-5, which matters where the sun grazes. What is shaded is black.
                const double expected = albedo * std::sin(elevation) / glm::pi<double>();
                for (int y = 0; y < 16; ++y)
                    for (int x = 0; x < 16; ++x)
                        ASSERT_NEAR(image.at(x, y, 0), expected, 7e-5 * albedo / glm::pi<double>()) << elevation << ", pixel " << x << ", " << y;
            }
        }
    }
}

// A lamp far above ground, and a shade a ten-thousandth of the way before it that takes it from all that is looked at, or from nothing.
TEST_F(RayOffsets, ShadesCloseToLampsHold) {
    const Paint paint{.color = Point(albedo)};
    for (const double away : {1.0, 1e3, 1e6}) {
        for (const bool area : {false, true}) {
            for (const double side : {-1.0, 1.0}) {
                SCOPED_TRACE(fmt::format("{} lamp {} units away, {}", area ? "area" : "point", away, side < 0 ? "shaded" : "bare"));
                const double x = side * 0.5 * away, size = 1e-2 * away, radiance = 1e4;
                std::vector<Quad> quads{{{-away, 0, away}, {2 * away, 0, 0}, {0, 0, -2 * away}, paint},
                                        {{-away, (1 - 1e-4) * away, away}, {away, 0, 0}, {0, 0, -2 * away}, paint}};
                OrderedJson lights = OrderedJson::array();
                if (area)
                    quads.push_back({{x - size / 2, away, -size / 2}, {size, 0, 0}, {0, 0, size}, {.emission = Point(radiance)}});
                else
                    lights.push_back({{"type", "point"}, {"position", toJson({x, away, 0})}, {"intensity", away * away}});
                writeModel(folder, "lamp", quads);
                writeScene(folder, "lamp", {{0, 0.5 * away, 0}, {0, 0, 0}, {0, 0, -1}, 40}, constantEnvironment(Point(0)), lights);
                const Path graph =
                    writeGraph(folder, "lamp", 16, 16, {{"spp", 16}, {"bounces", 1}, {"film", "centre"}, {"technique", "light"}});
                const std::vector<ImageData> images = test::render(graph, "trace", 1);
                ASSERT_EQ(images.size(), 1u);
                for (int py = 0; py < 16; ++py) {
                    for (int px = 0; px < 16; ++px) {
                        const double reach = 0.5 * std::tan(glm::radians(20.0)), dx = (px + 0.5 - 8) / 8 * reach - side * 0.5,
                                     dz = (py + 0.5 - 8) / 8 * reach;
                        const double square = 1 + dx * dx + dz * dz, falloff = area ? radiance * 1e-4 / square : 1 / std::sqrt(square);
                        const double expected = side < 0 ? 0 : albedo / glm::pi<double>() * falloff / square;
                        ASSERT_NEAR(images[0].at(px, py, 0), expected, (area ? 0.02 : 1e-4) * expected) << px << ", " << py;
                    }
                }
            }
        }
    }
}

}  // namespace
}  // namespace lodestir::test
