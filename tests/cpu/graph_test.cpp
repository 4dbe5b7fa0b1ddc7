// SPDX-License-Identifier: MIT
// Wrong wiring that goes unnoticed gives a plausible wrong image; a wrong message costs its reader an hour.
#include "fake_passes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace lodestir {
namespace {

std::string inputOf(const Graph& graph, const std::string& node, const std::string& port) {
    const GraphNode& n = graph.nodes[std::size_t(graph.find(node))];
    for (std::size_t i = 0; i < n.inputs.size(); ++i) {
        if (n.pass->ports[i]->name == port) return n.inputs[i] ? graph.nameOf(*n.inputs[i]) : "unwired";
    }
    return "no such port";
}

template <class F> std::string complaint(const F& part) {
    try {
        part();
    } catch (const Error& error) {
        return error.what();
    }
    return "nothing";
}

/// The text of an expected Value of a parameter.
std::string valueOf(const Graph& graph, const std::string& node, const std::string& name) {
    for (const Parameter* p : graph.nodes[std::size_t(graph.find(node))].pass->parameters) {
        if (p->name == name) return writeValue(*p, p->value).dump(-1);
    }
    return "no such parameter";
}

TEST(Graph, WiresInputsAndSetsParameters) {
    fake::Workshop workshop;
    const Graph g = workshop.build(R"("r": {"type": "render", "set": {"gain": 2, "sky": false, "note": "x"}},
                                      "b": {"type": "blur", "in": {"color": "r.color"}, "set": {"radius": 3, "taps": 5}},
                                      "t": {"type": "tone_map", "in": {"color": "b"}})",
                                   "t");
    EXPECT_EQ(inputOf(g, "b", "color"), "r.color");
    EXPECT_EQ(inputOf(g, "b", "mask"), "unwired");
    EXPECT_EQ(inputOf(g, "t", "color"), "b.glow");
    EXPECT_EQ(valueOf(g, "r", "gain"), "2.0");
    EXPECT_EQ(valueOf(g, "r", "sky"), "false");
    EXPECT_EQ(valueOf(g, "b", "taps"), "5");
    EXPECT_EQ(g.nameOf(g.show), "t.image");
    EXPECT_EQ(g.nodes[std::size_t(g.find("b"))].pass->shader, "fake.comp");
}

TEST(Graph, AddsTheSceneWhereNobodyMakesAWorld) {
    fake::Workshop workshop;
    const Graph g = workshop.build(R"("r": {"type": "render"})", "r.color");
    ASSERT_EQ(g.nodes.size(), 2u);
    EXPECT_EQ(g.nodes[0].name, "scene");
    EXPECT_TRUE(g.nodes[0].implied);
    EXPECT_EQ(inputOf(g, "r", "world"), "scene.world");
    const Graph lod = workshop.build(R"("r": {"type": "render"}, "lod": {"type": "lod_select"})", "r.color");
    EXPECT_EQ(inputOf(lod, "lod", "scene"), "scene.world");
    EXPECT_EQ(inputOf(lod, "r", "world"), "lod.world");  // though it stands further down
    const Graph named =
        workshop.build(R"("lod": {"type": "lod_select", "in": {"scene": "scene.world"}}, "r": {"type": "render"})", "r.color");
    EXPECT_EQ(inputOf(named, "lod", "scene"), "scene.world");
    const Graph explicitly = workshop.build(R"("s": {"type": "scene"}, "r": {"type": "render"})", "r.color");
    EXPECT_EQ(explicitly.nodes.size(), 2u);
    EXPECT_EQ(inputOf(explicitly, "r", "world"), "s.world");
}

TEST(Graph, BindsWorldsToTheLastProducerThatDoesNotDependOnTheConsumer) {
    fake::Workshop workshop;
    const Graph chain = workshop.build(R"("a": {"type": "lod_select"}, "b": {"type": "lod_select"}, "r": {"type": "render"})", "r.color");
    EXPECT_EQ(inputOf(chain, "a", "scene"), "scene.world");
    EXPECT_EQ(inputOf(chain, "b", "scene"), "a.world");
    EXPECT_EQ(inputOf(chain, "r", "world"), "b.world");
    const Graph prev = workshop.build(R"("lod": {"type": "lod_select"}, "m": {"type": "motion"})", "m");
    EXPECT_EQ(inputOf(prev, "m", "world"), "lod.world");
    EXPECT_EQ(inputOf(prev, "m", "worldPrev"), "lod.world@prev");
    EXPECT_EQ(inputOf(prev, "m", "other"), "unwired");  // optional inputs are left alone
}

