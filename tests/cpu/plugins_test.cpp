// SPDX-License-Identifier: MIT
// A pass library that is found wrongly, or built against another framework, crashes in a place that says nothing.
#include <framework/graph/graph.h>
#include <framework/graph/header.h>
#include <framework/graph/plugins.h>
#include <framework/graph/schema.h>
#include <framework/study/content.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <unistd.h>

namespace lodestir {
namespace {

namespace fs = std::filesystem;

constexpr const char* twoPasses = R"(#include <framework/pass/pass.h>
#include <array>
using namespace lodestir;
struct Stars {
    static constexpr std::string_view name = "Stars";
    static constexpr std::array members{bundled<vec4>("places", "where each is"), bundled<float>("ages", "how old")};
};
struct First final : Pass {
    Out<Image> image{this, "image", "an image", Format::r16f};
    Out<Stars> stars{this, "stars", "stars", Count::fixed(9)};
    Param<int> n{this, "n", 3, {0, 9}, "a number"};
};
struct Second final : Pass {
    In<Image> image{this, "image", "an image"};
    In<Stars> stars{this, "stars", "stars", Need::optional};
    Out<Image> copy{this, "copy", "a copy", Format::r16f};
};
LODESTIR_PASS(First, "first.comp", "Makes an image.")
LODESTIR_PASS(Second, "second.comp", "Copies an image.")
)";
constexpr const char* onePass = R"(#include <framework/pass/pass.h>
using namespace lodestir;
struct Only final : Pass { Out<Image> image{this, "image", "an image", Format::r16f}; };
LODESTIR_PASS(Only, "only.comp", "The only pass of its folder.")
)";
constexpr const char* noPass = "#include <framework/pass/pass.h>\nnamespace { struct Lost final : lodestir::Pass {}; }\n";

/// Folders of passes, compiled once for all tests of this file, as somebody outside the tree would.
class Plugins : public testing::Test {
protected:
    static void SetUpTestSuite() {
        root() = Path(testing::TempDir()) / ("lodestir_plugins_" + std::to_string(::getpid()));
        compile("pair", twoPasses, LODESTIR_ABI);
        compile("single", onePass, LODESTIR_ABI);
        compile("stale", onePass, "0123456789abcdef");
        compile("empty", noPass, LODESTIR_ABI);
        writeFile(root() / "broken" / "libbroken.so", "this is no library");
        writeFile(root() / "single" / "only.comp", "// beside source and library\n");
    }
    static void TearDownTestSuite() { fs::remove_all(root()); }

    static Path& root() {
        static Path path;
        return path;
    }

    static void compile(const std::string& name, const char* source, const std::string& abi, const char* rest = "") {
        const Path folder = root() / name;
        writeFile(folder / (name + ".cpp"), source);
        writeFile(folder / "rest.cpp", rest);
        const std::string api = LODESTIR_BUILD_DIR "/api", sources = (folder / (name + ".cpp")).string() + " " + (folder / "rest.cpp").string();
        const std::string command = "g++ -std=c++20 -fPIC -shared -fvisibility=hidden -I" + api + " -I" + api +
                                    "/framework/shaders '-DLODESTIR_ABI=\"" + abi + "\"' " + sources + " -o " + (folder / ("lib" + name + ".so")).string();
        ASSERT_EQ(std::system(command.c_str()), 0) << command;
    }

    static std::string complaint(PluginLibraries& libraries, const std::string& type) {
        try {
            libraries.find(type, {"g.json", 3, 7});
        } catch (const Error& error) {
            return error.what();
        }
        return "nothing";
    }
};

TEST_F(Plugins, AreFoundByFolderAndStruct) {
    PluginLibraries libraries({root()});
    EXPECT_STREQ(libraries.find("single").type, "Only");
    EXPECT_STREQ(libraries.find("single.Only").type, "Only");
    EXPECT_STREQ(libraries.find("pair.First").doc, "Makes an image.");
    EXPECT_STREQ(libraries.find("pair.Second").shader, "second.comp");
    EXPECT_EQ(&libraries.find("pair.First"), &libraries.find("pair.First"));
    const PassType second = makePassType("pair.Second", libraries.find("pair.Second"));
    ASSERT_EQ(second.pass->ports.size(), 4u);
    EXPECT_EQ(second.pass->ports[2]->name, "stars.ages");
    EXPECT_EQ(second.pass->ports[3]->name, "copy");
}

