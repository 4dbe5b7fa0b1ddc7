// SPDX-License-Identifier: MIT
// Merge patches between values, and written into text that keeps its form.
#include "../end_to_end/source_folder.h"

#include <framework/core/files.h>
#include <framework/core/merge_patch.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace lodestir {
namespace {

std::string merged(std::string_view text, std::string_view patch, Nulls nulls = Nulls::remove) { return mergedText(text, Json::parse(patch, "patch"), nulls); }
nlohmann::json unordered(const Json& value) { return nlohmann::json(value.plain()); }

// If this fails, saving an edit into a graph file rewrites what its author laid out.
TEST(MergedText, KeepsWhatThePatchDoesNotName) {
    const std::string_view text = "\xEF\xBB\xBF{ \"a\" : 1,\n\t\"b\": { \"x\":  [1,2 ], \"y\": \"},\\\"{\" } ,\r\n  \"c\": -1.50e2 }\n";
    EXPECT_EQ(merged(text, "{}"), text);
    EXPECT_EQ(merged(text, R"({"b": {"y": 3}})"), "\xEF\xBB\xBF{ \"a\" : 1,\n\t\"b\": { \"x\":  [1,2 ], \"y\": 3 } ,\r\n  \"c\": -1.50e2 }\n");
    EXPECT_EQ(merged(text, R"({"d": {"new": [1, "z"]}})"),
              "\xEF\xBB\xBF{ \"a\" : 1,\n\t\"b\": { \"x\":  [1,2 ], \"y\": \"},\\\"{\" } ,\r\n  \"c\": -1.50e2,\r\n  \"d\": { \"new\": [1, \"z\"] } }\n");
}

TEST(MergedText, AddsAndTakesAwayMembers) {
    EXPECT_EQ(merged("{}", R"({"a": 1})"), R"({ "a": 1 })");
    EXPECT_EQ(merged("{\n  \"a\": 1\n}", R"({"b": 2, "c": null})"), "{\n  \"a\": 1,\n  \"b\": 2\n}");
    EXPECT_EQ(merged("{\n  \"a\": 1,\n  \"b\": 2\n}", R"({"c": 3})"), "{\n  \"a\": 1,\n  \"b\": 2,\n  \"c\": 3\n}");
    EXPECT_EQ(merged("{\n  \"a\": 1,\n  \"b\": 2\n}", R"({"a": null})"), "{\n  \"b\": 2\n}");
    EXPECT_EQ(merged("{ \"a\": 1,\n  \"b\": 2 }", R"({"a": null})"), "{ \"b\": 2 }");
    EXPECT_EQ(merged("{ \"a\": 1,\n  \"b\": 2 }", R"({"b": null})"), "{ \"a\": 1 }");
    EXPECT_EQ(merged("{ \"a\": 1 }", R"({"a": null})"), "{ }");
    EXPECT_EQ(merged("{ \"a\": 1, \"b\": 2 }", R"({"a": null, "b": null, "c": {"d": 1, "e": null}})"), R"({ "c": { "d": 1 } })");
}

TEST(MergedText, KnowsKeysHoweverTheyAreWritten) {
    EXPECT_EQ(merged(R"({ "\u0061b": 1 })", R"({"ab": 2})"), R"({ "\u0061b": 2 })");
    EXPECT_EQ(merged(R"({ "q\"}": 1, "b": 2 })", R"({"q\"}": null})"), R"({ "b": 2 })");
    EXPECT_EQ(merged(R"({ "a": { "b": 1 }, "c": "b" })", R"({"b": 3})"), R"({ "a": { "b": 1 }, "c": "b", "b": 3 })");
}

// If this fails, an edit of a variant forgets what it takes away from the graph.
TEST(MergedText, KeepsNullsOfPatchesInPatches) {
    const std::string text = R"({ "variants": { "v": { "passes": { "a": { "off": true } } } } })";
    EXPECT_EQ(merged(text, R"({"variants": {"v": {"passes": {"a": {"off": null}, "b": null, "c": {"in": {"x": null}}}}}})", Nulls::keep),
              R"({ "variants": { "v": { "passes": { "a": { "off": null }, "b": null, "c": { "in": { "x": null } } } } } })");
}

// All shipped graphs and their variants, which are patches that people wrote.
TEST(MergePatch, LeadsFromEachGraphToItsVariantsAndTextFollows) {
    int variants = 0;
    for (const auto& entry : std::filesystem::directory_iterator(test::sourceFolder / "graphs")) {
        if (entry.path().extension() != ".json") continue;
        const std::string text = readText(entry.path());
        const Json graph = Json::parse(text, entry.path().string());
        EXPECT_EQ(mergedText(text, Json::object()), text) << entry.path();
        const Json* all = graph.find("variants");
        for (const auto& [name, variant] : all ? all->members() : std::vector<Json::Member>()) {
            ++variants;
            Json wanted = graph;
            wanted.merge(variant);
            EXPECT_EQ(unordered(Json::parse(mergedText(text, variant), "text")), unordered(wanted)) << entry.path() << ' ' << name;
            const Json patch = mergePatch(graph, wanted);
            EXPECT_EQ(unordered(Json::parse(mergedText(text, patch), "text")), unordered(wanted)) << entry.path() << ' ' << name;
            EXPECT_TRUE(mergePatch(wanted, wanted).members().empty());
        }
    }
    EXPECT_GT(variants, 50);
}

}  // namespace
}  // namespace lodestir