TEST(Graph, BindsWhateverIsHandedOnLikeAWorld) {
    fake::Workshop workshop;
    const Graph g = workshop.build(R"("s": {"type": "start_tally"}, "t": {"type": "show_tally"},
                                      "a": {"type": "add_to_tally"}, "b": {"type": "add_to_tally"})",
                                   "t");
    EXPECT_EQ(inputOf(g, "a", "tally"), "s.tally");
    EXPECT_EQ(inputOf(g, "b", "tally"), "a.tally");
    EXPECT_EQ(inputOf(g, "t", "tally"), "b.tally");
    EXPECT_EQ(inputOf(g, "t", "tallyPrev"), "b.tally@prev");
    EXPECT_EQ(complaint([&] { workshop.build(R"("t": {"type": "show_tally", "in": {"tallyPrev": "t@prev"}})", "t"); }),
              "test.json:1:56: pass \"t\": input \"tally\" (Tally: in the end) is not wired; no pass of the graph makes one\n"
              "test.json:1:104: pass \"t\": \"tallyPrev\" takes Tally, but t.image@prev is Image");
}

TEST(Graph, AnInputAndAnOutputMayShareTheirName) {
    fake::Workshop workshop;
    const char* passes =
        R"("r": {"type": "render"}, "s": {"type": "sharpen", "in": {"color": "r.color"}}, "t": {"type": "tone_map", "in": {"color": "s.color"}})";
    const Graph g = workshop.build(passes, "s.color");
    EXPECT_EQ(inputOf(g, "s", "color"), "r.color");
    EXPECT_EQ(g.show, (Source{g.find("s"), 1}));
    EXPECT_EQ(inputOf(g, "t", "color"), "s.color");
}

TEST(Graph, BindsAStructThatOnlyOnePassMakes) {
    fake::Workshop workshop;
    EXPECT_EQ(inputOf(workshop.build(R"("a": {"type": "agree_on"}, "f": {"type": "follow"})", "f"), "f", "agreed"), "a.agreed");
    const auto message = [&](const std::string& passes) {
        try {
            workshop.build(passes, "f");
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    const std::string two = message(R"("a": {"type": "agree_on"}, "b": {"type": "agree_on"}, "f": {"type": "follow"})");
    EXPECT_NE(two.find("is not wired; made by: a.agreed, b.agreed"), std::string::npos) << two;
    EXPECT_NE(message(R"("f": {"type": "follow"})").find("no pass of the graph makes one"), std::string::npos);
}

TEST(Graph, WiresABundleByOneName) {
    fake::Workshop workshop;
    const char* passes = R"("e": {"type": "emit"}, "a": {"type": "drift", "in": {"particles": "e", "past": "b.particles@prev"}},
                            "b": {"type": "drift", "in": {"particles": "a.particles"}},
                            "all": {"type": "weigh", "in": {"masses": "b"}}, "one": {"type": "weigh", "in": {"masses": "e.particles.masses"}},
                            "both": {"type": "mix", "in": {"a": "all", "b": "one"}})";
    const Graph g = workshop.build(passes, "both");
    EXPECT_EQ(inputOf(g, "a", "particles.places"), "e.particles.places");
    EXPECT_EQ(inputOf(g, "a", "particles.masses"), "e.particles.masses");
    EXPECT_EQ(inputOf(g, "a", "past.masses"), "b.particles.masses@prev");
    EXPECT_EQ(inputOf(g, "b", "past.places"), "unwired");
    EXPECT_EQ(inputOf(g, "all", "masses"), "b.particles.masses");  // a member alone, found by its type
    EXPECT_EQ(inputOf(g, "one", "masses"), "e.particles.masses");
    EXPECT_EQ(countOf(g, g.find("b"), 4, {8, 8}), 300u);           // like its own input, across both edges
    EXPECT_EQ(bytesOf(g, g.find("b"), 5, {8, 8}), 300u * 4);
    const Json in = *g.resolved().find("passes")->find("a")->find("in");
    EXPECT_EQ(in.dump(-1), "{\"particles\": \"e.particles\", \"past\": \"b.particles@prev\"}");
    const std::vector<Source> dumped = findSources(g, "b.particles");
    ASSERT_EQ(dumped.size(), 2u);
    EXPECT_EQ(g.nameOf(dumped[1]), "b.particles.masses");
    EXPECT_EQ(workshop.build(passes, "b.particles.masses").show, dumped[1]);
    EXPECT_EQ(complaint([&] { findSource(g, "b.masses"); }), "pass \"b\" has no port \"masses\"; did you mean \"particles.masses\"?");
    EXPECT_EQ(complaint([&] { findSource(g, "b.particles"); }),
              "\"b.particles\" is a bundle of 2 ports; name one: b.particles.places, b.particles.masses");
}

TEST(Graph, ABundleGoesThroughAPassThatIsOff) {
    fake::Workshop workshop;
    const Graph g = workshop.build(R"("e": {"type": "emit"}, "a": {"type": "drift", "off": true, "in": {"particles": "e"}},
                                      "b": {"type": "drift", "in": {"particles": "a", "past": "a@prev"}}, "w": {"type": "weigh", "in": {"masses": "b"}})",
                                   "w");
    EXPECT_EQ(inputOf(g, "b", "particles.masses"), "e.particles.masses");
    EXPECT_EQ(inputOf(g, "b", "past.places"), "e.particles.places@prev");
}

