// SPDX-License-Identifier: MIT
// What an event does to a technique, of sequences whose answer is known; the rules of a study, what is said of wrong ones, and the matrix they make.
#include "../temporary_folder.h"

#include <framework/core/error.h>
#include <framework/study/error/summary.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lodestir {
namespace {

constexpr double unsettled = std::numeric_limits<double>::infinity();

/// One run more or less shows every frame the same.
Course steady(const std::vector<int>& offsets, const std::vector<double>& errors, int runs = 3) {
    Course course{.offsets = offsets, .values = {}};
    for (const double error : errors) course.values.push_back(std::vector<double>(std::size_t(runs), error));
    return course;
}

const std::vector<int> frames{-2, -1, 0, 1, 2, 4, 8};

TEST(Stability, SpikeIsTheLargestErrorAfterOverTheMeanBefore) {
    const StabilityNumber spike = spikeHeight(steady(frames, {1, 3, 4, 6, 5, 2, 2}));
    EXPECT_DOUBLE_EQ(spike.value, 3);
    EXPECT_NEAR(spike.high - spike.low, 0, 1e-12) << "all runs agree";
    EXPECT_DOUBLE_EQ(spikeHeight(steady(frames, {2, 2, 2, 2, 2, 2, 2})).value, 1) << "nothing happens";
    EXPECT_DOUBLE_EQ(spikeHeight(steady(frames, {9, 1, 1, 2, 1, 1, 1})).value, 0.4) << "what is worst before the event is no spike";
    const Course noisy{.offsets = {-1, 0}, .values = {{1, 3}, {4, 8}}};
    EXPECT_DOUBLE_EQ(spikeHeight(noisy).value, 3);
    EXPECT_NEAR((spikeHeight(noisy).high - 3), 12.7062047 * 0.5, 1e-5) << "residuals 0.5 and -0.5, Student's t of one degree of freedom";
    EXPECT_TRUE(std::isnan(spikeHeight({.offsets = {-1, 0}, .values = {{1}, {2}}}).low)) << "one run says nothing of its spread";
    EXPECT_TRUE(std::isnan(spikeHeight(steady(frames, {1, 1, 1, std::nan(""), 1, 1, 1})).value)) << "a broken frame is not passed over";
}

TEST(Stability, RecoveryIsWhenTheErrorIsBackForGood) {
    const auto recovery = [](const std::vector<double>& errors) { return recoveryTime(steady(frames, errors)).value; };
    EXPECT_EQ(recovery({1, 1, 1.05, 1, 1, 1, 1}), 0);
    EXPECT_EQ(recovery({1, 1, 3, 2, 1.09, 1, 1}), 2);
    EXPECT_EQ(recovery({1, 1, 3, 2, 1.11, 1, 1}), 4);
    EXPECT_EQ(recovery({1, 1, 5, 4, 3.2, 3, 3}), unsettled) << "it stays higher than it was, and may be falling yet";
    EXPECT_EQ(recovery({1, 1, 1.8, 1.5, 1.4, 1.25, 1.15}), unsettled) << "it falls, but the last frame is no place to call settled";
    EXPECT_EQ(recovery({1, 1, 3, 2, 2, 2, 1.09}), 8) << "back in the last frame";
    EXPECT_EQ(recovery({0.5, 1.5, 3, 2, 1.09, 1, 1}), 2) << "the level before is a mean over frames";
    EXPECT_EQ(recovery({1, 1, 0.5, 0.4, 0.3, 0.2, 0.1}), 0) << "lower than before is no harm";
    EXPECT_EQ(recovery({1, 1, 1, 1, 5, 1, 1}), 4) << "it was not over yet";
    EXPECT_EQ(recovery({1, 1, 16, 8, 6, 4, 2}), unsettled) << "it is still falling";
    EXPECT_EQ(recovery({1, 1, std::nan(""), 1, 1, 1, 1}), 1);
    EXPECT_EQ(recoveryTime(steady(frames, {1, 1, 3, 1.4, 1, 1, 1}), 1.5).value, 1);
}

TEST(Stability, RecoveryIsUncertainWhereOneRunDecides) {
    Course course = steady(frames, {1, 1, 3, 1, 1, 1, 1});
    course.values[4][0] = 2;  // frame 2 of one run of three: a mean of 1.33
    const StabilityNumber time = recoveryTime(course);
    EXPECT_EQ(time.value, 4);
    EXPECT_EQ(time.low, 1) << "without that run";
    EXPECT_EQ(time.high, 4);
}

TEST(Stability, PoppingIsWhatTheSwitchAddsToNoise) {
    const Course step{.offsets = {-2, -1, 0, 1}, .values = {{0.1, 0.2}, {0.3, 0.2}, {0.5, 0.6}, {9, 9}}};
    const StabilityNumber popping = poppingIndex(step);
    EXPECT_NEAR(popping.value, 0.35, 1e-12);
    EXPECT_NEAR(popping.high - popping.value, 12.7062047 * 0.05, 1e-6) << "differences of 0.3 and 0.4, run by run";
    EXPECT_NEAR(poppingIndex(steady(frames, {0.2, 0.2, 0.2, 0.2, 0.2, 0.2, 0.2})).value, 0, 1e-12) << "noise that flickers the same pops nothing";
}

TEST(Stability, EnergyAndBaselineLookFromTheEventOn) {
    EXPECT_DOUBLE_EQ(energyError(steady({-1, 0, 1}, {0.5, -0.04, -0.02})).value, -0.03);
    // Two frames whose references are off by 3 % and 4 % make a mean that is off by 2.5 %, as good as known: Student's t of many degrees of freedom.
    Course shared = steady({-1, 0, 1}, {0.5, -0.04, -0.02});
    shared.deviations = {9, 0.03, 0.04};
    EXPECT_DOUBLE_EQ(energyError(shared).value, -0.03);
    EXPECT_NEAR(energyError(shared).high - energyError(shared).value, 1.96 * 0.025, 2e-4);
    const Course errors{.offsets = {-1, 0, 1}, .values = {{9, 9}, {2, 4}, {4, 6}}}, baseline{.offsets = {-1, 0, 1}, .values = {{1, 1}, {1, 2}, {1, 2}}};
    const StabilityNumber ratio = errorAgainst(errors, {baseline}).value();
    EXPECT_NEAR(ratio.value, 4 / 1.5, 1e-12);
    const double t = 12.7062047, a = t * 1 / 4, b = t * 0.5 / 1.5;
    EXPECT_NEAR(ratio.high - ratio.value, ratio.value * std::hypot(a, b), 1e-5) << "relative half-widths add up as of independent runs";
}

// If this fails, a technique is called better than a baseline that was given other rays than it.
TEST(Stability, ABaselineOfSeveralCostsIsTakenAtEqualRays) {
    const auto course = [](std::vector<double> rays, double error, double spread = 0) {
        Course made{.offsets = {-1, 0, 1}, .values = {}, .deviations = {}, .rays = std::move(rays)};
        made.values = {{99, 99}, {error - spread, error + spread}, {error - spread, error + spread}};
        return made;
    };
    // Path tracing: 12 / rays. The frame before the event, of other rays and errors, has no part in it.
    const std::vector<Course> tracing{course({70, 2, 2}, 6), course({70, 6, 10}, 1.5), course({70, 4, 4}, 3)};
    const auto against = [&](double before, double after, double error) { return errorAgainst(course({1, before, after}, error), tracing); };
    EXPECT_NEAR(against(5, 7, 1).value().value, 6 / 12.0, 1e-12);
    EXPECT_NEAR(against(3, 3, 8).value().value, 8 * 3 / 12.0, 1e-12);
    EXPECT_NEAR(against(2, 2, 6).value().value, 1, 1e-12) << "the least rays of the baseline";
    EXPECT_NEAR(against(8, 8, 1.5).value().value, 1, 1e-12) << "its most";
    EXPECT_FALSE(against(1.9, 1.9, 1)) << "nothing is known of a baseline of fewer rays";
    EXPECT_FALSE(against(8.1, 8.1, 1));
    EXPECT_TRUE(errorAgainst(course({1, 20, 20}, 1), {tracing[0]})) << "one alone is taken at the rays it has";

    const std::vector<Course> noisy{course({1, 2, 2}, 6, 0.6), course({1, 8, 8}, 1.5, 0.3)};
    const StabilityNumber ratio = errorAgainst(course({1, 4, 4}, 3, 0.15), noisy).value();
    const double t = 12.7062047;  // half-widths of one degree of freedom: t * spread
    EXPECT_NEAR(ratio.value, 1, 1e-12);
    EXPECT_NEAR(ratio.high - ratio.value, t * std::hypot(0.05, 0.5 * 0.1, 0.5 * 0.2), 1e-5) << "half way in logarithms, of either half";
}

TEST(Outcomes, FollowFromTheNumberAlone) {
    const FailureCase rule{.limits = {1.2, 2}};
    const auto outcome = [&](double value) { return judge(rule, {value, value, value}).outcome; };
    EXPECT_EQ(outcome(1.2), Outcome::holds);
    EXPECT_EQ(outcome(1.21), Outcome::strained);
    EXPECT_EQ(outcome(2), Outcome::strained);
    EXPECT_EQ(outcome(2.01), Outcome::fails);
    EXPECT_EQ(outcome(unsettled), Outcome::fails);
    EXPECT_EQ(outcome(std::nan("")), Outcome::fails) << "what is broken does not hold";
    EXPECT_TRUE(judge(rule, {1.5, 1.3, 1.9}).certain);
    EXPECT_FALSE(judge(rule, {1.5, 1.1, 1.9}).certain);
    EXPECT_FALSE(judge(rule, {1.5, 1.3, 2.1}).certain);
    EXPECT_FALSE(judge(rule, {1, std::nan(""), std::nan("")}).certain) << "one run";
}

TEST(Outcomes, EnergyMayBeOffEitherWay) {
    const FailureCase rule{.quantity = StabilityQuantity::energy, .limits = {0.01, 0.05}};
    EXPECT_EQ(judge(rule, {-0.02, -0.03, -0.012}).outcome, Outcome::strained);
    EXPECT_TRUE(judge(rule, {-0.02, -0.03, -0.012}).certain);
    EXPECT_EQ(judge(rule, {0.06, 0.055, 0.065}).outcome, Outcome::fails);
    EXPECT_EQ(judge(rule, {0.001, -0.03, 0.032}).outcome, Outcome::holds);
    EXPECT_FALSE(judge(rule, {0.001, -0.03, 0.032}).certain);
    EXPECT_TRUE(judge(rule, {0.001, -0.006, 0.008}).certain);
}

class OutcomeFiles : public test::FolderTest {
protected:
    OutcomeFiles() {
        for (const char* file : {"box.json", "hall.json", "graph.json"}) writeFile(folder / file, std::string_view("{}"));
    }
    Study load(const std::string& outcomes, const std::string& measure = "[-2, -1, 0, 1]") {
        writeFile(folder / "study.json", R"({ "format": 1, "scenes": ["box.json", "hall.json"], "seeds": 3, "frames": { "warmup": 4, "measure": )" + measure +
                                             R"( }, "reference": { "graph": "graph.json", "spp": 64 },
            "techniques": { "plain": { "graph": "graph.json" }, "other": { "graph": "graph.json" },
                            "many": { "graph": "graph.json", "vary": { "a.spp": [1, 2] } },
                            "grid": { "graph": "graph.json", "vary": { "a.spp": [1, 2], "a.depth": [1, 2] } } },
            "metrics": ["relmse", "bias", "step_flip"], "outcomes": )" +
                                             outcomes + " }");
        return loadStudy(folder / "study.json");
    }
    std::string complaint(const std::string& outcomes, const std::string& measure = "[-2, -1, 0, 1]") {
        try {
            load(outcomes, measure);
        } catch (const Error& error) {
            return error.what();
        }
        return {};
    }
    static std::string oneCase(const std::string& rest) {
        return R"({ "baseline": "plain", "cases": [{ "name": "n", "scene": "hall", "limits": [1, 2], )" + rest + "}] }";
    }
};

