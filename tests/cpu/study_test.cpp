// SPDX-License-Identifier: MIT
// The study core without a device: study files and what is said of wrong ones, runs, statistics, errors by halves, results that survive a kill, reports.
#include "../temporary_folder.h"

#include <framework/core/error.h>
#include <framework/image/metrics.h>
#include <framework/study/error/halves.h>
#include <framework/study/report/images.h>
#include <framework/study/report/summary_json.h>

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <random>
#include <set>

namespace lodestir {
namespace {

class StudyTest : public test::FolderTest {
protected:
    StudyTest() {
        writeFile(folder / "box.json", "{}");
        writeFile(folder / "hall.json", "{}");
        writeFile(folder / "graph.json", "{}");
    }

    Path write(const std::string& text) {
        writeFile(folder / "study.json", text);
        return folder / "study.json";
    }
    /// What is said of a study file, line by line, without the folder.
    std::vector<std::string> complaints(const std::string& text) {
        std::vector<std::string> lines;
        try {
            loadStudy(write(text));
        } catch (const Error& error) {
            for (const Problem& problem : error.problems()) lines.push_back(problem.text().substr(folder.string().size() + 1));
        }
        return lines;
    }

    const std::string good = R"({ "format": 1, "about": "two knobs",
      "scenes": ["box.json", "hall.json"], "size": [32, 18], "seeds": 3,
      "frames": { "warmup": 4, "event": 10, "measure": [2, -1, 0] },
      "reference": { "graph": "graph.json", "spp": 64, "finest": true },
      "techniques": { "plain": { "graph": "graph.json", "vary": { "a.mode": ["x", "y"], "a.spp": [1, 2, 4] } },
                      "other": { "graph": "graph.json", "variant": "v", "set": { "a.spp": 2 }, "clear": [1, 0] } },
      "mask": "switched", "metrics": ["mse"], "charts": ["error_vs_time"] })";
};

TEST_F(StudyTest, PathsMayHaveBackslashes) {
    writeFile(folder / "scenes/far.json", std::string_view("{}"));
    std::string text = good;
    text.replace(text.find("hall.json"), 9, R"(scenes\\far.json)");
    EXPECT_EQ(loadStudy(write(text)).scenes[1].file, folder / "scenes/far.json");
}

TEST_F(StudyTest, ReadsTheContract) {
    const Study study = loadStudy(write(good));
    ASSERT_EQ(study.scenes.size(), 2u);
    EXPECT_EQ(study.scenes[1].name, "hall");
    EXPECT_EQ(study.scenes[1].size, glm::uvec2(32, 18));
    EXPECT_EQ(study.seeds, (std::vector<std::uint32_t>{1, 2, 3}));
    EXPECT_EQ(study.warmup, 4);
    EXPECT_EQ(study.event, 10);
    EXPECT_EQ(study.measure, (std::vector<int>{-1, 0, 2}));
    EXPECT_EQ(study.referenceSamples, 64);
    ASSERT_EQ(study.techniques.size(), 2u);
    EXPECT_EQ(study.techniques[1].graph.variant, "v");
    EXPECT_EQ(study.techniques[1].clear, (std::vector<int>{0, 1}));
    std::vector<std::string> names;
    for (const Measure& measure : measuresOf(study)) names.push_back(measure.name());
    EXPECT_EQ(names, (std::vector<std::string>{"mse.switched", "mse", "mse.switched.finest", "mse.finest"}));
    EXPECT_EQ(study.techniques[1].graph.set.at(0).name, "a.spp");
    EXPECT_EQ(study.techniques[1].graph.graph, folder / "graph.json");
}

// If this fails, a row of one size is told as one of another.
TEST_F(StudyTest, ScenesAreTakenAtEachSize) {
    std::string text = good;
    text.replace(text.find("[32, 18]"), 8, "[[32, 18], [64, 36]]");
    const Study study = loadStudy(write(text));
    ASSERT_EQ(study.scenes.size(), 4u);
    EXPECT_EQ(study.scenes[1].name, "box, 64x36");
    EXPECT_EQ(study.scenes[1].file, study.scenes[0].file);
    EXPECT_EQ(study.scenes[1].pixels(), 64 * 36);
    EXPECT_EQ(study.scenes[2].name, "hall, 32x18");
    EXPECT_EQ(expandRuns(study).size(), 2 * expandRuns(loadStudy(write(good))).size());
    const auto said = [&](const char* sizes) {
        std::string wrong = good;
        wrong.replace(wrong.find("[32, 18]"), 8, sizes);
        const std::vector<std::string> lines = complaints(wrong);
        return lines.empty() ? std::string() : lines.front().substr(lines.front().find(": ") + 2);
    };
    EXPECT_EQ(said("[[32, 18], [32, 18]]"), "the size 32x18 is given twice");
    EXPECT_EQ(said("[[32, 18], [32]]"), "a size must be [width, height], in pixels");
    EXPECT_EQ(said("[]"), "a size must be [width, height], in pixels");
}

