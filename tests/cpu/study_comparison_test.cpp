// SPDX-License-Identifier: MIT
// What makes a study fair, without a device: budgets and the knobs that meet them, differences seed by seed, bias apart from variance, and slopes; each
// against values drawn from a known truth.
#include "../temporary_folder.h"

#include <framework/core/error.h>
#include <framework/study/error/equal.h>
#include <framework/study/error/summary.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lodestir {
namespace {

constexpr int trials = 2000;
/// 19 of 20, give or take four standard deviations of the share.
const double tolerance = 4 * std::sqrt(0.95 * 0.05 / trials);

TEST(Budget, IsMetByTheNearestValue) {
    for (const double base : {0.0, 3.0})
        for (const double slope : {0.7, 2.0})
            for (const double budget : {5.0, 33.0, 123.4}) {
                const auto cost = [&](int v) { return base + slope * v; };
                const Solution solution = solveKnob(cost, 1, 4096, budget);
                int nearest = 1;
                for (int v = 1; v <= 4096; ++v)
                    if (std::abs(std::log(cost(v) / budget)) < std::abs(std::log(cost(nearest) / budget))) nearest = v;
                EXPECT_EQ(solution.value, nearest) << base << " + " << slope << " v = " << budget;
                EXPECT_EQ(solution.reached, cost(nearest));
                EXPECT_TRUE(solution.inRange);
                EXPECT_LE(solution.tried.size(), 14u);
                EXPECT_LE(solution.tried.rbegin()->first, std::max(2, 2 * nearest)) << "nothing much dearer is ever run";
            }
}

TEST(Budget, ThatIsOutOfRangeIsSaid) {
    const auto cost = [](int v) { return 10.0 * v; };
    const Solution cheap = solveKnob(cost, 2, 8, 5), dear = solveKnob(cost, 2, 8, 500);
    EXPECT_EQ(cheap.value, 2);
    EXPECT_FALSE(cheap.inRange);
    EXPECT_EQ(dear.value, 8);
    EXPECT_FALSE(dear.inRange);
}

TEST(Budget, IsMetDespiteNoise) {
    std::mt19937 random(1);
    std::normal_distribution<double> noise(1, 0.03);
    for (int trial = 0; trial < 200; ++trial) {
        const Solution solution = solveKnob([&](int v) { return (4 + 1.5 * v) * noise(random); }, 1, 1000, 100);
        EXPECT_NEAR(4 + 1.5 * solution.value, 100, 15) << "five deviations of the noise";
    }
}

// Two techniques whose errors rise and fall together with the seed: a difference of 5 % that the spread of either hides.
TEST(Comparison, SeedBySeedSeesWhatSpreadHides) {
    std::mt19937 random(3);
    std::normal_distribution<double> common(0, 0.5), own(0, 0.02);
    const std::vector<std::uint32_t> seeds{1, 2, 3, 4, 5, 6, 7, 8}, others{11, 12, 13, 14, 15, 16, 17, 18};
    int pairedHolds = 0, unpairedHolds = 0, unpairedSees = 0, pairedSees = 0;
    for (int trial = 0; trial < trials; ++trial) {
        std::vector<double> a, b, c;
        for (std::size_t i = 0; i < seeds.size(); ++i) {
            const double level = common(random);
            a.push_back(std::exp(level + own(random)));
            b.push_back(1.05 * std::exp(level + own(random)));
            c.push_back(1.05 * std::exp(common(random) + own(random)));
        }
        const Difference paired = compareValues(b, seeds, a, seeds), unpaired = compareValues(c, others, a, seeds);
        EXPECT_TRUE(paired.paired && paired.ratio && unpaired.ratio && !unpaired.paired);
        pairedHolds += paired.low() <= 1.05 && 1.05 <= paired.high();
        unpairedHolds += unpaired.low() <= 1.05 && 1.05 <= unpaired.high();
        pairedSees += paired.low() > 1;
        unpairedSees += unpaired.low() > 1;
    }
    EXPECT_NEAR(double(pairedHolds) / trials, 0.95, tolerance);
    EXPECT_NEAR(double(unpairedHolds) / trials, 0.95, tolerance + 0.01) << "Welch's degrees of freedom are rounded down";
    EXPECT_GT(double(pairedSees) / trials, 0.95);
    EXPECT_LT(double(unpairedSees) / trials, 0.1);
}

TEST(Comparison, IsADifferenceWhereValuesMayBeNegative) {
    const Difference difference = compareValues({-0.01, 0.03}, {1, 2}, {0.01, 0.01}, {1, 2});
    EXPECT_FALSE(difference.ratio);
    EXPECT_NEAR(difference.middle(), 0, 1e-15);
    EXPECT_NEAR(difference.high(), 12.7062 * 0.02, 1e-5);
}

ImageData constant(float value) {
    ImageData image = makeImage(48, 48, 3);
    for (float& v : image.values) v = value;
    return image;
}
ImageData noisy(const ImageData& truth, double sigma, std::mt19937& random) {
    std::normal_distribution<float> normal(0, float(sigma));
    ImageData image = truth;
    for (float& value : image.values) value += normal(random);
    return image;
}

// If this fails, a biased method's floor is hidden in its noise, or noise of the reference is taken for bias.
TEST(Decomposition, TellsBiasFromVariance) {
    std::mt19937 random(5);
    constexpr double bias = 0.05, sigma = 0.2, referenceSigma = 0.1;
    const ImageData truth = constant(0.5f), shifted = constant(0.5f + float(bias));
    for (const int runs : {2, 8}) {
        std::vector<double> biases, variances, whole;
        int holds = 0;
        for (int trial = 0; trial < 60; ++trial) {
            const Halves reference(noisy(truth, referenceSigma, random), noisy(truth, referenceSigma, random));
            std::vector<ImageData> images;
            for (int i = 0; i < runs; ++i) images.push_back(noisy(shifted, sigma, random));
            const Decomposition parts = decompose("mse", images, reference, {.exposure = 1});
            biases.push_back(parts.bias.mean);
            variances.push_back(parts.variance.mean);
            double mean = 0;
            for (const ImageData& image : images) mean += measureError("mse", image, reference, {.exposure = 1}) / runs;
            EXPECT_NEAR(parts.bias.mean + parts.variance.mean, mean, 1e-9) << "they are the error";
            EXPECT_EQ(std::isnan(parts.bias.halfWidth), runs == 2);
            holds += std::abs(parts.variance.mean - sigma * sigma) <= parts.variance.halfWidth;
        }
        const Estimate b = estimateMean(biases), v = estimateMean(variances);
        EXPECT_NEAR(b.mean, bias * bias, 2 * b.halfWidth);
        EXPECT_LT(b.halfWidth, 0.1 * bias * bias);
        EXPECT_NEAR(v.mean, sigma * sigma, 2 * v.halfWidth);
        EXPECT_LT(v.halfWidth, 0.02 * sigma * sigma);
        if (runs == 2) continue;
        EXPECT_GE(holds, 50) << "of 60 intervals of 95 %";
    }
}

TEST(Exponent, OfIndependentSamplesIsMinusOne) {
    std::mt19937 random(7);
    std::normal_distribution<double> noise(0, 0.1);
    const std::vector<double> x{1, 2, 4, 8};
    int holds = 0;
    for (int trial = 0; trial < trials; ++trial) {
        std::vector<std::vector<double>> runs(4);
        for (auto& run : runs)
            for (const double n : x) run.push_back(3 / n * std::exp(noise(random)));
        const Estimate slope = estimateExponent(x, runs);
        holds += std::abs(slope.mean + 1) <= slope.halfWidth;
    }
    EXPECT_NEAR(double(holds) / trials, 0.95, tolerance);
}

class FairStudy : public test::FolderTest {
protected:
    FairStudy() {
        writeFile(folder / "box.json", "{}");
        writeFile(folder / "graph.json", "{}");
    }
    Study load(const std::string& more, const std::string& techniques) {
        writeFile(folder / "study.json", R"({ "format": 1, "scenes": ["box.json"], "seeds": 3, "reference": { "graph": "graph.json", "spp": 4 },
                                            "metrics": ["mse"], )" +
                                             more + R"( "techniques": {)" + techniques + "} }");
        return loadStudy(folder / "study.json");
    }
    std::string complaint(const std::string& more, const std::string& techniques) {
        try {
            load(more, techniques);
        } catch (const Error& error) {
            const std::string text = error.problems().front().text();
            return text.substr(text.find(": ") + 2);
        }
        return {};
    }
    const std::string plain = R"("plain": { "graph": "graph.json" })";
    const std::string solved = R"("solved": { "graph": "graph.json", "solve": { "a.spp": [1, 64] } })";
};

