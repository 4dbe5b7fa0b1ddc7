// SPDX-License-Identifier: MIT
// A graph file read wrongly would render something else than its author wrote, or hide where the mistake is.
#include <framework/graph/description.h>

#include <gtest/gtest.h>

#include <filesystem>

namespace lodestir {
namespace {

constexpr const char* text = R"({ "format": 1, "$schema": "graph.schema.json",
  "about": "a test",
  "scene": "../scenes/rock.json",
  "frame": { "size": [320, 200], "count": 64, "seed": 7 },
  "passes": {
    "hits":  { "type": "visibility" },
    "shade": { "type": "restir.Shade", "about": "a comment",
               "in": { "hits": "hits.hits", "past": "shade@prev", "all": "hits" },
               "set": { "bounces": 4, "mode": "both" } } },
  "show": "shade.color",
  "variants": { "dark": { "passes": { "shade": { "off": true, "set": { "bounces": 1 } } } },
                "lone": { "passes": { "shade": { "in": { "past": null } } } } } }
)";

Description read(const GraphOptions& options = {}) { return readDescription(Json::parse(text, "graphs/g.json"), "graphs/g.json", options); }

/// The text of the Error that reading throws.
std::string complaint(const GraphOptions& options) {
    try {
        read(options);
    } catch (const Error& error) {
        return error.what();
    }
    return "nothing";
}

TEST(Description, ReadsEverythingThatIsWritten) {
    const Description d = read();
    EXPECT_EQ(d.about, "a test");
    EXPECT_EQ(d.scene, Path("scenes/rock.json"));
    EXPECT_EQ(d.size, glm::uvec2(320, 200));
    EXPECT_EQ(d.count, 64);
    EXPECT_EQ(d.seed, 7u);
    EXPECT_EQ(d.showNode, "shade");
    EXPECT_EQ(d.showPort, "color");
    EXPECT_EQ(d.variants, (std::vector<std::string>{"dark", "lone"}));
    ASSERT_EQ(d.nodes.size(), 2u);
    EXPECT_EQ(d.nodes[0].name, "hits");
    EXPECT_EQ(d.nodes[0].type, "visibility");
    EXPECT_FALSE(d.nodes[1].off);
    ASSERT_EQ(d.nodes[1].edges.size(), 3u);
    EXPECT_EQ(d.nodes[1].edges[0].fromNode, "hits");
    EXPECT_EQ(d.nodes[1].edges[0].fromPort, "hits");
    EXPECT_FALSE(d.nodes[1].edges[0].prev);
    EXPECT_EQ(d.nodes[1].edges[1].fromNode, "shade");
    EXPECT_EQ(d.nodes[1].edges[1].fromPort, "");
    EXPECT_TRUE(d.nodes[1].edges[1].prev);
    EXPECT_EQ(d.nodes[1].edges[0].where.line, 8);
    EXPECT_EQ(d.nodes[1].edges[0].where.column, 32);
    EXPECT_EQ(d.nodes[1].edges[0].portWhere.column, 24);
    ASSERT_EQ(d.nodes[1].settings.size(), 2u);
    EXPECT_EQ(d.nodes[1].settings[0].name, "bounces");
    EXPECT_EQ(d.nodes[1].settings[0].value.asInt(), 4);
}

TEST(Description, HasDefaultsForFrameAndScene) {
    const Description d = readDescription(Json::parse(R"({"format": 1, "passes": {"a": {"type": "t"}}, "show": "a"})", "g.json"), "g.json");
    EXPECT_EQ(d.size, glm::uvec2(960, 540));
    EXPECT_EQ(d.count, 1);
    EXPECT_EQ(d.seed, 1u);
    EXPECT_TRUE(d.scene.empty());
}

TEST(Description, TheScenesPathMayHaveBackslashes) {
    const Path folder = Path(testing::TempDir()) / "lodestir_description";
    for (const char* name : {"scenes/room.json", "graphs/g.json"}) writeFile(folder / name, std::string_view("{}"));
    const Description d = readDescription(
        Json::parse(R"({"format": 1, "scene": "..\\scenes\\room.json", "passes": {"a": {"type": "t"}}, "show": "a"})", "g.json"),
        folder / "graphs/g.json");
    EXPECT_EQ(d.scene, folder / "scenes/room.json");
}

TEST(Description, AppliesAVariantAsAMergePatch) {
    const Description dark = read({.variant = "dark"});
    EXPECT_TRUE(dark.nodes[1].off);
    EXPECT_EQ(dark.nodes[1].settings[0].value.asInt(), 1);
    EXPECT_EQ(dark.nodes[1].settings[1].value.asString(), "both");  // what a patch doesn't name stays
    EXPECT_EQ(dark.source.find("variants"), nullptr);
    EXPECT_EQ(read({.variant = "lone"}).nodes[1].edges.size(), 2u);  // null removes
    EXPECT_EQ(complaint({.variant = "drak"}), "graphs/g.json: no variant \"drak\"; did you mean \"dark\"?");
}

