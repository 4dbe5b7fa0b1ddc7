// SPDX-License-Identifier: MIT
// What `lodestir probe` tells is what has happened: the same bits as in a run, factors that make the Jacobians, weights that make the image.
#include "frames.h"
#include "program.h"
#include "shift_session.h"

#include <framework/app/probe_tree.h>

#include <functional>

namespace lodestir::test {
namespace {

/// A graph in this process, whose shaders can be asked.
class Probed {
public:
    Probed(const Path& graph, const std::string& scene, glm::uvec2 size, const std::string& variant = {}) {
        SessionOptions options;
        options.graph = graph;
        options.changes.scene = sceneFile(scene).string();
        options.changes.size = size;
        if (!variant.empty()) options.changes.variant = variant;
        SessionParts parts;
        parts.probe = true;
        session_ = std::make_unique<Session>(options, std::move(parts));
    }
    ~Probed() { EXPECT_EQ(session_->device().validationMessages(), std::vector<std::string>{}); }

    Session& session() { return *session_; }
    void run() { session_->runner().run(); }
    /// Runs a frame and gives what the invocations of a pass told in it, one dispatch after the other.
    OrderedJson ask(const std::string& pass, glm::ivec2 pixel) {
        told_ = session_->runner().probe(pixel);
        return toldBy(pass, pixel);
    }
    OrderedJson toldBy(const std::string& pass, glm::ivec2 pixel) const {
        OrderedJson all = OrderedJson::array();
        for (const ProbedDispatch& dispatch : told_) {
            EXPECT_EQ(dispatch.lost, 0u);
            if (session_->graph().nodes[std::size_t(dispatch.node)].name == pass)
                for (OrderedJson& invocation : probeTree(dispatch, pixel)) all.push_back(std::move(invocation));
        }
        return all;
    }
    template <class T> T record(const std::string& port, glm::ivec2 pixel) {
        const std::vector<std::byte> bytes = session_->runner().readBytes(findSource(session_->graph(), port));
        T value;
        std::memcpy(&value, bytes.data() + (std::size_t(pixel.y) * session_->runner().size().x + std::size_t(pixel.x)) * sizeof value, sizeof value);
        return value;
    }
    glm::vec3 color(const std::string& port, glm::ivec2 pixel) {
        const ImageData image = session_->runner().readImage(findSource(session_->graph(), port));
        return {image.at(pixel.x, pixel.y, 0), image.at(pixel.x, pixel.y, 1), image.at(pixel.x, pixel.y, 2)};
    }

private:
    std::unique_ptr<Session> session_;
    std::vector<ProbedDispatch> told_;
};

glm::vec3 vectorOf(const OrderedJson& json) { return {json.at(0).get<float>(), json.at(1).get<float>(), json.at(2).get<float>()}; }
void expectNear(const glm::vec3& a, const glm::vec3& b, float relative) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], relative * std::max(std::abs(b[c]), 1e-6f)) << c;
}

/// The pixels of a grid over a frame.
std::vector<glm::ivec2> someOf(glm::ivec2 size, int step) {
    std::vector<glm::ivec2> pixels;
    for (int y = step / 2; y < size.y; y += step)
        for (int x = step / 2; x < size.x; x += step) pixels.emplace_back(x, y);
    return pixels;
}

/// Everything that has a key, however deep.
void eachWith(const OrderedJson& json, const std::string& key, const std::function<void(const OrderedJson&)>& say) {
    if (json.is_object() && json.contains(key)) say(json);
    if (json.is_structured())
        for (const OrderedJson& part : json) eachWith(part, key, say);
}

/// Product of all factors that a shift told, with what had happened to the path before.
double productOf(const OrderedJson& shift) {
    double product = shift.at("jacobianBefore");
    eachWith(shift, "factor", [&](const OrderedJson& factor) {
        product *= factor.at("factor").get<double>();
        EXPECT_NEAR(factor.at("factor").get<double>(), std::max(factor.at("shifted").get<double>(), 1e-30) / factor.at("base").get<double>(),
                    1e-5 * factor.at("factor").get<double>()) << factor;
    });
    return product;
}

const glm::uvec2 small{48, 32};
constexpr int step = 11;

struct GraphCase {
    const char *graph, *variant, *scene;
};
std::string nameOf(const testing::TestParamInfo<GraphCase>& test) {
    std::string name = std::string(test.param.graph) + "_" + test.param.variant;
    std::ranges::replace_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
    return name;
}
class ProbeBits : public testing::TestWithParam<GraphCase> {};
class ProbeReuse : public testing::TestWithParam<GraphCase> {};

