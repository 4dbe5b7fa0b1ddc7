// SPDX-License-Identifier: MIT
// An edit that loses a wire, or that is offered and can't be built, leaves people with another graph than they believe to see.
#include "../end_to_end/source_folder.h"
#include "fake_passes.h"

#include <framework/app/view/edit_history.h>
#include <framework/app/view/graph_edit.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace lodestir {
namespace {

/// Which passes a graph has and what each takes: "temporal (temporal_splat): hits=hits.hits motion=hits.motion ...". What it binds by itself is left out.
std::map<std::string, std::string> wiring(const Graph& graph) {
    std::map<std::string, std::string> texts;
    for (const NodeDescription& node : graph.description.nodes) {
        std::string& text = texts[node.name];
        text = node.type + (node.off ? ", off" : "");
        const Pass& pass = *graph.nodes[std::size_t(graph.find(node.name))].pass;
        for (const Wire& input : wiresOf(pass, [](const Port& port) { return port.isInput(); })) {
            const std::optional<Feed> feed = feedOf(graph, graph.find(node.name), input);
            if (!feed || !feed->written) continue;
            const std::string& from = graph.nodes[std::size_t(feed->node)].name;
            text += " " + std::string(input.name()) + "=" + from + "." + std::string(feed->output.name()) + (feed->prev ? "@prev" : "");
        }
    }
    return texts;
}

std::vector<std::string> textsOf(const std::vector<Offer>& offers) {
    std::vector<std::string> texts;
    for (const Offer& offer : offers) texts.push_back(offer.text);
    return texts;
}

Wire inputOf(const Graph& graph, const std::string& node, const std::string& name) {
    const std::vector<Wire> inputs = wiresOf(*graph.nodes[std::size_t(graph.find(node))].pass, [](const Port& port) { return port.isInput(); });
    return *std::ranges::find(inputs, name, &Wire::name);
}

/// With the passes of the tests.
class GraphEdit : public testing::Test {
protected:
    Graph edited(const Json& patch) { return workshop.build(passes, show, {.patches = {patch}}); }
    PassType type(const std::string& name) { return makePassType(name, workshop.libraries().find(name)); }

    fake::Workshop workshop;
    std::string passes, show;
};

TEST_F(GraphEdit, RemovalLeavesConsumersWithWhatThePassWouldHandThrough) {
    passes = R"("r": {"type": "render"}, "b": {"type": "blur", "in": {"color": "r"}}, "m": {"type": "blur", "in": {"color": "b", "mask": "r.color"}},
                "t": {"type": "temporal", "in": {"color": "m", "past": "b@prev"}})";
    show = "b";
    const Graph graph = workshop.build(passes, show);
    const Graph without = edited(removalPatch(graph, graph.find("b")));
    EXPECT_EQ(wiring(without), (std::map<std::string, std::string>{{"r", "render"},
                                                                    {"m", "blur color=r.color mask=r.color"},
                                                                    {"t", "temporal color=m.glow past=r.color@prev"}}));
    EXPECT_EQ(without.nameOf(without.show), "r.color");
}

TEST_F(GraphEdit, RemovalUnwiresOptionalInputsAndRefusesRequiredOnes) {
    passes = R"("r": {"type": "render"}, "h": {"type": "half", "in": {"color": "r"}}, "b": {"type": "blur", "in": {"color": "r", "mask": "h"}})";
    show = "b";
    const Graph graph = workshop.build(passes, show);
    EXPECT_EQ(wiring(edited(removalPatch(graph, graph.find("h"))))["b"], "blur color=r.color");
    try {
        removalPatch(graph, graph.find("r"));
        FAIL() << "two passes need it";
    } catch (const Error& error) {
        EXPECT_EQ(error.problems().size(), 2u);
        EXPECT_EQ(error.problems()[0].text(), "pass \"h\" needs r as its \"color\"; wire that to another first");
    }
    const Graph bare = edited(removalPatch(graph, graph.find("b")));
    EXPECT_EQ(bare.nameOf(bare.show), "r.color");
    passes = R"("r": {"type": "render"}, "h": {"type": "half", "in": {"color": "r"}})";
    show = "h";
    const Graph shown = workshop.build(passes, show);
    EXPECT_THROW(removalPatch(shown, shown.find("h")), Error) << "nothing stands for what is shown";
}

