// SPDX-License-Identifier: MIT
// The moving furnace has one answer whatever moves in it: reuse across frames in which the chance of every light changes must find it.
// The study of the same name goes to 0.1 %.
#include "../../scenes/generate/scenes/moving_furnace.h"
#include "frames.h"
#include "known_answer.h"
#include "model.h"
#include "planted_faults.h"

#include <numbers>

namespace lodestir::test {
namespace {

namespace furnace = generate::furnace;

constexpr int width = 32, height = 18, frame = 23;

/// What the two panels show above 1: they scatter light from three lights without extent, and each what the other does. Solved by patches in
/// double precision.
class Panels {
public:
    Panels() {
        for (const furnace::Panel& panel : {furnace::floorPanel, furnace::wallPanel}) sides_.push_back(divide(panel));
        for (int scattering = 0; scattering < 8; ++scattering) {  // 0.6 times a form factor of less than 0.15 each: 1e-8 are left
            const std::vector<Side> before = sides_;
            for (std::size_t i = 0; i < 2; ++i)
                for (Patch& patch : sides_[i].patches) patch.radiance = radianceAt(patch.at, i, before);
        }
    }

    /// Above 1, of the first panel that the ray meets; 0 where it meets none.
    double seen(const Point& origin, const Point& direction) const {
        double nearest = 1e30, radiance = 0;
        for (std::size_t i = 0; i < 2; ++i) {
            const Side& side = sides_[i];
            const double t = glm::dot(side.corner - origin, side.normal) / glm::dot(direction, side.normal);
            const Point at = origin + t * direction, way = at - side.corner;
            const double u = glm::dot(way, side.right) / glm::dot(side.right, side.right), v = glm::dot(way, side.down) / glm::dot(side.down, side.down);
            if (!(t > 0 && t < nearest) || u < 0 || u > 1 || v < 0 || v > 1) continue;
            nearest = t;
            radiance = glm::dot(direction, side.normal) < 0 ? radianceAt(at, i, sides_) : 0;  // the lights shine on the fronts alone
        }
        return radiance;
    }

private:
    struct Patch {
        Point at;
        double radiance;
    };
    struct Side {
        Point corner, right, down, normal;
        double patchArea;
        std::vector<Patch> patches;
    };

    static Side divide(const furnace::Panel& panel) {
        constexpr int n = 40;
        Side side{panel.corner, panel.right, panel.down, {}, 0, {}};
        const Point cross = glm::cross(side.down, side.right);
        side.normal = glm::normalize(cross);
        side.patchArea = glm::length(cross) / (n * n);
        for (int i = 0; i < n * n; ++i)
            side.patches.push_back({side.corner + (i % n + 0.5) / n * side.right + (i / n + 0.5) / n * side.down, 0});
        return side;
    }
    /// By the units and falloffs of KHR_lights_punctual.
    static double irradiance(const Point& at, const Point& normal) {
        double sum = furnace::sun * std::max(normal.y, 0.0);
        const auto add = [&](const furnace::Lamp& lamp, double (*cone)(const Point&)) {
            const Point way = Point(lamp.position) - at;
            const double squared = glm::dot(way, way);
            const Point direction = way / std::sqrt(squared);
            sum += lamp.intensity * std::max(glm::dot(direction, normal), 0.0) / squared * cone(direction);
        };
        add(furnace::bulb, [](const Point&) { return 1.0; });
        add(furnace::spot, [](const Point& direction) {
            const double inner = std::cos(glm::radians(double(furnace::spotInner))), outer = std::cos(glm::radians(double(furnace::spotOuter)));
            const Point axis = glm::normalize(Point(furnace::spotTarget) - Point(furnace::spot.position));
            const double share = std::clamp((-glm::dot(direction, axis) - outer) / (inner - outer), 0.0, 1.0);
            return share * share;
        });
        return sum;
    }
    static double radianceAt(const Point& at, std::size_t on, const std::vector<Side>& sides) {
        const Side &own = sides[on], &other = sides[1 - on];
        double sum = irradiance(at, own.normal);
        for (const Patch& patch : other.patches) {
            const Point way = patch.at - at;
            const double squared = glm::dot(way, way), facing = std::max(glm::dot(way, own.normal), 0.0) * std::max(-glm::dot(way, other.normal), 0.0);
            sum += patch.radiance * facing / (squared * squared) * other.patchArea;
        }
        return furnace::albedo / std::numbers::pi * sum;
    }

