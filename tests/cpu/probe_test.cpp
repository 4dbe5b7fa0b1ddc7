// SPDX-License-Identifier: MIT
// What shaders tell of a pixel: which lines are read as macros, how records become JSON, and that nothing of it is left where nothing is probed.
#include "../temporary_folder.h"

#include <framework/app/probe_tree.h>
#include <framework/core/error.h>
#include <framework/gpu/include_closure.h>
#include <framework/gpu/shader.h>
#include <framework/graph/header.h>

#include <nlohmann/json.hpp>

#include <bit>
#include <limits>
#include <regex>
#include <sstream>

namespace lodestir {
namespace {

using OrderedJson = nlohmann::ordered_json;

TEST(ProbeSites, AreTheMacrosOfALine) {
    const auto only = [](std::string_view line) {
        const std::vector<ProbeSite> sites = probeSitesOf(line);
        EXPECT_EQ(sites.size(), 1u) << line;
        return sites.empty() ? ProbeSite{} : sites.front();
    };
    EXPECT_EQ(only("    PROBE(jacobian, f(a, b));").name, "jacobian");
    EXPECT_EQ(only("if (c) PROBE_CHOICE( way , w, \"forth|back\");").name, "way");
    EXPECT_EQ(only("if (c) PROBE_CHOICE( way , w, \"forth|back\");").words, "forth|back");
    EXPECT_EQ(only("PROBE_TEXT_IF(failed, \"nothing, at all\", a && !b);").words, "nothing, at all");
    EXPECT_EQ(only("PROBE_CLOSE(vertices);  // PROBE(of, a_comment);").name, "vertices");
    for (const char* none : {"#define PROBE(name, value) probeNumber(PROBE_PLACE, value)", "// PROBE(name, value);", "const uint PROBE_FLOAT = 0u;",
                             "uint x = SOUND_PROBE(y);", "probeNumber(place, 1.0);"})
        EXPECT_TRUE(probeSitesOf(none).empty()) << none;
    EXPECT_EQ(probeSitesOf("PROBE(a, x); PROBE(b, y);").size(), 2u);
}

class ProbeClosure : public test::FolderTest {};

TEST_F(ProbeClosure, RefusesTwoInALine) {
    writeFile(folder / "good.comp", std::string("#version 460\n#include \"part.glsl\"\nvoid main() {\n    PROBE(a, 1);\n}\n"));
    writeFile(folder / "part.glsl", std::string("void part() {\n    PROBE_TEXT(b, \"c\");\n}\n"));
    const ProbeSites sites = probeSites(gpu::IncludeClosure(folder / "good.comp", {}, {}));
    ASSERT_EQ(sites.size(), 2u);
    EXPECT_EQ(sites.at(0u << 16 | 4u).name, "a");
    EXPECT_EQ(sites.at(1u << 16 | 2u).words, "c");
    writeFile(folder / "bad.comp", std::string("#version 460\nvoid main() {\n    PROBE(a, 1); PROBE(b, 2);\n}\n"));
    try {
        probeSites(gpu::IncludeClosure(folder / "bad.comp", {}, {}));
        FAIL() << "nothing was said";
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()), (folder / "bad.comp").string() +
                                                 ":3: two PROBE macros stand in one line, which can't be told apart; give each a line of its own");
    }
}

/// Records made by hand: each names its site.
class Story {
public:
    explicit Story(glm::ivec2 pixel) : pixel_(pixel) {}
    Story& add(const std::string& name, std::uint32_t kind, std::vector<std::uint32_t> numbers = {}, const std::string& words = {}) {
        const auto place = std::uint32_t(sites_.size());
        sites_[place] = {name, words};
        ProbeRecord record{place, kind, std::uint32_t(numbers.size()), std::uint32_t(pixel_.x) | std::uint32_t(pixel_.y) << 16, {}};
        for (std::size_t i = 0; i < numbers.size(); ++i) record.numbers[int(i)] = numbers[i];
        dispatch_.records.push_back(record);
        return *this;
    }
    Story& number(const std::string& name, float x) { return add(name, PROBE_FLOAT, {std::bit_cast<std::uint32_t>(x)}); }
    Story& from(glm::ivec2 pixel) {
        pixel_ = pixel;
        return *this;
    }
    OrderedJson tree(glm::ivec2 pixel) {
        dispatch_.sites = std::make_shared<const ProbeSites>(sites_);
        return probeTree(dispatch_, pixel);
    }

private:
    glm::ivec2 pixel_;
    ProbeSites sites_;
    ProbedDispatch dispatch_;
};

TEST(ProbeTree, ValuesAreWhatTheyWereInTheShader) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    const std::uint32_t one = std::bit_cast<std::uint32_t>(1.0f), tenth = std::bit_cast<std::uint32_t>(0.1f);
    Story story({3, 4});
    story.number("share", 0.1f).number("broken", nan).number("endless", -infinity);
    story.add("color", PROBE_FLOAT, {one, tenth, 0}).add("count", PROBE_UINT, {~0u}).add("offset", PROBE_INT, {~0u, 2});
    story.add("kept", PROBE_BOOL, {1}).add("way", PROBE_CHOICE_OF, {1}, "forth|back").add("far", PROBE_CHOICE_OF, {7}, "forth|back");
    story.add("failed", PROBE_WORDS, {}, "something is in the way");
    EXPECT_EQ(story.tree({3, 4}).dump(),
              R"([{"pixel":[3,4],"share":0.1,"broken":"nan","endless":"-inf","color":[1.0,0.1,0.0],"count":4294967295,"offset":[-1,2],)"
              R"("kept":true,"way":"back","far":7,"failed":"something is in the way"}])");
}

