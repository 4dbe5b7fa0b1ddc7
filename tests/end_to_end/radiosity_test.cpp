// SPDX-License-Identifier: MIT
// Diffuse rooms against solutions that share nothing with the renderer: a closed form, a plane under a point light, and
// a plain Monte Carlo solution in double precision on analytic parallelograms.
#include "model.h"
#include "program.h"
#include "render.h"
#include "statistics.h"

#include <numbers>
#include <random>
#include <thread>

namespace lodestir::test {
namespace {

constexpr int size = 64;

class Radiosity : public ProgramTest {};

/// Pinhole: direction through a point of the film, (0, 0) at its upper left.
Point viewDirection(const View& view, double x, double y) {
    const Point forward = glm::normalize(view.target - view.position), right = glm::normalize(glm::cross(forward, view.up)),
                up = glm::cross(right, forward);
    const double half = std::tan(view.fovy * std::numbers::pi / 360);
    return forward + (2 * x - 1) * half * right + (1 - 2 * y) * half * up;
}

struct Crossing {
    const Quad* quad = nullptr;
    double t = std::numeric_limits<double>::infinity();
};

/// A parallelogram prepared for rays: point = corner + u a + v b, with u and v from the dual basis.
struct Plane {
    Point normal, dualA, dualB;
    explicit Plane(const Quad& q) : normal(glm::cross(q.a, q.b)) {
        const double square = glm::dot(normal, normal);
        dualA = glm::cross(q.b, normal) / square;
        dualB = glm::cross(normal, q.a) / square;
    }
};

class Reference {
public:
    explicit Reference(std::vector<Quad> quads) : quads_(std::move(quads)) {
        for (const Quad& q : quads_) planes_.emplace_back(q);
    }

    /// One frame: `samples` paths through random points of each pixel, of at most `bounces` scatterings. Cosine-weighted directions, no
    /// light sampling, no roulette: nothing that could be wrong in the same way as in the renderer.
    ImageData frame(const View& view, int samples, int bounces, std::uint64_t seed) const {
        std::mt19937_64 random(seed);
        const auto uniform = [&] { return std::generate_canonical<double, 53>(random); };
        ImageData image = makeImage(size, size, 3);
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                Point sum(0);
                for (int s = 0; s < samples; ++s) {
                    Point origin = view.position, direction = viewDirection(view, (x + uniform()) / size, (y + uniform()) / size),
                          throughput(1);
                    for (int k = 0;; ++k) {
                        const Crossing hit = cross(origin, direction);
                        if (!hit.quad) break;
                        Point normal = hit.quad->normal();
                        const bool front = glm::dot(normal, direction) < 0;
                        if (front) sum += throughput * hit.quad->paint.emission;
                        if (k == bounces) break;
                        throughput *= hit.quad->paint.color;
                        if (throughput == Point(0)) break;
                        if (!front) normal = -normal;
                        origin += hit.t * direction + 1e-9 * normal;
                        // A uniform point of the unit sphere that touches the surface from above is cosine-weighted.
                        const double z = 2 * uniform() - 1, phi = 2 * std::numbers::pi * uniform(), r = std::sqrt(1 - z * z);
                        direction = normal + Point(r * std::cos(phi), r * std::sin(phi), z);
                    }
                }
                for (int c = 0; c < 3; ++c) image.at(x, y, c) = static_cast<float>(sum[c] / samples);
            }
        }
        return image;
    }

private:
    Crossing cross(const Point& origin, const Point& direction) const {
        Crossing nearest;
        for (std::size_t i = 0; i < quads_.size(); ++i) {
            const Point from = quads_[i].corner - origin;
            const double t = glm::dot(from, planes_[i].normal) / glm::dot(direction, planes_[i].normal);
            if (!(t > 0 && t < nearest.t)) continue;
            const Point at = t * direction - from;
            const double u = glm::dot(at, planes_[i].dualA), v = glm::dot(at, planes_[i].dualB);
            if (u >= 0 && u <= 1 && v >= 0 && v <= 1) nearest = {&quads_[i], t};
        }
        return nearest;
    }

