// SPDX-License-Identifier: MIT
// Where impostors are known to fail, each case with how far it may go: thin things, what no view sees, seams, many materials below a texel, switches of level,
// silhouettes, normals below a texel, far away. Truth is the geometry under the same light, sampled 3 x 3 times a pixel where sizes below a pixel matter.
#include "frames.h"

#include <framework/image/metrics.h>

#include <framework/shaders/world/primary_hit.h>
#include <framework/shaders/impostor/surfel.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace lodestir::test {
namespace {

constexpr std::uint32_t nothing = 0xffffffffu;
constexpr int side = 256, finer = 3;  // odd, so that one of the samples is the pixel's centre

OrderedJson withOrbit(OrderedJson passes) {
    OrderedJson all = {{"orbit", {{"type", "orbit"}, {"set", {{"directions", 0}}}}}};
    all.update(passes);
    return all;
}

/// An impostor and the geometry it stands for, seen by one camera.
class Pair {
public:
    Pair(const std::string& scene, const std::string& mesh, int views = 18)
        : drawn_(sceneFile(scene), glm::uvec2(side),
                 withOrbit({{"bake", {{"type", "impostor_bake"}, {"set", {{"mesh", mesh}, {"resolution", side}, {"views", views}, {"points", 0}}}}},
                            {"draw", {{"type", "impostor_forward_map"}, {"set", {{"hysteresis", 0}}}}},
                            {"fill", {{"type", "hole_fill"}, {"in", {{"surfels", "draw"}}}}},
                            {"shade", {{"type", "reshade"}, {"in", {{"surfels", "fill"}, {"impostors", "bake"}}}}}}),
                 {"shade.color", "draw.surfels", "fill.surfels"}),
          truth_(sceneFile(scene), glm::uvec2(side * finer),
                 withOrbit({{"hits", {{"type", "visibility"}, {"set", {{"film", "centre"}}}}}, {"shade", {{"type", "reshade"}, {"in", {{"hits", "hits"}}}}}}),
                 {"shade.color", "hits.depth", "hits.hits"}) {
        const std::vector<Instance>& instances = truth_.scene().instances;
        for (std::uint32_t i = 0; i < instances.size(); ++i)
            if (truth_.scene().meshes[instances[i].mesh].name == mesh) instance_ = i;
    }

    void set(const std::string& parameter, const Json& value) { drawn_.set(parameter, value); }
    void setTruth(const std::string& parameter, const Json& value) { truth_.set(parameter, value); }
    /// From here on frames look from so many directions.
    void around(int directions) {
        for (Frames* frames : {&drawn_, &truth_}) frames->set("orbit.directions", Json(directions));
    }
    /// `distance`: as a multiple of the scene's camera's.
    void look(double distance = 1, std::uint32_t frame = 0, double turn = 0, bool both = true) {
        for (Frames* frames : {&drawn_, &truth_}) {
            if (frames == &truth_ && !both) continue;
            frames->set("orbit.distance", Json(distance));
            frames->set("orbit.turn", Json(turn));
            frames->restart(frame);
            frames->run();
        }
    }
    /// The impostor's next frame, with history.
    void next() { drawn_.run(); }
    /// Exposed colour times coverage, and coverage.
    ImageData drawn() { return premultiplied(drawn_.image("shade.color")); }
    /// The same of the geometry, the mean of 3 x 3 samples.
    ImageData truth() { return smaller(premultiplied(alone("shade.color"))); }
    /// One sample at the centre of each pixel.
    ImageData truthAtCentres() { return every(premultiplied(alone("shade.color"))); }
    ImageData depthAtCentres() { return every(alone("hits.depth")); }
    std::vector<Surfel> surfels(const std::string& pass) { return drawn_.records<Surfel>(pass + ".surfels"); }

private:
    /// Without what else the scene has: lamps come into view from elsewhere.
    ImageData alone(const std::string& port) {
        ImageData image = truth_.image(port);
        const std::vector<PrimaryHit> hits = truth_.records<PrimaryHit>("hits.hits");
        for (std::size_t i = 0; i < image.values.size(); ++i) {
            const PrimaryHit& hit = hits[i / std::size_t(image.channels)];
            if (hit.primitive == nothing || hit.instance != instance_) image.values[i] = 0;
        }
        return image;
    }
    ImageData premultiplied(ImageData image) {
        const float exposure = std::exp2(truth_.scene().exposure);
        for (std::size_t i = 0; i < image.values.size(); i += 4)
            for (std::size_t c = 0; c < 3; ++c) image.values[i + c] *= exposure * image.values[i + 3];
        return image;
    }
    static ImageData smaller(const ImageData& image) {
        ImageData mean = makeImage(side, side, 4);
        for (int y = 0; y < side * finer; ++y)
            for (int x = 0; x < side * finer; ++x)
                for (int c = 0; c < 4; ++c)
                    mean.values[std::size_t((y / finer * side + x / finer) * 4 + c)] += image.at(x, y, c) / float(finer * finer);
        return mean;
    }
    static ImageData every(const ImageData& image) {
        ImageData some = makeImage(side, side, image.channels);
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
                for (int c = 0; c < image.channels; ++c)
                    some.values[std::size_t((y * side + x) * image.channels + c)] = image.at(x * finer + finer / 2, y * finer + finer / 2, c);
        return some;
    }

