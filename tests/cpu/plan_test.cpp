// SPDX-License-Identifier: MIT
// A barrier too few corrupts frames on some GPUs only; a pass in the wrong order shows old data. Neither would be seen on lavapipe.
#include "fake_passes.h"

#include <framework/graph/hazards.h>
#include <framework/graph/header.h>
#include <framework/graph/plan.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace lodestir {
namespace {

std::string orderOf(const Plan& plan, const Graph& graph) {
    std::string names;
    for (const PlanStep& step : plan.steps) names += graph.nodes[std::size_t(step.node)].name + " ";
    return names;
}

std::string told(const std::vector<Hazard>& hazards) {
    std::string all;
    for (const Hazard& hazard : hazards) all += hazard.text + "\n";
    return all;
}

const PlanResource& resourceOf(const Plan& plan, const Graph& graph, const std::string& name) {
    const Source source = findSource(graph, name);
    return plan.resources.at(std::size_t(plan.resourceOf(source.node, source.port)));
}

/// Graphs that use everything a plan must handle.
struct Case {
    const char* name;
    const char* passes;
    const char* show;
};
const std::vector<Case> cases{
    {"chain",
     R"("r": {"type": "render"}, "b": {"type": "blur", "in": {"color": "r.color"}}, "t": {"type": "tone_map", "in": {"color": "b"}})", "t"},
    {"backwards",
     R"("t": {"type": "tone_map", "in": {"color": "b"}}, "b": {"type": "blur", "in": {"color": "r.color"}}, "r": {"type": "render"})", "t"},
    {"feedback", R"("r": {"type": "render"}, "x": {"type": "temporal", "in": {"color": "r.color", "past": "b@prev"}},
                    "b": {"type": "blur", "in": {"color": "x"}}, "t": {"type": "tone_map", "in": {"color": "b"}})",
     "t"},
    {"self", R"("r": {"type": "render"}, "x": {"type": "temporal", "in": {"color": "r.color", "past": "x@prev"}})", "x"},
    {"both",
     R"("r": {"type": "render"}, "x": {"type": "temporal", "in": {"color": "r.color", "past": "r.color@prev"}}, "y": {"type": "blur", "in": {"color": "x"}})",
     "y"},
    {"state",
     R"("r": {"type": "render"}, "a": {"type": "accumulate", "in": {"color": "r.color"}}, "t": {"type": "tone_map", "in": {"color": "a.mean"}})",
     "t"},
    {"state read before",
     R"("r": {"type": "render"}, "a": {"type": "accumulate", "in": {"color": "m"}}, "q": {"type": "rate", "in": {"sum": "a.sum@prev"}},
                             "m": {"type": "mix", "in": {"a": "q", "b": "r.color"}})",
     "a.mean"},
    {"once",
     R"("k": {"type": "bake"}, "r": {"type": "render"}, "l": {"type": "lookup", "in": {"color": "r.color", "table": "k"}},
                             "t": {"type": "tone_map", "in": {"color": "l"}})",
     "t"},
    {"once, last frame's",
     R"("k": {"type": "bake"}, "r": {"type": "render"}, "l": {"type": "lookup", "in": {"color": "r.color", "table": "k@prev"}})", "l"},
    {"worlds",
     R"("lod": {"type": "lod_select"}, "r": {"type": "render"}, "m": {"type": "motion"}, "x": {"type": "mix", "in": {"a": "r.color", "b": "m"}})",
     "x"},
    {"diamond",
     R"("r": {"type": "render"}, "a": {"type": "blur", "in": {"color": "r.color"}}, "b": {"type": "half", "in": {"color": "r.color"}},
                   "c": {"type": "blur", "in": {"color": "b"}}, "d": {"type": "mix", "in": {"a": "a", "b": "c"}},
                    "t": {"type": "tone_map", "in": {"color": "d"}})",
     "t"},
    {"alone", R"("k": {"type": "bake"})", "k"},
    {"in place", R"("r": {"type": "render"}, "g": {"type": "grade", "in": {"color": "r.color"}}, "h": {"type": "grade", "in": {"color": "g.graded"}})",
     "h.graded"},
    {"in place, read twice",
     R"("r": {"type": "render"}, "g": {"type": "grade", "in": {"color": "r.color"}}, "m": {"type": "mix", "in": {"a": "g.graded", "b": "r.color"}})", "m"},
    {"in place of what @prev reads",
     R"("r": {"type": "render"}, "x": {"type": "temporal", "in": {"color": "r.color", "past": "b@prev"}}, "b": {"type": "blur", "in": {"color": "x"}},
        "g": {"type": "grade", "in": {"color": "b"}}, "h": {"type": "grade", "in": {"color": "g.graded"}})",
     "h.graded"},
};