    std::vector<Quad> quads_;
    std::vector<Plane> planes_;
};

constexpr Point glow{1.0, 0.5, 0.25}, dye{0.8, 0.5, 0.2};
const View insideGlow{.position = {0.4, 0.1, 0.7}, .target = {0, 0, -1}, .fovy = 70};

std::vector<Quad> glowingRoom() { return box({-1, -1, -1}, {1, 1.5, 1}, {.color = dye, .emission = glow}, /* inward = */ true); }

/// Its radiance after n scatterings: E (1 + a + ... + a^n).
Point glowAfter(int bounces) {
    Point sum(0), factor(1);
    for (int k = 0; k <= bounces; ++k, factor *= dye) sum += glow * factor;
    return sum;
}

// If this fails, the solution that the renderer is judged by is wrong itself.
TEST_F(Radiosity, ReferenceSolvesTheUniformEnclosure) {
    const ImageData image = Reference(glowingRoom()).frame(insideGlow, 1, 6, 1);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(image.at(x, y, c), glowAfter(6)[c], 1e-6) << "pixel " << x << ", " << y;
}

// In a closed room whose walls all emit E and reflect a share a, radiance is the same everywhere.
TEST_F(Radiosity, UniformEnclosureHasItsClosedForm) {
    writeModel(folder, "enclosure", glowingRoom());
    writeScene(folder, "enclosure", insideGlow, constantEnvironment(Point(0)));
    for (const int bounces : {0, 1, 6}) {
        const Point expected = glowAfter(bounces);
        // BSDF sampling meets the same radiance whatever it hits: no noise but rounding. Roulette would bring some.
        const auto exact =
            render(writeGraph(folder, "enclosure", 32, 32, {{"spp", 1}, {"bounces", bounces}, {"technique", "bsdf"}, {"roulette", false}}), "trace", 1);
        ASSERT_EQ(exact.size(), 1u);
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 32; ++x)
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(exact[0].at(x, y, c), expected[c], 2e-4 * expected[c]) << bounces << " bounces, pixel " << x << ", " << y;
        const auto both = render(writeGraph(folder, "enclosure", 32, 32, {{"spp", 16}, {"bounces", bounces}}), "trace", 8);
        std::vector<double> energies;
        for (const ImageData& image : both) energies.push_back(meanOf(image));
        const Mean mean = lodestir::test::meanOf(energies);
        const double known = (expected.x + expected.y + expected.z) / 3;
        EXPECT_NEAR(mean.value, known, 5 * std::sqrt(mean.variance) + 2e-4 * known) << bounces << " bounces, both";
        EXPECT_LE(1.96 * std::sqrt(mean.variance), 0.01 * known) << "inconclusive";
    }
}

// Radiance of a diffuse plane is albedo / pi times its irradiance: candela over distance squared times cosine,
// or the directional light's lux.
TEST_F(Radiosity, PlaneUnderPunctualLightsHasItsClosedForm) {
    const Point albedo{0.9, 0.6, 0.3}, color{1, 0.5, 0.25}, lamp{0.3, 1.5, -0.4};
    writeModel(folder, "plane", {{{-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, {.color = albedo}}});
    const View view{.position = {0, 3, 4}, .target = {0, 0, 0}, .fovy = 50};
    const Point downwards = glm::normalize(Point(0.5, -1, 0.25));
    const std::vector<std::pair<OrderedJson, bool>> lights{
        {{{"type", "point"}, {"position", toJson(lamp)}, {"intensity", 5.0}, {"color", toJson(color)}}, true},
        {{{"type", "directional"}, {"direction", toJson(downwards)}, {"intensity", 2.0}, {"color", toJson(color)}}, false}};
    for (const auto& [light, isPoint] : lights) {
        writeScene(folder, "plane", view, constantEnvironment(Point(0)), OrderedJson::array({light}));
        const auto images = render(writeGraph(folder, "plane", size, size, {{"spp", 1}, {"bounces", 1}, {"film", "centre"}}), "trace", 1);
        ASSERT_EQ(images.size(), 1u);
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                const Point direction = viewDirection(view, (x + 0.5) / size, (y + 0.5) / size),
                            at = view.position - direction * (view.position.y / direction.y);
                if (direction.y >= 0 || std::abs(at.x) > 3.99 || std::abs(at.z) > 3.99) continue;  // beside the plane or at its very edge
                const Point to = lamp - at;
                const double irradiance = isPoint ? 5 * to.y / std::pow(glm::dot(to, to), 1.5) : 2 * -downwards.y;
                for (int c = 0; c < 3; ++c) {
                    const double expected = albedo[c] / std::numbers::pi * color[c] * irradiance;
                    ASSERT_NEAR(images[0].at(x, y, c), expected, 1e-3 * expected)
                        << (isPoint ? "point" : "directional") << ", pixel " << x << ", " << y;
                }
            }
        }
    }
}