TEST_F(StudyTest, TellsAllErrorsAtOnceWithPlaces) {
    const std::vector<std::string> said = complaints(R"({ "format": 1,
"scenes": ["box.json", "nowhere.json"], "size": [32, 0],
"seeds": 0, "frames": { "warmup": 4, "event": 2, "measure": [-9] },
"reference": { "graph": "graph.json", "spp": 63 },
"techniques": { "plain": { "graph": "graph.json", "set": { "spp": 1, "a.b": [1] }, "vary": { "a.spp": [1, 1] } } },
"metrics": ["relmes"], "chart": [], "mask": "swiched" })");
    const std::vector<std::string> expected{
        "study.json:2:24: there is no file",
        "study.json:2:54: the height must be 1..16384, not 0",
        "study.json:3:10: the number of seeds must be 1..100000, not 0",
        "study.json:3:23: 4 frames of warm-up don't fit before frame 2",
        "study.json:3:62: a measured frame must be -4..1000000000, not -9",
        "study.json:4:46: the reference's \"spp\" must be even; it is rendered in two halves",
        "study.json:5:60: \"spp\" names no parameter; write \"pass.parameter\"",
        "study.json:5:107: \"a.spp\" takes 1 twice",
        "study.json:6:13: unknown metric \"relmes\"; did you mean \"relmse\"?",
        "study.json:6:24: ",
        "study.json:6:45: "};
    for (std::size_t i = 0; i < std::max(said.size(), expected.size()); ++i)
        EXPECT_TRUE(i < said.size() && i < expected.size() && said[i].starts_with(expected[i]))
            << "said: " << (i < said.size() ? said[i] : "nothing") << "\nexpected: " << (i < expected.size() ? expected[i] : "nothing");
}

TEST_F(StudyTest, WhatIsMissingIsSaid) {
    const std::vector<std::string> said = complaints("{}");
    std::string all;
    for (const std::string& line : said) all += line + "\n";
    for (const char* key : {"format", "scenes", "seeds", "reference", "techniques"})
        EXPECT_NE(all.find("needs \"" + std::string(key) + "\""), std::string::npos) << key;
    EXPECT_EQ(said.size(), 5u) << all;
}

// If this fails, a parameter that was to follow another keeps its default, and nothing is said.
TEST_F(StudyTest, AParameterTakesTheValueOfAnother) {
    const auto text = [&](const std::string& alike) {
        std::string changed = good;
        const std::string plain = R"("vary": { "a.mode": ["x", "y"], "a.spp": [1, 2, 4] })";
        return changed.replace(changed.find(plain), plain.size(), plain + R"(, "set": { "a.on": true }, "alike": { )" + alike + " }");
    };
    const Study study = loadStudy(write(text(R"("b.samples": "a.spp", "b.on": "a.on")")));
    const StudyRun run = expandRuns(study)[1];
    std::string given;
    for (const Setting& setting : settingsOf(study.techniques[0].graph, run.knobs)) given += setting.name + "=" + setting.value.dump(-1) + " ";
    EXPECT_EQ(given, R"(a.on=true a.mode="x" a.spp=2 b.samples=2 b.on=true )");
    const Where where = settingsOf(study.techniques[0].graph, run.knobs)[3].value.where();
    EXPECT_NE(study.techniques[0].vary[1].values[0].where().column, where.column) << "what is wrong with it here is told here";
    EXPECT_EQ(where.column, study.techniques[0].graph.alike[0].where.column);

    const auto said = [&](const std::string& alike) {
        const std::vector<std::string> lines = complaints(text(alike));
        return lines.empty() ? std::string() : lines.front().substr(lines.front().find(": ") + 2);
    };
    EXPECT_EQ(said(R"("b.samples": "a.sp")"), R"("a.sp" is given no value that "b.samples" could take; did you mean "a.spp"?)");
    EXPECT_EQ(said(R"("a.spp": "b.samples")"), R"("a.spp" is given a value, and takes that of "b.samples"; remove one of them)") << "the names swapped";
    EXPECT_EQ(said(R"("a.spp": "a.spp")"), R"("a.spp" is given a value, and takes that of "a.spp"; remove one of them)");
    EXPECT_EQ(said(R"("b": "a.spp")"), R"("b" names no parameter; write "pass.parameter")");
    EXPECT_EQ(said(R"("b.samples": "a.spp", "c.samples": "b.samples")").substr(0, 58), R"("b.samples" is given no value that "c.samples" could take;)");
}