TEST_F(OutcomeFiles, AreRead) {
    const Study study = load(R"({ "baseline": "other", "cases": [
        { "name": "switch", "scene": "hall", "quantity": "spike", "measure": "relmse", "limits": [1.2, 2] },
        { "name": "light", "scene": "box", "quantity": "energy", "measure": "bias", "limits": [0.01, 0.05] }] })");
    ASSERT_TRUE(study.outcomes);
    EXPECT_EQ(study.outcomes->baseline, 1u);
    ASSERT_EQ(study.outcomes->cases.size(), 2u);
    EXPECT_EQ(study.outcomes->cases[0].scene, 1u);
    EXPECT_EQ(study.outcomes->cases[1].quantity, StabilityQuantity::energy);
    EXPECT_EQ(study.outcomes->cases[1].limits, (std::array<double, 2>{0.01, 0.05}));
}

// If this fails, a wrong rule is found after the study has run, or never.
TEST_F(OutcomeFiles, WrongOnesAreTold) {
    const auto expectSaid = [&](const std::string& outcomes, const char* said, const std::string& measure = "[-2, -1, 0, 1]") {
        const std::string text = complaint(outcomes, measure);
        EXPECT_NE(text.find(said), text.npos) << outcomes << ": " << text;
    };
    EXPECT_EQ(complaint(oneCase(R"("quantity": "spike", "measure": "relmse")")), "");
    expectSaid(R"({ "baseline": "plane", "cases": [] })", "the study has no technique \"plane\"");
    expectSaid(R"({ "baseline": "grid", "cases": [] })", "several knobs of the baseline vary");
    expectSaid(R"({ "cases": [] })", "there are no cases");
    expectSaid(oneCase(R"("quantity": "height", "measure": "relmse")"), "spike");
    expectSaid(oneCase(R"("quantity": "spike", "measure": "relmse.switched")"), "the study has no measure \"relmse.switched\"");
    expectSaid(oneCase(R"("quantity": "popping", "measure": "relmse")"), "\"popping\" is made of step_flip, not of relmse");
    expectSaid(oneCase(R"("quantity": "energy", "measure": "relmse")"), "\"energy\" is made of bias, not of relmse");
    expectSaid(oneCase(R"("quantity": "spike", "measure": "relmse", "limit": 3)"), "limit");
    expectSaid(oneCase(R"("quantity": "spike", "measure": "relmse")"), "relmse is never measured before the event", "[0, 1]");
    expectSaid(oneCase(R"("quantity": "popping", "measure": "step_flip")"), "step_flip is never measured before the event", "[-1, 0, 1]");
    expectSaid(oneCase(R"("quantity": "energy", "measure": "bias")"), "bias isn't measured at the event", "[-2, -1, 1]");
    expectSaid(oneCase(R"("quantity": "recovery", "measure": "relmse")"), "no frame after the event is measured", "[-2, -1, 0]");
    std::string text = oneCase(R"("quantity": "spike", "measure": "relmse")");
    expectSaid(text.replace(text.find("[1, 2]"), 6, "[2, 2]"), "\"limits\" must rise");
    expectSaid(R"({ "cases": [{ "name": "n", "scene": "room", "quantity": "baseline", "measure": "relmse", "limits": [1, 2] }] })", "there is no baseline");
}

