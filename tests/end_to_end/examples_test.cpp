// SPDX-License-Identifier: MIT
// Every graph that ships runs: the example beside each pass, its variants, and the named configurations.
#include "program.h"
#include "shared_device.h"

#include <framework/app/session.h>

#include <optional>

namespace lodestir::test {
namespace {

/// Graph files in a folder and its folders.
std::vector<Path> graphsIn(const Path& folder) {
    std::vector<Path> graphs;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".json") graphs.push_back(entry.path());
    std::ranges::sort(graphs);
    return graphs;
}

class Examples : public ProgramTest {
protected:
    /// Some small frames: finite, no port read or written outside, and validation silent.
    void runs(const Path& graph, int frames, const std::optional<std::string>& variant = {}) {
        SCOPED_TRACE(graph.string() + (variant ? ", " + *variant : ""));
        SessionOptions options{.graph = graph, .changes = {.size = glm::uvec2(64, 36), .variant = variant}, .checkBounds = true};
        try {
            Session session(options, {.device = sharedDevice(), .scene = scene_});
            scene_ = session.sharedScene();
            for (int frame = 0; frame < frames; ++frame) {
                session.runner().run();
                EXPECT_TRUE(allFinite(session.runner().readImage(session.graph().show))) << "frame " << frame;
            }
        } catch (const Error& error) {
            ADD_FAILURE() << error.what();
        }
        EXPECT_EQ(sharedDevice()->validationMessages(), std::vector<std::string>{});
    }

private:
    std::shared_ptr<Scene> scene_;  ///< of the last graph; the next one often has the same
};

// Four frames, so that history, states and @prev are met.
TEST_F(Examples, OfEachPass) {
    for (const Path& graph : graphsIn(sourceFolder / "passes")) {
        EXPECT_EQ(graph.stem(), graph.parent_path().filename()) << "an example is named like its pass";
        runs(graph, 4);
    }
}

using LongExamples = Examples;

// By default `check` reads them, below.
TEST_F(LongExamples, EachVariantOfEachPass) {
    for (const Path& graph : graphsIn(sourceFolder / "passes")) {
        const OrderedJson variants = readJson(graph).value("variants", OrderedJson::object());
        for (const auto& [name, patch] : variants.items()) runs(graph, 1, name);
    }
}

// By default those that no test of their own runs; their passes are above.
TEST_F(Examples, NamedConfigurations) {
    const std::set<std::string> withTests{"impostor",  "impostor_restir", "path_tracer",        "path_tracer_lod", "restir_lod",   "restir_lod_enhanced",
                                          "restir_pt", "restir_pt_2022",  "restir_pt_enhanced", "stochastic_lod",  "variable_rate"};
    for (const Path& graph : graphsIn(sourceFolder / "graphs"))
        if (!withTests.contains(graph.stem().string())) runs(graph, 3);
}

// The same as the driver's compiler makes them for others.
TEST_F(LongExamples, OfEachPass) {
    for (const Path& graph : graphsIn(sourceFolder / "passes")) runs(graph, 4);
}

TEST_F(LongExamples, NamedConfigurations) {
    for (const Path& graph : graphsIn(sourceFolder / "graphs")) runs(graph, 3);
}

// If this fails, a pass has no example, and nobody sees it work.
TEST_F(Examples, EachPassHasOne) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(sourceFolder / "passes")) {
        if (entry.path().extension() != ".cpp") continue;
        const Path place = entry.path().parent_path();
        EXPECT_TRUE(std::filesystem::exists(place / (place.filename().string() + ".json"))) << place;
    }
}

// With their variants.
TEST_F(Examples, CheckPlansEachWithoutADevice) {
    std::vector<Path> graphs = graphsIn(sourceFolder / "passes");
    for (const Path& graph : graphsIn(sourceFolder / "graphs")) graphs.push_back(graph);
    const std::string sceneFile = (sourceFolder / "scenes/cornell.json").string();  // their own are loaded by the tests above
    for (const Path& graph : graphs) {
        const Output output =
            runProcess({LODESTIR_BINARY, "check", graph.string(), "--scene", sceneFile}, {{"VK_DRIVER_FILES", "/nowhere"}, {"VK_ICD_FILENAMES", "/nowhere"}});
        EXPECT_EQ(output.exitCode, 0) << graph << "\n" << output.err;
        EXPECT_FALSE(output.out.empty()) << graph;
    }
}

}  // namespace
}  // namespace lodestir::test