    std::vector<Side> sides_;
};

/// The frame of the scene that is measured, without noise. `centre`: what pixel centres see alone.
BlockMeans answer(bool centre) {
    const Panels panels;
    const OrderedJson camera = OrderedJson::parse(readText(sourceFolder / "scenes/moving_furnace.json"))["camera"], keys = camera["keyframes"];
    const double t = frame / keys[1]["frame"].get<double>();
    const auto between = [&](const char* name) {
        Point p;
        for (int k = 0; k < 3; ++k) p[k] = glm::mix(keys[0][name][std::size_t(k)].get<double>(), keys[1][name][std::size_t(k)].get<double>(), t);
        return p;
    };
    const Point position = between("position"), forward = glm::normalize(between("target") - position),
                right = glm::normalize(glm::cross(forward, Point(0, 1, 0))), up = glm::cross(right, forward);
    const double half = std::tan(camera["fovy"].get<double>() * std::numbers::pi / 360);
    const int samples = centre ? 1 : 12;
    ImageData image = makeImage(width, height, 3);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            double sum = 0;
            for (int s = 0; s < samples * samples; ++s) {
                const double u = 2 * (x + (s % samples + 0.5) / samples) / width - 1, v = 1 - 2 * (y + (s / samples + 0.5) / samples) / height;
                sum += panels.seen(position, glm::normalize(forward + u * half * width / height * right + v * half * up));
            }
            for (int c = 0; c < 3; ++c) image.at(x, y, c) = static_cast<float>(1 + sum / (samples * samples));
        }
    return known(image);
}

const Path graphs = sourceFolder / "graphs";

class MovingFurnace : public testing::Test {
protected:
    static EnsembleSetup setup(int runs) {
        return {.scene = sourceFolder / "scenes/moving_furnace.json",
                .size = {width, height},
                .warmup = 6,
                .frame = frame,
                .runs = runs,
                .reference = studyGraph(graphs / "path_tracer.json", "no accumulation", {{"trace.bounces", Json(8)}}),
                .referenceSamples = 1024,
                .device = sharedDevice()};
    }
    EnsembleResult judge(const char* name, const BlockMeans& runs, const BlockMeans& expected) {
        return judgeByAnswer(name, runs, expected, 0.01);
    }

    TemporaryFolder folder;
};

TEST_F(MovingFurnace, ReuseFindsTheAnswer) {
    EnsembleJudge judged(setup(96));
    const BlockMeans box = answer(false), centres = answer(true);
    const EnsembleResult reference = judge("path tracing", judged.reference(), box);
    EXPECT_EQ(reference.verdict, Verdict::unbiased) << reference.reason;

    const Setting bounces{"initial.bounces", Json(8)}, many{"initial.candidates", Json(4)}, radius{"spatial.radius", Json(5)};
    const struct {
        const char *name, *file, *variant;
        bool centre;
        std::vector<Setting> set;
    } techniques[] = {{"temporal only", "restir_pt.json", "temporal only", false, {bounces, many}},
                      {"fractional gather", "restir_pt.json", "temporal only", false, {bounces, many, {"temporal.gather", Json("fractional")}}},
                      {"spatial only", "restir_pt.json", "spatial only", false, {bounces, many, radius}},
                      {"ReSTIR PT", "restir_pt.json", nullptr, false, {bounces, many, radius}},
                      {"splatting", "restir_lod.json", nullptr, false, {bounces, many, radius}},
                      {"enhanced", "restir_pt_enhanced.json", nullptr, false, {bounces, many, {"pairing.radius", Json(5)}}},
                      {"2022", "restir_pt_2022.json", nullptr, true, {bounces, many, radius, {"direct.radius", Json(5)}}}};
    for (const auto& technique : techniques) {
        const EnsembleResult result =
            judge(technique.name, judged.measure(studyGraph(graphs / technique.file, technique.variant, technique.set)), technique.centre ? centres : box);
        EXPECT_EQ(result.verdict, Verdict::unbiased) << technique.name << ": " << result.reason;
    }
}

using LongMovingFurnace = MovingFurnace;

// Keeps the chance of a light without extent in the integrand of what is reused, though it is another in each frame.
TEST_F(LongMovingFurnace, FindsChancesThatAreKept) {
    const char* right = "return l.delta ? w.lights.at[l.point.light].pmf : l.pdf;";
    const char* wrong = "return l.delta ? 1.0 : l.pdf;";
    std::vector<Fault> faults;
    for (const char* pass : {"initial_sampling", "temporal_reprojection", "restir_di"})
        faults.push_back({std::string(pass) + "_kept", pass, "light/light.glsl", right, wrong});
    plant(folder.path, faults);
    ASSERT_FALSE(HasFailure());
    const auto faulty = [&](const char* file) {
        OrderedJson json = OrderedJson::parse(readText(graphs / file));
        json["scene"] = (sourceFolder / "scenes/moving_furnace.json").string();
        for (auto& [name, pass] : json["passes"].items())
            for (const Fault& fault : faults)
                if (pass["type"] == fault.pass) pass["type"] = fault.type;
        writeFile(folder.path / file, json.dump());
        return folder.path / file;
    };
    EnsembleSetup setup = MovingFurnace::setup(48);
    setup.renderer.passes = {folder.path};
    setup.referenceSamples = 64;
    EnsembleJudge judged(setup);
    const EnsembleResult paths = judge(
        "temporal only, kept",
        judged.measure(studyGraph(faulty("restir_pt.json"), "temporal only", {{"initial.bounces", Json(8)}, {"initial.candidates", Json(4)}})), answer(false));
    EXPECT_EQ(paths.verdict, Verdict::biased) << paths.reason;
    const EnsembleResult direct =
        judge("2022, kept",
              judged.measure(studyGraph(faulty("restir_pt_2022.json"), "temporal only", {{"initial.bounces", Json(8)}, {"initial.candidates", Json(4)}})),
              answer(true));
    EXPECT_EQ(direct.verdict, Verdict::biased) << direct.reason;
}

}  // namespace
}  // namespace lodestir::test
