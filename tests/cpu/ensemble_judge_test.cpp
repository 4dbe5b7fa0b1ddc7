// SPDX-License-Identifier: MIT
// The judge of bias without a device: moments and tests with known answers, error rates by simulation, verdicts, rows, reports, wrong
// files.
#include "../temporary_folder.h"

#include <framework/core/error.h>
#include <framework/study/ensemble/images.h>
#include <framework/study/ensemble/report.h>
#include <framework/study/report/summary_json.h>
#include <framework/study/results.h>
#include <framework/study/error/statistics.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace lodestir {
namespace {

using Random = std::mt19937_64;

double uniform(Random& random) { return (double(random() >> 11) + 0.5) * 0x1p-53; }
/// Skewness 2, mean 1.
double exponential(Random& random) { return -std::log(uniform(random)); }

TEST(Moments, KnownAnswers) {
    const Moments m = momentsOf(std::vector<double>{1, 2, 3, 10});
    EXPECT_DOUBLE_EQ(m.mean, 4);
    EXPECT_DOUBLE_EQ(m.squares, 9 + 4 + 1 + 36);
    EXPECT_DOUBLE_EQ(m.cubes, -27 - 8 - 1 + 216);
    EXPECT_DOUBLE_EQ(m.variance(), 50.0 / 3);
}

// If this fails, a study that was resumed or sharded has another verdict than one made in one go.
TEST(Moments, ChunksMergeToTheWhole) {
    Random random(1);
    std::vector<double> values(1000);
    for (double& value : values) value = 100 + std::pow(exponential(random), 3);
    const Moments whole = momentsOf(values);
    Moments merged, oneByOne;
    for (std::size_t begin = 0, size = 1; begin < values.size(); begin += size, size = 2 * size + 1)
        merged.merge(momentsOf(std::span(values).subspan(begin, std::min(size, values.size() - begin))));
    for (const double value : values) oneByOne.add(value);
    for (const Moments& m : {merged, oneByOne}) {
        EXPECT_EQ(m.count, 1000);
        EXPECT_NEAR(m.mean, whole.mean, 1e-11 * whole.mean);
        EXPECT_NEAR(m.squares, whole.squares, 1e-10 * whole.squares);
        EXPECT_NEAR(m.cubes, whole.cubes, 1e-9 * std::abs(whole.cubes));
    }
    Moments same = whole;
    same.merge({});
    EXPECT_EQ(same.mean, whole.mean);
}

TEST(Student, TailsAreExactFarOut) {
    for (const int freedom : {1, 2, 5, 30, 400})
        for (const double p : {0.5, 0.05, 1e-3, 1e-6})
            EXPECT_NEAR(studentTail(studentQuantile(1 - p / 2, freedom), freedom) / p, 1, 1e-6) << freedom << " " << p;
    const double pi = std::acos(-1.0);
    EXPECT_NEAR(studentTail(1e4, 1) / (1 - 2 / pi * std::atan(1e4)), 1, 1e-9) << "Cauchy's distribution";
    EXPECT_NEAR(studentTail(6, 1e6) / std::erfc(6 / std::sqrt(2.0)), 1, 1e-3) << "nearly the normal distribution";
    EXPECT_EQ(studentTail(0, 7), 1);
    EXPECT_LT(studentTail(3, 9.5), studentTail(3, 9));
    EXPECT_GT(studentTail(3, 9.5), studentTail(3, 10));
    EXPECT_EQ(studentTail(-3, 9), studentTail(3, 9));
}

TEST(CompareMeans, SymmetricValuesGiveWelchsTest) {
    const Moments x = momentsOf(std::vector<double>{1, 2, 3, 4, 5}), y = momentsOf(std::vector<double>{3, 5, 7});  // variances 2.5 and 4
    const MeanTest test = compareMeans(x, y, 0);
    const double variance = 2.5 / 5 + 4.0 / 3;
    EXPECT_DOUBLE_EQ(test.difference, -2);
    EXPECT_DOUBLE_EQ(test.error, std::sqrt(variance));
    EXPECT_NEAR(test.t, -2 / std::sqrt(variance), 1e-12);
    EXPECT_NEAR(test.freedom, variance * variance / (0.25 / 4 + 16.0 / 9 / 2), 1e-9);
    EXPECT_NEAR(test.p, studentTail(test.t, test.freedom), 1e-15);
    EXPECT_NEAR(test.halfWidth(), studentQuantile(0.975, 3) * test.error, 1e-12);
    const MeanTest coarse = compareMeans(x, y, 10);
    EXPECT_DOUBLE_EQ(coarse.error, std::sqrt(variance + 100));
    EXPECT_GT(coarse.p, 0.8);
}

TEST(CompareMeans, WithoutNoiseEqualIsEqual) {
    const Moments one = momentsOf(std::vector<double>{1, 1, 1}), two = momentsOf(std::vector<double>{2, 2, 2}),
                  nearly = momentsOf(std::vector<double>(3, 1.00005));
    EXPECT_EQ(compareMeans(one, one, 0).p, 1);
    EXPECT_EQ(compareMeans(one, two, 0).p, 0);
    EXPECT_LT(compareMeans(one, two, 1e-4).p, 1e-100);
    EXPECT_GT(compareMeans(nearly, one, 1e-4).p, 0.5) << "what storage rounds is no bias";
    const Moments broken = momentsOf(std::vector<double>{1, std::nan(""), 1});
    EXPECT_EQ(compareMeans(broken, one, 1e-4).p, 0);
    EXPECT_EQ(compareMeans(one, momentsOf(std::vector<double>{1, std::numeric_limits<double>::infinity()}), 0).p, 0);
}

// Johnson's own form turns back: with much skewness a mean ten sigmas too low would count as none.
TEST(CompareMeans, ALargerDifferenceIsNeverMoreInnocent) {
    const Moments y{.count = 1000, .mean = 0};
    for (const double cubes : {0.0, 2e5, -2e5}) {  // skewness of the values 0 and +-6.2, of their mean +-0.39
        double last = -std::numeric_limits<double>::infinity();
        for (double mean = -3; mean <= 3; mean += 0.01) {
            const double t = compareMeans({.count = 256, .mean = mean, .squares = 256 * 6.25, .cubes = cubes / 8}, y, 0).t;
            EXPECT_GE(t, last);
            last = t;
        }
        EXPECT_GT(last, 3);
    }
}

/// How often a test of two-sided level 0.01 blames the mean 1 of `count` exponential values, and the share of those that blame it for being
/// too low.
struct Alarms {
    double plain = 0, corrected = 0, plainLow = 0, correctedLow = 0;
};
Alarms falseAlarms(int count, int trials) {
    Random random(11);
    Alarms alarms;
    const Moments truth{.count = 1e9, .mean = 1};
    for (int trial = 0; trial < trials; ++trial) {
        std::vector<double> values(static_cast<std::size_t>(count));
        for (double& value : values) value = exponential(random);
        const MeanTest test = compareMeans(momentsOf(values), truth, 0);
        const double t = test.difference / test.error;
        const bool plain = studentTail(t, test.freedom) < 0.01, corrected = test.p < 0.01;
        alarms.plain += plain;
        alarms.plainLow += plain && t < 0;
        alarms.corrected += corrected;
        alarms.correctedLow += corrected && test.t < 0;
    }
    for (double* n : {&alarms.plain, &alarms.corrected, &alarms.plainLow, &alarms.correctedLow}) *n /= trials;
    return alarms;
}

// If this fails, skewed noise, which path tracing has, is taken for bias.
TEST(CompareMeans, SkewedValuesKeepTheRateOfFalseAlarms) {
    constexpr int trials = 60000;
    const Alarms alarms = falseAlarms(64, trials);
    EXPECT_GT(alarms.plain, 0.016) << "Student's t alone is misled, nearly always downwards: " << alarms.plainLow;
    EXPECT_GT(alarms.plainLow, 0.014);
    EXPECT_LT(alarms.corrected, 0.0135);
    EXPECT_GT(alarms.corrected, 0.007);
    EXPECT_LT(std::abs(alarms.correctedLow / alarms.corrected - 0.5), 0.5 * std::abs(alarms.plainLow / alarms.plain - 0.5))
        << "both sides alike";
}

constexpr BlockGrid grid{64, 40};  // 4 x 3 blocks, the lowest half as high

/// Runs of an image whose blocks have the means `truth` and exponential noise of `noise` of that, a share of it common to the whole run.
BlockMeans ensemble(Random& random, std::size_t runs, double noise, const std::vector<double>& truth) {
    BlockMeans means{.grid = grid, .values = {}};
    for (std::size_t run = 0; run < runs; ++run) {
        const double common = exponential(random) - 1;
        for (std::size_t block = 0; block < grid.count(); ++block)
            for (int c = 0; c < 3; ++c)
                means.values.push_back(truth[block] * (1 + 0.1 * c) * (1 + noise * (0.5 * common + exponential(random) - 1)));
    }
    return means;
}
std::vector<double> ramp() {
    std::vector<double> truth(grid.count());
    for (std::size_t block = 0; block < truth.size(); ++block) truth[block] = 0.2 + 0.1 * double(block);
    return truth;
}

TEST(BlockMeans, EdgesAndEnergy) {
    EXPECT_EQ(grid.columns(), 4);
    EXPECT_EQ(grid.rows(), 3);
    double sum = 0;
    for (std::size_t block = 0; block < grid.count(); ++block) sum += grid.share(block);
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_NEAR(grid.share(0), 0.1, 1e-12);
    EXPECT_NEAR(grid.share(11), 0.05, 1e-12);
    ImageData image = makeImage(64, 40, 4);
    double red = 0;
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 64; ++x)
            red += double(image.at(x, y, 0) = float(x + y)) / (64 * 40), image.at(x, y, 1) = 2, image.at(x, y, 3) = 9;
    BlockMeans means;
    means.add(image);
    means.add(image);
    ASSERT_EQ(means.runs(), 2u);
    EXPECT_NEAR(means.at(1, 0, 0), 15, 1e-9);
    EXPECT_NEAR(means.at(1, 11, 0), 48 + 7.5 + 32 + 3.5, 1e-9) << "an edge block's mean is over its own pixels";
    const Energy energy = energyOf(means, 1);
    EXPECT_NEAR(energy[1], red, 1e-9);
    EXPECT_NEAR(energy[2], 2, 1e-9);
    EXPECT_NEAR(energy[0], 0.2126 * red + 0.7152 * 2, 1e-9);
    EXPECT_THROW(means.add(makeImage(64, 64, 3)), Error);
}