TEST(Graph, APassAloneIsItsOnlyOutputOfTheWantedType) {
    fake::Workshop workshop;
    const Graph g = workshop.build(R"("r": {"type": "render"}, "t": {"type": "tone_map", "in": {"color": "r"}},
                                      "v": {"type": "values", "in": {"values": "r@prev"}})",
                                   "v");
    EXPECT_EQ(inputOf(g, "t", "color"), "r.color");
    EXPECT_EQ(inputOf(g, "v", "values"), "r.values@prev");
}

TEST(Graph, ASwitchedOffPassHandsItsInputThrough) {
    fake::Workshop workshop;
    const char* passes = R"("lod": {"type": "lod_select", "off": true}, "r": {"type": "render"},
                            "b": {"type": "blur", "off": true, "in": {"color": "r.color"}},
                            "c": {"type": "blur", "off": true, "in": {"color": "b.glow"}},
                            "x": {"type": "temporal", "in": {"color": "c", "past": "c@prev"}},
                            "t": {"type": "tone_map", "in": {"color": "c"}})";
    const Graph g = workshop.build(passes, "x");
    EXPECT_EQ(inputOf(g, "r", "world"), "scene.world");
    EXPECT_EQ(inputOf(g, "t", "color"), "r.color");
    EXPECT_EQ(inputOf(g, "x", "past"), "r.color@prev");
    EXPECT_EQ(workshop.build(passes, "c").show, (Source{g.find("r"), 1}));
}

TEST(Graph, SetsParametersLater) {
    fake::Workshop workshop;
    Graph g = workshop.build(R"("lod": {"type": "lod_select"}, "r": {"type": "render"})", "r.color");
    EXPECT_TRUE(setParameter(g, "r.gain", Json(0.25)));
    EXPECT_FALSE(setParameter(g, "r.gain", Json(0.25)));
    EXPECT_TRUE(setParameter(g, "lod.mode", Json("schedule")));
    EXPECT_EQ(static_cast<fake::LodSelect&>(*g.nodes[std::size_t(g.find("lod"))].pass).mode, fake::LodSelect::Mode::schedule);
    EXPECT_EQ(complaint([&] { setParameter(g, "r.gian", Json(1)); }),
              "pass \"r\": no parameter \"gian\" on render; did you mean \"gain\"?");
    EXPECT_EQ(complaint([&] { setParameter(g, "q.gain", Json(1)); }), "no pass \"q\"; known: scene, lod, r");
    EXPECT_EQ(complaint([&] { setParameter(g, "r.gain", Json(11)); }),
              "pass \"r\": \"gain\" must be 0..10, not 11; float 0..10, default 0.1: multiplies the radiance");
    EXPECT_EQ(complaint([&] { setParameter(g, "lod.mode", Json("shedule")); }),
              "pass \"lod\": \"mode\" can't be \"shedule\"; did you mean \"schedule\"?");
    EXPECT_EQ(valueOf(g, "r", "gain"), "0.25");
}

TEST(Graph, CommandLineSettingsAreCheckedLikeTheFile) {
    fake::Workshop workshop;
    EXPECT_EQ(valueOf(workshop.build(R"("r": {"type": "render"})", "r.color", {.set = {readSetting("r.gain=0.1")}}), "r", "gain"), "0.1");
    EXPECT_EQ(complaint([&] { workshop.build(R"("r": {"type": "render"})", "r.color", {.set = {readSetting("r.gain=fast")}}); }),
              "--set r.gain=fast: pass \"r\": \"gain\" must be a number, not a string (\"fast\")");
}