    Frames drawn_, truth_;
    std::uint32_t instance_ = nothing;
};

double sumOfChannel(const ImageData& image, int channel) {
    double sum = 0;
    for (std::size_t i = std::size_t(channel); i < image.values.size(); i += 4) sum += image.values[i];
    return sum;
}
/// Mean over what is covered.
glm::dvec3 colorOf(const ImageData& image) {
    return glm::dvec3(sumOfChannel(image, 0), sumOfChannel(image, 1), sumOfChannel(image, 2)) / sumOfChannel(image, 3);
}
double light(const ImageData& image) { return sumOfChannel(image, 0) + sumOfChannel(image, 1) + sumOfChannel(image, 2); }

/// Over the pixels that either shows, of displayed values.
double errorOf(const ImageData& a, const ImageData& b) {
    std::vector<bool> mask;
    for (std::size_t i = 3; i < a.values.size(); i += 4) mask.push_back(a.values[i] > 0 || b.values[i] > 0);
    return evaluate("mse_display", firstChannels(a, 3), firstChannels(b, 3), {.mask = mask});
}

/// Is nothing there, nor in a pixel beside it?
bool isFree(const ImageData& truth, int pixel) {
    const int x = pixel % side, y = pixel / side;
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, side - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, side - 1); ++u)
            if (truth.at(u, v, 3) > 0) return false;
    return true;
}

// Wires of 0.5 to 4 pixels: half of that here.
TEST(ImpostorFailures, ThinThings) {
    Pair pair("impostor_wires", "wires");
    pair.look();
    const ImageData truth = pair.truth();
    const auto recall = [&](const char* what) {
        const std::vector<Surfel> surfels = pair.surfels("fill");
        std::array<double, 3> seen{}, drawn{};  // covered wholly, more than by half, with nothing beside them
        for (std::size_t i = 0; i < surfels.size(); ++i) {
            const float covered = truth.values[i * 4 + 3];
            const int group = covered > 0.95f ? 0 : covered > 0.5f ? 1 : isFree(truth, int(i)) ? 2 : -1;
            if (group < 0) continue;
            ++seen[std::size_t(group)];
            drawn[std::size_t(group)] += surfels[i].instance != nothing;
        }
        const std::array<double, 3> share{drawn[0] / seen[0], drawn[1] / seen[1], drawn[2] / seen[2]};
        std::printf("%s: of pixels covered wholly %.3f are drawn, by more than half %.3f, with nothing beside them %.4f\n", what, share[0], share[1], share[2]);
        return share;
    };
    const auto both = recall("both stages");
    EXPECT_GT(both[0], 0.95);
    EXPECT_GT(both[1], 0.7);
    EXPECT_LT(both[2], 0.02);
    pair.set("fill.stage2", Json(false));
    pair.look();
    EXPECT_LE(recall("first stage")[0], both[0]);
}