// If this fails, what is told is not what happens in a run.
TEST_P(ProbeBits, AProbedRunHasTheBitsOfAnyOther) {
    const auto [graph, variant, scene] = GetParam();
    const Path file = sourceFolder / "graphs" / graph;
    Probed probed(file, scene, small, variant);
    std::vector<std::string> ports;
    for (const Source& port : probed.session().dumps()) ports.push_back(probed.session().graph().nameOf(port));
    SessionOptions options;
    options.graph = file;
    options.changes.scene = sceneFile(scene).string();
    options.changes.size = small;
    if (*variant) options.changes.variant = variant;
    options.dumps = ports;
    Session plain(options);
    for (int frame = 0; frame < 4; ++frame) {
        if (frame < 3) probed.run();
        else probed.ask("", {20, 12});
        plain.runner().run();
        for (const std::string& port : ports)
            EXPECT_TRUE(probed.session().runner().readBytes(findSource(probed.session().graph(), port)) ==
                        plain.runner().readBytes(findSource(plain.graph(), port))) << port << " in frame " << frame;
    }
}

// If this fails, weights, targets or numbers are not those that chose.
TEST_P(ProbeReuse, WhatIsKeptFollowsFromWhatIsTold) {
    const auto [graph, variant, scene] = GetParam();
    Probed probed(sourceFolder / "graphs" / graph, scene, small, variant);
    for (int i = 0; i < 2; ++i) probed.run();
    std::size_t draws = 0, shifts = 0, failed = 0, held = 0;
    for (const glm::ivec2 pixel : someOf(small, step)) {
        probed.ask("", pixel);
        for (const std::string pass : {"initial", "temporal", "spatial"}) {
            const OrderedJson told = probed.toldBy(pass, pixel);
            ASSERT_FALSE(told.empty()) << pass;
            // The reservoir that was told is the one that the pass has stored.
            eachWith(told, "kept", [&](const OrderedJson& invocation) {
                if (invocation.at("pixel") != OrderedJson{pixel.x, pixel.y}) return;
                const auto stored = probed.record<Reservoir>(pass + ".paths.reservoirs", pixel);
                const OrderedJson& kept = invocation.at("kept");
                EXPECT_FLOAT_EQ(kept.at("W").get<float>(), stored.W) << pass << told.dump(1);
                if (stored.W > 0) expectNear(vectorOf(kept.at("F")), stored.F, 0);
                held += stored.W > 0;
                if (invocation.contains("color")) expectNear(vectorOf(invocation.at("color")), probed.color(pass + ".color", pixel), 0);
            });
            // Of candidates in a row the last that was taken is kept; each draw is u wSum < w.
            eachWith(told, "taken", [&](const OrderedJson& draw) {
                const auto w = draw.at("w").get<float>(), sum = draw.at("wSum").get<float>(), u = draw.at("u").get<float>();
                EXPECT_EQ(draw.at("taken").get<bool>(), u * sum < w) << draw;
                if (draw.contains("m")) {
                    const double weight = draw.at("m").get<double>() * draw.at("target").get<double>() * draw.at("W").get<double>() *
                                          draw.at("jacobian").get<double>();
                    EXPECT_NEAR(w, weight, 1e-5 * weight) << draw;
                    EXPECT_GE(draw.at("m").get<double>(), 0);
                    EXPECT_LE(draw.at("m").get<double>(), 1 + 1e-6);
                }
                ++draws;
            });
            eachWith(told, "way", [&](const OrderedJson& shift) {
                ++shifts;
                if (shift.at("jacobian").get<double>() > 0) {
                    const double product = productOf(shift);
                    EXPECT_NEAR(shift.at("jacobian").get<double>(), product, 2e-6 * product) << shift.dump(1);
                    EXPECT_FALSE(shift.contains("failed")) << shift.dump(1);
                } else {
                    // A shift that is no more says why, and where.
                    bool says = false;
                    for (const char* why : {"failed", "black", "later"}) eachWith(shift, why, [&](const OrderedJson&) { says = true; });
                    EXPECT_TRUE(says) << shift.dump(1);
                    ++failed;
                }
            });
        }
    }
    EXPECT_GT(draws, 50u);
    EXPECT_GT(shifts, 20u);
    EXPECT_GT(failed, 0u);
    EXPECT_GT(held, 10u);
}

