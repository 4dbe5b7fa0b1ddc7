// SPDX-License-Identifier: MIT
// White furnace: an object that absorbs nothing, in an environment of radiance 1, cannot be seen. Rough glass and rough metal lose what
// scatters more than once between their microfacets, which the model leaves out; how much that is comes from a solution of our own.
#include "model.h"
#include "program.h"
#include "render.h"
#include "statistics.h"

#include <numbers>
#include <random>
#include <thread>

namespace lodestir::test {
namespace {

constexpr int size = 48, frameCount = 12;
const View view{.position = {2.6, 2.0, 3.2}, .target = {0, 0, 0}, .fovy = 34};  // the box fills about half of the image

class Furnace : public ProgramTest {
protected:
    /// Frames of a box of this paint, edges of 2, in the furnace.
    std::vector<ImageData> frames(const std::string& name, const Paint& paint, OrderedJson parameters, int count = frameCount) {
        writeModel(folder, name, box(Point(-1), Point(1), paint));
        writeScene(folder, name, view, constantEnvironment(Point(1)));
        parameters["roulette"] = false;
        return render(writeGraph(folder, name, size, size, parameters), "trace", count);
    }
    /// Every pixel, without noise.
    void expectInvisible(const std::vector<ImageData>& images, float tolerance) {
        for (const ImageData& image : images)
            for (int y = 0; y < size; ++y)
                for (int x = 0; x < size; ++x) ASSERT_NEAR(image.at(x, y, 1), 1, tolerance) << "pixel " << x << ", " << y;
    }
    /// On the whole and in each block of 12x12 pixels.
    void expectSame(const std::vector<ImageData>& images, const std::vector<ImageData>& expected, double halfWidth) {
        if (HasFailure()) return;
        const Comparison comparison = compareFrames(images, expected, 12);
        std::printf("%s\n", comparison.text.c_str());
        EXPECT_TRUE(comparison.equal()) << comparison.text;
        EXPECT_LE(comparison.halfWidth, halfWidth) << "inconclusive";
    }
    static std::vector<ImageData> ones() {
        ImageData image = makeImage(size, size, 3);
        std::ranges::fill(image.values, 1.0f);
        return std::vector<ImageData>(frameCount, image);
    }
};

double energyOf(const std::vector<ImageData>& images) {
    double energy = 0;
    for (const ImageData& image : images) energy += meanOf(image) / static_cast<double>(images.size());
    return energy;
}

const Paint diffuse{.color = Point(1)};
const Paint mirror{.color = Point(1), .metallic = 1, .roughness = 0, .ior = 1.5};
const Paint glass{.color = Point(1), .roughness = 0, .ior = 1.5, .transmission = 1, .solid = true};
const Paint roughGlass{.color = Point(1), .roughness = 0.5, .ior = 1.5, .transmission = 1, .solid = true};
const Paint roughMetal{.color = Point(1), .metallic = 1, .roughness = 0.7, .ior = 1.5};

// Directions in proportion to the cosine carry a weight of exactly 1.
TEST_F(Furnace, DiffuseHasNoNoise) {
    expectInvisible(frames("diffuse", diffuse, {{"spp", 1}, {"bounces", 2}, {"technique", "bsdf"}}, 2), 1e-4f);
}

TEST_F(Furnace, DiffuseByLightSampling) {
    expectSame(frames("both", diffuse, {{"spp", 16}, {"bounces", 2}}), ones(), 0.005);
    expectSame(frames("light", diffuse, {{"spp", 64}, {"bounces", 2}, {"technique", "light"}}), ones(), 0.005);
}

TEST_F(Furnace, MirrorHasNoNoise) { expectInvisible(frames("mirror", mirror, {{"spp", 1}, {"bounces", 2}}, 2), 1e-4f); }

// 64 scatterings leave less than 1e-4 of the light in the box.
TEST_F(Furnace, Glass) { expectSame(frames("glass", glass, {{"spp", 32}, {"bounces", 64}}), ones(), 0.005); }

// A clear coat takes away from a mirror just what it reflects itself.
TEST_F(Furnace, MirrorUnderAClearCoat) {
    Paint lacquered = mirror;
    lacquered.layers = {{"KHR_materials_clearcoat", {{"clearcoatFactor", 1.0}}}};
    expectSame(frames("lacquered", lacquered, {{"spp", 32}, {"bounces", 2}}), ones(), 0.005);
}

// All layers at once lose some light, make none, and look the same whatever finds the light.
TEST_F(Furnace, AllLayersLoseLittleAndMakeNothing) {
    Paint all{.color = Point(1), .metallic = 0.3, .roughness = 0.4, .ior = 1.5, .transmission = 0.2};
    all.layers = {{"KHR_materials_clearcoat", {{"clearcoatFactor", 0.8}, {"clearcoatRoughnessFactor", 0.2}}},
                  {"KHR_materials_sheen", {{"sheenColorFactor", {0.8, 0.8, 0.8}}, {"sheenRoughnessFactor", 0.4}}},
                  {"KHR_materials_anisotropy", {{"anisotropyStrength", 0.4}, {"anisotropyRotation", 0.5}}},
                  {"KHR_materials_specular", {{"specularFactor", 0.9}, {"specularColorFactor", {3.0, 3.0, 3.0}}}}};
    const auto both = frames("layers", all, {{"spp", 64}, {"bounces", 32}});
    const auto scattered = frames("layers_bsdf", all, {{"spp", 64}, {"bounces", 32}, {"technique", "bsdf"}});
    ASSERT_FALSE(HasFailure());
    expectSame(both, scattered, 0.005);
    const double energy = energyOf(both);
    std::printf("all layers return %.4f of the light\n", energy);
    EXPECT_LT(energy, 1.0);
    EXPECT_GT(energy, 0.85);
}

// Under a smooth layer the diffuse base returns all that enters, up to a fit of the mean Fresnel reflectance (error below 0.5 %).
TEST_F(Furnace, DiffuseUnderASmoothLayer) {
    const Paint coated{.color = Point(1), .roughness = 0, .ior = 1.5};
    const auto images = frames("coated", coated, {{"spp", 16}, {"bounces", 2}});
    ASSERT_FALSE(images.empty());
    EXPECT_NEAR(energyOf(images), 1, 0.005);
}

/// Reflection and refraction by GGX microfacets, one scattering at a time, in double precision: visible normals as Heitz 2018
/// (Sampling the GGX Distribution of Visible Normals, appendix A) samples them, so that a path's weight changes by G2 / G1 alone.
class Microfacets {
public:
    Microfacets(double roughness, double eta, bool metal) : alpha_(roughness * roughness), eta_(eta), metal_(metal) {}