TEST_F(FairStudy, IsReadAsItIsWritten) {
    const Study study = load(R"("equal": { "rays": "plain" }, "baseline": "solved", "decompose": true, "charts": ["error_vs_rays"], "mask": "switched",
        "masks": { "far": "hits.depth", "mine": { "graph": "graph.json", "port": "a.b" } },)",
                             plain + ", " + solved + R"(, "parts": { "graph": "graph.json", "ablate": "pairs" })");
    ASSERT_TRUE(study.equal);
    EXPECT_EQ(study.equal->technique, "plain");
    EXPECT_EQ(study.baseline, 1u);
    EXPECT_TRUE(study.decompose);
    EXPECT_FALSE(study.judgesTime());
    EXPECT_EQ(study.techniques[1].solve->high, 64);
    EXPECT_EQ(study.techniques[2].ablate, Ablate::pairs);
    std::vector<std::string> names;
    for (const Measure& measure : measuresOf(study)) names.push_back(measure.name());
    EXPECT_EQ(names, (std::vector<std::string>{"mse.switched", "mse.far", "mse.mine", "mse"}));
    EXPECT_EQ(study.masks[2].graph->port, "a.b");

    EXPECT_TRUE(load(R"("equal": { "time": 20 }, "charts": ["error_vs_rays"],)", solved).judgesTime()) << "its budget is a time";
    EXPECT_TRUE(load(R"("charts": ["time_by_pass"],)", plain).judgesTime());
    EXPECT_TRUE(load(R"("charts": ["frontier"],)", plain).judgesTime());
    EXPECT_TRUE(load(R"("charts": ["advantage"],)", plain).judgesTime());
    EXPECT_FALSE(load(R"("charts": ["advantage"], "countSteps": true,)", plain).judgesTime()) << "steps are the cost";
    EXPECT_TRUE(load("", plain).judgesTime()) << "all charts";
}