TEST(Graph, SizesFollowPortsAndEdges) {
    fake::Workshop workshop;
    const Graph g = workshop.build(R"("r": {"type": "render"}, "h": {"type": "half", "in": {"color": "r.color"}},
                                      "b": {"type": "blur", "in": {"color": "h"}}, "v": {"type": "values", "in": {"values": "r.values"}},
                                      "k": {"type": "bake"}, "l": {"type": "lookup", "in": {"color": "b", "table": "k"}})",
                                   "l.found");
    const glm::uvec2 frame(101, 61);
    EXPECT_EQ(sizeOf(g, g.find("h"), 1, frame), glm::uvec2(51, 31));  // rounded up
    EXPECT_EQ(sizeOf(g, g.find("b"), 2, frame), glm::uvec2(51, 31));
    EXPECT_EQ(sizeOf(g, g.find("b"), 1, frame), glm::uvec2(0, 0));  // an unwired input
    EXPECT_EQ(countOf(g, g.find("v"), 1, frame), 2u * 101 * 61);
    EXPECT_EQ(countOf(g, g.find("l"), 2, frame), 1000u);
    EXPECT_EQ(bytesOf(g, g.find("l"), 3, frame), 4u * 101 * 61);
    EXPECT_EQ(bytesOf(g, g.find("v"), 1, frame), 16u * 2 * 101 * 61);
}

TEST(Graph, WritesItselfWithAllDefaultsAndReadsTheSameAgain) {
    fake::Workshop workshop;
    const Graph g = workshop.build(R"("lod": {"type": "lod_select", "set": {"mode": "distance"}}, "r": {"type": "render"},
                                      "off": {"type": "blur", "off": true, "in": {"color": "r.color"}},
                                      "x": {"type": "temporal", "in": {"color": "off", "past": "x@prev"}})",
                                   "x");
    const Json resolved = g.resolved();
    EXPECT_EQ(resolved.find("passes")->find("r")->find("set")->find("gain")->asNumber(), 0.1);
    EXPECT_EQ(resolved.find("passes")->find("lod")->find("set")->find("mode")->asString(), "distance");
    EXPECT_EQ(resolved.find("passes")->find("x")->find("in")->find("past")->asString(), "x.result@prev");
    const Graph again = buildGraph(readDescription(Json::parse(resolved.dump(), "again.json"), "again.json"), workshop.libraries());
    EXPECT_EQ(again.resolved().dump(), resolved.dump());
}

TEST(Graph, FindsPortsToShow) {
    fake::Workshop workshop;
    const Graph g = workshop.build(R"("r": {"type": "render"}, "k": {"type": "bake"}, "b": {"type": "blur", "in": {"color": "r.color"}},
                                      "l": {"type": "lookup", "in": {"color": "b", "table": "k"}})",
                                   "l.counts");  // scratch can be shown
    EXPECT_EQ(g.nameOf(g.show), "l.counts");
    EXPECT_EQ(g.nameOf(findSource(g, "b.color")), "r.color");  // an input is what it is wired to
    EXPECT_EQ(complaint([&] { findSource(g, "b.mask"); }), "\"b.mask\" is not wired, so there is nothing to show");
    EXPECT_EQ(complaint([&] { findSource(g, "r"); }), "pass \"r\" has 2 outputs; name one: r.color, r.values");
    EXPECT_EQ(complaint([&] { findSource(g, "b.glowe"); }), "pass \"b\" has no port \"glowe\"; did you mean \"glow\"?");
}

/// Every file of tests/errors/graphs is wrong in its own way; beside it stands what must be said, without the folder.
TEST(Graph, SaysWhatIsWrongWithBadGraphs) {
    fake::Workshop workshop;
    const Path folder = Path(LODESTIR_SOURCE_DIR) / "tests/errors/graphs";
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != ".json") continue;
        Path expected = entry.path();
        expected.replace_extension(".expected");
        std::string said = complaint([&] { buildGraph(loadDescription(entry.path()), workshop.libraries()); }) + "\n";
        const std::string prefix = folder.string() + "/";
        for (std::size_t at = 0; (at = said.find(prefix)) != said.npos;) said.erase(at, prefix.size());
        EXPECT_EQ(said, readText(expected)) << entry.path();
        ++count;
    }
    EXPECT_GE(count, 20);
}

}  // namespace
}  // namespace lodestir
