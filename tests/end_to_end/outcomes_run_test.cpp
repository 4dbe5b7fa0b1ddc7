// SPDX-License-Identifier: MIT
// A study with rules prints which techniques hold: one in which a level switches in one scene and nothing does in the other.
#include "program.h"

#include <sstream>

namespace lodestir::test {
namespace {

class OutcomesRun : public ProgramTest {
protected:
    Output study(const char* mask) {
        const auto scene = [](const char* name) { return (sourceFolder / "scenes" / (std::string(name) + ".json")).string(); };
        const OrderedJson tracer = {{"graph", (sourceFolder / "graphs/path_tracer.json").string()}, {"variant", "no accumulation"}};
        OrderedJson baseline = tracer, sixteen = tracer;
        baseline["vary"] = {{"trace.spp", {4, 64}}}, sixteen["set"] = {{"trace.spp", 16}};
        const auto rule = [](const char* name, const char* in, const char* quantity, const char* measure, double holds, double strained) {
            return OrderedJson{{"name", name}, {"scene", in}, {"quantity", quantity}, {"measure", measure}, {"limits", {holds, strained}}};
        };
        write("study.json", {{"format", 1},
                             {"scenes", {scene("globe"), scene("cornell")}},
                             {"size", {48, 27}},
                             {"seeds", 1},
                             {"frames", {{"warmup", 2}, {"event", 40}, {"measure", {-2, -1, 0, 1, 2}}}},
                             {"reference", {{"graph", tracer["graph"]}, {"spp", 32}}},
                             {"techniques", {{"samples", baseline}, {"sixteen", sixteen}}},
                             {"mask", mask},
                             {"metrics", {"mse", "smape", "step_flip"}},
                             {"outcomes",
                              {{"baseline", "samples"},
                               {"cases",
                                {rule("seams", "globe", "spike", "smape.switched", 1.8, 2.5), rule("pop", "globe", "popping", "step_flip.switched", 0.1, 0.2),
                                 rule("room", "cornell", "baseline", "mse", 1.6, 2), rule("none", "cornell", "spike", "smape.switched", 1.8, 2.5)}}}}});
        std::filesystem::remove_all(folder / "out");
        return lodestir({"study", (folder / "study.json").string(), "--out", (folder / "out").string()});
    }
};

// If this fails, the rules of a study are read and forgotten, or a scene in which nothing switches ends it.
TEST_F(OutcomesRun, PrintsTheMatrix) {
    const Output output = study("switched_if_any");
    ASSERT_EQ(output.exitCode, 0) << output.err;
    std::vector<std::vector<std::string>> cells;  // of the matrix' lines, what stands apart by two blanks
    std::istringstream text(output.out.substr(output.out.find("outcomes (")));
    for (std::string line; std::getline(text, line);) {
        std::vector<std::string>& row = cells.emplace_back();
        for (std::size_t at = 0; (at = line.find_first_not_of(' ', at)) != line.npos;) {
            const std::size_t end = std::min(line.find("  ", at), line.size());
            row.push_back(line.substr(at, end - at));
            at = end;
        }
    }
    ASSERT_EQ(cells.size(), 6u) << output.out;
    EXPECT_EQ(cells[1], (std::vector<std::string>{"case", "scene", "quantity", "limits", "samples, spp 4", "samples, spp 64", "sixteen"}));
    for (std::size_t row = 2; row < cells.size(); ++row) ASSERT_EQ(cells[row].size(), 7u) << output.out;
    EXPECT_TRUE(cells[2][4].starts_with("holds")) << "no history, nothing to lose: " << cells[2][4];
    EXPECT_TRUE(cells[2][6].starts_with("holds")) << cells[2][6];
    EXPECT_TRUE(cells[3][6].starts_with("holds")) << "the levels look alike: " << cells[3][6];
    EXPECT_EQ(cells[4][4], "-") << "the baseline";
    EXPECT_EQ(cells[4][5], "-") << "the baseline";
    ASSERT_TRUE(cells[4][6].starts_with("holds? ")) << cells[4][6];
    EXPECT_NEAR(std::stod(cells[4][6].substr(7)), 1, 0.4) << "at equal rays the same technique has the same error, a quarter of 4 samples', four times 64's";
    for (const std::size_t column : {4u, 5u, 6u}) EXPECT_EQ(cells[5][column], "-") << "nothing switches there";

    for (const OrderedJson& row : readRows(folder / "out/results.jsonl")) {
        EXPECT_EQ(row["metrics"].contains("mse.switched"), row["scene"] == "globe") << row;
        EXPECT_EQ(row["metrics"].contains("step_flip"), row["frame"] != -2) << row;
    }

    const Output strict = study("switched");
    EXPECT_EQ(strict.exitCode, 1);
    EXPECT_NE(strict.err.find("no pixel sees an object that takes another level"), std::string::npos) << strict.err;
}

}  // namespace
}  // namespace lodestir::test