// A ring around a ball, seen from as far from all views as can be, and from around.
TEST(ImpostorFailures, WhatNoViewSees) {
    double last = 0;
    std::map<int, double> errors;
    for (const int views : {18, 12, 6}) {
        Pair pair("impostor_torus", "torus", views);
        pair.look();
        const ImageData depth = pair.depthAtCentres();
        const auto holes = [&](const std::string& pass, double& wrong) {
            const std::vector<Surfel> surfels = pair.surfels(pass);
            double missing = 0, seen = 0;
            wrong = 0;
            for (int y = 1; y < side - 1; ++y) {
                for (int x = 1; x < side - 1; ++x) {
                    bool inside = true;
                    float low = 1e30f, high = 0;
                    for (int k = 0; k < 9; ++k) {
                        const float z = depth.at(x + k % 3 - 1, y + k / 3 - 1, 0);
                        inside &= z > 0;
                        low = std::min(low, z);
                        high = std::max(high, z);
                    }
                    if (!inside) continue;
                    ++seen;
                    const Surfel& f = surfels[std::size_t(y * side + x)];
                    missing += f.instance == nothing;
                    const float slack = 3 * low * 2 * std::tan(0.13f) / side;
                    wrong += f.instance != nothing && (f.depth < low - slack || f.depth > high + slack);
                }
            }
            wrong /= seen;
            return missing / seen;
        };
        double wrong = 0;
        const double before = holes("draw", wrong), after = holes("fill", wrong);
        std::printf("%d views: holes %.4f, filled %.4f, wrong depth %.4f\n", views, before, after, wrong);
        EXPECT_GE(before, last);
        last = before;
        if (views == 18) {
            EXPECT_LT(after, 0.005);
            EXPECT_LT(wrong, 0.02);
        }
        pair.around(8);
        for (std::uint32_t frame = 1; frame < 8; frame += 2) {
            pair.look(1, frame);
            errors[views] += errorOf(pair.drawn(), pair.truthAtCentres()) / 4;
        }
        std::printf("  from around: error %.5f\n", errors[views]);
    }
    EXPECT_LT(errors[12], errors[6]);
    EXPECT_LT(errors[18], errors[6]);  // which hold the 6; the 12 are others
}

// Charts whose neighbours in the picture are of other colours: a mean across the seam would be one of those.
TEST(ImpostorFailures, SeamsOfTextureCoordinates) {
    Pair pair("impostor_seam", "seam");
    pair.set("draw.level", Json("fixed"));
    const auto wrongAt = [&](int level) {
        pair.set("draw.bias", Json(level));
        pair.look();
        const ImageData drawn = pair.drawn(), truth = pair.truthAtCentres();
        double wrong = 0;
        for (std::size_t i = 0; i < drawn.values.size(); i += 4) {
            if (drawn.values[i + 3] < 1 || truth.values[i + 3] < 1) continue;
            // Magenta is between the charts and on no surface.
            wrong += drawn.values[i] > 1.5f * drawn.values[i + 1] && drawn.values[i + 2] > 1.5f * drawn.values[i + 1];
        }
        return wrong;
    };
    const double finest = wrongAt(0), coarse = wrongAt(1), coarser = wrongAt(2);
    std::printf("pixels of a colour that is on no surface: level 0 %g, level 1 %g, level 2 %g\n", finest, coarse, coarser);
    EXPECT_LE(coarse, 2 * finest + 4);
    EXPECT_LE(coarser, 2 * finest + 4);
}

// Cells smaller than a texel in eight materials. The mean colour is the same from afar; samples of geometry that far apart would meet some materials alone.
TEST(ImpostorFailures, ManyMaterialsInATexel) {
    Pair pair("impostor_checker", "checker");
    pair.setTruth("hits.film", Json("random"));  // not by a grid, which would beat with that of the cells
    pair.look();
    const ImageData truth = pair.truth();
    for (int level = 0; level <= 4; ++level) {
        pair.look(std::pow(2, level), 0, 0, false);
        const ImageData drawn = pair.drawn();
        const glm::dvec3 mean = colorOf(drawn), wanted = colorOf(truth);
        const double error = glm::distance(mean, wanted) / glm::length(wanted);
        std::printf("%d times as far: mean colour off by %.4f\n", 1 << level, error);
        EXPECT_LT(error, 0.03) << level;
    }
}

/// FLIP over the pixels that either picture shows.
double flipOf(const ImageData& after, const ImageData& before) {
    std::vector<bool> mask;
    for (std::size_t i = 3; i < before.values.size(); i += 4) mask.push_back(before.values[i] > 0 || after.values[i] > 0);
    return evaluate("flip_ldr", firstChannels(after, 3), firstChannels(before, 3), {.mask = mask});
}

TEST(ImpostorFailures, SwitchesOfLevel) {
    Pair pair("bunny", "bunny");
    pair.set("draw.level", Json("fixed"));
    // Where the next level's texels are nearly as wide as pixels (impostor_forward_map): the object spans six sevenths of the picture once.
    for (const int level : {0, 1, 2}) {
        const double distance = 2 * std::pow(2, level);
        pair.set("draw.bias", Json(level + 1));
        pair.look(distance, 0, 0, false);
        const ImageData after = pair.drawn();
        pair.set("draw.bias", Json(level));
        pair.look(distance, 0, 0, false);
        const ImageData before = pair.drawn();
        const double flip = flipOf(after, before);
        EXPECT_LT(flip, 0.1);

        // Pixel by pixel, over half a second.
        pair.set("draw.transition", Json(31));
        pair.set("draw.bias", Json(level + 1));
        ImageData last = before;
        double most = 0;
        for (int frame = 0; frame < 32; ++frame) {
            pair.next();
            const ImageData now = pair.drawn();
            most = std::max(most, flipOf(now, last));
            last = now;
        }
        pair.set("draw.transition", Json(0));
        std::printf("level %d to %d: FLIP %.4f; over 32 frames %.4f at most\n", level, level + 1, flip, most);
        EXPECT_LT(most, 0.03);
        EXPECT_GT(most, 0);
        EXPECT_EQ(last.values, after.values);
    }
}