// If this fails, a study of four long lists takes all memory before it says anything.
TEST_F(StudyTest, TooManyRunsAreRefused) {
    std::string values = "1";
    for (int i = 2; i <= 100; ++i) values += ", " + std::to_string(i);
    std::string vary;
    for (const char* name : {"a.a", "a.b", "a.c", "a.d"}) vary += (vary.empty() ? "\"" : ", \"") + std::string(name) + "\": [" + values + "]";
    const std::vector<std::string> said = complaints(R"({ "format": 1, "scenes": ["box.json"], "seeds": 5,
      "reference": { "graph": "graph.json", "spp": 64 }, "techniques": { "all": { "graph": "graph.json", "vary": {)" + vary + "} } } }");
    ASSERT_EQ(said.size(), 1u);
    EXPECT_EQ(said[0], "study.json:1:1: the study asks for 5e+08 runs, more than 1000000; scenes, seeds and the values in \"vary\" multiply");
}

TEST_F(StudyTest, ExpandsToEveryCombinationOnce) {
    const Study study = loadStudy(write(good));
    const std::vector<StudyRun> runs = expandRuns(study);
    EXPECT_EQ(runs.size(), 2u * 3u * (2u * 3u + 1u));  // scenes x seeds x (modes x samples + 1)
    std::set<std::string> different;
    for (const StudyRun& run : runs)
        different.insert(std::to_string(run.scene) + " " + std::to_string(run.technique) + " " + std::to_string(run.seed) +
                         knobJson(run.knobs).dump());
    EXPECT_EQ(different.size(), runs.size());
    EXPECT_EQ(knobJson(runs[1].knobs).dump(), R"({"a.mode":"x","a.spp":2})") << "the last knob varies fastest";
    EXPECT_EQ(knobText(runs[1].knobs), "mode x, spp 2");

    std::vector<int> taken(runs.size(), 0);
    for (const char* text : {"1/3", "2/3", "3/3"})
        for (std::size_t i = 0; i < runs.size(); ++i) taken[i] += readShard(text).holds(i);
    EXPECT_EQ(taken, std::vector<int>(runs.size(), 1)) << "shards share the runs out";
    for (const char* text : {"0/3", "4/3", "1", "1/", "/3", "a/b", "1/3x", "-1/3"}) EXPECT_THROW(readShard(text), Error) << text;
}

// If this fails, techniques that are all a little too dark by the same luck look like many observations of one fault.
TEST_F(StudyTest, TechniquesDrawSeedsOfTheirOwnUnlessPaired) {
    Study study = loadStudy(write(good));
    std::map<std::string, std::vector<std::uint32_t>> drawn;
    for (const StudyRun& run : expandRuns(study)) {
        EXPECT_LT(run.seed, firstReferenceSeed) << "the noise of the reference";
        if (run.scene == 0) drawn[std::to_string(run.technique) + knobJson(run.knobs).dump()].push_back(run.seed);
    }
    ASSERT_EQ(drawn.size(), 7u);
    std::set<std::uint32_t> all;
    for (const auto& [name, seeds] : drawn) {
        EXPECT_EQ(seeds.size(), 3u) << name;
        all.insert(seeds.begin(), seeds.end());
    }
    EXPECT_EQ(all.size(), 7u * 3u) << "a seed is drawn twice";
    const std::vector<StudyRun> again = expandRuns(loadStudy(write(good)));
    for (std::size_t i = 0; i < again.size(); ++i) EXPECT_EQ(again[i].seed, expandRuns(study)[i].seed) << "a study that is resumed";

    std::string text = good;
    text.insert(text.find("\"seeds\""), "\"paired\": true, ");
    study = loadStudy(write(text));
    ASSERT_TRUE(study.paired);
    for (const StudyRun& run : expandRuns(study)) EXPECT_LE(run.seed, 3u);
}