TEST(ProbeTree, ScopesNestAndEnd) {
    Story story({0, 0});
    story.add("trees", PROBE_SCOPE).add("vertices", PROBE_SCOPE).number("x", 1).add("pair", PROBE_OBJECT).number("y", 2);
    story.add("vertices", PROBE_SCOPE).number("x", 3);          // ends the pair and the vertex before
    story.add("vertices", PROBE_SCOPE_END).number("z", 4);      // of the tree
    story.add("vertices", PROBE_SCOPE_AGAIN).number("w", 5);    // the second vertex once more
    story.add("nothing", PROBE_SCOPE_END).number("v", 6);       // no such scope is open
    story.add("", PROBE_ITEM_END).number("end", 7);
    story.add("trees", PROBE_SCOPE).number("z", 8);
    EXPECT_EQ(story.tree({0, 0}).dump(),
              R"([{"pixel":[0,0],"trees":[{"vertices":[{"x":1.0,"pair":{"y":2.0}},{"x":3.0,"w":5.0,"v":6.0}],"z":4.0},{"z":8.0}],"end":7.0}])");
}

TEST(ProbeTree, WhatIsToldTwiceIsAList) {
    Story story({0, 0});
    story.number("x", 1).number("x", 2).number("x", 3).add("v", PROBE_UINT, {1, 2}).add("v", PROBE_UINT, {3, 4});
    EXPECT_EQ(story.tree({0, 0}).dump(), R"([{"pixel":[0,0],"x":[1.0,2.0,3.0],"v":[[1,2],[3,4]]}])");
}

TEST(ProbeTree, ThePixelsOwnInvocationComesFirst) {
    Story story({9, 0});
    story.number("x", 1).from({2, 1}).number("x", 2).from({9, 0}).number("y", 3).from({5, 5}).add("", PROBE_ITEM_END).from({1, 1}).number("x", 4);
    EXPECT_EQ(story.tree({2, 1}).dump(), R"([{"pixel":[2,1],"x":2.0},{"pixel":[9,0],"x":1.0,"y":3.0},{"pixel":[1,1],"x":4.0}])")
        << "others by rows, those that told nothing left out";
}

/// A copy of a folder of shaders without the lines that tell.
void copyWithout(const Path& from, const Path& to, std::size_t& left) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(from)) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".glsl" && extension != ".comp" && extension != ".h") continue;
        std::istringstream lines(readText(entry.path()));
        std::string text;
        bool defines = false;
        for (std::string line; std::getline(lines, line);) {
            if (line.starts_with("#ifdef PROBING")) defines = true;
            const bool tells = !defines && !probeSitesOf(line).empty();
            if (line.starts_with("#endif")) defines = false;
            if (tells) {
                EXPECT_TRUE(std::regex_match(line, std::regex(R"(\s*PROBE\w*\(.*\);)"))) << entry.path() << ": " << line;
                ++left;
            } else {
                text += line;
            }
            text += '\n';
        }
        writeFile(to / entry.path().lexically_relative(from), text);
    }
}

// If this fails, runs pay for what nobody asks.
TEST_F(ProbeClosure, NothingIsLeftOfItWhereNothingIsProbed) {
    setenv("LODESTIR_CACHE", (folder / "cache").c_str(), 1);
    std::size_t left = 0, shaders = 0;
    copyWithout(shaderFolder(), folder / "framework/shaders", left);
    copyWithout(familyFolder(), folder / "passes", left);
    EXPECT_GT(left, 100u);
    PluginLibraries libraries;
    for (const char* name : {"restir_pt.json", "restir_pt_enhanced.json", "restir_lod.json", "restir_pt_2022.json"}) {
        const Graph graph = buildGraph(loadDescription(Path(LODESTIR_SOURCE_DIR) / "graphs" / name, {}), libraries);
        const Plan plan = makePlan(graph);
        for (std::size_t node = 0; node < graph.nodes.size(); ++node) {
            const GraphNode& n = graph.nodes[node];
            if (n.pass->shader.empty()) continue;
            for (const auto& entry : std::filesystem::directory_iterator(shaderOf(*n.plugin, n.pass->shader).parent_path())) {
                if (entry.path().extension() != ".comp" || entry.path().string().ends_with(".test.comp")) continue;
                gpu::ShaderSource source{
                    entry.path(), includeFolders(*n.plugin), {{"pass.glsl", passHeader(graph, plan, int(node))}}, {{"TRACE_PACKET", "1"}}};
                for (const Path& file : gpu::IncludeClosure(source.file, source.folders, source.generated).files())
                    if (file.filename() == "driver.glsl") source.defines.emplace_back("TRACE_DRIVER", "1");
                gpu::ShaderSource without = source;
                const auto moved = [&](const Path& path) {
                    return folder / std::filesystem::weakly_canonical(path).lexically_relative(std::filesystem::weakly_canonical(LODESTIR_SOURCE_DIR));
                };
                without.file = moved(source.file);
                for (Path& path : without.folders) path = moved(path);
                EXPECT_TRUE(gpu::compileShader(source).words == gpu::compileShader(without).words) << n.name << ": " << entry.path();
                ++shaders;
            }
        }
    }
    EXPECT_GT(shaders, 20u);
}

}  // namespace
}  // namespace lodestir
