// SPDX-License-Identifier: MIT
// Faults planted in shaders, one line each, and the tool that must find each of them: if it doesn't, the tests of the same kind in shift_test
// prove nothing.
#include "planted_faults.h"
#include "shift_session.h"

namespace lodestir::test {
namespace {

class Mutations : public testing::Test {
protected:
    TemporaryFolder folder;
};
using LongMutations = Mutations;

const OrderedJson near{{"radius", 10}};

void expectFound(const char* tool, const std::string& fault, bool found, double figure, double of) {
    std::printf("%-28s %s: %.3g (right: %.3g)\n", fault.c_str(), tool, figure, of);
    EXPECT_TRUE(found) << fault << " isn't found by " << tool << ": " << figure << " where right is " << of;
}
void expectNotOne(const char* tool, const std::string& fault, const Ratio& ratio) {
    std::printf("%-28s %s: %.4f +- %.4f\n", fault.c_str(), tool, ratio.value, ratio.halfWidth);
    EXPECT_FALSE(ratio.isOne()) << fault << " isn't found by " << tool << ": " << ratio.value << " +- " << ratio.halfWidth;
}

/// Round trips of several checks over some frames, the first of which has no history.
std::map<std::string, RoundTrips> tripsOf(ShiftSession& session, const std::vector<std::string>& checks, int frames) {
    std::map<std::string, RoundTrips> trips;
    for (int frame = 0; frame < frames; ++frame) {
        session.frame();
        if (frame == 0) continue;
        for (const std::string& check : checks) trips[check].add(session.checks(check));
    }
    return trips;
}

// Between pixels that look alike at different distances of what their paths meet.
TEST_F(Mutations, BetweenPixels) {
    plant(
        folder.path,
        {{"without_g", "shift_check", "restir/jacobian.glsl",
          "float reconnectionJacobian(float Gy, float Gx) { return jacobianRatio(Gy, Gx); }",
          "float reconnectionJacobian(float Gy, float Gx) { return Gy > 0.0 ? 1.0 : 0.0; }"},
         {"without_light_g", "shift_check", "restir/shift.glsl",
          "float G = connectionTerm(w, d.light);\n        t.jacobian *= reconnectionJacobian(G, t.path.G);",
          "float G = connectionTerm(w, d.light);"},
         {"unchecked", "spatial_reuse", "restir/shift.glsl", "if (t.vertex < 2u || suffix) return true;", "return true;"},
         {"lobe_pdf", "shift_check", "restir/shift.glsl", "leave(t, s, d.way, roughness, value.pdf);", "leave(t, s, d.way, roughness, value.onePdf);"},
         {"share_lost", "shift_check", "restir/mis.glsl", "(theirs > 0.0 ? balanceMis(p.canonical * pHat, theirs) : 1.0)",
          "balanceMis(p.canonical * pHat, theirs) * float(theirs > 0.0)"}});
    ASSERT_FALSE(HasFailure());
    const std::vector<std::string> checks{"right", "without_g", "without_light_g", "lobe_pdf", "share_lost", "of_unchecked"};
    // So long a distance that many a path is near it.
    OrderedJson passes{{"hits", hitsNode()}, {"initial", initialNode({{"bounces", 3}, {"distance", 0.6}})}};
    for (const char* check : {"without_g", "without_light_g", "lobe_pdf", "share_lost"})
        passes[check] = node(check, pathsOf("initial"), near);
    passes["right"] = node("shift_check", pathsOf("initial"), near);
    passes["unchecked"] = node("unchecked", pathsOf("initial"), near);
    passes["of_unchecked"] = node("shift_check", pathsOf("unchecked"), near);
    ShiftSession session(
        {.scene = sceneFile("ensemble_glossy"), .size = {64, 64}, .passes = passes, .checks = checks, .libraries = {folder.path}});
    auto trips = tripsOf(session, checks, 40);

    const RoundTrips& right = trips["right"];
    EXPECT_TRUE(right.all.stretched.ratio().isOne());
    for (const char* fault : {"without_g", "without_light_g"})
        expectNotOne("energy of both ends", fault, trips[fault].all.stretched.ratio());
    // It comes back by its own lax rules; paths that it leaves behind are no paths of their pixels, and don't come back by the right ones.
    const auto lost = [](const RoundTrips& t) { return double(t.lost) / double(t.there); };
    expectFound("return", "unchecked", lost(trips["of_unchecked"]) > 1e-4, lost(trips["of_unchecked"]), lost(right));
    expectFound("F there and back", "lobe_pdf", RoundTrips::shareAbove(trips["lobe_pdf"].all.errorsF, 1e-3f) > 1e-4,
                RoundTrips::shareAbove(trips["lobe_pdf"].all.errorsF, 1e-3f), RoundTrips::shareAbove(right.all.errorsF, 1e-3f));
    expectFound("sum of MIS weights", "share_lost", RoundTrips::shareAbove(trips["share_lost"].errorsMis, 1e-4f) > 1e-4,
                RoundTrips::shareAbove(trips["share_lost"].errorsMis, 1e-4f), RoundTrips::shareAbove(right.errorsMis, 1e-4f));
}

// What decides about connections by footprint, and which light a path ends in, asked otherwise where the path was made than where it goes.
TEST_F(LongMutations, FootprintsAndLights) {
    plant(folder.path,
          {{"one_way", "shift_check", "restir/criteria.glsl",
            "return (p.end != PAIR_SURFACE || p.at > 0.0) && spreadsOver(c.least, pdfFrom(p), p.cosineBefore, p.distance);",
            "return p.end != PAIR_SURFACE || p.at > 0.0;"},
           {"another_threshold", "shift_check", "restir/path_vertex.glsl", "pathThreshold(seed, rules.spread)", "pathThreshold(seed.yx, rules.spread)"},
           {"another_light", "shift_check", "restir/shift.glsl", "lightPoint(w, t.hit.light)", "lightPoint(w, t.hit.light + 1u)"}});
    ASSERT_FALSE(HasFailure());
    const std::vector<std::string> checks{"right", "one_way", "another_threshold", "another_light"};
    // So large a footprint that many a path is near it.
    OrderedJson passes{{"hits", hitsNode()},
                       {"initial", initialNode({{"bounces", 3}, {"criteria", "footprint"}, {"footprint", 1.0}, {"lightCandidates", 8}})}};
    for (const std::string& check : checks) {
        passes[check] = node(check == "right" ? "shift_check" : check, pathsOf("initial"), near);
        passes[check]["set"]["suffix"] = "walked";
    }
    ShiftSession session(
        {.scene = sceneFile("ensemble_glossy"), .size = {64, 64}, .passes = passes, .checks = checks, .libraries = {folder.path}});
    auto trips = tripsOf(session, checks, 20);
    const auto lost = [&](const char* check) { return double(trips[check].lost) / double(trips[check].there); };
    const auto off = [&](const char* check) { return RoundTrips::shareAbove(trips[check].all.errorsF, 1e-3f); };
    EXPECT_LE(lost("right"), 1e-4);
    EXPECT_LE(off("right"), 1e-4);
    for (const char* fault : {"one_way", "another_threshold"}) expectFound("return", fault, lost(fault) > 1e-4, lost(fault), lost("right"));
    expectFound("F there and back", "another_light", off("another_light") > 1e-4, off("another_light"), off("right"));
}

TEST_F(Mutations, BetweenFrames) {
    plant(folder.path, {{"wrong_world", "shift_check", "shift_check.comp", "    return partnerWorld();\n}",
                         "    return trip == OF_PARTNER && way == BACK ? world() : partnerWorld();\n}"},
                        {"without_light_pdf", "shift_check", "restir/shift.glsl",
                         "t.jacobian *= jacobianRatio(t.path.lightPdf > 0.0 ? t.path.lightPdf : 1.0, density);", ""}});
    ASSERT_FALSE(HasFailure());
    const std::vector<std::string> checks{"right", "wrong_world", "without_light_pdf"};
    OrderedJson passes{{"hits", hitsNode()}, {"initial", initialNode({{"bounces", 2}})}};
    for (const std::string& check : checks) passes[check] = node(check == "right" ? "shift_check" : check, pathsOf("initial", "initial"));
    // Lantern and toy move as far in a frame as they do in several of the scene file.
    OrderedJson scene = OrderedJson::parse(readText(sceneFile("ensemble_moving")));
    scene["animation"]["speed"] = 6;
    for (auto& [name, model] : scene["models"].items()) model["file"] = (sceneFolder() / model["file"].get<std::string>()).string();
    writeFile(folder.path / "fast.json", scene.dump());
    ShiftSession session(
        {.scene = folder.path / "fast.json", .size = {64, 64}, .passes = passes, .checks = checks, .libraries = {folder.path}});
    auto trips = tripsOf(session, checks, 40);

    const RoundTrips& right = trips["right"];
    EXPECT_LE(RoundTrips::shareAbove(right.all.errorsF, 1e-3f), 1e-4);
    EXPECT_TRUE(right.of(PathEnd::toLight).stretched.ratio().isOne());
    expectFound("F there and back", "wrong_world", RoundTrips::shareAbove(trips["wrong_world"].all.errorsF, 1e-3f) > 1e-4,
                RoundTrips::shareAbove(trips["wrong_world"].all.errorsF, 1e-3f), RoundTrips::shareAbove(right.all.errorsF, 1e-3f));
    expectNotOne("energy of both ends", "without_light_pdf", trips["without_light_pdf"].of(PathEnd::toLight).stretched.ratio());
}

// What behind glass has been absorbed once is absorbed again by every shift.
TEST_F(Mutations, AbsorbedTwice) {
    plant(folder.path,
          {{"absorbed_twice", "initial_sampling", "restir/path_tree.glsl", "if (p.k > 0u) p.suffix *= left;", "p.suffix *= left;"}});
    ASSERT_FALSE(HasFailure());
    OrderedJson passes{{"hits", hitsNode()}};
    const std::vector<std::string> checks{"right", "absorbed_twice"};
    for (const std::string& check : checks) {
        const std::string initial = check + "_initial";
        passes[initial] = initialNode({{"bounces", 6}});
        if (check != "right") passes[initial]["type"] = check;
        passes[check] = node("shift_check", pathsOf(initial, initial));
        passes[check]["in"]["rules"] = initial + ".rules";
    }
    ShiftSession session(
        {.scene = sceneFile("ensemble_glass"), .size = {64, 64}, .passes = passes, .checks = checks, .libraries = {folder.path}});
    auto trips = tripsOf(session, checks, 24);
    const RoundTrips& right = trips["right"];
    const double share = RoundTrips::shareAbove(trips["absorbed_twice"].all.errorsF, 1e-3f);
    expectFound("F there and back", "absorbed_twice", share > 1e-4, share, RoundTrips::shareAbove(right.all.errorsF, 1e-3f));
}

// What panes take of a light's last segment is missing in F but not behind x_k, or where the segment was traced anew.
TEST_F(LongMutations, DimmedInPart) {
    plant(folder.path, {{"bright_suffix", "initial_sampling", "restir/reservoir.glsl", "if (s.k > 0u && s.k < s.d) r.radiance *= share;", ""},
                        {"bright_shift", "shift_check", "restir/shift.glsl", "dimLight(t.path, t.shape, transmittance(hit));", ""}});
    ASSERT_FALSE(HasFailure());
    OrderedJson passes{
        {"hits", hitsNode()}, {"initial", initialNode({{"bounces", 3}})}, {"bright", node("bright_suffix", OrderedJson::object(), {{"bounces", 3}})}};
    passes["right"] = node("shift_check", pathsOf("initial", "initial"));
    passes["bright_suffix"] = node("shift_check", pathsOf("bright", "bright"));
    passes["bright_shift"] = node("bright_shift", pathsOf("initial", "initial"));
    for (const char* check : {"right", "bright_suffix", "bright_shift"}) {
        passes[check]["set"]["suffix"] = "kept";
        passes[check]["in"]["rules"] = check == std::string("bright_suffix") ? "bright.rules" : "initial.rules";
    }
    ShiftSession session({.scene = sceneFile("ensemble_panes"),
                          .size = {64, 64},
                          .passes = passes,
                          .checks = {"right", "bright_suffix", "bright_shift"},
                          .libraries = {folder.path}});
    auto trips = tripsOf(session, {"right", "bright_suffix", "bright_shift"}, 8);
    const auto off = [&](const char* check) { return RoundTrips::shareAbove(trips[check].all.errorsF, 1e-3f); };
    EXPECT_LE(off("right"), 1e-4);
    for (const char* fault : {"bright_suffix", "bright_shift"}) expectFound("F there and back", fault, off(fault) > 1e-4, off(fault), off("right"));
}

/// Energies of images over independent frames or chains of them.
using Energies = std::map<std::string, std::vector<double>>;
Energies energiesOf(ShiftSession& session, const std::vector<std::string>& images, int chains, int length) {
    Energies energies;
    for (int chain = 0; chain < chains; ++chain) {
        session.restart(std::uint32_t(chain * length));
        for (int i = 0; i < length; ++i) session.frame();
        for (const std::string& image : images) energies[image].push_back(session.energy(image));
    }
    return energies;
}

// Energy after reuse against that of the same frames before it.
TEST_F(Mutations, Energy) {
    plant(folder.path,
          {{"failed_is_absent", "spatial_reuse", "spatial_reuse.comp", "    } else if (result.jacobian > 0) {\n",
            "    } else if (result.jacobian == 0) {\n"
            "        r.pairs = defensivePairwiseMis(r.pairs.canonical, r.pairs.neighbours - r.confidence);\n"
            "    } else {\n"},
           {"share_gone", "spatial_reuse", "restir/mis.glsl", "(theirs > 0.0 ? balanceMis(p.canonical * pHat, theirs) : 1.0)",
            "balanceMis(p.canonical * pHat, theirs) * float(theirs > 0.0)"},
           {"one_percent", "shade_reservoirs", "restir/reservoir.glsl", "r.F * r.W : vec3(0.0)", "r.F * (1.01 * r.W) : vec3(0.0)"},
           {"three_percent", "shade_reservoirs", "restir/reservoir.glsl", "r.F * r.W : vec3(0.0)", "r.F * (1.03 * r.W) : vec3(0.0)"}});
    ASSERT_FALSE(HasFailure());
    OrderedJson passes{{"hits", hitsNode()}, {"initial", initialNode({{"bounces", 3}})}, {"first", shadeNode("initial")}};
    std::vector<std::string> images{"first"}, faults{"right", "failed_is_absent", "share_gone"};
    for (const std::string& fault : faults) {
        passes[fault + "_reuse"] = node(fault == "right" ? "spatial_reuse" : fault, pathsOf("initial"), near);
        passes[fault + "_image"] = shadeNode(fault + "_reuse");
        images.push_back(fault + "_image");
    }
    for (const char* fault : {"one_percent", "three_percent"}) {
        passes[std::string(fault) + "_image"] = node(fault, {{"paths", "right_reuse"}});
        images.push_back(std::string(fault) + "_image");
        faults.push_back(fault);
    }
    ShiftSession session(
        {.scene = sceneFile("ensemble_glossy"), .size = {48, 48}, .passes = passes, .images = images, .libraries = {folder.path}});
    const Energies energies = energiesOf(session, images, 60, 1);
    for (const std::string& fault : faults) {
        const Ratio ratio = ratioOf(energies.at(fault + "_image"), energies.at("first"));
        if (fault != "right")
            expectNotOne("energy", fault, ratio);
        else
            EXPECT_TRUE(ratio.isOne()) << ratio.value << " +- " << ratio.halfWidth;
    }
}

// The furnace's answer is exact, so that even small faults of temporal weights stand out.
TEST_F(Mutations, Furnace) {
    plant(folder.path, {{"cap_on_one_side", "temporal_reprojection", "temporal_reprojection.comp",
                         "float m = balanceMis(mine * target(r.own), r.confidence * r.back);",
                         "float m = balanceMis(mine * target(r.own), confidence(historyReservoirs(place(pastPixel(r, 0)))) * r.back);"}});
    ASSERT_FALSE(HasFailure());
    OrderedJson passes{{"hits", hitsNode()}, {"initial", initialNode({{"bounces", 2}, {"technique", "bsdf"}, {"roulette", false}})}};
    const std::vector<std::string> images{"right_image", "cap_on_one_side_image"};
    for (const std::string fault : {"right", "cap_on_one_side"}) {
        passes[fault] = node(fault == "right" ? "temporal_reprojection" : fault, pathsOf("initial", fault), {{"cap", 2}});
        passes[fault + "_image"] = shadeNode(fault);
    }
    ShiftSession session({.scene = sceneFile("furnace"), .size = {32, 32}, .passes = passes, .images = images, .libraries = {folder.path}});
    const Energies energies = energiesOf(session, images, 8, 6);
    const std::vector<double> exact(8, 1.75);
    const Ratio right = ratioOf(energies.at("right_image"), exact);
    EXPECT_NEAR(right.value, 1, 1e-5) << "no path of it is noisy: but for rounding it is exact";
    expectNotOne("furnace", "cap_on_one_side", ratioOf(energies.at("cap_on_one_side_image"), exact));
}

}  // namespace
}  // namespace lodestir::test