// Over all they look at, the tests blame correct code as often as they say.
TEST(EnsembleTests, BonferroniKeepsTheLevel) {
    Random random(5);
    constexpr int trials = 2000;
    int energy = 0, blocks = 0, single = 0;
    for (int trial = 0; trial < trials; ++trial) {
        const EnsembleTests tests = testEnsemble(ensemble(random, 64, 0.2, ramp()), ensemble(random, 64, 0.02, ramp()));
        energy += tests.energyP < 0.05;
        blocks += tests.blockP < 0.05;
        single += tests.blocks[7].p < 0.05;
    }
    EXPECT_NEAR(double(single) / trials, 0.05, 0.016);
    EXPECT_LT(double(energy) / trials, 0.066);  // 0.05 and three standard deviations; less, as luminance and colours go together
    EXPECT_LT(double(blocks) / trials, 0.066);
    EXPECT_GT(double(blocks) / trials, 0.02) << "but not much more seldom";
}

TEST(EnsembleTests, ChunksJoinToTheWhole) {
    Random random(8);
    const BlockMeans whole = ensemble(random, 50, 0.3, ramp()), reference = ensemble(random, 64, 0.1, ramp());
    const std::size_t cut = 3 * grid.count() * 32;
    BlockMeans joined{.grid = grid, .values = {whole.values.begin(), whole.values.begin() + std::ptrdiff_t(cut)}};
    joined.append({.grid = grid, .values = {whole.values.begin() + std::ptrdiff_t(cut), whole.values.end()}});
    EXPECT_EQ(testEnsemble(joined, reference).blockP, testEnsemble(whole, reference).blockP);
    EXPECT_THROW(joined.append({.grid = {64, 64}, .values = {}}), Error);
}