TEST_F(Plugins, SayWhatIsWrong) {
    PluginLibraries libraries({root()});
    EXPECT_EQ(complaint(libraries, "pair"), "g.json:3:7: \"pair\" holds 2 passes; name one: pair.First, pair.Second");
    EXPECT_EQ(complaint(libraries, "pair.Frist"), "g.json:3:7: no pass type \"pair.Frist\"; did you mean \"pair.First\"?");
    EXPECT_EQ(complaint(libraries, "singel"), "g.json:3:7: no pass type \"singel\"; did you mean \"single\"?");
    EXPECT_EQ(complaint(libraries, "stale"),
              "g.json:3:7: pass library \"stale\" was built against framework 0123456789abcdef, this is " LODESTIR_ABI
              "; build it again against the framework that it is to run with");
    EXPECT_EQ(complaint(libraries, "empty"),
              "g.json:3:7: \"" + (root() / "empty/libempty.so").string() + "\" exports no pass; end its .cpp with LODESTIR_PASS(...)");
    EXPECT_NE(complaint(libraries, "broken").find("pass library \"broken\" can't be loaded: "), std::string::npos)
        << complaint(libraries, "broken");
    EXPECT_THROW(PluginLibraries({root() / "nowhere"}), Error);
}

TEST_F(Plugins, AllLoadsWhatLoads) {
    PluginLibraries libraries({root()});
    Problems problems;
    std::vector<std::string> ours;
    for (const PluginLibraries::Entry& entry : libraries.all(problems)) {
        if (entry.type.starts_with("pair.") || entry.type.starts_with("single")) ours.push_back(entry.type);
    }
    EXPECT_EQ(ours, (std::vector<std::string>{"pair.First", "pair.Second", "single"}));
    EXPECT_EQ(problems.list().size(), 3u);  // broken, empty, stale
}

TEST_F(Plugins, WorkInAGraph) {
    PluginLibraries libraries({root()});
    const Json json = Json::parse(
        R"({"format": 1, "show": "b",
            "passes": {"a": {"type": "pair.First", "set": {"n": 4}}, "b": {"type": "pair.Second", "in": {"image": "a", "stars": "a"}}}})",
        "g.json");
    const Graph graph = buildGraph(readDescription(json, "g.json"), libraries);
    EXPECT_EQ(graph.nameOf(graph.show), "b.copy");
    EXPECT_EQ(graph.wiringOf(1, 1), "a.stars");  // a bundle that the framework has never heard of
    EXPECT_EQ(graph.nameOf(*graph.nodes[1].inputs[2]), "a.stars.ages");
    EXPECT_EQ(std::get<int>(graph.nodes[0].pass->parameters[0]->value), 4);
}

// A study would keep what no program computes any more.
TEST_F(Plugins, AnyOfTheirSourcesRenamesResults) {
    const auto content = [](const char* rest) {
        compile("single", onePass, LODESTIR_ABI, rest);
        PluginLibraries libraries({root()});
        const Json json = Json::parse(R"({"format": 1, "passes": {"a": {"type": "single"}}, "show": "a"})", "g.json");
        return contentOf(buildGraph(readDescription(json, "g.json"), libraries));
    };
    const Hash before = content("int rest() { return 1; }"), same = content("int rest() { return 1; }"), changed = content("int rest() { return 2; }");
    EXPECT_EQ(before, same);
    EXPECT_NE(before, changed);
}

TEST_F(Plugins, FindTheirShaders) {
    PluginLibraries libraries({root()});
    EXPECT_EQ(shaderOf(libraries.find("single"), "only.comp"), root() / "single" / "only.comp");
    EXPECT_THROW(shaderOf(libraries.find("pair.First"), "first.comp"), Error);
    EXPECT_EQ(includeFolders(libraries.find("single")).back(), familyFolder());
}

/// A rule of the house: constructing a pass never touches the GPU. This test has none.
TEST(ShippedPasses, DeclareThemselvesWithoutAGpu) {
    PluginLibraries libraries;
    Problems problems;
    for (const PluginLibraries::Entry& entry : libraries.all(problems)) {
        const PassType type = makePassType(entry.type, *entry.plugin);
        checkDeclaration(*type.pass, entry.type, {}, problems);
        EXPECT_FALSE(type.doc.empty()) << entry.type;
        for (const Port* port : type.pass->ports) EXPECT_FALSE(port->doc.empty()) << entry.type << "." << port->name;
        for (const Parameter* parameter : type.pass->parameters)
            EXPECT_FALSE(parameter->doc.empty()) << entry.type << "." << parameter->name;
    }
    std::string said;
    for (const Problem& problem : problems.list()) said += problem.text() + "\n";
    EXPECT_EQ(said, "");
}

}  // namespace
}  // namespace lodestir