TEST(Plan, RunsInFileOrderUnlessNeedsSayOtherwise) {
    fake::Workshop workshop;
    const auto order = [&](int i) {
        const Graph g = workshop.build(cases[std::size_t(i)].passes, cases[std::size_t(i)].show);
        return orderOf(makePlan(g), g);
    };
    EXPECT_EQ(order(0), "scene r b t ");
    EXPECT_EQ(order(1), "scene r b t ");
    EXPECT_EQ(order(2), "scene r x b t ");
    EXPECT_EQ(order(6), "scene r q m a ");  // q reads the sum before a changes it
    EXPECT_EQ(order(7), "scene k r l t ");  // the implied scene comes first
    EXPECT_EQ(order(10), "scene r a b c d t ");
}

TEST(Plan, LeavesOutWhatNobodyNeeds) {
    fake::Workshop workshop;
    const Graph g = workshop.build(R"("r": {"type": "render"}, "b": {"type": "blur", "in": {"color": "r.color"}}, "k": {"type": "bake"},
                                      "x": {"type": "temporal", "in": {"color": "r.color", "past": "h@prev"}}, "h": {"type": "half", "in": {"color": "x"}},
                                      "o": {"type": "blur", "off": true, "in": {"color": "x"}})",
                                   "o");
    const Plan plan = makePlan(g);
    EXPECT_EQ(orderOf(plan, g), "scene r x h ");  // h feeds x through @prev
    ASSERT_EQ(plan.culled.size(), 3u);
    const Plan more = makePlan(g, {findSource(g, "b.glow")});
    EXPECT_EQ(orderOf(more, g), "scene r b x h ");
    EXPECT_TRUE(resourceOf(more, g, "b.glow").pinned);
    EXPECT_TRUE(resourceOf(plan, g, "x.result").pinned);
}

TEST(Plan, KnowsHowLongMemoryLives) {
    fake::Workshop workshop;
    const Graph g = workshop.build(cases[2].passes, cases[2].show);  // scene r x b t
    const Plan plan = makePlan(g);
    EXPECT_EQ(resourceOf(plan, g, "r.color").firstStep, 1);
    EXPECT_EQ(resourceOf(plan, g, "r.color").lastStep, 2);
    EXPECT_EQ(resourceOf(plan, g, "r.values").lastStep, 1);
    EXPECT_FALSE(resourceOf(plan, g, "r.color").history);
    EXPECT_TRUE(resourceOf(plan, g, "b.glow").history);
    EXPECT_TRUE(resourceOf(plan, g, "b.glow").keeps);
    const std::size_t pixels = 100 * 60;
    EXPECT_EQ(resourceOf(plan, g, "b.glow").copies, 1) << "x reads b@prev before b runs";
    EXPECT_EQ(planBytes(plan, g, {100, 60}), sizeof(World) + pixels * (8 + 2 * 16 + 8 + 8 + 4));
    const Graph self = workshop.build(cases[3].passes, cases[3].show);
    EXPECT_EQ(resourceOf(makePlan(self), self, "x.result").copies, 2) << "x reads other pixels of x@prev while it writes";
    const Graph state = workshop.build(cases[5].passes, cases[5].show);
    EXPECT_TRUE(resourceOf(makePlan(state), state, "a.sum").keeps);
    EXPECT_FALSE(resourceOf(makePlan(state), state, "a.sum").history);
}

TEST(Plan, SaysWhyABarrierIsThere) {
    fake::Workshop workshop;
    const Graph g = workshop.build(cases[0].passes, cases[0].show);
    const Plan plan = makePlan(g);
    EXPECT_EQ(plan.steps[1].barrier, "reads scene.world, written by step 1 (scene)");
    EXPECT_EQ(plan.steps[2].barrier, "reads r.color, written by step 2 (r)");
    EXPECT_EQ(plan.steps[3].barrier, "reads b.glow, written by step 3 (b)");
    const Graph once = workshop.build(cases[11].passes, cases[11].show);
    EXPECT_EQ(makePlan(once).steps[0].barrier, "writes k.table, written by step 1 (k) of the frame before");
    EXPECT_EQ(makePlan(once, {}, {.allBarriers = true}).steps[0].barrier, makePlan(once).steps[0].barrier);
}