constexpr VerdictOptions studyOptions{};

TEST(Verdict, ARightEnsembleIsUnbiased) {
    Random random(21);
    const EnsembleResult result = judgeEnsemble(ensemble(random, 256, 0.03, ramp()), ensemble(random, 64, 0.003, ramp()), studyOptions);
    EXPECT_EQ(result.verdict, Verdict::unbiased) << result.reason;
    EXPECT_LT(result.halfWidth, 0.003);
    EXPECT_GT(result.halfWidth, 0.001);
    EXPECT_LT(result.falseAlarms, 0.015);
    ASSERT_EQ(result.faults.size(), 4u);
    for (const PlantedFault& fault : result.faults) {
        EXPECT_TRUE(fault.needed);
        EXPECT_GE(fault.caught, 0.95) << fault.size << (fault.block ? " in a block" : "");
    }
}

TEST(Verdict, FaultsAreCaughtAndNamed) {
    Random random(22);
    const BlockMeans reference = ensemble(random, 64, 0.003, ramp());
    for (const double scale : {1.01, 0.97}) {
        std::vector<double> wrong = ramp();
        for (double& mean : wrong) mean *= scale;
        const EnsembleResult result = judgeEnsemble(ensemble(random, 256, 0.03, wrong), reference, studyOptions);
        EXPECT_EQ(result.verdict, Verdict::biased);
        EXPECT_NEAR(result.energy[0] / result.referenceEnergy[0], scale, 2 * result.halfWidth);
        EXPECT_NE(result.reason.find("energy: "), std::string::npos) << result.reason;
    }
    // Energy that is moved, not made: only blocks can tell.
    std::vector<double> moved = ramp();
    moved[6] *= 1.05;
    moved[5] -= 0.05 * ramp()[6];
    const EnsembleResult result = judgeEnsemble(ensemble(random, 256, 0.03, moved), reference, studyOptions);
    EXPECT_EQ(result.verdict, Verdict::biased);
    EXPECT_GT(result.tests.energyP, 1e-3);
    EXPECT_LT(result.tests.blockP, 1e-3);
    EXPECT_TRUE(result.reason.starts_with("block (1, 1)") || result.reason.starts_with("block (2, 1)")) << result.reason;

    BlockMeans broken = ensemble(random, 32, 0.03, ramp());
    broken.values[40] = std::nan("");
    EXPECT_EQ(judgeEnsemble(broken, reference, studyOptions).verdict, Verdict::biased);
}