const GraphCase withReuse[] = {{"restir_pt.json", "", "ensemble_glossy"},
                               {"restir_pt.json", "paired", "ensemble_moving"},
                               {"restir_pt_enhanced.json", "", "ensemble_lights"},
                               {"restir_lod.json", "", "ensemble_moving"}};
const GraphCase others[] = {{"path_tracer.json", "", "ensemble_glass"}, {"restir_pt_2022.json", "", "ensemble_glossy"}};
INSTANTIATE_TEST_SUITE_P(Reuse, ProbeReuse, testing::ValuesIn(withReuse), nameOf);
INSTANTIATE_TEST_SUITE_P(Reuse, ProbeBits, testing::Values(withReuse[3]), nameOf);
INSTANTIATE_TEST_SUITE_P(LongOthers, ProbeBits, testing::Values(withReuse[0], withReuse[1], withReuse[2], others[0], others[1]), nameOf);

class ProbeWeights : public FolderTest {
protected:
    Path graph(const OrderedJson& passes, const std::string& show) {
        const OrderedJson json{{"format", 1}, {"passes", passes}, {"show", show}};
        writeFile(folder / "graph.json", json.dump());
        return folder / "graph.json";
    }
};

// What is shown where the image is F W of the kept path alone.
TEST_F(ProbeWeights, ContributionTimesWeightIsTheImage) {
    const Path file = graph({{"hits", hitsNode()},
                             {"initial", initialNode({{"bounces", 3}})},
                             {"temporal", node("temporal_reprojection", pathsOf("initial", "temporal"))},
                             {"shade", shadeNode("temporal")}},
                            "shade");
    Probed probed(file, "ensemble_glossy", small);
    for (int i = 0; i < 2; ++i) probed.run();
    std::size_t lit = 0;
    for (const glm::ivec2 pixel : someOf(small, step)) {
        const OrderedJson kept = probed.ask("temporal", pixel).at(0).at("kept");
        const glm::vec3 shown = probed.color("shade.color", pixel);
        lit += shown.x > 0;
        if (kept.contains("F")) expectNear(shown, vectorOf(kept.at("F")) * kept.at("W").get<float>(), 1e-6f);
        else EXPECT_EQ(shown, glm::vec3(0));
    }
    EXPECT_GT(lit, 6u);
}

// The same of a path tracer: what it met and what it sampled, by throughput and share, is the pixel.
TEST_F(ProbeWeights, VerticesAddUpToTheImage) {
    constexpr int samples = 3;
    Probed probed(graph({{"trace", {{"type", "path_tracer"}, {"set", {{"spp", samples}, {"bounces", 4}}}}}}, "trace"), "ensemble_glass", small);
    std::size_t lit = 0;
    for (const glm::ivec2 pixel : someOf(small, step)) {
        const OrderedJson paths = probed.ask("trace", pixel).at(0).at("paths");
        ASSERT_EQ(paths.size(), std::size_t(samples));
        glm::vec3 sum(0);
        for (const OrderedJson& path : paths)
            for (const OrderedJson& vertex : path.at("vertices")) {
                if (vertex.contains("emission"))
                    sum += vectorOf(vertex.at("throughput")) * vectorOf(vertex.at("emission")) * vertex.at("emissionShare").get<float>();
                if (vertex.contains("arrives")) sum += vectorOf(vertex.at("lightSample").at("adds")) * vectorOf(vertex.at("arrives"));
            }
        const glm::vec3 shown = probed.color("trace.color", pixel);
        expectNear(shown, sum / float(samples), 1e-5f);
        lit += shown.x > 0;
    }
    EXPECT_GT(lit, 6u);
}