TEST(Plan, HasNoHazards) {
    fake::Workshop workshop;
    for (const Case& c : cases) {
        const Graph g = workshop.build(c.passes, c.show);
        EXPECT_EQ(told(findHazards(makePlan(g), g)), "") << c.name;
        EXPECT_EQ(told(findHazards(makePlan(g, {}, {.sharing = true}), g)), "") << c.name << " with sharing";
        EXPECT_EQ(told(findHazards(makePlan(g, {}, {.keepAll = true}), g)), "") << c.name << " with all kept";
        EXPECT_EQ(told(findHazards(makePlan(g, {}, {.allBarriers = true}), g)), "") << c.name << " with all barriers";
    }
}

TEST(Plan, NeedsEachOfItsBarriers) {
    fake::Workshop workshop;
    int dropped = 0;
    for (const Case& c : cases) {
        for (const bool sharing : {false, true}) {
            const Graph g = workshop.build(c.passes, c.show);
            const Plan plan = makePlan(g, {}, {.sharing = sharing});
            for (int s = 0; s < int(plan.steps.size()); ++s) {
                if (plan.steps[std::size_t(s)].barrier.empty()) continue;
                const std::vector<Hazard> hazards = findHazards(plan, g, std::vector<int>{s});
                EXPECT_FALSE(hazards.empty()) << c.name << ", barrier before step " << s + 1;
                EXPECT_TRUE(std::ranges::none_of(hazards, [](const Hazard& h) { return h.kind == Hazard::Kind::wrongContent; }))
                    << told(hazards);
                ++dropped;
            }
        }
    }
    EXPECT_GE(dropped, 60);
}

TEST(Hazards, FindPlantedFaults) {
    fake::Workshop workshop;
    const auto kinds = [](const std::vector<Hazard>& hazards) {
        std::vector<Hazard::Kind> found;
        for (const Hazard& hazard : hazards) found.push_back(hazard.kind);
        return found;
    };
    const auto has = [&](const std::vector<Hazard>& hazards, Hazard::Kind kind) { return std::ranges::count(kinds(hazards), kind) > 0; };

    Graph g = workshop.build(cases[2].passes, cases[2].show);
    Plan noCopy = makePlan(g);
    noCopy.resources[std::size_t(noCopy.resourceOf(g.find("r"), 1))].copies = 2;  // a copy too many is only waste
    EXPECT_EQ(told(findHazards(noCopy, g)), "");

    g = workshop.build(cases[4].passes, cases[4].show);  // x reads r.color and r.color@prev
    noCopy = makePlan(g);
    noCopy.resources[std::size_t(noCopy.resourceOf(g.find("r"), 1))].copies = 1;
    EXPECT_TRUE(has(findHazards(noCopy, g), Hazard::Kind::wrongContent));

    g = workshop.build(cases[0].passes, cases[0].show);
    Plan swapped = makePlan(g);
    std::swap(swapped.steps[1].node, swapped.steps[2].node);
    EXPECT_TRUE(has(findHazards(swapped, g), Hazard::Kind::wrongContent));

    g = workshop.build(cases[6].passes, cases[6].show);  // q must read a.sum before a runs
    Plan late = makePlan(g);
    std::rotate(late.steps.begin(), late.steps.begin() + 4, late.steps.end());  // a first
    EXPECT_TRUE(has(findHazards(late, g), Hazard::Kind::wrongContent));

    g = workshop.build(cases[10].passes, cases[10].show);
    Plan shared = makePlan(g);
    shared.resources[std::size_t(shared.resourceOf(g.find("a"), 2))].group = 0;  // a.glow lives until d reads it,
    shared.resources[std::size_t(shared.resourceOf(g.find("c"), 2))].group = 0;  // and c writes before
    shared.groups = 1;
    EXPECT_TRUE(has(findHazards(shared, g), Hazard::Kind::wrongContent));

    Plan bare = makePlan(g);
    std::vector<int> all;
    for (int s = 0; s < int(bare.steps.size()); ++s) all.push_back(s);
    const std::vector<Hazard> hazards = findHazards(bare, g, all);
    EXPECT_TRUE(has(hazards, Hazard::Kind::readAfterWrite));
    EXPECT_TRUE(has(hazards, Hazard::Kind::writeAfterRead));
    EXPECT_TRUE(has(hazards, Hazard::Kind::writeAfterWrite));
}

