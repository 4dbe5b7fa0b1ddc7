// SPDX-License-Identifier: MIT
// What reservoirs of paths stand on: shifts that can be undone, Jacobians, MIS weights that sum to 1, one image whatever the strategy, and the
// furnace, whose answers are exact.
//
// Seeds are fixed. Statements about means take frames as samples: an interval must hold the right value with 3.3 standard errors (which a
// correct renderer misses once in a thousand times), and must be narrow.
#include "shift_session.h"

namespace lodestir::test {
namespace {

/// Whose place inside the pixel and on the lens paths have: their own, or the pixel's, with one place inside all pixels of a frame.
enum class Camera { path, frame };
/// How connections and lights are chosen: as in 2022, or by footprint and from tiles.
enum class Sampling { plain, enhanced };

/// Reuse as graphs/restir_pt.json has it; "pixels" shifts fresh paths between pixels, "frames" resampled ones between frames.
OrderedJson tripsGraph(Camera camera, Sampling sampling) {
    OrderedJson hits = hitsNode();
    if (camera == Camera::frame) hits["set"] = {{"film", "frame"}};
    OrderedJson initial = node("initial_sampling", {{"hits", "hits"}}, {{"bounces", 4}, {"camera", camera == Camera::frame ? "hits" : "path"}});
    if (sampling == Sampling::enhanced) {
        initial["set"].update(OrderedJson{{"criteria", "footprint"}, {"lightCandidates", 32}});
        initial["in"]["tiles"] = "tiles";
    }
    return {{"hits", hits},
            {"tiles", {{"type", "light_tiles"}}},
            {"initial", initial},
            {"temporal", node("temporal_reprojection", pathsOf("initial", "spatial"))},
            {"spatial", node("spatial_reuse", pathsOf("temporal"), {{"radius", 10}})},
            {"pixels", node("shift_check", pathsOf("initial"), {{"radius", 10}})},
            {"frames", node("shift_check", pathsOf("temporal", "spatial"))}};
}

void print(const std::string& name, const RoundTrips& trips) {
    std::printf("%s: %zu paths, %zu shifted; %zu don't return, %zu as others; |JJ' - 1| <= %.1e; MIS off by > 1e-4: %.1e, worst %.1e\n",
                name.c_str(), trips.tried, trips.there, trips.lost, trips.different, double(trips.worstJacobian),
                RoundTrips::shareAbove(trips.errorsMis, 1e-4f), double(RoundTrips::largest(trips.errorsMis)));
    const auto line = [](const char* kind, const RoundTrips::Kind& k) {
        std::printf("    %-16s %7zu  F off by > 1e-3: %.1e, worst %.1e   energy", kind, k.returned, RoundTrips::shareAbove(k.errorsF, 1e-3f),
                    double(RoundTrips::largest(k.errorsF)));
        for (std::size_t i = 0; i < RoundTrips::energyNames.size(); ++i) {
            const Ratio ratio = k.energies()[i]->ratio();
            std::printf("%s %.4f +- %.4f", RoundTrips::energyNames[i], ratio.value, ratio.halfWidth);
        }
        std::printf("\n");
    };
    for (std::size_t i = 0; i < trips.kinds.size(); ++i)
        if (trips.kinds[i].returned > 0) line(pathEndNames[i], trips.kinds[i]);
    line("all", trips.all);
}

/// T4 to T6 of the notes: there and back, energies of both ends, MIS weights.
void expectSound(const std::string& name, const RoundTrips& trips, double halfWidth) {
    print(name, trips);
    ASSERT_GT(trips.there, 50'000u) << name;
    EXPECT_LE(double(trips.lost), 1e-4 * double(trips.there)) << name;
    EXPECT_LE(double(trips.different), 1e-4 * double(trips.there)) << name;
    EXPECT_LE(trips.worstJacobian, 1e-3) << name;
    EXPECT_LE(RoundTrips::shareAbove(trips.all.errorsF, 1e-3f), 1e-4) << name;
    EXPECT_LE(RoundTrips::shareAbove(trips.errorsMis, 1e-4f), 1e-4) << name;
    const auto expectBalance = [&](const std::string& what, const RoundTrips::Kind& kind) {
        for (std::size_t i = 0; i < RoundTrips::energyNames.size(); ++i) {
            const Ratio ratio = kind.energies()[i]->ratio();
            EXPECT_TRUE(ratio.isOne()) << name << ", " << what << RoundTrips::energyNames[i] << ": " << ratio.value << " +- " << ratio.halfWidth;
            // What it leaves open is no more of the whole energy than the whole may leave open.
            EXPECT_LE(ratio.halfWidth * kind.energies()[i]->mean() / trips.all.all.mean(), halfWidth)
                << name << ", " << what << RoundTrips::energyNames[i] << ": inconclusive";
        }
    };
    for (std::size_t i = 0; i < trips.kinds.size(); ++i) expectBalance(pathEndNames[i], trips.kinds[i]);
    expectBalance("all", trips.all);
}

struct Room {
    const char* scene;
    double halfWidth;  ///< of the interval of energies between pixels: lamps that few pixels see make it wide
    Camera camera = Camera::path;
    Sampling sampling = Sampling::plain;
};
class Shifts : public testing::TestWithParam<Room> {};

TEST_P(Shifts, ComeBackAndKeepTheirEnergy) {
    const OrderedJson passes = tripsGraph(GetParam().camera, GetParam().sampling);
    ShiftSession session({.scene = sceneFile(GetParam().scene), .size = {64, 64}, .passes = passes, .checks = {"pixels", "frames"}});
    RoundTrips pixels, frames, walked;
    for (int frame = 0; frame < 120; ++frame) {
        // What follows x_k is walked anew in the second half, whether or not anything moves.
        if (frame == 60) session.set("pixels.suffix", Json("walked"));
        if (frame == 60) session.set("frames.suffix", Json("walked"));
        // Chains are short: in a long one each frame's paths are almost those of the frame before, and frames are no samples.
        if (frame % 3 == 0) session.restart(std::uint32_t(frame));
        session.frame();
        pixels.add(session.checks("pixels"));
        if (frame % 3 > 0) frames.add(session.checks("frames"));
    }
    expectSound("between pixels", pixels, GetParam().halfWidth);
    expectSound("between frames", frames, 0.01);
}

std::string roomName(const testing::TestParamInfo<Room>& room) {
    return room.param.scene + std::string(room.param.camera == Camera::frame ? "_frame_jitter" : "") +
           (room.param.sampling == Sampling::enhanced ? "_enhanced" : "");
}

INSTANTIATE_TEST_SUITE_P(, Shifts,
                         testing::Values(Room{"ensemble_glossy", 0.01}, Room{"ensemble_glass", 0.015},
                                         Room{"ensemble_environment", 0.01}, Room{"ensemble_moving", 0.02}, Room{"ensemble_lens", 0.03},
                                         Room{"ensemble_lights", 0.02, Camera::path, Sampling::enhanced}),
                         roomName);
// Kernels for layers and for panes are compiled for their scenes alone; by default unbiased_test judges reuse in them.
INSTANTIATE_TEST_SUITE_P(Long, Shifts,
                         testing::Values(Room{"ensemble_layers", 0.015}, Room{"ensemble_panes", 0.02}, Room{"ensemble_diffuse", 0.01},
                                         Room{"ensemble_lights", 0.02}, Room{"ensemble_orthographic", 0.01},
                                         Room{"ensemble_lens", 0.03, Camera::frame, Sampling::enhanced},
                                         Room{"ensemble_glossy", 0.01, Camera::frame},
                                         Room{"ensemble_moving", 0.02, Camera::frame}, Room{"ensemble_lens", 0.03, Camera::frame},
                                         Room{"ensemble_glossy", 0.01, Camera::path, Sampling::enhanced},
                                         Room{"ensemble_moving", 0.02, Camera::path, Sampling::enhanced}),
                         roomName);

/// Initial sampling, temporal and spatial reuse, each of them shaded: "first", "past" (temporal), "near" (spatial alone), "both".
OrderedJson stagesGraph(OrderedJson sampling) {
    return {{"hits", hitsNode()},
            {"initial", node("initial_sampling", {{"hits", "hits"}}, std::move(sampling))},
            {"temporal", node("temporal_reprojection", pathsOf("initial", "spatial"))},
            {"spatial", node("spatial_reuse", pathsOf("temporal"), {{"radius", 10}})},
            {"alone", node("spatial_reuse", pathsOf("initial"), {{"radius", 10}})},
            {"first", shadeNode("initial")},
            {"past", shadeNode("temporal")},
            {"near", shadeNode("alone")},
            {"both", shadeNode("spatial")}};
}
const std::vector<std::string> stages{"first", "past", "near", "both"};

/// Energies of the stages, one mean over the frames of each chain: chains are independent, frames of one aren't.
std::map<std::string, std::vector<double>> chainsOf(ShiftSession& session, int chains, int length, const std::vector<std::string>& images) {
    std::map<std::string, std::vector<double>> energies;
    for (int chain = 0; chain < chains; ++chain) {
        session.restart(std::uint32_t(chain * length));
        for (const std::string& image : images) energies[image].push_back(0);
        for (int i = 0; i < length; ++i) {
            session.frame();
            for (const std::string& image : images) energies[image].back() += session.energy(image) / length;
        }
    }
    return energies;
}

// T8: all surfaces reflect one half and glow with radiance 1, so a path of d segments is worth exactly 2^(1 - d).
TEST(Furnace, IsExactAfterEveryStage) {
    ShiftSession session({.scene = sceneFile("furnace"),
                          .size = {32, 32},
                          .passes = stagesGraph({{"technique", "bsdf"}, {"roulette", false}}),
                          .images = stages});
    const auto expectAll = [&](const std::string& name, double exact) {
        const auto energies = chainsOf(session, 24, 3, stages);
        for (const std::string& stage : stages) {
            const Mean mean = meanOf(energies.at(stage));
            const Ratio ratio{mean.value / exact, 1.96 * std::sqrt(mean.variance) / exact};
            std::printf("%s, %s: %.5f +- %.5f\n", name.c_str(), stage.c_str(), ratio.value, ratio.halfWidth);
            EXPECT_TRUE(stage == "first" ? std::abs(ratio.value - 1) < 1e-4 : ratio.isOne())
                << name << ", " << stage << ": " << ratio.value << " +- " << ratio.halfWidth;
            EXPECT_LE(ratio.halfWidth, 0.005) << name << ", " << stage << ": inconclusive";
        }
    };
    for (const int d : {2, 3, 5}) {
        session.set("initial.bounces", Json(d - 1));
        session.set("initial.segmentsMin", Json(d));
        expectAll(std::to_string(d) + " segments", std::pow(0.5, d - 1));
    }
    session.set("initial.segmentsMin", Json(1));
    session.set("initial.bounces", Json(3));
    expectAll("1 to 4 segments", 1.875);
    session.set("spatial.mis", Json("pairwise"));
    session.set("alone.mis", Json("pairwise"));
    session.set("spatial.rounds", Json(2));
    expectAll("pairwise, two rounds", 1.875);
}

/// T7: what must not change the image, whatever it does to the noise.
struct Switch {
    const char* name;
    std::vector<std::pair<std::string, Json>> set;
    bool centre = false;  ///< integrates over less than the pixel
};

void expectOneImage(const std::string& scene, const std::vector<Switch>& switches) {
    const std::vector<std::pair<std::string, Json>> defaults{
        {"technique", Json("both")}, {"roulette", Json(true)},     {"forcedNee", Json(true)}, {"roughness", Json(0.2)},
        {"distance", Json(0.1)},     {"lightCandidates", Json(1)}, {"candidates", Json(1)},   {"camera", Json("path")},
        {"criteria", Json("distance")}};
    ShiftSession session({.scene = sceneFile(scene), .size = {48, 48}, .passes = stagesGraph({{"bounces", 3}}), .images = stages});
    std::vector<double> base;
    for (const Switch& s : switches) {
        for (const auto& [name, value] : defaults) session.set("initial." + name, value);
        for (const auto& [name, value] : s.set) session.set("initial." + name, value);
        const auto energies = chainsOf(session, 24, 3, stages);
        if (base.empty()) base = energies.at("first");
        // Reuse against the same frames without it, and these against the first line's.
        for (const std::string& stage : stages) {
            const bool first = stage == "first";
            const Ratio ratio = ratioOf(energies.at(stage), first ? base : energies.at("first"));
            std::printf("%s, %s: %.4f +- %.4f\n", s.name, stage.c_str(), ratio.value, ratio.halfWidth);
            if (first && s.centre) continue;
            EXPECT_TRUE(ratio.isOne()) << s.name << ", " << stage << ": " << ratio.value << " +- " << ratio.halfWidth;
            EXPECT_LE(ratio.halfWidth, stage == "near" ? 0.005 : 0.015) << s.name << ", " << stage << ": inconclusive";
        }
    }
}

TEST(Strategies, OfFindingLight) {
    expectOneImage("ensemble_diffuse", {{"as it is", {}},
                                        {"light sampling", {{"technique", Json("light")}}},
                                        {"BSDF sampling, 8 trees", {{"technique", Json("bsdf")}, {"candidates", Json(8)}}},
                                        {"32 light candidates", {{"lightCandidates", Json(32)}}},
                                        {"without roulette", {{"roulette", Json(false)}}},
                                        {"4 trees", {{"candidates", Json(4)}}},
                                        {"pixel centres", {{"camera", Json("hits")}}, true}});
}

TEST(Strategies, OfConnecting) {
    const std::pair<std::string, Json> far{"distance", Json(1e5)};  // nothing is as long
    expectOneImage("ensemble_glossy", {{"as it is", {}},
                                       {"no light forced to connect", {{"forcedNee", Json(false)}}},
                                       {"replay, lights connected", {far}},
                                       {"replay alone", {far, {"forcedNee", Json(false)}}},
                                       {"only diffuse lobes connected", {{"roughness", Json(1.0)}}},
                                       {"connected as early as can be", {{"roughness", Json(0.0)}, {"distance", Json(0.0)}}},
                                       {"32 light candidates, replayed", {{"lightCandidates", Json(32)}, {"forcedNee", Json(false)}}},
                                       {"footprints", {{"criteria", Json("footprint")}}},
                                       {"large footprints", {{"criteria", Json("footprint")}, {"footprint", Json(5.0)}, {"forcedNee", Json(false)}}}});
}

}  // namespace
}  // namespace lodestir::test