// The balance heuristic of two: both techniques' weights of one path, from what is told, sum to 1. By fractions of a pixel the past is one technique, whichever
// of its pixels a path is from.
TEST_F(ProbeWeights, TechniquesShareEachPath) {
    const Path file = graph({{"hits", hitsNode()},
                             {"initial", initialNode({{"bounces", 3}})},
                             {"temporal", node("temporal_reprojection", pathsOf("initial", "temporal"), {{"gather", "fractional"}})}},
                            "temporal.color");
    Probed probed(file, "ensemble_moving", small);
    for (int i = 0; i < 2; ++i) probed.run();
    std::size_t shared = 0, past = 0;
    for (const glm::ivec2 pixel : someOf(small, step)) {
        const OrderedJson told = probed.ask("temporal", pixel).at(0);
        if (!told.contains("ownCandidate")) continue;
        const double cOwn = told.at("own").at("confidence"), cPast = told.at("confidencePast");
        const auto expectShare = [&](const OrderedJson& candidate, double c, double pHat, double cOther, double pHatOther) {
            const double mine = c * pHat, theirs = cOther * pHatOther, m = candidate.at("m");
            if (mine + theirs == 0) return;
            EXPECT_NEAR(m, mine / (mine + theirs), 1e-5) << candidate;
            shared += m > 0 && m < 1;
        };
        // p^ from where it was made and p^ from the other technique, each times its confidence.
        const OrderedJson& own = told.at("ownCandidate");
        expectShare(own, cOwn, own.at("target"), cPast, own.at("targetFrom"));
        for (const OrderedJson& shift : told.at("shifts")) {
            if (!shift.contains("candidate")) continue;
            const OrderedJson& candidate = shift.at("candidate");
            expectShare(candidate, cPast, candidate.at("targetFrom"), cOwn, candidate.at("target"));
            ++past;
        }
    }
    EXPECT_GT(shared, 6u);
    EXPECT_GT(past, 3u);
}

// Pairwise: the own path has its share of the beginning and one from each neighbour, and no more; a neighbour's is what the comparison of two gives.
TEST_F(ProbeWeights, NeighboursTakeTheirSharesFromTheOwnPath) {
    const Path file = graph({{"hits", hitsNode()},
                             {"initial", initialNode({{"bounces", 3}})},
                             {"spatial", node("spatial_reuse", pathsOf("initial"), {{"radius", 6}, {"neighbours", 4}})}},
                            "spatial.color");
    Probed probed(file, "ensemble_glossy", small);
    std::size_t compared = 0;
    for (const glm::ivec2 pixel : someOf(small, step)) {
        const OrderedJson told = probed.ask("spatial", pixel).at(0);
        const double mine = told.at("own").at("confidence"), sum = told.at("neighboursConfidence"), total = mine + sum;
        if (sum == 0 || !told.at("own").contains("target")) continue;
        const double target = told.at("own").at("target");
        double share = mine / total;
        EXPECT_NEAR(told.at("ownShareAtFirst").get<double>(), share, 1e-6);
        for (const OrderedJson& shift : told.at("shifts")) {
            if (!shift.contains("way")) continue;
            if (shift.at("way") == "back") {
                const double c = shift.at("confidence"), from = shift.at("targetFrom");
                share += c / total * mine * target / (mine * target + sum * from);
                EXPECT_NEAR(shift.at("ownShare").get<double>(), share, 1e-5) << shift;
                ++compared;
            } else if (shift.contains("candidate")) {
                const OrderedJson& candidate = shift.at("candidate");
                const double c = candidate.at("confidence"), from = candidate.at("targetFrom"), here = candidate.at("target");
                EXPECT_NEAR(candidate.at("m").get<double>(), c / total * sum * from / (sum * from + mine * here), 1e-5) << candidate;
                EXPECT_NEAR(from * shift.at("jacobian").get<double>(), shift.at("base").at("target").get<double>(), 1e-5 * from) << shift;
            }
        }
        EXPECT_NEAR(told.at("ownCandidate").at("m").get<double>(), share, 1e-5);
    }
    EXPECT_GT(compared, 10u);
}

// There and back: both Jacobians of a path that returns, and both shifts' ends.
TEST_F(ProbeWeights, ThereAndBackIsOne) {
    const Path file = graph({{"hits", hitsNode()},
                             {"initial", initialNode({{"bounces", 3}})},
                             {"check", node("shift_check", pathsOf("initial"), {{"radius", 6}})}},
                            "check.color");
    Probed probed(file, "ensemble_glossy", small);
    std::size_t returned = 0;
    double farthest = 1;
    for (const glm::ivec2 pixel : someOf(small, step)) {
        const OrderedJson told = probed.ask("check", pixel).at(0), empty = OrderedJson::array();
        const OrderedJson& shifts = told.contains("shifts") ? told.at("shifts") : empty;
        for (std::size_t i = 0; i + 1 < shifts.size(); i += 2) {
            const OrderedJson &there = shifts.at(i), &back = shifts.at(i + 1);
            if (!there.contains("way") || !back.contains("way") || there.at("jacobian") == 0) continue;
            EXPECT_EQ(there.at("from"), back.at("to"));
            EXPECT_EQ(there.at("to"), back.at("from"));
            EXPECT_NEAR(there.at("jacobian").get<double>() * back.at("jacobian").get<double>(), 1, 1e-6) << there << back;
            farthest = std::max(farthest, there.at("jacobian").get<double>());
            ++returned;
        }
    }
    EXPECT_GT(returned, 10u);
    EXPECT_GT(farthest, 1.05) << "Jacobians that are 1 prove nothing";
}

