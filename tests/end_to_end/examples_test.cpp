// SPDX-License-Identifier: MIT
// Every graph that ships runs: the example beside each pass, its variants, and the named configurations.
#include "program.h"

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
    void runs(const Path& graph, const Arguments& more) {
        SCOPED_TRACE(graph.string() + " " + commandText(more));
        Arguments arguments{"--size", "64x36", "--check-nan", "--check-bounds"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Path out = run("out", graph, arguments);
        EXPECT_TRUE(std::filesystem::exists(out / "run.json"));
        std::filesystem::remove_all(out);
    }
};

// Four frames, so that history, states and @prev are met.
TEST_F(Examples, OfEachPass) {
    for (const Path& graph : graphsIn(sourceFolder / "passes")) {
        EXPECT_EQ(graph.stem(), graph.parent_path().filename()) << "an example is named like its pass";
        runs(graph, {"--frames", "4"});
    }
}

TEST_F(Examples, EachVariantOfEachPass) {
    for (const Path& graph : graphsIn(sourceFolder / "passes")) {
        const OrderedJson variants = readJson(graph).value("variants", OrderedJson::object());
        for (const auto& [name, patch] : variants.items()) runs(graph, {"--frames", "1", "--variant", name});
    }
}

TEST_F(Examples, NamedConfigurations) {
    for (const Path& graph : graphsIn(sourceFolder / "graphs")) runs(graph, {"--frames", "3"});
}

// If this fails, a pass has no example, and nobody sees it work.
TEST_F(Examples, EachPassHasOne) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(sourceFolder / "passes")) {
        if (entry.path().extension() != ".cpp") continue;
        const Path place = entry.path().parent_path();
        EXPECT_TRUE(std::filesystem::exists(place / (place.filename().string() + ".json"))) << place;
    }
}

TEST_F(Examples, CheckPlansEachWithoutADevice) {
    std::vector<Path> graphs = graphsIn(sourceFolder / "passes");
    for (const Path& graph : graphsIn(sourceFolder / "graphs")) graphs.push_back(graph);
    for (const Path& graph : graphs) {
        const Output output =
            runProcess({LODESTIR_BINARY, "check", graph.string()}, {{"VK_DRIVER_FILES", "/nowhere"}, {"VK_ICD_FILENAMES", "/nowhere"}});
        EXPECT_EQ(output.exitCode, 0) << graph << "\n" << output.err;
        EXPECT_FALSE(output.out.empty()) << graph;
    }
}

}  // namespace
}  // namespace lodestir::test