TEST(Verdict, FewNoisyRunsAreInconclusive) {
    Random random(23);
    const BlockMeans reference = ensemble(random, 64, 0.003, ramp());
    const EnsembleResult result = judgeEnsemble(ensemble(random, 64, 0.2, ramp()), reference, studyOptions);
    EXPECT_EQ(result.verdict, Verdict::inconclusive);
    EXPECT_NE(result.reason.find("times as many runs"), std::string::npos) << result.reason;
    // The same runs do where less is asked for: of the faults only those have to be seen that such an interval shows.
    const EnsembleResult coarse = judgeEnsemble(ensemble(random, 256, 0.06, ramp()), reference, {.halfWidth = 0.01});
    EXPECT_EQ(coarse.verdict, Verdict::unbiased) << coarse.reason;
    EXPECT_FALSE(coarse.faults[0].needed);
    EXPECT_TRUE(coarse.faults[1].needed);
    EXPECT_LT(coarse.faults[0].caught, coarse.faults[1].caught);
}

// The bootstrap's power is the one that fresh ensembles have.
TEST(Verdict, PowerIsWhatItIs) {
    Random random(31);
    const double noise = 0.1;  // an energy known to +-0.65 %: 1 % is seen now and then
    const EnsembleResult result = judgeEnsemble(ensemble(random, 256, noise, ramp()), ensemble(random, 64, 0.003, ramp()), studyOptions);
    std::vector<double> wrong = ramp();
    for (double& mean : wrong) mean *= 1.01;
    int caught = 0;
    constexpr int trials = 300;
    for (int trial = 0; trial < trials; ++trial) {
        const EnsembleTests tests = testEnsemble(ensemble(random, 256, noise, wrong), ensemble(random, 64, 0.003, ramp()));
        caught += tests.energyP < 1e-3 || tests.blockP < 1e-3;
    }
    const double power = double(caught) / trials;
    EXPECT_GT(power, 0.05);
    EXPECT_LT(power, 0.95);
    EXPECT_NEAR(result.faults[0].caught, power, 0.17) << "the ensemble's own spread is an estimate";
}