TEST_F(GraphEdit, AMemberOfABundleIsHandedThroughLikeTheWhole) {
    passes = R"("e": {"type": "emit"}, "d": {"type": "drift", "in": {"particles": "e"}},
                "w": {"type": "weigh", "in": {"masses": "d.particles.masses"}}, "f": {"type": "drift", "in": {"particles": "d", "past": "f.particles@prev"}})";
    show = "w";
    const Graph graph = workshop.build(passes, show);
    std::map<std::string, std::string> now = wiring(edited(removalPatch(graph, graph.find("d"))));
    EXPECT_EQ(now["w"], "weigh masses=e.particles.masses");
    EXPECT_EQ(now["f"], "drift particles=e.particles past=f.particles@prev");
}

TEST_F(GraphEdit, WhatIsOffIsStillWiredAsTheGraphSays) {
    passes = R"("r": {"type": "render"}, "b": {"type": "blur", "in": {"color": "r"}}, "t": {"type": "tone_map", "in": {"color": "b"}})";
    show = "t";
    const Graph off = edited(turnPatch("b", true));
    EXPECT_EQ(wiring(off)["b"], "blur, off color=r.color");
    EXPECT_EQ(wiring(off)["t"], "tone_map color=b.glow");
    EXPECT_EQ(off.nodes[std::size_t(off.find("t"))].inputs[0], (Source{off.find("r"), 1}));
    const Graph on = workshop.build(passes, show, {.patches = {turnPatch("b", true), turnPatch("b", false)}});
    EXPECT_EQ(wiring(on)["b"], "blur color=r.color");
}

TEST_F(GraphEdit, ASwapTakesOutputsOfOtherNamesAndItsOwnOfLastFrame) {
    passes = R"("r": {"type": "render"}, "b": {"type": "blur", "in": {"color": "r.color", "mask": "b.glow@prev"}, "set": {"radius": 3}},
                "t": {"type": "tone_map", "in": {"color": "b.glow"}})";
    show = "b.glow";
    const Graph graph = workshop.build(passes, show);
    const std::optional<Json> sharpen = swapPatch(graph, graph.find("b"), type("sharpen"));
    ASSERT_TRUE(sharpen);
    const Graph next = edited(*sharpen);
    EXPECT_EQ(wiring(next)["b"], "sharpen color=r.color");
    EXPECT_EQ(wiring(next)["t"], "tone_map color=b.color");
    EXPECT_EQ(next.nameOf(next.show), "b.color");
    // Two images are asked for: the mask is the other.
    const std::optional<Json> mix = swapPatch(graph, graph.find("b"), type("mix"));
    ASSERT_TRUE(mix);
    EXPECT_EQ(wiring(edited(*mix))["b"], "mix a=r.color b=b.sum@prev");
    EXPECT_FALSE(swapPatch(graph, graph.find("b"), type("blur"))) << "the same";
    EXPECT_FALSE(swapPatch(graph, graph.find("b"), type("values"))) << "makes no image";
    EXPECT_FALSE(swapPatch(graph, graph.find("b"), type("lookup"))) << "nobody has a table";
    EXPECT_FALSE(swapPatch(graph, graph.find("scene"), type("render"))) << "there is one scene";
}

TEST_F(GraphEdit, OffersLastFramesValueOfWhatComesAfter) {
    passes = R"("r": {"type": "render"}, "t": {"type": "temporal", "in": {"color": "r", "past": "t@prev"}}, "b": {"type": "blur", "in": {"color": "t"}})";
    show = "b";
    const Graph graph = workshop.build(passes, show);
    EXPECT_EQ(textsOf(offersFor(graph, graph.find("t"), inputOf(graph, "t", "color"))),
              (std::vector<std::string>{"r.color", "t.result@prev", "b.glow@prev"}));
    EXPECT_EQ(textsOf(offersFor(graph, graph.find("t"), inputOf(graph, "t", "past"))),
              (std::vector<std::string>{"r.color@prev", "t.result@prev", "b.glow@prev"}));
    EXPECT_EQ(wiring(edited(wirePatch("t", "color", "b.glow@prev")))["t"], "temporal color=b.glow@prev past=t.result@prev");
    EXPECT_EQ(wiring(workshop.build(passes, show, {.patches = {wirePatch("b", "mask", "r.color"), wirePatch("b", "mask", "")}}))["b"], "blur color=t.result");
}