// If this fails, what is told of techniques together is told of one of them, or of them in another order.
TEST(Description, VariantsAreAppliedOneAfterTheOther) {
    const auto both = [](const char* first, const char* second) {
        return readDescription(Json::parse(R"({"format": 1, "passes": {"a": {"type": "t", "set": {"x": 0, "y": 0}}}, "show": "a", "variants": {
            "one": {"passes": {"a": {"set": {"x": 1}}}}, "two": {"passes": {"a": {"set": {"x": 2, "y": 2}}}}}})",
                                           "g.json"),
                               "g.json", {.variant = fmt::format("{} + {}", first, second)})
            .nodes[0]
            .settings;
    };
    EXPECT_EQ(both("one", "two")[0].value.asInt(), 2);
    EXPECT_EQ(both("two", "one")[0].value.asInt(), 1);
    EXPECT_EQ(both("two", "one")[1].value.asInt(), 2) << "of the one before";
    EXPECT_EQ(complaint({.variant = "dark + lonely"}), "graphs/g.json: no variant \"lonely\"; did you mean \"lone\"?");
    EXPECT_TRUE(complaint({.variant = "dark + "}).starts_with("graphs/g.json: no variant \"\""));
    const auto joined = [] { readDescription(Json::parse(R"({"format": 1, "variants": {"a + b": {}}})", "g.json"), "g.json"); };
    EXPECT_THROW(joined(), Error);
}

TEST(Description, TheCommandLineWinsOverFileAndVariant) {
    GraphOptions options;
    options.variant = "dark";
    options.scene = "other.glb";
    options.frames = 3;
    options.size = glm::uvec2(64, 32);
    options.seed = 4000000000u;
    options.show = "hits";
    for (const char* set : {"shade.bounces=9", "shade.mode=nee", "shade.gain=0.5", "hits.flag=true", "frame.seed=12"}) options.set.push_back(readSetting(set));
    const Description d = read(options);
    EXPECT_EQ(d.scene, std::filesystem::current_path() / "other.glb");
    EXPECT_EQ(d.count, 3);
    EXPECT_EQ(d.size, glm::uvec2(64, 32));
    EXPECT_EQ(d.seed, 12u);  // --set comes last
    EXPECT_EQ(d.showNode, "hits");
    EXPECT_EQ(d.nodes[1].settings[0].value.asInt(), 9);
    EXPECT_EQ(d.nodes[1].settings[1].value.asString(), "nee");
    EXPECT_EQ(d.nodes[1].settings[2].value.asNumber(), 0.5);
    EXPECT_TRUE(d.nodes[0].settings[0].value.asBool());
    EXPECT_EQ(read({.seed = 4000000000u}).seed, 4000000000u);
    EXPECT_EQ(read({.set = {readSetting("frame.size=1280x720")}}).size, glm::uvec2(1280, 720));
    EXPECT_EQ(read({.set = {readSetting("frame.size=[128, 72]")}}).size, glm::uvec2(128, 72));
}

TEST(Description, NamesTheOptionThatIsWrong) {
    Json placed(1);
    placed.moveTo({"study.json", 3, 4});
    EXPECT_THROW(readSetting("shade"), Error);
    EXPECT_EQ(complaint({.set = {{"shode.bounces", placed}}}), "study.json:3:4: no pass \"shode\"; did you mean \"shade\"?");
    EXPECT_EQ(complaint({.set = {readSetting("shode.bounces=1")}}), "--set shode.bounces=1: no pass \"shode\"; did you mean \"shade\"?");
    EXPECT_EQ(complaint({.set = {readSetting("frame.size=12")}}), "--set frame.size=12: \"size\" must be an array, not an integer (12)");
    EXPECT_EQ(complaint({.frames = 0}), "--frames: \"count\" must be 1..2147483647, not 0");
    EXPECT_EQ(complaint({.show = "a.b.c.d"}), "--show: \"a.b.c.d\" names no port; write \"pass\" or \"pass.port\"");
}

TEST(Description, ReportsAllProblemsAtOnce) {
    const char* bad = R"({ "format": 2, "passs": {},
  "frame": { "size": [0, 99999], "count": "many" },
  "passes": { "a b": { "type": "t", "in": { "x": "y." } }, "c": { "kind": "t" } } })";
    try {
        readDescription(Json::parse(bad, "bad.json"), "bad.json");
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(std::string(error.what()),
                  "bad.json:1:1: the graph shows nothing; add \"show\": \"pass.port\"\n"
                  "bad.json:1:13: format 2 is not known; this program reads format 1\n"
                  "bad.json:1:16: unknown key \"passs\" in the graph; did you mean \"passes\"?\n"
                  "bad.json:2:23: the frame's width must be 1..16384, not 0\n"
                  "bad.json:2:26: the frame's height must be 1..16384, not 99999\n"
                  "bad.json:2:43: \"count\" must be an integer, not a string (\"many\")\n"
                  "bad.json:3:15: \"a b\" can't be the name of a pass; use letters, digits, _ and -\n"
                  "bad.json:3:50: \"y.\" names no port; write \"pass\", \"pass.port\" or \"pass.port@prev\"\n"
                  "bad.json:3:60: pass \"c\" has no \"type\"\n"
                  "bad.json:3:67: unknown key \"kind\" in pass \"c\"; known: type, in, set, off, about");
    }
}

}  // namespace
}  // namespace lodestir
