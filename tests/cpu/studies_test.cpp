// SPDX-License-Identifier: MIT
// Studies with the graphs of the tree, without a device: each file starts, and what is judged by another pixel filter than its own is refused.
#include "../end_to_end/source_folder.h"
#include "../temporary_folder.h"

#include <framework/study/ablation.h>
#include <framework/study/stage.h>

#include <set>

#include <gtest/gtest.h>

namespace lodestir::test {
namespace {

/// What is said of a study before anything runs; empty: nothing.
std::string complaintOf(const Path& file) {
    try {
        Study study = loadStudy(file);
        Renderer renderer;
        expandAblations(study, renderer);
        Stage(study, {}).check();
        return {};
    } catch (const Error& error) {
        return error.what();
    }
}

std::vector<Path> studiesOfTheTree() {
    std::vector<Path> files;
    for (std::filesystem::recursive_directory_iterator entry(sourceFolder / "studies"), end; entry != end; ++entry) {
        if (entry->path().filename() == "results") entry.disable_recursion_pending();  // what studies have found is no study
        if (entry->path().extension() == ".json") files.push_back(entry->path());
    }
    std::ranges::sort(files);
    return files;
}

// If this fails, a study is found broken on the day that somebody needs it.
TEST(Studies, Start) {
    const std::vector<Path> files = studiesOfTheTree();
    EXPECT_GT(files.size(), 10u);
    for (const Path& file : files) EXPECT_EQ(complaintOf(file), "") << file;
}

/// The graphs of a study's techniques on its first scene.
struct StudyGraphs {
    const Study study;
    Stage stage;
    std::vector<Graph> graphs;