TEST_F(OutcomeFiles, MakeAMatrixOfWhatWasMeasured) {
    const Study study = load(R"({ "baseline": "plain", "cases": [
        { "name": "switch", "scene": "hall", "quantity": "spike", "measure": "relmse", "limits": [1.2, 2] },
        { "name": "noise", "scene": "box", "quantity": "baseline", "measure": "relmse", "limits": [0.5, 1] },
        { "name": "pop", "scene": "hall", "quantity": "popping", "measure": "step_flip", "limits": [0.01, 0.1] }] })");
    std::vector<Cell> cells;
    const auto add = [&](std::size_t scene, std::size_t technique, std::vector<double> relmse) {
        for (std::size_t i = 0; i < study.measure.size(); ++i) {
            Cell& cell = cells.emplace_back(Cell{.scene = scene, .technique = technique, .offset = study.measure[i], .seeds = 2});
            cell.values["relmse"] = {relmse[i], relmse[i]};
            if (i > 0) cell.values["step_flip"] = {0.01 * relmse[i], 0.01 * relmse[i]};  // the first frame has none before it
        }
    };
    add(0, 0, {1, 1, 1, 1}), add(0, 1, {1, 1, 0.25, 0.25});
    add(1, 0, {1, 1, 1, 1}), add(1, 1, {1, 1, 1.5, 1});
    const OutcomeMatrix matrix = judgeOutcomes(study, cells);
    EXPECT_EQ(matrix.columns, (std::vector<std::string>{"plain", "other"}));
    ASSERT_EQ(matrix.rows.size(), 3u);
    EXPECT_EQ(matrix.rows[0][0]->outcome, Outcome::holds);
    EXPECT_EQ(matrix.rows[0][1]->outcome, Outcome::strained);
    EXPECT_DOUBLE_EQ(matrix.rows[0][1]->number.value, 1.5);
    EXPECT_FALSE(matrix.rows[1][0]) << "the baseline against itself says nothing";
    EXPECT_DOUBLE_EQ(matrix.rows[1][1]->number.value, 0.25);
    EXPECT_NEAR(matrix.rows[2][1]->number.value, 0.005, 1e-12);
    const std::string text = outcomesText(study, matrix);
    EXPECT_NE(text.find("strained 1.5 +- 0"), text.npos) << text;
    EXPECT_NE(text.find("holds 0.25 +- 0"), text.npos) << text;

    // A baseline whose knob varies is several columns, and is held against none; others are at its errors of as many rays.
    const Study curve = load(R"({ "baseline": "many", "cases": [
        { "name": "noise", "scene": "box", "quantity": "baseline", "measure": "relmse", "limits": [0.5, 1] } ] })");
    std::vector<Cell> costs;
    const auto addCost = [&](std::size_t technique, int spp, double error, double rays) {
        for (const int offset : curve.measure) {
            Cell& cell = costs.emplace_back(Cell{.technique = technique, .offset = offset, .seeds = 2, .rays = {.mean = rays * curve.scenes[0].pixels()}});
            if (spp > 0) cell.knobs = {{"a.spp", Json(spp)}};
            cell.values["relmse"] = {error, error};
        }
    };
    addCost(0, 0, 1, 4), addCost(1, 0, 1, 9), addCost(2, 1, 4, 2), addCost(2, 2, 1, 8);
    const OutcomeMatrix equal = judgeOutcomes(curve, costs);
    EXPECT_EQ(equal.columns, (std::vector<std::string>{"plain", "other", "many, spp 1", "many, spp 2"}));
    ASSERT_TRUE(equal.rows[0][0]);
    EXPECT_NEAR(equal.rows[0][0]->number.value, 0.5, 1e-12) << "the baseline's error of 4 rays is 2";
    for (const std::size_t absent : {1u, 2u, 3u}) EXPECT_FALSE(equal.rows[0][absent]) << equal.columns[absent];
    for (Cell& cell : costs)
        if (cell.technique == 2 && cell.knobs[0].value.dump(-1) == "2") cell.values.clear();
    EXPECT_FALSE(judgeOutcomes(curve, costs).rows[0][0]) << "half of the baseline is still to be run";

    // What is solved for differs by scene, and is one technique.
    Study solved = study;
    solved.techniques[1].solve = SolvedKnob{.name = "a.spp", .low = 1, .high = 64};
    for (Cell& cell : cells)
        if (cell.technique == 1) cell.knobs = {{"a.spp", Json(cell.scene == 0 ? 2 : 3)}};
    EXPECT_EQ(judgeOutcomes(solved, cells).columns, (std::vector<std::string>{"plain", "other"}));

    // What is still to be run is no outcome.
    cells.resize(study.measure.size());
    EXPECT_FALSE(judgeOutcomes(study, cells).rows[0][0]);
    EXPECT_EQ(judgeOutcomes(study, {}).columns.size(), 0u);
}

}  // namespace
}  // namespace lodestir