class ProbeCommand : public ProgramTest {};

TEST_F(ProbeCommand, PrintsThePixelAndWhatItsPortsHold) {
    const Arguments common{(sourceFolder / "graphs/restir_pt.json").string(), "--scene", sceneFile("ensemble_glossy").string(), "--size", "48x32", "--variant",
                           "temporal only"};
    Arguments probe{"probe"}, shown{"run"};
    probe.insert(probe.end(), common.begin(), common.end());
    probe.insert(probe.end(), {"--frame", "2", "--pixel", "25,9"});
    shown.insert(shown.end(), common.begin(), common.end());
    shown.insert(shown.end(), {"--frames", "3", "--last", "--show", "shade", "--out", folder.string()});
    const Output told = lodestir(probe), ran = lodestir(shown);
    ASSERT_EQ(told.exitCode, 0) << told.err;
    ASSERT_EQ(ran.exitCode, 0) << ran.err;
    const OrderedJson json = OrderedJson::parse(told.out);
    EXPECT_EQ(json.at("frame"), 2);
    EXPECT_EQ(json.at("pixel"), (OrderedJson{25, 9}));
    const OrderedJson& passes = json.at("passes");
    const OrderedJson& initial = passes.at("initial");
    EXPECT_EQ(initial.at("type"), "initial_sampling");
    EXPECT_EQ(initial.at("dispatches").at(0).at("shader"), "initial_sampling.comp");
    // The tree begins where its port says.
    const OrderedJson& tree = initial.at("dispatches").at(0).at("invocations").at(0).at("trees").at(0);
    EXPECT_EQ(tree.at("seed"), initial.at("ports").at("paths.reservoirs").at("seed"));
    EXPECT_EQ(tree.at("vertices").at(0).at("primitive"), initial.at("ports").at("paths.samples").at("hit").at("primitive"));
    EXPECT_EQ(tree.at("vertices").at(0).at("barycentrics"), initial.at("ports").at("paths.samples").at("hit").at("barycentrics"));
    const ImageData image = readExr(folder / "shade.2.exr");
    const OrderedJson& shade = passes.at("shade").at("ports").at("color");
    const OrderedJson& kept = passes.at("temporal").at("dispatches").at(0).at("invocations").at(0).at("kept");
    for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(shade.at(std::size_t(c)).get<float>(), image.at(25, 9, c));
        EXPECT_NEAR(kept.at("F").at(std::size_t(c)).get<float>() * kept.at("W").get<float>(), image.at(25, 9, c), 1e-6f * image.at(25, 9, c));
    }
    EXPECT_GT(image.at(25, 9, 0), 0);
}

TEST_F(ProbeCommand, SaysWhatIsWrong) {
    const std::string graph = (sourceFolder / "graphs/restir_pt.json").string(), scene = sceneFile("ensemble_diffuse").string();
    const auto said = [&](Arguments more) {
        Arguments arguments{"probe", graph, "--scene", scene, "--size", "48x32"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Output output = lodestir(arguments);
        EXPECT_EQ(output.exitCode, 2) << output.err;
        EXPECT_EQ(output.out, "");
        return output.err;
    };
    const std::string help = "\nRun with --help for more information.\n";
    EXPECT_EQ(said({"--pixel", "48,5"}), "--pixel: (48, 5) lies outside the frame of 48x32 pixels; the last one is 47,31" + help);
    EXPECT_EQ(said({"--pixel", "4,-1"}), "--pixel: (4, -1) lies outside the frame of 48x32 pixels; the last one is 47,31" + help);
    EXPECT_EQ(said({"--pixel", "4"}), "--pixel: \"4\" is no pixel; write it like 109,69" + help);
    EXPECT_EQ(said({"--pixel", "4,5", "--frame", "-1"}), "--frame: Value -1 not in range 0 to 2147483647" + help);
    EXPECT_NE(said({}).find("--pixel is required"), std::string::npos);
}

}  // namespace
}  // namespace lodestir::test