    explicit StudyGraphs(const char* file) : study(loadStudy(sourceFolder / "studies" / file)), stage(study, {}) {
        for (const Technique& technique : study.techniques) graphs.push_back(stage.build(technique.graph, {}, 0, 1).graph);
    }
};

/// Passes of a graph by name, with every default; what is said of criteria that are not asked left out.
nlohmann::json passesOf(const Graph& graph) {
    nlohmann::json passes = nlohmann::json::parse(graph.resolved().dump(-1))["passes"];  // sorted by name
    nlohmann::json& initial = passes["initial"]["set"];
    if (initial["criteria"] == "footprint")
        for (const char* name : {"distance", "distanceShare"}) initial.erase(name);
    return passes;
}

// If this fails, a row of the table shows more than one technique, or its end is not the graph that others are judged by.
TEST(Table1, LeadsFrom2022ToTheEnhancedGraphByOneTechniqueARow) {
    const StudyGraphs table("restir_pt_enhanced/table1.json");
    Renderer renderer;
    const auto expectSame = [&](const Graph& row, const char* file, const GraphOptions& options) {
        EXPECT_EQ(nlohmann::json::diff(passesOf(renderer.build(sourceFolder / "graphs" / file, options)), passesOf(row)).dump(), "[]") << file;
    };
    expectSame(table.graphs.front(), "restir_pt_2022.json", {});
    expectSame(table.graphs.back(), "restir_pt_enhanced.json",
               {.set = {{"hits.film", Json("centre")}, {"hits.lens", Json(false)}, {"spatial.compaction", Json(true)}}, .variant = "duplication map"});
    for (std::size_t row = 1; row < table.graphs.size(); ++row)
        EXPECT_NE(passesOf(table.graphs[row]), passesOf(table.graphs[row - 1])) << "row " << row << " shows nothing new";
}

bool wired(const Graph& graph, const char* pass, const char* port) {
    const GraphNode& node = graph.nodes[std::size_t(graph.find(pass))];
    for (std::size_t i = 0; i < node.inputs.size(); ++i)
        if (node.pass->ports[i]->name == port) return node.inputs[i].has_value();
    throw Error(std::string("no port ") + port);
}
std::string typeOf(const Graph& graph, const char* pass) { return graph.nodes[std::size_t(graph.find(pass))].type; }
std::string valueOf(const Graph& graph, const char* pass, const char* name) {
    const auto& parameters = graph.nodes[std::size_t(graph.find(pass))].pass->parameters;
    const Parameter& parameter = **std::ranges::find(parameters, name, &Parameter::name);
    return writeValue(parameter, parameter.value).dump(-1);
}

// If this fails, two techniques are never judged together, or one never without the other.
TEST(Combinations, HoldEveryPairOfTechniques) {
    const StudyGraphs study("restir_pt_enhanced/combinations.json");
    EXPECT_EQ(study.graphs.size(), 8u);
    std::vector<std::vector<std::string>> rows;
    for (const Graph& g : study.graphs)
        rows.push_back({typeOf(g, "spatial"), typeOf(g, "temporal"), valueOf(g, "initial", "criteria"), valueOf(g, "initial", "forcedNee"),
                        valueOf(g, "initial", "roulette"), valueOf(g, "initial", "camera"), valueOf(g, "spatial", "rounds"),
                        std::to_string(wired(g, "initial", "tiles")), std::to_string(wired(g, "shade", "color"))});
    for (std::size_t a = 0; a < rows[0].size(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
            std::set<std::pair<std::string, std::string>> pairs;
            for (const auto& row : rows) pairs.insert({row[a], row[b]});
            EXPECT_EQ(pairs.size(), 4u) << rows[0][a] << " with " << rows[0][b];
        }
}

class AblationTest : public FolderTest {
protected:
    /// The study of one technique, with what is made of it.
    Study study(const char* graph, const OrderedJson& more) {
        OrderedJson technique{{"graph", (sourceFolder / "graphs" / graph).string()}, {"ablate", "auto"}};
        OrderedJson json{{"format", 1},
                         {"scenes", {(sourceFolder / "scenes/cornell.json").string()}},
                         {"reference", {{"graph", (sourceFolder / "graphs/path_tracer.json").string()}, {"spp", 64}}},
                         {"seeds", 1}};
        technique.update(more["technique"]);
        json["techniques"]["whole"] = technique;
        json.update(more["study"]);
        writeFile(folder / "study.json", json.dump(1));
        Study study = loadStudy(folder / "study.json");
        Renderer renderer;
        expandAblations(study, renderer);
        return study;
    }
    static std::vector<std::string> namesOf(const Study& study) {
        std::vector<std::string> names;
        for (const Technique& technique : study.techniques) names.push_back(technique.name);
        return names;
    }
};

// If this fails, a part that another parameter turns on is told to be worth nothing, because it was never away.
TEST_F(AblationTest, WhatTakesAnothersValueIsTurnedOffToo) {
    const OrderedJson technique{{"set", {{"initial.forcedNee", true}}}, {"alike", {{"initial.roulette", "initial.forcedNee"}}}};
    const Study made = study("restir_pt.json", {{"technique", technique}, {"study", OrderedJson::object()}});
    Stage stage(made, {});
    const auto parameters = [&](const std::string& name) {
        const std::vector<std::string> names = namesOf(made);
        const auto place = std::size_t(std::ranges::find(names, name) - names.begin());
        const Graph graph = stage.build(made.techniques.at(place).graph, {}, 0, 1).graph;
        const nlohmann::json set = nlohmann::json::parse(graph.resolved().dump(-1))["passes"]["initial"]["set"];
        return std::pair(set["forcedNee"].get<bool>(), set["roulette"].get<bool>());
    };
    EXPECT_EQ(parameters("whole"), std::pair(true, true));
    EXPECT_EQ(parameters("whole without initial.roulette"), std::pair(true, false));
    EXPECT_EQ(parameters("whole without initial.forcedNee"), std::pair(false, false));
}

// If this fails, a study of parts that counts what one of them makes can't be run at all.
TEST_F(AblationTest, APartThatIsCountedStays) {
    const OrderedJson counts{{"counts", {{"ends", "temporal.cursor"}}}};
    const std::vector<std::string> all = namesOf(study("restir_lod.json", {{"technique", OrderedJson::object()}, {"study", OrderedJson::object()}}));
    const std::vector<std::string> counted = namesOf(study("restir_lod.json", {{"technique", OrderedJson::object()}, {"study", counts}}));
    EXPECT_TRUE(std::ranges::count(all, "whole without temporal"));
    EXPECT_FALSE(std::ranges::count(counted, "whole without temporal"));
    EXPECT_TRUE(std::ranges::count(counted, "whole without spatial"));
    EXPECT_EQ(complaintOf(folder / "study.json"), "");
}

class FilterTest : public FolderTest {
protected:
    static Path graph(const char* file) { return sourceFolder / "graphs" / file; }
    static OrderedJson technique(const Path& file, OrderedJson more = OrderedJson::object()) {
        more["graph"] = file.string();
        return more;
    }
    /// Of a study of one technique against path tracing with rays of that film, through all of the lens or, of centres, through the lens' centre.
    std::string complaint(const OrderedJson& judged, const std::string& referenceFilm, StudyKind kind = StudyKind::error) {
        const OrderedJson rays{{"trace.film", referenceFilm}, {"trace.lens", referenceFilm != "centre"}};
        OrderedJson study{{"format", 1},
                          {"scenes", {(sourceFolder / "scenes/cornell.json").string()}},
                          {"reference", technique(graph("path_tracer.json"), {{"set", rays}, {"spp", 64}})},
                          {"techniques", {{"judged", judged}}}};
        if (kind == StudyKind::ensemble)
            study.update(OrderedJson{{"kind", "ensemble"}, {"runs", 16}});
        else
            study["seeds"] = 1;
        writeFile(folder / "study.json", study.dump(1));
        return complaintOf(folder / "study.json");
    }
};

// If this fails, the difference between two filters stands in a report as an error, or a technique is refused that has its reference's filter.
TEST_F(FilterTest, IsThatOfTheReference) {
    const OrderedJson ownPlaces{{"hits.film", "centre"}, {"hits.lens", false}, {"initial.camera", "path"}};
    const std::vector<std::pair<OrderedJson, std::string>> techniques{
        {technique(graph("path_tracer.json")), "random"},
        {technique(graph("path_tracer.json"), {{"set", {{"trace.film", "centre"}, {"trace.lens", false}}}}), "centre"},
        {technique(graph("restir_pt.json")), "random"},
        {technique(graph("restir_pt.json"), {{"variant", "no reuse"}}), "random"},
        {technique(graph("restir_pt.json"), {{"variant", "paired"}, {"port", "spatial.color"}}), "random"},
        {technique(graph("restir_pt_2022.json")), "centre"},
        {technique(graph("restir_pt_2022.json"), {{"port", "direct.color"}}), "centre"},
        {technique(graph("restir_lod.json")), "random"},
        {technique(graph("restir_pt_enhanced.json"), {{"set", {{"hits.film", "centre"}, {"hits.lens", false}}}}), "centre"},
        {technique(graph("restir_pt_enhanced.json"), {{"variant", "duplication map"}, {"set", ownPlaces}}), "random"}};
    for (const auto& [judged, film] : techniques)
        for (const char* reference : {"random", "centre"}) {
            const std::string said = complaint(judged, reference);
            EXPECT_EQ(said.empty(), film == reference) << judged << ", " << reference << ": " << said;
            EXPECT_EQ(complaint(judged, reference, StudyKind::ensemble), said);
        }
}

TEST_F(FilterTest, OneFrameOfOnePlaceIsNoBoxFilter) {
    for (const char* file : {"restir_pt.json", "restir_lod.json"}) {
        const OrderedJson jittered = technique(graph(file), {{"variant", "frame jitter"}});
        for (const char* reference : {"random", "centre", "frame"}) EXPECT_NE(complaint(jittered, reference), "") << file << ", " << reference;
        EXPECT_EQ(complaint(jittered, "random", StudyKind::ensemble), "") << "its mean is";
        EXPECT_NE(complaint(jittered, "centre", StudyKind::ensemble), "");
    }
}

// One point of the lens a pixel is no mean over the lens, however many frames of history stand behind it.
TEST_F(FilterTest, OneFrameOfOneLensPointIsNoLens) {
    const OrderedJson centres = technique(graph("restir_pt_enhanced.json"), {{"set", {{"hits.film", "centre"}}}});
    const std::string said = complaint(centres, "centre");
    EXPECT_NE(said.find("the centres of pixels and one point of the lens a frame, the reference through the centres of pixels and the lens' centre"), said.npos)
        << said;
    EXPECT_NE(complaint(technique(graph("path_tracer.json"), {{"set", {{"trace.lens", false}}}}), "random"), "");
    EXPECT_EQ(complaint(technique(graph("restir_pt_enhanced.json")), "random", StudyKind::ensemble), "") << "its mean is";
}

TEST_F(FilterTest, OneThatDiffersIsToldAndMayBeMeant) {
    OrderedJson judged = technique(graph("restir_pt_2022.json"));
    const std::string said = complaint(judged, "random");
    EXPECT_TRUE(said.starts_with((folder / "study.json:").string())) << said;
    const char* part =
        "technique \"judged\" sees through the centres of pixels and the lens' centre, the reference through random places of pixels and all of the lens; give";
    EXPECT_NE(said.find(part), said.npos) << said;
    judged["otherFilter"] = true;
    EXPECT_EQ(complaint(judged, "random"), "");
    const OrderedJson varied = technique(graph("path_tracer.json"), {{"vary", {{"trace.film", {"random", "centre"}}}}});
    EXPECT_NE(complaint(varied, "random").find("the centres"), std::string::npos) << "a value among others";
}

}  // namespace
}  // namespace lodestir::test