// A Cornell-like room: coloured walls, a block that casts shadows, a lamp below the ceiling, up to 6 scatterings.
// 16 frames of either side; limits and power as asserted below.
TEST_F(Radiosity, RoomWithABlockMatchesAnIndependentSolution) {
    std::vector<Quad> quads = box({0, 0, 0}, {4, 3, 4}, {.color = {0.75, 0.75, 0.75}}, /* inward = */ true);
    quads[0].paint.color = {0.63, 0.07, 0.05};
    quads[1].paint.color = {0.14, 0.45, 0.09};
    const glm::dvec2 along(0.9, 0.35);  // a block turned about the vertical
    const Point a(along.x, 0, along.y), b(-along.y, 0, along.x), up(0, 1.3, 0), foot(1.2, 0, 1.1);
    const Paint grey{.color = {0.6, 0.55, 0.5}};
    for (const Quad& side : {Quad{foot, up, a, grey}, Quad{foot + a, up, b, grey}, Quad{foot + a + b, up, -a, grey},
                             Quad{foot + b, up, -b, grey}, Quad{foot + up, b, a, grey}})
        quads.push_back(side);
    for (std::size_t i = quads.size() - 5; i < quads.size(); ++i)
        ASSERT_GT(glm::dot(quads[i].normal(), quads[i].corner + 0.5 * (quads[i].a + quads[i].b) - (foot + 0.5 * (a + b + up))), 0)
            << "a side of the block faces inward";
    quads.push_back({{1.2, 2.9, 1.0}, {1.8, 0, 0}, {0, 0, 1.8}, {.color = Point(0), .emission = {4, 3.2, 2.0}}});
    ASSERT_LT(quads.back().normal().y, 0);

    const View view{.position = {2.2, 1.6, 3.9}, .target = {1.9, 1.1, 0}, .fovy = 70};
    constexpr int bounces = 6, frames = 16;
    std::vector<ImageData> expected(frames);
    {
        const Reference reference(quads);
        std::vector<std::jthread> workers;
        for (int worker = 0; worker < 2; ++worker)
            workers.emplace_back([&, worker] {
                for (int i = worker; i < frames; i += 2)
                    expected[std::size_t(i)] = reference.frame(view, 64, bounces, std::uint64_t(1000 + i));
            });
    }
    writeModel(folder, "room", quads);
    writeScene(folder, "room", view, constantEnvironment(Point(0)));
    const auto actual = render(writeGraph(folder, "room", size, size, {{"spp", 24}, {"bounces", bounces}}), "trace", frames);
    ASSERT_EQ(actual.size(), std::size_t(frames));

    const Comparison comparison = compareFrames(actual, expected);
    std::printf("renderer against reference: %s\n", comparison.text.c_str());
    EXPECT_TRUE(comparison.equal()) << comparison.text;
    EXPECT_LE(comparison.halfWidth, 0.005) << "inconclusive";
    EXPECT_LE(comparison.blockWidth, 0.02) << "inconclusive";
    EXPECT_FALSE(compareFrames(actual, expected, 16, 1.015).equal()) << "a planted bias of 1.5 % goes unseen";
}

}  // namespace
}  // namespace lodestir::test