    ImageData frame(int samples, int bounces, std::uint64_t seed) const {
        std::mt19937_64 random(seed);
        const auto uniform = [&] { return std::generate_canonical<double, 53>(random); };
        const Point forward = glm::normalize(view.target - view.position), right = glm::normalize(glm::cross(forward, view.up)),
                    up = glm::cross(right, forward);
        const double half = std::tan(view.fovy * std::numbers::pi / 360);
        ImageData image = makeImage(size, size, 3);
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                double sum = 0;
                for (int s = 0; s < samples; ++s) {
                    const double u = 2 * (x + uniform()) / size - 1, v = 1 - 2 * (y + uniform()) / size;
                    sum += path(view.position, glm::normalize(forward + u * half * right + v * half * up), bounces, uniform);
                }
                for (int c = 0; c < 3; ++c) image.at(x, y, c) = static_cast<float>(sum / samples);
            }
        }
        return image;
    }

private:
    /// Weight with which a path leaves into the furnace; 0 where it ends inside or is masked.
    template <class Uniform> double path(Point at, Point direction, int bounces, Uniform& uniform) const {
        double weight = 1;
        bool inside = false;
        for (int k = 0;; ++k) {
            // The slabs of the box [-1, 1]^3: entered at the last first crossing, left at the first last one.
            double enter = -1e300, leave = 1e300;
            int enterAxis = 0, leaveAxis = 0;
            for (int axis = 0; axis < 3; ++axis) {
                const double a = (-1 - at[axis]) / direction[axis], b = (1 - at[axis]) / direction[axis];
                if (std::min(a, b) > enter) enter = std::min(a, b), enterAxis = axis;
                if (std::max(a, b) < leave) leave = std::max(a, b), leaveAxis = axis;
            }
            if (!inside && (k > 0 || enter >= leave)) return weight;  // the box is convex: who left it does not come back
            if (k == bounces) return 0;
            at += (inside ? leave : enter) * direction;
            Point normal(0);
            const int axis = inside ? leaveAxis : enterAxis;
            normal[axis] = direction[axis] > 0 ? -1 : 1;  // towards where the path comes from
            at[axis] = std::copysign(1.0, at[axis]);

            const Point o = -direction;
            const double cosO = glm::dot(o, normal), eta = inside ? 1 / eta_ : eta_;
            const Point m = visibleNormal(o, axis, normal[axis], uniform(), uniform());
            const double cosM = glm::dot(o, m), inner = 1 - (1 - cosM * cosM) / (eta * eta);
            const bool reflected = metal_ || uniform() < fresnel(cosM, eta);
            direction = reflected ? 2 * cosM * m - o : (cosM / eta - std::sqrt(std::max(inner, 0.0))) * m - o / eta;
            const double cosI = glm::dot(direction, normal);
            if ((cosI > 0) != reflected) return 0;
            weight *= (1 + lambda(cosO)) / (1 + lambda(cosO) + lambda(cosI));  // G2 / G1, height-correlated
            inside = inside == reflected;
        }
    }

