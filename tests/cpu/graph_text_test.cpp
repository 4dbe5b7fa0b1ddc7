// SPDX-License-Identifier: MIT
// What is changed by hand, written into the graph's own file.
#include "../end_to_end/source_folder.h"

#include <framework/app/view/graph_text.h>

#include <gtest/gtest.h>

#include <sstream>

namespace lodestir {
namespace {

const Path file = test::sourceFolder / "graphs/restir_pt.json";

nlohmann::json described(const std::string& text, const GraphOptions& options) {
    return nlohmann::json(readDescription(Json::parse(text, file.string()), file, options).source.plain());
}
std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}
/// Those of the second that the first hasn't at the same place; both have as many lines.
std::vector<std::string> changed(const std::string& before, const std::string& after) {
    const std::vector<std::string> a = linesOf(before), b = linesOf(after);
    EXPECT_EQ(a.size(), b.size());
    std::vector<std::string> lines;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        if (a[i] != b[i]) lines.push_back(b[i]);
    return lines;
}
GraphOptions withEdits(std::optional<std::string> variant = {}) {
    return {.set = {readSetting("initial.bounces=6"), readSetting("spatial.neighbours=2")},
            .variant = std::move(variant),
            .patches = {Json::parse(R"({"passes": {"hits": {"in": {"worldPrev": null}}}})", "edit")}};
}

// If this fails, whoever saves an edit finds another file than the one that was written by hand.
TEST(GraphText, ChangesTheLinesThatWereEdited) {
    const std::string text = readText(file), after = textWithChanges(text, file, withEdits());
    EXPECT_EQ(described(after, {}), described(text, withEdits()));
    const std::vector<std::string> lines = changed(text, after);
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_EQ(lines[1], R"(    "initial":  { "type": "initial_sampling", "set": { "bounces": 6 } },)");
    EXPECT_NE(lines[2].find(R"("set": { "radius": 10, "neighbours": 2 } },)"), std::string::npos) << lines[2];
    EXPECT_EQ(textWithChanges(after, file, withEdits()), after) << "what is there is not written again";
}

TEST(GraphText, LeavesWhatConcernsTheRunAlone) {
    const std::string text = readText(file);
    GraphOptions run;
    run.scene = "elsewhere.json";
    run.size = glm::uvec2(64, 36);
    run.show = "shade";
    EXPECT_EQ(textWithChanges(text, file, run), text);
}

// If this fails, an edit made while a variant is shown changes the graph for all the others.
TEST(GraphText, EditsBehindAVariantAreTheVariants) {
    const std::string text = readText(file), after = textWithChanges(text, file, withEdits("paired"));
    EXPECT_EQ(described(after, {.variant = "paired"}), described(text, withEdits("paired")));
    EXPECT_NE(described(after, {.variant = "paired"}), described(text, {.variant = "paired"}));
    for (const std::optional<std::string>& other : {std::optional<std::string>(), std::optional<std::string>("temporal only")})
        EXPECT_EQ(described(after, {.variant = other}), described(text, {.variant = other}));
    const auto outside = [](const std::string& t) { return t.substr(0, t.find("\"paired\"")) + t.substr(t.find("\"frame jitter\"")); };
    EXPECT_EQ(outside(after), outside(text));
}

TEST(GraphText, RefusesWhatAVariantCannotSay) {
    const auto refusal = [](const std::string& text, const GraphOptions& changes) -> std::string {
        try {
            textWithChanges(text, file, changes);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_NE(refusal(readText(file), withEdits("paired + own history")).find("\"paired + own history\" are several variants; choose one"), std::string::npos);
    // The variant takes a pass away, and the edit puts another of that name in its place: merged into the graph's it would get its inputs.
    const std::string text = R"({ "format": 1, "passes": { "a": { "type": "x", "in": { "i": "b" } }, "b": { "type": "x" } }, "show": "b",
                                  "variants": { "v": { "passes": { "a": null } } } })";
    const Json edit = Json::parse(R"({"passes": {"a": {"type": "y"}}})", "edit");
    EXPECT_NE(refusal(text, {.variant = "v", .patches = {edit}}).find("can't hold these edits"), std::string::npos);
}

}  // namespace
}  // namespace lodestir