class EnsembleFiles : public test::FolderTest {
protected:
    EnsembleFiles() {
        writeFile(folder / "box.json", "{}");
        writeFile(folder / "graph.json", "{}");
    }

    Study load(const std::string& text) {
        writeFile(folder / "study.json", text);
        return loadStudy(folder / "study.json");
    }
    std::vector<std::string> complaints(const std::string& text) {
        std::vector<std::string> lines;
        try {
            load(text);
        } catch (const Error& error) {
            for (const Problem& problem : error.problems()) lines.push_back(problem.text().substr(folder.string().size() + 1));
        }
        return lines;
    }

    const std::string good =
        R"({ "format": 1, "kind": "ensemble", "about": "a < b", "scenes": ["box.json"], "size": [64, 40], "runs": 80, "seed": 7,
      "frames": { "warmup": 3, "measure": [0, 2] }, "reference": { "graph": "graph.json", "spp": 128 }, "halfWidth": 0.02,
      "techniques": { "plain": { "graph": "graph.json", "control": true, "vary": { "a.spp": [1, 2] } },
                      "wrong": { "graph": "graph.json", "planted": true } } })";
};

TEST_F(EnsembleFiles, AreRead) {
    const Study study = load(good);
    EXPECT_EQ(study.kind, StudyKind::ensemble);
    ASSERT_EQ(study.seeds.size(), 80u);
    EXPECT_EQ(study.seeds.front(), 7u);
    EXPECT_EQ(study.seeds.back(), 86u);
    EXPECT_EQ(study.halfWidth, 0.02);
    EXPECT_TRUE(study.techniques[0].control);
    EXPECT_FALSE(study.techniques[0].planted);
    EXPECT_TRUE(study.techniques[1].planted);
}

TEST_F(EnsembleFiles, WrongOnesAreTold) {
    const std::vector<std::string> said = complaints(R"({ "format": 1, "kind": "ensemble", "scenes": ["box.json"],
"runs": 8, "seeds": 4,
"halfWidth": 0.3,
"reference": { "graph": "graph.json", "spp": 100 },
"techniques": { "plain": { "graph": "graph.json", "control": 1 }, "both": { "graph": "graph.json", "control": true, "planted": true } },
"metrics": ["mse"] })");
    const std::vector<std::string> expected{"study.json:2:9: the number of runs must be 16..",
                                            "study.json:2:12: ",
                                            "study.json:3:14: \"halfWidth\" must be above 0 and at most 0.1, not 0.3; it is a share",
                                            "study.json:4:46: the reference's \"spp\" must be a multiple of 64",
                                            "study.json:5:62: \"control\"",
                                            "study.json:5:75: technique \"both\" can't be both right and wrong",
                                            "study.json:6:1: "};
    ASSERT_EQ(said.size(), expected.size()) << [&] {
        std::string all;
        for (const std::string& line : said) all += line + "\n";
        return all;
    }();
    for (std::size_t i = 0; i < said.size(); ++i) EXPECT_TRUE(said[i].starts_with(expected[i])) << said[i] << "\nexpected: " << expected[i];
    EXPECT_FALSE(
        complaints(R"({ "format": 1, "scenes": ["box.json"], "seeds": 4, "runs": 64, "reference": { "graph": "graph.json", "spp": 64 },
        "techniques": { "plain": { "graph": "graph.json" } } })")
            .empty())
        << "\"runs\" belongs to ensembles";
}