// Tables of Student's t, two-sided 95 %.
TEST(Statistics, StudentQuantilesAreThoseOfTheTables) {
    const std::vector<std::pair<int, double>> table{{1, 12.7062}, {2, 4.30265},  {3, 3.18245},  {4, 2.77645},
                                                    {7, 2.36462}, {15, 2.13145}, {30, 2.04227}, {1000, 1.96234}};
    for (const auto& [freedom, t] : table) EXPECT_NEAR(studentQuantile(0.975, freedom), t, 1e-5 * t) << freedom;
    EXPECT_NEAR(studentQuantile(0.95, 5), 2.01505, 1e-5);
    EXPECT_NEAR(studentQuantile(0.025, 3), -3.18245, 1e-4);
    EXPECT_NEAR(studentQuantile(0.5, 3), 0, 1e-12);
}

TEST(Statistics, MeansHaveTheIntervalsOfStudent) {
    const std::vector<double> values{2, 4, 4, 6};  // mean 4, variance 8/3, of the mean 2/3
    const Estimate e = estimateMean(values);
    EXPECT_DOUBLE_EQ(e.mean, 4);
    EXPECT_NEAR(e.halfWidth, 3.182446 * std::sqrt(2.0 / 3.0), 1e-5);
    EXPECT_EQ(e.count, 4);
    EXPECT_TRUE(std::isnan(estimateMean(std::vector<double>{1}).halfWidth)) << "one run says nothing of its spread";
    EXPECT_TRUE(std::isnan(estimateMean({}).mean));
    EXPECT_DOUBLE_EQ(medianOf({5, 1, 3}), 3);
    EXPECT_DOUBLE_EQ(medianOf({5, 1, 3, 4}), 3.5);
    const Estimate ratio = estimateRatio(std::vector<double>{2, 4, 8}, std::vector<double>{1, 2, 4});
    EXPECT_DOUBLE_EQ(ratio.mean, 2);
    EXPECT_NEAR(ratio.halfWidth, 0, 1e-12) << "twice as much every time";
}

TEST(Statistics, IntervalsHoldTheMeanNineteenTimesInTwenty) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal(3, 2);
    int holds = 0;
    constexpr int trials = 4000;
    for (int trial = 0; trial < trials; ++trial) {
        std::vector<double> values(4);
        for (double& value : values) value = normal(random);
        const Estimate e = estimateMean(values);
        holds += std::abs(e.mean - 3) <= e.halfWidth;
    }
    EXPECT_NEAR(double(holds) / trials, 0.95, 4 * std::sqrt(0.95 * 0.05 / trials));
}

// If this fails, a bias of the reference's own noise is taken for the technique's: all seeds share it.
TEST(Statistics, IntervalsHoldTheMeanWhereAllValuesShareAnError) {
    std::mt19937 random(2);
    std::normal_distribution<double> normal;
    int holds = 0, narrow = 0;
    constexpr int trials = 4000;
    constexpr double spread = 2, shared = 1.5;
    for (int trial = 0; trial < trials; ++trial) {
        const double common = shared * normal(random);
        std::vector<double> values(8);
        for (double& value : values) value = 3 + common + spread * normal(random);
        const Estimate own = estimateMean(values), whole = withSharedError(own, shared);
        EXPECT_EQ(own.mean, whole.mean);
        narrow += std::abs(own.mean - 3) <= own.halfWidth;
        holds += std::abs(whole.mean - 3) <= whole.halfWidth;
    }
    EXPECT_NEAR(double(holds) / trials, 0.95, 4 * std::sqrt(0.95 * 0.05 / trials));
    EXPECT_LT(double(narrow) / trials, 0.75) << "the error is too small to ask anything of the test";
    EXPECT_TRUE(std::isnan(withSharedError(estimateMean(std::vector<double>{1}), 1).halfWidth));
    EXPECT_EQ(withSharedError(estimateMean(std::vector<double>{1, 2}), 0).halfWidth, estimateMean(std::vector<double>{1, 2}).halfWidth);
}

ImageData noisy(const ImageData& truth, double sigma, std::mt19937& random) {
    std::normal_distribution<float> normal(0, float(sigma));
    ImageData image = truth;
    for (float& value : image.values) value += normal(random);
    return image;
}

ImageData gradient() {
    ImageData truth = makeImage(64, 64, 3);
    for (std::size_t i = 0; i < truth.values.size(); ++i) truth.values[i] = 0.5f + float(i % 97) / 97;
    return truth;
}