TEST(ImpostorFailures, Silhouettes) {
    Pair pair("impostor_sphere", "sphere");
    for (int level = 0; level <= 4; ++level) {
        pair.look(std::pow(2, level));
        const ImageData drawn = pair.drawn(), truth = pair.truth();
        // Outlines meet where rows and columns change from one to the other: compared by the length of each row's and column's part inside.
        double sum = 0, most = 0, lines = 0, area = sumOfChannel(drawn, 3) - sumOfChannel(truth, 3);
        for (int turn = 0; turn < 2; ++turn) {
            for (int i = 0; i < side; ++i) {
                double a = 0, b = 0;
                for (int k = 0; k < side; ++k) {
                    a += turn == 0 ? drawn.at(k, i, 3) : drawn.at(i, k, 3);
                    b += turn == 0 ? truth.at(k, i, 3) : truth.at(i, k, 3);
                }
                if (a == 0 && b < 4) continue;
                sum += std::abs(a - b) / 2;
                most = std::max(most, std::abs(a - b) / 2);
                ++lines;
            }
        }
        std::printf("%d times as far: outline off by %.3f pixels, at most %.2f; area %+.4f\n", 1 << level, sum / lines, most, area / sumOfChannel(truth, 3));
        EXPECT_LT(sum / lines, 0.5);
        EXPECT_LT(most, 3);  // where a row touches the outline it grows by the root of a pixel times its length
    }
}

// Noise in the normals, below a texel from the second level on: highlights become wide instead of going out.
TEST(ImpostorFailures, NormalsBelowATexel) {
    Pair pair("impostor_bumps", "bumps");
    const auto flicker = [&](double& energy) {
        constexpr double distance = 8;
        constexpr int steps = 4;
        double change = 0, sum = 0;
        std::optional<ImageData> last;
        for (std::uint32_t i = 0; i < steps; ++i) {
            pair.look(distance, i, 0.5 * 360 / (std::numbers::pi * side / distance), true);  // half a pixel in the middle
            const ImageData drawn = pair.drawn();
            energy += light(drawn) / light(pair.truth()) / steps;
            for (std::size_t k = 0; last && k < drawn.values.size(); ++k) change += std::pow(double(drawn.values[k]) - last->values[k], 2);
            for (const float v : drawn.values) sum += double(v) * v;
            last = drawn;
        }
        return change / sum;
    };
    double with = 0, without = 0;
    const double steady = flicker(with);
    pair.set("shade.spread", Json(false));
    const double unsteady = flicker(without);
    std::printf("with the spread of normals: energy %.3f, flicker %.4f; without: %.3f, %.4f\n", with, steady, without, unsteady);
    EXPECT_NEAR(with, 1, 0.05);
    EXPECT_LT(steady, unsteady);
}

// From one level to far away, in steps of a quarter of a pixel.
TEST(ImpostorFailures, FarAway) {
    Pair pair("teapot", "teapot");
    const auto flicker = [&](double distance, bool truth) {
        double change = 0;
        std::optional<ImageData> last;
        for (std::uint32_t i = 0; i < 4; ++i) {
            pair.look(distance, i, 0.25 * 360 / (std::numbers::pi * side / distance), truth);
            const ImageData seen = truth ? pair.truth() : pair.drawn();
            for (std::size_t k = 0; last && k < seen.values.size(); ++k) change += std::pow(double(seen.values[k]) - last->values[k], 2);
            last = seen;
        }
        return change;
    };
    for (const double distance : {4.0, 16.0}) {
        pair.set("draw.level", Json("footprint"));
        const double truth = flicker(distance, true), levels = flicker(distance, false);
        pair.set("draw.level", Json("fixed"));
        const double finest = flicker(distance, false);
        std::printf("%g times as far: flicker over that of the truth with levels %.2f, without %.2f\n", distance, levels / truth, finest / truth);
        EXPECT_LT(levels, finest);
        EXPECT_LT(levels, 1.5 * truth);
    }
}

}  // namespace
}  // namespace lodestir::test