TEST_F(GraphEdit, AnAddedPassTakesWhatThereIsOneOfAndAsksForTheRest) {
    passes = R"("blur": {"type": "render"}, "half": {"type": "half", "in": {"color": "blur"}}, "bake": {"type": "bake"})";
    show = "half";
    const Graph graph = workshop.build(passes, show);
    const std::vector<Question> questions = questionsOf(graph, type("lookup"));
    ASSERT_EQ(questions.size(), 1u);
    EXPECT_EQ(questions[0].input, "color");
    EXPECT_EQ(questions[0].answers, (std::vector<std::string>{"blur.color", "half.small"}));
    EXPECT_EQ(wiring(edited(additionPatch(graph, type("lookup"), {{"color", "half.small"}})))["lookup"], "lookup color=half.small table=bake.table");
    EXPECT_EQ(wiring(edited(additionPatch(graph, type("blur"), {{"color", "half.small"}})))["blur_2"], "blur color=half.small") << "no mask was asked for";
    EXPECT_EQ(wiring(edited(additionPatch(graph, type("motion"))))["motion"], "motion") << "the scene comes by itself";
}

/// With the passes and the graphs that are shipped.
class ShippedGraphEdit : public testing::Test {
protected:
    Graph build(const std::string& name, const GraphOptions& options = {}) {
        return buildGraph(loadDescription(test::sourceFolder / "graphs" / (name + ".json"), options), libraries);
    }
    PassType type(const std::string& name) { return makePassType(name, libraries.find(name)); }

    PluginLibraries libraries;
};

TEST_F(ShippedGraphEdit, ASwapKeepsWiresAndSettingsThatBothHave) {
    const Graph before = build("restir_pt", {.set = {readSetting("temporal.cap=12"), readSetting("temporal.depth=0.5")}});
    const std::optional<Json> patch = swapPatch(before, before.find("temporal"), type("temporal_splat"));
    ASSERT_TRUE(patch);
    const Graph after = build("restir_pt", {.patches = {*patch}});
    std::map<std::string, std::string> wanted = wiring(before);
    wanted["temporal"].replace(0, std::string("temporal_reprojection").size(), "temporal_splat");
    EXPECT_EQ(wiring(after), wanted);
    const std::string resolved = after.resolved()["passes"]["temporal"]["set"].dump(-1);
    EXPECT_NE(resolved.find("\"cap\": 12.0"), std::string::npos) << resolved;
    EXPECT_EQ(resolved.find("\"depth\":"), std::string::npos) << "only the other has it: " << resolved;
    // And back again.
    const std::optional<Json> back = swapPatch(after, after.find("temporal"), type("temporal_reprojection"));
    ASSERT_TRUE(back);
    EXPECT_EQ(wiring(build("restir_pt", {.patches = {*patch, *back}})), wiring(before));
    EXPECT_FALSE(swapPatch(before, before.find("temporal"), type("initial_sampling"))) << "there would be two of the rules that the others take by themselves";
    // Nobody makes the partners, and who shades wants the colour.
    EXPECT_FALSE(swapPatch(before, before.find("spatial"), type("spatial_paired_reuse")));
    EXPECT_FALSE(swapPatch(before, before.find("spatial"), type("boiling_filter")));
    const Graph paired = build("restir_lod_enhanced");
    EXPECT_TRUE(swapPatch(paired, paired.find("spatial"), type("spatial_reuse")));
    const Graph disk = build("restir_lod_enhanced", {.variant = "disk", .patches = {additionPatch(paired, type("pairing_textures"))}});
    EXPECT_TRUE(swapPatch(disk, disk.find("spatial"), type("spatial_paired_reuse")));
}