// If this fails, a technique is blamed for the noise of its reference.
TEST(Halves, TheNoiseOfTheReferenceIsTakenOut) {
    std::mt19937 random(7);
    const ImageData truth = gradient();
    constexpr double sigma = 0.05, referenceSigma = 0.1;  // the reference noisier than what it judges
    std::vector<double> errors, naive, relative, floors;
    for (int i = 0; i < 40; ++i) {
        const Halves halves(noisy(truth, referenceSigma, random), noisy(truth, referenceSigma, random));
        const ImageData test = noisy(truth, sigma, random);
        errors.push_back(measureError("mse", test, halves, {.exposure = 1}));
        relative.push_back(measureError("relmse", test, halves, {.exposure = 1}));
        naive.push_back(evaluate("mse", test, halves.mean));
        floors.push_back(referenceNoise("mse", test, halves, {.exposure = 1}));
        // The definition itself.
        double sum = 0;
        for (std::size_t k = 0; k < test.values.size(); ++k)
            sum += (double(test.values[k]) - halves.a.values[k]) * (double(test.values[k]) - halves.b.values[k]);
        EXPECT_NEAR(errors.back(), sum / double(test.values.size()), 1e-7);
    }
    const Estimate e = estimateMean(errors);
    EXPECT_LT(e.halfWidth, 0.03 * sigma * sigma);
    EXPECT_NEAR(e.mean, sigma * sigma, 2 * e.halfWidth);
    EXPECT_NEAR(estimateMean(floors).mean, referenceSigma * referenceSigma / 2, 0.02 * referenceSigma * referenceSigma)
        << "variance of the mean of two";
    EXPECT_GT(estimateMean(naive).mean, 2 * sigma * sigma) << "without halves the error is three times too large";
    double expected = 0;  // sigma^2 / (mean(r)^2 + 0.01), averaged over pixels
    for (std::size_t p = 0; p < truth.pixelCount(); ++p) {
        const double mean = (truth.values[3 * p] + truth.values[3 * p + 1] + truth.values[3 * p + 2]) / 3.0;
        expected += sigma * sigma / (mean * mean + 0.01) / double(truth.pixelCount());
    }
    EXPECT_NEAR(estimateMean(relative).mean, expected, 0.06 * expected);
}

// If this fails, trimmed errors of techniques are pressed towards each other by the noise of what they are measured against.
TEST(Halves, TheNoiseOfTheReferenceIsTakenOutOfWhatIsTrimmed) {
    constexpr double sigma = 0.05, referenceSigma = 0.1;
    constexpr std::size_t outliers = 60;  // of 65,536 pixels, of which 65 are left out
    ImageData truth = makeImage(256, 256, 3);
    for (float& value : truth.values) value = 10;  // the noise of the denominator is another matter
    const MetricOptions asIs{.exposure = 1};
    /// Mean value and noise told of an image over many references.
    const auto measured = [&](double testSigma, std::size_t broken) {
        std::mt19937 random(5);
        std::vector<double> errors, noise;
        for (int i = 0; i < 24; ++i) {
            const Halves halves(noisy(truth, referenceSigma, random), noisy(truth, referenceSigma, random));
            ImageData test = noisy(truth, testSigma, random);
            for (std::size_t pixel = 0; pixel < broken; ++pixel) test.values[3000 * pixel] = 5000;
            errors.push_back(measureError("relmse_trimmed", test, halves, asIs));
            noise.push_back(referenceNoise("relmse_trimmed", test, halves, asIs));
            EXPECT_NEAR(errors.back() + noise.back(), evaluate("relmse_trimmed", test, halves.mean, asIs), 1e-12);
        }
        return std::pair(estimateMean(errors), estimateMean(noise));
    };
    /// Share of the sum of squares that the largest thousandth holds of three Gaussian channels: P(chi-square of 5 > c), c being exceeded by 3 with 0.001.
    constexpr double largest = 0.006124;
    const double weight = 1 / 100.01, v = weight * sigma * sigma, noise = weight * referenceSigma * referenceSigma / 2;
    const auto [error, told] = measured(sigma, 0);
    EXPECT_NEAR(told.mean, noise, 0.02 * noise);
    EXPECT_LT(error.halfWidth, 0.02 * v);
    const double expected = ((v + noise) * (1 - largest) / 0.999) - noise;
    EXPECT_NEAR(error.mean, expected, 0.01 * v) << "near " << v * (1 - largest) / 0.999 << ", that of a perfect reference";
    EXPECT_NEAR(measured(sigma, outliers).first.mean, v, 0.03 * v) << "fireflies go, and what stays is judged without noise";
    EXPECT_NEAR(measured(0, 0).first.mean, -noise * (largest - 0.001) / 0.999, 0.003 * noise) << "what has no error: too low by half a hundredth of the noise";
}

