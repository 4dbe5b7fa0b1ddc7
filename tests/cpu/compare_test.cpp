// SPDX-License-Identifier: MIT
// The command that compares two images: what it prints, and what it refuses.
#include "../temporary_folder.h"
#include "printed.h"

#include <framework/app/commands/commands.h>
#include <framework/core/error.h>
#include <framework/core/files.h>
#include <framework/core/json.h>
#include <framework/image/exr.h>
#include <framework/image/image_file.h>
#include <framework/image/metrics.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace lodestir {
namespace {

class Compare : public test::FolderTest {
protected:
    Compare() {
        writeImage(folder / "x.exr", {2, 1, 3, {1, 2, 3, 4, 4, 4}});
        writeImage(folder / "x4.exr", {2, 1, 4, {1, 2, 3, 0, 4, 4, 4, 0.5f}});
        writeImage(folder / "r.exr", {2, 1, 3, {1, 0, 0.5f, 4, 4, 4}});
    }

    /// Parses and runs; returns what was printed.
    std::string compare(std::vector<std::string> arguments) {
        for (std::string& argument : arguments) {
            if (argument.find('.') != argument.npos && argument[0] != '-' && argument[0] != '0') argument = (folder / argument).string();
        }
        return printed(addCompare, "compare", std::move(arguments));
    }
};

// Scripts read this.
TEST_F(Compare, JsonHasTheMetricsAskedForAndNoOthers) {
    const Json some = Json::parse(compare({"x.exr", "r.exr", "--metrics", "mse,mae", "--json"}), "stdout");
    ASSERT_EQ(some.members().size(), 2u);
    EXPECT_DOUBLE_EQ(some.find("mse")->asNumber(), 10.25 / 6);
    EXPECT_DOUBLE_EQ(some.find("mae")->asNumber(), 4.5 / 6);
    const Json all = Json::parse(compare({"x.exr", "r.exr", "--json"}), "stdout");
    EXPECT_EQ(all.members().size(), metricNames().size());
    EXPECT_NE(all.find("relmse"), nullptr);
    const Json same = Json::parse(compare({"r.exr", "r.exr", "--json", "--metrics", "psnr"}), "stdout");
    EXPECT_TRUE(same.find("psnr")->isNull()) << "JSON has no infinity";
}

TEST_F(Compare, TextIsALineAMetric) {
    EXPECT_EQ(compare({"x.exr", "r.exr", "--metrics", "mse,mae"}), "mse             1.70833\nmae             0.75\n");
    EXPECT_EQ(compare({"r.exr", "r.exr", "--metrics", "psnr"}), "psnr            inf\n");
    EXPECT_EQ(compare({"--metrics", "mae,mse", "x.exr", "r.exr"}), "mae             0.75\nmse             1.70833\n");
}

TEST_F(Compare, OpacityIsNotCompared) {
    EXPECT_EQ(compare({"x4.exr", "r.exr", "--metrics", "mse"}), compare({"x.exr", "r.exr", "--metrics", "mse"}));
}

// If this fails, images that differ in red are called equal: red is the last of a layer's channels by name.
TEST_F(Compare, LayersAreComparedByTheirColours) {
    const std::vector<std::string> names{"View.Combined.R", "View.Combined.G", "View.Combined.B", "View.Combined.A"};
    writeExr(folder / "layer.exr", {1, 1, 4, {0.2f, 0.5f, 0.8f, 1}}, {.channels = names});
    writeExr(folder / "red.exr", {1, 1, 4, {0.3f, 0.5f, 0.8f, 0}}, {.channels = names});
    writeExr(folder / "plain.exr", {1, 1, 3, {0.2f, 0.5f, 0.8f}});
    writeExr(folder / "motion.exr", {1, 1, 2, {1, 2}});
    writeExr(folder / "other.exr", {1, 1, 2, {1, 4}});
    const auto mse = [&](const char* test, const char* reference) {
        return Json::parse(compare({test, reference, "--metrics", "mse", "--json"}), "stdout").find("mse")->asNumber();
    };
    EXPECT_NEAR(mse("red.exr", "layer.exr"), 0.01 / 3, 1e-8);
    EXPECT_EQ(mse("layer.exr", "plain.exr"), 0);
    EXPECT_EQ(mse("motion.exr", "other.exr"), 2) << "the second of two channels is no opacity";
}

TEST_F(Compare, ExposureCanBeFixed) {
    const Json fixed = Json::parse(compare({"x.exr", "r.exr", "--metrics", "relmse", "--json", "--exposure", "1"}), "stdout");
    EXPECT_DOUBLE_EQ(fixed.find("relmse")->asNumber(), 10.25 / 3 / (0.25 + 0.01) / 2);
}

TEST_F(Compare, FlipExposuresCanBeFixed) {
    const ImageData x = readImage(folder / "x.exr"), r = readImage(folder / "r.exr");
    const double expected = evaluate("flip", x, r, {.flip = {.exposures = FlipExposures{-1, 2, 4}}});
    EXPECT_NE(expected, evaluate("flip", x, r));
    const Json fixed = Json::parse(compare({"x.exr", "--flip-exposures", "-1,2,4", "r.exr", "--metrics", "flip", "--json"}), "stdout");
    EXPECT_DOUBLE_EQ(fixed.find("flip")->asNumber(), expected);
    EXPECT_THROW(compare({"x.exr", "r.exr", "--flip-exposures", "-1,2"}), CLI::ParseError);
    EXPECT_THROW(compare({"x.exr", "r.exr", "--flip-exposures", "-1,2,0"}), CLI::ParseError);
}

// The published program means LDR-FLIP where it is given pictures, and HDR-FLIP where it is given radiance.
TEST_F(Compare, FlipIsOfWhatTheFilesHold) {
    const ImageData test{2, 1, 3, {1, 0.5f, 0.25f, 0.1f, 0.2f, 0.3f}}, reference{2, 1, 3, {1, 0.25f, 0.5f, 0.1f, 0.1f, 0.1f}};
    for (const char* ending : {"exr", "png"}) {
        writeImage(folder / (std::string("shown.") + ending), test);
        writeImage(folder / (std::string("wanted.") + ending), reference);
    }
    const ImageData x = readImage(folder / "shown.png"), r = readImage(folder / "wanted.png");
    const auto flip = [&](const char* a, const char* b, std::vector<std::string> more = {}) {
        more.insert(more.begin(), {a, b, "--metrics", "flip", "--json"});
        testing::internal::CaptureStderr();
        const double value = Json::parse(compare(more), "stdout").find("flip")->asNumber();
        return std::pair(value, testing::internal::GetCapturedStderr());
    };
    const double displayed = evaluate("flip_ldr", x, r), radiance = evaluate("flip", test, reference);
    ASSERT_GT(std::abs(displayed - radiance), 0.01);
    const auto pictures = flip("shown.png", "wanted.png"), light = flip("shown.exr", "wanted.exr"), mixed = flip("shown.png", "wanted.exr");
    EXPECT_DOUBLE_EQ(pictures.first, displayed);
    EXPECT_NE(pictures.second.find("flip: LDR-FLIP of pictures as displayed, 67.02 pixels per degree"), std::string::npos) << pictures.second;
    EXPECT_DOUBLE_EQ(light.first, radiance);
    EXPECT_NE(light.second.find("flip: HDR-FLIP of radiance, "), std::string::npos) << light.second;
    EXPECT_DOUBLE_EQ(mixed.first, evaluate("flip", x, reference)) << "one of them holds radiance";
    EXPECT_DOUBLE_EQ(flip("shown.png", "wanted.png", {"--flip-exposures", "-1,1,2"}).first,
                     evaluate("flip", x, r, {.flip = {.exposures = FlipExposures{-1, 1, 2}}}))
        << "who names exposures means HDR-FLIP";
}

TEST_F(Compare, SpacesBetweenMetricsDoNotCount) {
    EXPECT_EQ(compare({"x.exr", "r.exr", "--metrics", "mse, mae"}), compare({"x.exr", "r.exr", "--metrics", "mse,mae"}));
    EXPECT_EQ(compare({"x.exr", "r.exr", "--metrics", " mse ,mae "}), compare({"x.exr", "r.exr", "--metrics", "mse,mae"}));
}

// If this fails, the error map takes the place of what it was made of.
TEST_F(Compare, AMapIsNoneOfTheImages) {
    std::filesystem::create_symlink(folder / "r.exr", folder / "link.exr");
    const std::vector<std::byte> before = readBytes(folder / "r.exr");
    for (const char* map : {"x.exr", "r.exr", "link.exr"}) EXPECT_THROW(compare({"x.exr", "r.exr", "--metrics", "mse", "--map", map}), Error) << map;
    EXPECT_EQ(readBytes(folder / "r.exr"), before);
}

TEST_F(Compare, MapsAreWritten) {
    compare({"x.exr", "r.exr", "--metrics", "mse", "--map", "map.exr"});
    EXPECT_FLOAT_EQ(readImage(folder / "map.exr").at(0, 0, 0), 10.25f / 3);
    testing::internal::CaptureStderr();
    compare({"x.exr", "r.exr", "--metrics", "mse", "--map", "map.png", "--map-top", "2"});
    EXPECT_EQ(testing::internal::GetCapturedStderr(),
              (folder / "map.png").string() + ": mse per pixel, black is 0, pale yellow is 2 and more\n");
    EXPECT_GT(readImage(folder / "map.png").at(0, 0, 1), 0.9f);
    EXPECT_THROW(compare({"x.exr", "r.exr", "--map", "map.jpg"}), CLI::ParseError);
}

TEST_F(Compare, SequencesAreMeansOverFramesAndSteps) {
    for (int t = 0; t < 3; ++t) {
        writeImage(folder / ("s." + std::to_string(t) + ".exr"), {1, 1, 3, {1.0f + float(t), 1.0f + float(t), 1.0f + float(t)}});
        writeImage(folder / ("q." + std::to_string(t) + ".exr"), {1, 1, 3, {1, 1, 1}});
    }
    const auto value = [&](std::vector<std::string> arguments, const char* metric) {
        arguments.insert(arguments.end(), {"--json", "--exposure", "1"});
        const Json json = Json::parse(compare(std::move(arguments)), "stdout");
        return json.find(metric)->asNumber();
    };
    EXPECT_DOUBLE_EQ(value({"s.%d.exr", "q.%d.exr", "--metrics", "mse"}, "mse"), (0 + 1 + 4) / 3.0);
    const double e1 = std::log2(1.5), e2 = 1;  // of brightness log2(1 + Y), against 1
    EXPECT_NEAR(value({"s.%d.exr", "q.%d.exr"}, "flicker_uncorrelated"), (e1 * e1 + (e2 - e1) * (e2 - e1)) / 4, 1e-6);
    EXPECT_NEAR(value({"s.%d.exr", "q.%d.exr"}, "flicker_correlated"), (0 + e1 * e2) / 2, 1e-6);
    EXPECT_NEAR(value({"s.%d.exr", "q.0.exr", "--metrics", "flicker_correlated"}, "flicker_correlated"), (0 + e1 * e2) / 2, 1e-6)
        << "one image stands for a reference that is still";
    // A step needs two frames in a row.
    std::filesystem::remove(folder / "s.1.exr");
    EXPECT_DOUBLE_EQ(value({"s.%d.exr", "q.%d.exr", "--metrics", "mse"}, "mse"), 2);
    EXPECT_THROW(compare({"s.%d.exr", "q.%d.exr", "--metrics", "tflip"}), Error);
    std::filesystem::remove(folder / "q.2.exr");
    EXPECT_THROW(compare({"s.%d.exr", "q.%d.exr", "--metrics", "mse"}), Error) << "frame 2 has no reference";
    EXPECT_THROW(compare({"x.exr", "r.exr", "--metrics", "tflip"}), Error);
    EXPECT_THROW(compare({"x.exr", "q.%d.exr"}), Error);
}

TEST_F(Compare, WrongUseAndWrongFiles) {
    EXPECT_THROW(compare({"x.exr"}), CLI::ParseError);
    EXPECT_THROW(compare({"x.exr", "none.exr"}), Error);
    try {
        compare({"x.exr", "r.exr", "--metrics", "relsme"});
        FAIL() << "an unknown metric is wrong use";
    } catch (const CLI::ParseError& error) {
        EXPECT_NE(std::string(error.what()).find("did you mean \"relmse\"?"), std::string::npos) << error.what();
    }
    const std::vector<std::vector<std::string>> wrong{
        {"--exposure", "0"},      {"--exposure", "nan"},      {"--exposure", "inf"}, {"--map-top", "-1"}, {"--map", ""}, {"--map", "map.jpg"},
        {"--flip-exposures", "0,1,0"}, {"--flip-exposures", "0,1,1000000000"}, {"--flip-exposures", "0,1,nan"}, {"--flip-exposures", "0,1,1.5"}};
    for (std::vector<std::string> arguments : wrong) {
        arguments.insert(arguments.begin(), {"x.exr", "r.exr"});
        EXPECT_THROW(compare(arguments), CLI::ParseError) << arguments[2] << " " << arguments[3];
    }
}

}  // namespace
}  // namespace lodestir