TEST_F(ShippedGraphEdit, EverySwapThatIsOfferedCanBeBuilt) {
    Problems problems;
    std::vector<PassType> types;
    for (const auto& [name, plugin] : libraries.all(problems)) types.push_back(makePassType(name, *plugin));
    ASSERT_TRUE(problems.empty());
    int offered = 0;
    for (const std::string graph : {"restir_pt", "restir_lod_enhanced", "impostor_field", "offline"}) {
        const Graph before = build(graph);
        for (std::size_t n = 0; n < before.nodes.size(); ++n)
            for (const PassType& other : types) {
                const std::optional<Json> patch = swapPatch(before, int(n), other);
                if (!patch) continue;
                ++offered;
                EXPECT_NO_THROW(build(graph, {.patches = {*patch}})) << graph << ": " << before.nodes[n].name << " as " << other.type << patch->dump();
            }
    }
    EXPECT_GT(offered, 8);
}

/// Who makes each World that a graph's passes take: "hits.worldPrev" -> "lod.world@prev".
std::map<std::string, std::string> worlds(const Graph& graph) {
    std::map<std::string, std::string> texts;
    for (std::size_t n = 0; n < graph.nodes.size(); ++n)
        for (const Wire& input : wiresOf(*graph.nodes[n].pass, [](const Port& port) { return port.isInput(); })) {
            if (input.bundle || !input.port().type.isSame(PortTypeOf<World>::value)) continue;
            if (const std::optional<Feed> feed = feedOf(graph, int(n), input))
                texts[graph.nodes[n].name + "." + std::string(input.name())] = graph.nameOf({feed->node, feed->output.first, feed->prev});
        }
    return texts;
}

// An edit of the scene that only some passes see would have reuse compare two scenes.
TEST_F(ShippedGraphEdit, AnEditOfTheSceneIsSeenByAllWhoSawTheScene) {
    for (const std::string name : {"path_tracer", "restir_pt", "restir_lod", "restir_lod_enhanced", "impostor_field", "impostor", "variable_rate"}) {
        const Graph before = build(name);
        const Json patch = worldPatch(before, "lamp", {.type = "light_edit"});
        const Graph after = build(name, {.patches = {patch}});
        std::map<std::string, std::string> expected = worlds(before);
        for (auto& [input, from] : expected)
            if (from.starts_with("scene.")) from.replace(0, 5, "lamp");
        expected["lamp.world"] = "scene.world";
        EXPECT_EQ(worlds(after), expected) << name;
        // One more comes before it.
        const Graph twice = build(name, {.patches = {patch, worldPatch(after, "levels", {.type = "lod_select", .ownPrevious = true})}});
        EXPECT_EQ(worlds(twice)["lamp.world"], "levels.world") << name;
        EXPECT_EQ(worlds(twice)["levels.worldPrev"], "levels.world@prev") << name;
    }
}

HandMade with(int patches, int cap = 0) {
    HandMade made;
    made.patches.resize(std::size_t(patches));
    if (cap > 0) made.set["temporal.cap"] = cap;
    return made;
}

TEST(EditHistory, TakesBackAndDoesAgainInOrder) {
    EditHistory history;
    EXPECT_EQ(history.undoable(), "");
    history.did("first", with(0));
    history.did("second", with(1));
    EXPECT_EQ(history.undoable(), "second");
    EXPECT_EQ(history.beforeLast().patches.size(), 1u);
    history.undid(with(2));
    EXPECT_EQ(history.undoable(), "first");
    EXPECT_EQ(history.redoable(), "second");
    EXPECT_EQ(history.afterNext().patches.size(), 2u);
    history.redid(with(1));
    EXPECT_EQ(history.undoable(), "second");
    EXPECT_EQ(history.redoable(), "");
    history.undid(with(2));
    history.did("another", with(1));
    EXPECT_EQ(history.redoable(), "") << "what was taken back is another story now";
}

TEST(EditHistory, ADraggedSliderIsOneStep) {
    using namespace std::chrono_literals;
    EditHistory history;
    const auto start = EditHistory::Clock::now();
    for (int i = 0; i < 50; ++i) history.did("temporal.cap", with(0, i), start + i * 100ms);
    EXPECT_TRUE(history.beforeLast().set.empty());
    history.did("temporal.cap", with(0, 50), start + 10s);
    EXPECT_EQ(std::get<int>(history.beforeLast().set.at("temporal.cap")), 50) << "later it is another";
    history.undid(with(0, 60));
    EXPECT_TRUE(history.beforeLast().set.empty());
}

}  // namespace
}  // namespace lodestir