TEST_F(EnsembleFiles, ChunksCoverEveryRunOnce) {
    const Study study = load(good);
    const std::vector<EnsembleChunk> chunks = expandChunks(study);
    int reference = 0, runs = 0;
    for (const EnsembleChunk& chunk : chunks) {
        EXPECT_EQ(chunk.first % chunkRuns, 0);
        (chunk.technique ? runs : reference) += chunk.count;
    }
    EXPECT_EQ(reference, 64);
    EXPECT_EQ(runs, 3 * 80);
    EXPECT_EQ(chunks.size(), 2u + 3u * 3u);
    EXPECT_TRUE(chunks[2].isSeriesOf(chunks[4]));
    EXPECT_FALSE(chunks[4].isSeriesOf(chunks[5])) << "another knob value";
    Study large = study;
    large.referenceSamples = 1 << 17;
    EXPECT_EQ(batchesOf(large), 128) << "at most 1024 samples a batch";
    large.referenceSamples = 3 << 16;
    EXPECT_EQ((large.referenceSamples / batchesOf(large)) * batchesOf(large), large.referenceSamples);
}

EnsembleRow rowFor(const std::string& name, const EnsembleChunk& chunk, int offset, double scale, Random& random) {
    std::vector<double> truth = ramp();
    for (double& mean : truth) mean *= scale;
    EnsembleRow row{.run = name, .scene = "box", .technique = chunk.technique ? "some" : "", .offset = offset, .first = chunk.first};
    row.means = ensemble(random, std::size_t(chunk.count), chunk.technique ? 0.1 : 0.01, truth);
    row.milliseconds = 2;
    row.rays = 64 * 40 * 6;
    row.device = "a device";
    return row;
}