// The bias of what is right is the reference's own, whose standard deviation is sigma / sqrt(2) for a value of (A + B) / 2.
TEST(Halves, TheNoiseOfTheReferenceInABiasIsKnown) {
    std::mt19937 random(11);
    const ImageData truth = gradient();
    constexpr double sigma = 0.1;
    double mean = 0, squares = 0, told = 0;
    for (const float value : truth.values) mean += double(value) / double(truth.values.size());
    constexpr int draws = 200;
    for (int i = 0; i < draws; ++i) {
        const Halves halves(noisy(truth, sigma, random), noisy(truth, sigma, random));
        const double bias = measureError("bias", truth, halves, {.exposure = 1});
        squares += bias * bias / draws;
        told += referenceDeviation("bias", halves, {.exposure = 1}) / draws;
    }
    const double expected = sigma / std::sqrt(2 * double(truth.values.size())) / mean;
    EXPECT_NEAR(told, expected, 0.02 * expected);
    EXPECT_NEAR(std::sqrt(squares), expected, 0.2 * expected) << "four sigmas of a deviation over 200 draws";
    const Halves halves(noisy(truth, sigma, random), noisy(truth, sigma, random));
    EXPECT_EQ(referenceDeviation("mae", halves, {.exposure = 1}), 0);
    std::vector<bool> half(truth.pixelCount());
    for (std::size_t p = 0; p < half.size(); ++p) half[p] = p % 2 == 0;
    EXPECT_NEAR(referenceDeviation("bias", halves, {.exposure = 1, .mask = half}), std::sqrt(2.0) * expected, 0.1 * expected);
}

TEST(Halves, AnErrorIsWhatItIs) {
    std::mt19937 random(3);
    const ImageData truth = gradient();
    const Halves halves(truth, truth);
    ImageData brighter = truth;
    for (float& value : brighter.values) value += 0.25f;
    EXPECT_NEAR(measureError("mse", brighter, halves, {.exposure = 1}), 0.0625, 1e-6);
    EXPECT_EQ(measureError("mse", truth, halves, {.exposure = 1}), 0);
    EXPECT_NEAR(measureError("mae", brighter, halves, {.exposure = 1}), 0.25, 1e-6);
    EXPECT_FALSE(isNoiseFree("mae"));
    EXPECT_EQ(measureError("relmse_trimmed", truth, halves, {.exposure = 1}), 0);
    ImageData broken = truth;
    broken.values[5] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(std::isnan(measureError("mse", broken, halves, {.exposure = 1}))) << "a broken pixel is seen";
    EXPECT_THROW(Halves(truth, makeImage(2, 2, 3)), Error);
}

ResultRow exampleRow(const std::string& run, int offset, double error) {
    ResultRow row{
        .run = run, .scene = "box", .technique = "plain", .seed = 2, .offset = offset, .device = "a device", .milliseconds = 12.5};
    row.knobs["a.spp"] = 4;
    row.passes = {{"trace", 10, {{"primary", 100}, {"nee", 50}}}, {"display", 2.5, {{"primary", 0}}}};
    row.metrics = {{"mse", error}};
    row.noise = {{"mse", 0.25}};
    row.exposure = 2;
    return row;
}

TEST_F(StudyTest, RowsComeBackAsTheyWere) {
    const ResultRow row = exampleRow("abc", -3, 0.1), back = rowOf(toJson(row));
    EXPECT_EQ(toJson(back), toJson(row));
    EXPECT_EQ(back.rays(), 150u);
    EXPECT_EQ(back.offset, -3);
    EXPECT_EQ(back.metrics.at("mse"), 0.1) << "to the last bit";
    const ResultRow broken = rowOf(nlohmann::ordered_json::parse(toJson(exampleRow("abc", 0, std::nan(""))).dump()));
    EXPECT_TRUE(std::isnan(broken.metrics.at("mse")));
}