TEST_F(FairStudy, TellsWhatIsWrong) {
    EXPECT_EQ(complaint(R"("equal": { "time": 20 },)", plain),
              "no technique has a knob for the budget; add \"solve\": { \"pass.parameter\": [least, most] } to one");
    EXPECT_EQ(complaint("", solved), "there is no budget to solve for; add \"equal\" to the study");
    EXPECT_EQ(complaint(R"("equal": { "time": 0 },)", solved), "the budget must be above 0, not 0");
    EXPECT_EQ(complaint(R"("equal": { "watts": 3 },)", solved).substr(0, 48), "\"equal\" needs a \"time\", \"rays\" or \"steps\"; write");
    EXPECT_EQ(complaint(R"("equal": { "rays": "solved" },)", solved).substr(0, 48), "\"solved\" has no cost of its own to give others; ");
    EXPECT_EQ(complaint(R"("equal": { "rays": 9 },)", R"("s": { "graph": "graph.json", "set": { "a.spp": 1 }, "solve": { "a.spp": [1, 64] } })").substr(0, 44),
              "\"a.spp\" is set or varied, and solved for; re");
    EXPECT_EQ(complaint(R"("baseline": "plian",)", plain), "the study has no technique \"plian\"; did you mean \"plain\"?");
    EXPECT_EQ(complaint(R"("masks": { "finest": "hits.depth" },)", plain).substr(0, 33), "a mask can't be named \"finest\"; i");
}

// If this fails, times of one technique are measured while the machine was another than for the next.
TEST_F(FairStudy, TechniquesTakeTurnsWithinASeed) {
    const Study study = load("", plain + R"(, "other": { "graph": "graph.json" })");
    std::string order;
    for (const StudyRun& run : expandRuns(study)) order += char('A' + int(run.technique));
    EXPECT_EQ(order, "ABABAB");
}

ResultRow row(const std::string& run, std::uint32_t seed, double error, double ms) {
    ResultRow row{.run = run, .scene = "box", .technique = "t", .seed = seed, .device = "d", .milliseconds = ms};
    row.passes = {{"trace", ms, {{"primary", std::uint64_t(100 * ms)}}}};
    row.metrics = {{"mse", error}};
    return row;
}

TEST_F(FairStudy, HoldsTechniquesAgainstTheBaseline) {
    const Study study = load(R"("paired": true, "baseline": "plain",)", plain + R"(, "other": { "graph": "graph.json", "vary": { "a.spp": [1, 2, 4] } })");
    const std::vector<StudyRun> runs = expandRuns(study);
    std::vector<std::string> names;
    std::vector<ResultRow> rows;
    for (const StudyRun& run : runs) {
        names.push_back("run " + std::to_string(names.size()));
        const double samples = run.technique == 0 ? 1 : run.knobs[0].value.asNumber(), luck = 1 + 0.1 * run.seed;
        rows.push_back(row(names.back(), run.seed, (run.technique == 0 ? 2 : 1) * luck / samples, 3 * samples));
    }
    const Summary summary = summarize(study, runs, names, rows);
    ASSERT_EQ(summary.comparisons.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
        const Comparison& comparison = summary.comparisons[i];
        EXPECT_EQ(summary.cells[comparison.baseline].technique, 0u);
        EXPECT_NEAR(comparison.metrics.at("mse").middle(), 0.5 / (1 << i), 1e-12);
        EXPECT_NEAR(comparison.metrics.at("mse").high() / comparison.metrics.at("mse").low(), 1, 1e-9) << "the same for every seed";
        EXPECT_NEAR(comparison.rays.middle(), 1 << i, 1e-12);
    }
    ASSERT_EQ(summary.exponents.size(), 1u);
    EXPECT_EQ(summary.exponents[0].over, "a.spp");
    EXPECT_NEAR(summary.exponents[0].estimate.mean, -1, 1e-9);
    EXPECT_NE(summaryText(study, summary).find("mse ~ a.spp^(-1"), std::string::npos) << summaryText(study, summary);
}

}  // namespace
}  // namespace lodestir
