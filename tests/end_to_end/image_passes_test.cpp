// SPDX-License-Identifier: MIT
// image_loader gives what is in the file; image_error gives what the metrics of `lodestir compare` are means of.
#include "frames.h"
#include "program.h"

#include <framework/core/error.h>
#include <framework/image/color_map.h>
#include <framework/image/image_file.h>
#include <framework/image/metrics.h>

#include <array>

namespace lodestir::test {
namespace {

constexpr glm::uvec2 size{40, 24};

class ImagePasses : public ProgramTest {
protected:
    /// A file of values that have no short name, some of them negative or above 1.
    Path picture(const std::string& name, int channels, float shift = 0) {
        ImageData image = makeImage(int(size.x), int(size.y), channels);
        for (std::size_t i = 0; i < image.values.size(); ++i) image.values[i] = std::sin(0.37f * float(i) + shift) * 1.5f + 0.8f;
        writeImage(folder / name, image);
        return folder / name;
    }
    static OrderedJson loader(const Path& file, bool resample = false) {
        return {{"load", {{"type", "image_loader"}, {"set", {{"file", file.string()}, {"resample", resample}}}}}};
    }
    /// What a graph file with this loader, beside the file, is refused with.
    std::string refusal(const OrderedJson& set, const Arguments& more = {"--size", "40x24"}) {
        write("graph.json", {{"format", 1},
                             {"scene", sceneFile("cornell").string()},
                             {"passes", {{"load", {{"type", "image_loader"}, {"set", set}}}}},
                             {"show", "load"}});
        Arguments arguments{"run", (folder / "graph.json").string(), "--out", (folder / "out").string()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Output output = lodestir(arguments);
        EXPECT_EQ(output.exitCode, 1) << output.err;
        const bool started = output.err.starts_with("device ");  // what is used was said before
        const std::string message = started ? output.err.substr(output.err.find('\n') + 1) : output.err;
        EXPECT_EQ(std::ranges::count(message, '\n'), 1) << "one message: " << message;
        EXPECT_TRUE(filesOf(folder / "out").empty());
        return message;
    }
};

TEST_F(ImagePasses, LoaderGivesWhatIsInTheFile) {
    const Path color = picture("color.exr", 3), opaque = picture("opaque.exr", 4, 1), gray = picture("gray.exr", 1, 2),
               png = picture("shown.png", 3);
    Frames frames(sceneFile("cornell"), size, loader(color), {"load.image"});
    for (const Path& file : {color, opaque, gray, png}) {
        frames.set("load.file", Json(file.string()));
        frames.run(2);
        const ImageData expected = readImage(file), found = frames.image("load.image");
        ASSERT_EQ(found.channels, 4);
        for (int y = 0; y < found.height; ++y)
            for (int x = 0; x < found.width; ++x)
                for (int c = 0; c < 4; ++c)
                    ASSERT_EQ(found.at(x, y, c),
                              c == 3 && expected.channels < 4 ? 1 : expected.at(x, y, std::min(c, expected.channels - 1)))
                        << file << " " << x << ", " << y << ", " << c;
    }
    // It looks at the file once, however often the graph runs.
    picture("shown.png", 3, 3);
    const ImageData before = frames.image("load.image");
    frames.run();
    EXPECT_EQ(frames.image("load.image").values, before.values);
}

TEST_F(ImagePasses, LoaderStretchesWhereAskedTo) {
    writeImage(folder / "two.exr", {2, 1, 3, {0, 0, 0, 1, 2, 4}});
    Frames frames(sceneFile("cornell"), {4, 2}, loader(folder / "two.exr", true), {"load.image"});
    frames.run();
    const ImageData found = frames.image("load.image");
    constexpr std::array shares{0.0f, 0.25f, 0.75f, 1.0f};
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 4; ++x)
            for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(found.at(x, y, c), shares[std::size_t(x)] * float(1 << c)) << x << ", " << y;
}

TEST_F(ImagePasses, LoaderFindsFilesBesideTheGraph) {
    std::filesystem::create_directories(folder / "pictures");
    picture("pictures/a.exr", 3);
    write("graph.json", {{"format", 1},
                         {"scene", sceneFile("cornell").string()},
                         {"passes", {{"load", {{"type", "image_loader"}, {"set", {{"file", "pictures/a.exr"}}}}}}},
                         {"show", "load"}});
    const Path out = run("out", folder / "graph.json", {"--size", "40x24"});
    EXPECT_EQ(firstChannels(readExr(out / "load.0.exr"), 3).values, readExr(folder / "pictures/a.exr").values);
    // What was run says which file that was, and the command line may name another.
    EXPECT_EQ(readJson(out / "run.json")["graph"]["passes"]["load"]["set"]["file"], (folder / "pictures/a.exr").string());
    const Path b = picture("b.exr", 3, 1);
    EXPECT_EQ(firstChannels(
                  readExr(run("other", folder / "graph.json", {"--size", "40x24", "--set", "load.file=" + b.string()}) / "load.0.exr"), 3)
                  .values,
              readExr(b).values);
}

// Paths in a study start from its folder, wherever the graphs lie.
TEST_F(ImagePasses, StudiesNameFilesToo) {
    writeImage(folder / "studies/black.exr", makeImage(40, 24, 3));
    write("graph.json",
          {{"format", 1}, {"scene", sceneFile("cornell").string()}, {"passes", {{"load", {{"type", "image_loader"}}}}}, {"show", "load"}});
    const std::string tracer = (sourceFolder / "graphs/path_tracer.json").string();
    write("studies/black.json", {{"format", 1},
                                 {"scenes", {sceneFile("cornell").string()}},
                                 {"size", {40, 24}},
                                 {"seeds", 1},
                                 {"reference", {{"graph", tracer}, {"spp", 4}}},
                                 {"techniques", {{"nothing", {{"graph", "../graph.json"}, {"set", {{"load.file", "black.exr"}}}}}}},
                                 {"metrics", {"bias"}}});
    const Output output = lodestir({"study", (folder / "studies/black.json").string(), "--out", (folder / "out").string()});
    ASSERT_EQ(output.exitCode, 0) << output.err;
    EXPECT_NEAR(OrderedJson::parse(readText(folder / "out/results.jsonl"))["metrics"]["bias"].get<double>(), -1, 1e-9);
}

TEST_F(ImagePasses, LoaderSaysWhatIsWrongWithAFile) {
    writeFile(folder / "broken.exr", readText(picture("whole.exr", 3)).substr(0, 400));
    writeFile(folder / "text.png", std::string_view("no image"));
    const std::string at = (folder / "graph.json").string();
    EXPECT_NE(refusal({{"file", "none.exr"}}).find("\"file\": there is no file " + (folder / "none.exr").string()), std::string::npos);
    EXPECT_TRUE(refusal({{"file", "none.exr"}}).starts_with(at + ":")) << "with line and column";
    EXPECT_NE(refusal({{"file", "broken.exr"}}).find((folder / "broken.exr").string()), std::string::npos);
    EXPECT_NE(refusal({{"file", "text.png"}}).find("is not an image that this program reads"), std::string::npos);
    EXPECT_NE(refusal({{"file", "whole.exr"}}, {"--size", "20x24"}).find("has 40 x 24 pixels, the frame 20 x 24; render with --size 40x24"),
              std::string::npos);
    EXPECT_NE(refusal(OrderedJson::object()).find("has no file to load"), std::string::npos);
    EXPECT_NE(refusal({{"file", "whole.exr"}}, {"--set", "load.file=gone.exr"}).find("gone.exr"), std::string::npos);
}

// The albedo against black is an error that sticks to what is seen. If this fails, flicker follows motion the wrong way.
TEST_F(ImagePasses, FlickerFollowsTheMotionOfVisibility) {
    const OrderedJson passes = {
        {"hits", {{"type", "visibility"}, {"in", {{"worldPrev", "scene.world@prev"}}}, {"set", {{"film", "centre"}, {"lens", false}}}}}};
    write("graph.json", {{"format", 1}, {"scene", sceneFile("ensemble_moving").string()}, {"passes", passes}, {"show", "hits.albedo"}});
    const Path out = run("out", folder / "graph.json", {"--size", "320x180", "--frames", "4", "--dump", "hits.motion"});
    writeExr(folder / "black.exr", makeImage(320, 180, 3));
    for (int frame = 0; frame < 4; ++frame) {
        ImageData motion = readExr(out / ("hits.motion." + std::to_string(frame) + ".exr"));
        for (float& pixels : motion.values) pixels = -pixels;
        writeExr(folder / ("against." + std::to_string(frame) + ".exr"), motion);
    }
    const auto flicker = [&](const Path& motion) {
        Arguments arguments{
            "compare", (out / "hits.albedo.%d.exr").string(), (folder / "black.exr").string(), "--metrics", "flicker_uncorrelated",
            "--json"};
        if (!motion.empty()) arguments.insert(arguments.end(), {"--motion", motion.string()});
        const Output output = lodestir(arguments);
        EXPECT_EQ(output.exitCode, 0) << output.err;
        return OrderedJson::parse(output.out)["flicker_uncorrelated"].get<double>();
    };
    const double along = flicker(out / "hits.motion.%d.exr"), inPlace = flicker({});
    EXPECT_LT(along, 0.7 * inPlace) << "what is left is edges and what comes into sight";
    EXPECT_GT(flicker(folder / "against.%d.exr"), 1.2 * inPlace);
}

// If this fails, the error that is looked at is not the one that is measured.
TEST_F(ImagePasses, ErrorsHaveTheMeansOfTheMetrics) {
    const OrderedJson passes = {{"test", {{"type", "path_tracer"}, {"set", {{"spp", 2}}}}},
                                {"reference", {{"type", "path_tracer"}, {"set", {{"spp", 32}, {"bounces", 2}}}}},
                                {"error", {{"type", "image_error"}, {"in", {{"test", "test"}, {"reference", "reference"}}}}}};
    Frames frames(sceneFile("cornell"), {96, 64}, passes, {"error.error", "error.colors", "test.color", "reference.color"});
    for (const double exposure : {1.0, 0.3}) {
        for (const char* metric : {"mse", "mae", "relmse", "mape", "smape"}) {
            SCOPED_TRACE(metric);
            frames.set("error.metric", Json(metric));
            frames.set("error.exposure", Json(exposure));
            frames.set("error.top", Json(0.5));
            frames.restart(0);
            frames.run();
            const ImageData test = firstChannels(frames.image("test.color"), 3),
                            reference = firstChannels(frames.image("reference.color"), 3);
            const MetricOptions how{.exposure = double(float(exposure))};
            const ImageData expected = errorMap(metric, test, reference, how), found = frames.image("error.error");
            for (std::size_t i = 0; i < expected.values.size(); ++i)
                ASSERT_NEAR(found.values[i], expected.values[i], 1e-5f * (1e-3f + expected.values[i])) << i;
            const double mean = evaluate(metric, test, reference, how);
            EXPECT_GT(mean, 1e-4);
            EXPECT_NEAR(meanOf(found), mean, 1e-6 * mean);
            const ImageData colors = colorMap(found, 0.5), shown = firstChannels(frames.image("error.colors"), 3);
            for (std::size_t i = 0; i < colors.values.size(); ++i) ASSERT_NEAR(shown.values[i], colors.values[i], 2e-4f) << i;
        }
    }
}

TEST_F(ImagePasses, ErrorsOfAnImageAgainstItsFileAreNone) {
    const Path reference =
        run("first", sourceFolder / "passes/basic/tone_map/tone_map.json", {"--size", "40x24", "--show", "trace.color"}) / "trace.color.0.exr";
    const OrderedJson passes = {{"trace", {{"type", "path_tracer"}, {"set", {{"spp", 4}}}}},
                                {"load", {{"type", "image_loader"}, {"set", {{"file", reference.string()}}}}},
                                {"error", {{"type", "image_error"}, {"in", {{"test", "trace"}, {"reference", "load"}}}}}};
    Frames frames(sceneFile("material_spheres"), size, passes, {"error.error"});
    frames.run();
    EXPECT_EQ(sumOf(frames.image("error.error")), 0) << "the same seed, the same picture";
    frames.run();
    EXPECT_GT(sumOf(frames.image("error.error")), 0);
}

}  // namespace
}  // namespace lodestir::test