// If this fails, a killed study cannot go on, or counts half a row.
TEST_F(StudyTest, ResultsSurviveACutLine) {
    const Path file = folder / "results.jsonl";
    { ResultFile(file).add(linesOf({exampleRow("one", 0, 1), exampleRow("one", 1, 2)})); }
    const std::string whole = readText(file);
    const std::string line = toJson(exampleRow("two", 0, 3)).dump();
    for (const std::size_t length : {std::size_t(1), line.size() / 2, line.size()}) {  // the last: only the line feed is missing
        std::ofstream(file, std::ios::app) << line.substr(0, length);
        EXPECT_EQ(readResults(folder).size(), 2u);
        { ResultFile(file).add(linesOf({exampleRow("three", 0, 4)})); }
        const std::vector<ResultRow> rows = readResults(folder);
        ASSERT_EQ(rows.size(), 3u);
        EXPECT_EQ(rows[2].run, "three");
        writeFile(file, whole);
    }
    { ResultFile(folder / "results.1-of-2.jsonl").add(linesOf({exampleRow("four", 0, 5), exampleRow("one", 1, 7)})); }
    const std::vector<ResultRow> rows = readResults(folder);
    EXPECT_EQ(rows.size(), 3u) << "shards' files are read together, and no frame counts twice";

    writeFile(file, "{\"run\": 1}\n" + whole);
    try {
        readResults(folder);
        FAIL() << "a damaged line was taken";
    } catch (const Error& error) {
        EXPECT_EQ(error.problems()[0].where.line, 1);
    }
    EXPECT_TRUE(readResults(folder / "nothing").empty());
}

TEST_F(StudyTest, SummariesCountWhatIsThere) {
    const Study study = loadStudy(
        write(R"({ "format": 1, "about": "a < b", "scenes": ["box.json"], "seeds": 3, "frames": { "warmup": 1, "measure": [0, 1] },
        "size": [10, 5], "reference": { "graph": "graph.json", "spp": 2 },
        "techniques": { "plain": { "graph": "graph.json", "vary": { "a.spp": [2, 4] } } }, "metrics": ["mse"] })"));
    const std::vector<StudyRun> runs = expandRuns(study);
    ASSERT_EQ(runs.size(), 6u);
    std::vector<std::string> names;
    std::vector<ResultRow> rows;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        names.push_back("run " + std::to_string(i));
        if (i == 5) break;  // never made
        rows.push_back(exampleRow(names[i], 0, 1.0 / double(i + 1)));
        if (i != 4) rows.push_back(exampleRow(names[i], 1, 2));  // run 4 was cut between its frames
    }
    rows.push_back(exampleRow("of another graph", 0, 1000));
    EXPECT_EQ(finishedRuns(study, rows), (std::set<std::string>{"run 0", "run 1", "run 2", "run 3"}));
    const Summary summary = summarize(study, runs, names, rows);
    EXPECT_EQ(summary.missing, 2u);
    EXPECT_EQ(summary.foreign, 1u);
    ASSERT_EQ(summary.cells.size(), 4u);  // two knob values, two frames
    EXPECT_EQ(summary.cells[0].seeds, 2);
    EXPECT_NEAR(summary.cells[0].metrics.at("mse").mean, (1 + 1.0 / 3) / 2, 1e-12);
    EXPECT_NEAR(summary.cells[0].metrics.at("mse").halfWidth, 12.7062 * (1 - 1.0 / 3) / 2, 1e-4);
    EXPECT_EQ(summary.cells[0].rays.mean, 150);
    EXPECT_EQ(summary.cells[3].offset, 1);
    EXPECT_NE(summaryText(study, summary).find("plain, spp 4"), std::string::npos);

    const nlohmann::ordered_json json = summaryJson(study, summary);
    EXPECT_EQ(json["missing"], 2);
    EXPECT_EQ(json["about"], "a < b");
    EXPECT_EQ(json["devices"], nlohmann::ordered_json({"a device"}));
    EXPECT_EQ(json["scenes"][0]["size"], nlohmann::ordered_json({10, 5}));
    EXPECT_EQ(json["metrics"][0]["noiseFree"], true);
    ASSERT_EQ(json["cells"].size(), 4u);
    const auto& cell = json["cells"][0];
    EXPECT_EQ(cell["knobs"], (nlohmann::ordered_json{{"a.spp", 2}}));
    EXPECT_EQ(cell["runs"], nlohmann::ordered_json({"run 0", "run 2"})) << "by which rows are found";
    EXPECT_EQ(cell["metrics"]["mse"]["values"], nlohmann::ordered_json({1.0, 1.0 / 3})) << "to the last bit";
    EXPECT_EQ(cell["metrics"]["mse"]["mean"], summary.cells[0].metrics.at("mse").mean);
    EXPECT_EQ(cell["metrics"]["mse"]["halfWidth"], summary.cells[0].metrics.at("mse").halfWidth);
    EXPECT_EQ(cell["passes"]["trace"]["rays"], (nlohmann::ordered_json{{"nee", 50}, {"primary", 100}}));
    EXPECT_EQ(json["cells"][1]["metrics"]["mse"]["againstStart"]["mean"], 3) << "2 and 2 against 1 and 1/3";
    EXPECT_EQ(json["baseline"], "plain");
    ASSERT_EQ(json["sequences"].size(), 2u);
    EXPECT_NEAR(json["sequences"][0]["metrics"]["mse"]["mean"].get<double>(), (1.5 + (1.0 / 3 + 2) / 2) / 2, 1e-12);
}