    double lambda(double cosine) const {
        const double c2 = cosine * cosine;
        return 0.5 * (std::sqrt(1 + alpha_ * alpha_ * (1 - c2) / c2) - 1);
    }
    /// Snell and Fresnel's own equations.
    static double fresnel(double cosI, double eta) {
        const double sin2 = (1 - cosI * cosI) / (eta * eta);
        if (sin2 >= 1) return 1;
        const double cosT = std::sqrt(1 - sin2), s = (cosI - eta * cosT) / (cosI + eta * cosT),
                     p = (eta * cosI - cosT) / (eta * cosI + cosT);
        return 0.5 * (s * s + p * p);
    }
    Point visibleNormal(const Point& o, int axis, double sign, double u1, double u2) const {
        const int ax = (axis + 1) % 3, ay = (axis + 2) % 3;
        const Point v = glm::normalize(Point(alpha_ * o[ax], alpha_ * o[ay], o[axis] * sign));
        const double flat = v.x * v.x + v.y * v.y;
        const Point t1 = flat > 0 ? Point(-v.y, v.x, 0) / std::sqrt(flat) : Point(1, 0, 0), t2 = glm::cross(v, t1);
        const double r = std::sqrt(u1), phi = 2 * std::numbers::pi * u2, s = 0.5 * (1 + v.z);
        const double p1 = r * std::cos(phi), p2 = (1 - s) * std::sqrt(1 - p1 * p1) + s * r * std::sin(phi);
        const Point n = p1 * t1 + p2 * t2 + std::sqrt(std::max(0.0, 1 - p1 * p1 - p2 * p2)) * v;
        Point m;
        m[ax] = alpha_ * n.x;
        m[ay] = alpha_ * n.y;
        m[axis] = sign * std::max(0.0, n.z);
        return glm::normalize(m);
    }

    double alpha_, eta_;
    bool metal_;
};

std::vector<ImageData> solve(const Microfacets& surface, int samples, int bounces) {
    std::vector<ImageData> frames(frameCount);
    std::vector<std::jthread> workers;
    for (int worker = 0; worker < 2; ++worker)
        workers.emplace_back([&, worker] {
            for (int i = worker; i < frameCount; i += 2) frames[std::size_t(i)] = surface.frame(samples, bounces, std::uint64_t(500 + i));
        });
    workers.clear();
    return frames;
}

// If this fails, the solution that the renderer is judged by is wrong itself: facets that lie almost flat lose next to nothing.
TEST_F(Furnace, ReferenceKeepsTheLightOfSmoothSurfaces) {
    EXPECT_NEAR(energyOf(solve(Microfacets(0.02, 1.5, false), 4, 64)), 1, 1e-3);
    EXPECT_NEAR(energyOf(solve(Microfacets(0.05, 1.5, true), 4, 2)), 1, 1e-4);
}

TEST_F(Furnace, RoughGlassLosesWhatItsModelLeavesOut) {
    const auto images = frames("rough_glass", roughGlass, {{"spp", 64}, {"bounces", 48}});
    const auto expected = solve(Microfacets(0.5, 1.5, false), 64, 48);
    expectSame(images, expected, 0.005);
    std::printf("rough glass returns %.4f of the light\n", energyOf(expected));
    EXPECT_LT(energyOf(expected), 0.999) << "the reference should lose some";
}

TEST_F(Furnace, RoughMetalLosesWhatItsModelLeavesOut) {
    expectSame(frames("rough_metal", roughMetal, {{"spp", 32}, {"bounces", 2}}), solve(Microfacets(0.7, 1.5, true), 64, 2), 0.005);
}

}  // namespace
}  // namespace lodestir::test