TEST_F(EnsembleFiles, RowsComeBackAndAreJudged) {
    const Study study = load(good);
    const std::vector<EnsembleChunk> chunks = expandChunks(study);
    std::vector<std::string> names;
    Random random(41);
    {
        ResultFile file(folder / "results.jsonl");
        for (std::size_t i = 0; i < chunks.size(); ++i) {
            names.push_back("chunk " + std::to_string(i));
            if (i == 7) continue;  // of "plain, spp 2": never made
            for (const int offset : study.measure)
                file.add(toJson(rowFor(names[i], chunks[i], offset, chunks[i].technique == 1 ? 1.1 : 1, random)).dump() + "\n");
        }
        file.add(toJson(rowFor("of another graph", chunks[3], 0, 1, random)).dump() + "\n");
    }
    const std::vector<EnsembleRow> rows = readEnsembleRows(folder);
    ASSERT_EQ(rows.size(), 2 * (chunks.size() - 1) + 1);
    for (const EnsembleRow& row : rows) EXPECT_EQ(toJson(ensembleRowOf(toJson(row))), toJson(row));
    EXPECT_EQ(float(rows[0].means.values[5]), float(ensembleRowOf(toJson(rows[0])).means.values[5])) << "to the last of 32 bits";

    const EnsembleSummary summary = summarizeEnsemble(study, chunks, names, rows);
    EXPECT_EQ(summary.missing, 1u);
    EXPECT_EQ(summary.foreign, 1u);
    ASSERT_EQ(summary.cells.size(), 6u);  // three configurations, two frames
    EXPECT_TRUE(summary.cells[0].complete);
    EXPECT_EQ(summary.cells[0].result.runs, 80);
    EXPECT_EQ(summary.cells[0].result.batches, 64);
    EXPECT_EQ(summary.cells[0].milliseconds, 2);
    EXPECT_LT(std::abs(summary.cells[0].halvesSigmas), 4);
    EXPECT_EQ(summary.cells[0].result.verdict, Verdict::unbiased) << summary.cells[0].result.reason;
    EXPECT_FALSE(summary.cells[2].complete);
    EXPECT_EQ(summary.cells[4].result.verdict, Verdict::biased);
    EXPECT_FALSE(summary.failed(study)) << "the only bias is a planted one";
    Study honest = study;
    honest.techniques[1].planted = false;
    EXPECT_TRUE(summary.failed(honest));

    const std::string text = ensembleText(study, summary);
    for (const char* part : {"plain, spp 1", "unbiased", "(planted fault)", "biased"})
        EXPECT_NE(text.find(part), std::string::npos) << part << text;

    const nlohmann::ordered_json json = nlohmann::ordered_json::parse(summaryJson(study, summary).dump());
    EXPECT_EQ(json["kind"], "ensemble");
    EXPECT_EQ(json["missing"], 1);
    EXPECT_EQ(json["halfWidth"], study.halfWidth);
    EXPECT_TRUE(json["techniques"][0]["control"]);
    EXPECT_TRUE(json["techniques"][1]["planted"]);
    ASSERT_EQ(json["cells"].size(), 6u);
    const auto &same = json["cells"][0], &bad = json["cells"][4];
    const EnsembleResult& result = summary.cells[4].result;
    EXPECT_EQ(same["verdict"], "unbiased");
    EXPECT_EQ(bad["verdict"], "biased");
    EXPECT_EQ(bad["reason"], result.reason);
    EXPECT_EQ(bad["energy"]["luminance"]["difference"], result.tests.energy[0].difference / result.referenceEnergy[0]);
    EXPECT_EQ(bad["energy"]["luminance"]["halfWidth"], result.halfWidth);
    EXPECT_EQ(bad["blockSigmas"].size() * 3, result.tests.blocks.size());
    ASSERT_EQ(same["faults"].size(), 4u);
    EXPECT_EQ(same["faults"][3]["size"], 0.03);
    EXPECT_TRUE(same["faults"][3]["block"]);
    EXPECT_EQ(same["faults"][3]["caught"], summary.cells[0].result.faults[3].caught);
    EXPECT_FALSE(json["cells"][2]["complete"]);
    EXPECT_FALSE(json["cells"][2].contains("verdict")) << "nothing is said of what isn't there";
}

TEST_F(EnsembleFiles, ImagesOfChunksJoin) {
    ImageData one = makeImage(2, 1, 4), two = makeImage(2, 1, 4), still = makeImage(2, 1, 4);
    one.values = {1, 1, 1, 1.5f, 2, 2, 2, 4};
    two.values = {4, 4, 4, 16.5f, 2, 2, 2, 4};
    still.values = {3, 3, 3, 9, 2, 2, 2, 4};
    keepChunkImage(folder, "one", 3, one, 20);
    keepChunkImage(folder, "two", 3, two, 40);
    const EnsembleImage joined = joinImages(readChunkImages(folder, {"one", "two"}, 3));
    EXPECT_EQ(joined.runs, 60);
    EXPECT_FLOAT_EQ(joined.image.values[0], 3);
    EXPECT_FLOAT_EQ(joined.image.values[3], 11.5f);
    const ImageData same = sigmaMap(joined, {still, 1000});
    EXPECT_NEAR(same.values[0], 0, 1e-3);
    EXPECT_EQ(same.values[1], 0);
    still.values[0] = still.values[1] = still.values[2] = 2;
    still.values[3] = 4;
    EXPECT_NEAR(sigmaMap(joined, {still, 1e6}).values[0], 1 / std::sqrt(2.5 / 59), 1e-2);  // variance 11.5 - 9
    EXPECT_THROW(readChunkImages(folder, {"one", "three"}, 3), Error);

    ImageData values = makeImage(4, 1, 1);
    values.values = {0, 9, -9, std::numeric_limits<float>::quiet_NaN()};
    EXPECT_EQ(divergingMap(values, 5).values, (std::vector<float>{1, 1, 1, 1, 0, 0, 0, 0, 1, 0, 1, 0}));
}

}  // namespace
}  // namespace lodestir