// If this fails, a technique's gain is told against another configuration, or seeds are mixed up.
TEST_F(StudyTest, PairedSeedsGiveRatiosSeedBySeed) {
    const Study study = loadStudy(write(R"({ "format": 1, "scenes": ["box.json"], "seeds": [7, 9, 12], "paired": true,
        "reference": { "graph": "graph.json", "spp": 2 },
        "techniques": { "plain": { "graph": "graph.json" }, "half": { "graph": "graph.json" } }, "metrics": ["mse"] })"));
    const std::vector<StudyRun> runs = expandRuns(study);
    std::vector<std::string> names;
    std::vector<ResultRow> rows;
    const std::map<std::uint32_t, double> errors{{7, 1.0}, {9, 4.0}, {12, 2.5}};
    for (std::size_t i = 0; i < runs.size(); ++i) {
        names.push_back("run " + std::to_string(i));
        if (runs[i].technique == 0 && runs[i].seed == 9) continue;  // not made yet
        rows.push_back(exampleRow(names[i], 0, errors.at(runs[i].seed) * (runs[i].technique == 0 ? 1 : 0.5)));
        rows.back().seed = runs[i].seed;
    }
    const nlohmann::ordered_json json = summaryJson(study, summarize(study, runs, names, rows));
    ASSERT_EQ(json["comparisons"].size(), 1u);
    const auto& comparison = json["comparisons"][0];
    EXPECT_EQ(comparison["technique"], "half");
    EXPECT_EQ(comparison["baseline"]["technique"], "plain");
    EXPECT_TRUE(comparison["without"].is_null());
    const auto& ratio = comparison["metrics"]["mse"];
    EXPECT_TRUE(ratio["paired"]);
    EXPECT_NEAR(ratio["middle"].get<double>(), 0.5, 1e-12) << "of seeds 7 and 12 alone";
    EXPECT_NEAR(ratio["high"].get<double>() - ratio["low"].get<double>(), 0, 1e-12) << "each seed says the same, however much they differ";
    EXPECT_EQ(comparison["rays"]["middle"], 1);
    EXPECT_EQ(json["cells"][0]["image"], shownImageFile(study, runs[0], "run 0").string());
}

// If this fails, rays a pixel of one size are counted by the pixels of another.
TEST_F(StudyTest, CostsAreToldByPixels) {
    const std::string text =
        R"({ "format": 1, "scenes": ["box.json", "hall.json"], "seeds": 1, "size": [[10, 5], [20, 5]], "reference": { "graph": "graph.json", "spp": 2 },
        "techniques": { "plain": { "graph": "graph.json" } }, "metrics": ["mse"], "charts": ["rays_by_pass"] })";
    const Study study = loadStudy(write(text));
    const std::vector<StudyRun> runs = expandRuns(study);
    std::vector<std::string> names;
    std::vector<ResultRow> rows;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        names.push_back("run " + std::to_string(i));
        rows.push_back(exampleRow(names[i], 0, 1));  // 150 rays
    }
    const nlohmann::ordered_json json = summaryJson(study, summarize(study, runs, names, rows));
    ASSERT_EQ(json["scenes"].size(), 4u);
    EXPECT_EQ(json["scenes"][3]["name"], "hall, 20x5");
    EXPECT_EQ(json["scenes"][3]["file"], "hall") << "sizes of one file are told by this";
    EXPECT_EQ(json["scenes"][3]["size"], nlohmann::ordered_json({20, 5}));
    EXPECT_EQ(json["cells"][3]["scene"], "hall, 20x5");
    EXPECT_EQ(json["cells"][3]["rays"]["mean"], 150);
}

}  // namespace
}  // namespace lodestir