TEST(Plan, SharesMemoryOnlyWhenAsked) {
    fake::Workshop workshop;
    const Graph g = workshop.build(
        R"("r": {"type": "render"}, "a": {"type": "blur", "in": {"color": "r.color"}}, "b": {"type": "blur", "in": {"color": "a"}},
                                      "c": {"type": "blur", "in": {"color": "b"}}, "d": {"type": "blur", "in": {"color": "c"}})",
        "d");
    EXPECT_EQ(makePlan(g).groups, 0);
    const Plan shared = makePlan(g, {}, {.sharing = true});
    EXPECT_GE(shared.groups, 1);
    EXPECT_LT(planBytes(shared, g, {100, 60}), planBytes(makePlan(g), g, {100, 60}));
    EXPECT_EQ(told(findHazards(shared, g)), "");
    Plan wrong = makePlan(g, {findSource(g, "a.glow")}, {.sharing = true});
    EXPECT_EQ(told(findHazards(wrong, g)), "");
    wrong.resources[std::size_t(wrong.resourceOf(g.find("a"), 2))].group = wrong.resources[std::size_t(wrong.resourceOf(g.find("d"), 2))].group = 0;
    EXPECT_NE(told(findHazards(wrong, g)), "") << "a.glow is asked for after the frame";
}

TEST(Plan, WritesInPlaceWhatNobodyElseNeeds) {
    fake::Workshop workshop;
    const auto named = [&](const std::string& name) { return *std::ranges::find(cases, name, [](const Case& c) { return std::string(c.name); }); };
    const std::size_t pixels = 100 * 60, values = 2 * 16;
    Graph g = workshop.build(named("in place").passes, named("in place").show);
    const Plan plan = makePlan(g);
    EXPECT_EQ(resourceOf(plan, g, "r.color").group, 0);
    EXPECT_EQ(resourceOf(plan, g, "g.graded").group, 0);
    EXPECT_EQ(resourceOf(plan, g, "h.graded").group, 0);
    EXPECT_EQ(planBytes(plan, g, {100, 60}), sizeof(World) + pixels * (8 + values)) << "r.values and one image";
    EXPECT_EQ(makePlan(g, {}, {.keepAll = true}).groups, 0);
    const Plan looked = makePlan(g, {findSource(g, "g.graded")});
    EXPECT_NE(resourceOf(looked, g, "h.graded").group, resourceOf(looked, g, "g.graded").group) << "what is looked at after the frame stays";

    g = workshop.build(named("in place, read twice").passes, named("in place, read twice").show);
    EXPECT_EQ(makePlan(g).groups, 0) << "m reads r.color after g has run";
    Plan wrong = makePlan(g);
    wrong.resources[std::size_t(wrong.resourceOf(g.find("r"), 1))].group = wrong.resources[std::size_t(wrong.resourceOf(g.find("g"), 1))].group = 0;
    wrong.groups = 1;
    EXPECT_NE(told(findHazards(wrong, g)), "");

    g = workshop.build(named("in place of what @prev reads").passes, named("in place of what @prev reads").show);
    EXPECT_EQ(resourceOf(makePlan(g), g, "b.glow").group, -1) << "next frame needs it";
    EXPECT_EQ(resourceOf(makePlan(g), g, "g.graded").group, resourceOf(makePlan(g), g, "h.graded").group);
}

TEST(Plan, MakesOptionalOutputsForReadersAlone) {
    fake::Workshop workshop;
    const char* passes = R"("r": {"type": "render"}, "g": {"type": "grade", "in": {"color": "r.color"}},
                            "t": {"type": "tone_map", "in": {"color": "g.change"}})";
    const Graph g = workshop.build(passes, "g.graded");
    const auto isMade = [&](const Plan& plan) { return plan.resourceOf(g.find("g"), 2) >= 0; };
    const auto stores = [&](const Plan& plan) {
        return passHeader(g, plan, g.find("g")).find("void storeChange(ivec2 p, vec2 value) {}") == std::string::npos;
    };
    for (const auto& [plan, made] : {std::pair(makePlan(g), false), std::pair(makePlan(g, {findSource(g, "g.change")}), true),
                                     std::pair(makePlan(g, {findSource(g, "t")}), true), std::pair(makePlan(g, {}, {.keepAll = true}), true)}) {
        EXPECT_EQ(isMade(plan), made);
        EXPECT_EQ(stores(plan), made);
    }
}

TEST(Plan, TellsItselfInWords) {
    fake::Workshop workshop;
    const Graph g = workshop.build(cases[2].passes, cases[2].show);
    const std::string words = text(makePlan(g), g);
    EXPECT_NE(words.find("5 steps, "), std::string::npos) << words;
    EXPECT_NE(words.find("barrier: reads r.color, written by step 2 (r)"), std::string::npos) << words;
    EXPECT_NE(words.find("kept (@prev)"), std::string::npos) << words;
    EXPECT_NE(words.find("past = b.glow@prev"), std::string::npos) << words;
    const Json fact = facts(makePlan(g), g);
    EXPECT_EQ(fact.find("steps")->items().size(), 5u);
    EXPECT_EQ(std::size_t(fact.find("bytes")->asInt()), planBytes(makePlan(g), g, g.description.size));
}

}  // namespace
}  // namespace lodestir
