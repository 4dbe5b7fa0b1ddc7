// SPDX-License-Identifier: MIT
// What lives from frame to frame while a graph runs: @prev, State, cadence, reset, cuts, restarts. Small passes with known answers.
#include <framework/core/files.h>
#include <framework/graph/runner.h>
#include <framework/scene/scene.h>

#include <gtest/gtest.h>

#include <unistd.h>

namespace lodestir::test {
namespace {

/// next = last + step, where last is wired to next@prev.
struct Feedback final : Pass {
    In<Image>    last{this, "last", "last frame's number"};
    Out<Image>   next{this, "next", "one more", Format::r32f};
    Param<float> step{this, "step", 1.0f, {0, 100}, "what is added"};
};
/// Counts its runs in a State.
struct Counter final : Pass {
    State<Image> runs{this, "runs", "number of runs since the last clearing", Format::r32f};
    Out<Image>   copy{this, "copy", "the same", Format::r32f};
    Param<bool>  flag{this, "flag", false, "does nothing"};
};
/// The same, but cleared whenever anything changes.
struct Restart final : Pass {
    State<Image> runs{this, "runs", "number of runs since the last clearing", Format::r32f};
    Out<Image>   copy{this, "copy", "the same", Format::r32f};
    Restart() { restartOnChange = true; }
};
/// Runs only when its parameter changes; its State tells how often.
struct Bake final : Pass {
    State<Image> runs{this, "runs", "number of runs since the last clearing", Format::r32f};
    Out<Image>   copy{this, "copy", "the same", Format::r32f};
    Param<int>   quality{this, "quality", 1, {1, 9}, "what it depends on"};
    Bake() { cadence = Cadence::onChange; }
};

/// All pixels count in one element of a buffer.
struct Tally final : Pass {
    Scratch<Buffer<uint>> counts{this, "counts", "what is counted in", Count::fixed(2)};
    Out<Image>            copy{this, "copy", "the second count", Format::r32f};
    Param<int>            at{this, "at", 1, {0, 9}, "which element"};

    void execute(Frame& frame) override {
        frame.fill(counts, 0);
        frame.dispatch("tally.comp", frame.size());
        frame.dispatch(shader, frame.size());
    }
};

constexpr const char* tallyShader = R"(#version 460
#include "pass.glsl"
void main() {
    if (skip()) return;
    addCounts(uint(params.at), 2u);
})";
constexpr const char* tallyCopyShader = R"(#version 460
#include "pass.glsl"
void main() {
    if (skip()) return;
    storeCopy(pixel(), float(counts(1u)));
})";
constexpr const char* countShader = R"(#version 460
#include "pass.glsl"
void main() {
    if (skip()) return;
    ivec2 p = pixel();
    float n = runs(p) + 1;
    storeRuns(p, n);
    storeCopy(p, n);
})";
constexpr const char* feedbackShader = R"(#version 460
#include "pass.glsl"
void main() {
    if (skip()) return;
    ivec2 p = pixel();
    storeNext(p, last(p) + params.step);
})";

class RunnerTest : public testing::Test {
protected:
    RunnerTest() : folder(std::filesystem::temp_directory_path() / ("lodestir_runner_test_" + std::to_string(::getpid()))),
                   source((folder / "passes.cpp").string()) {
        writeFile(folder / "count.comp", std::string_view(countShader));
        writeFile(folder / "feedback.comp", std::string_view(feedbackShader));
        add<Feedback>("feedback", "feedback.comp");
        add<Counter>("count", "count.comp");
        add<Restart>("restart", "count.comp");
        add<Bake>("bake", "count.comp");
        writeFile(folder / "tally.comp", std::string_view(tallyShader));
        writeFile(folder / "tally_copy.comp", std::string_view(tallyCopyShader));
        add<Tally>("tally", "tally_copy.comp");
    }
    ~RunnerTest() override { std::filesystem::remove_all(folder); }

    template <class T> void add(const std::string& type, const char* shader) {
        libraries.addBuiltIn(type,
                             Plugin{frameworkAbi().data(), "Test", shader, "A pass of this test.", source.c_str(), []() -> Pass* { return new T; }, nullptr});
    }
    void start(const std::string& passes, const std::string& show) {
        const std::string text = R"({"format": 1, "frame": {"size": [20, 12]}, "passes": {)" + passes + R"(}, "show": ")" + show + "\"}";
        graph = std::make_unique<Graph>(buildGraph(readDescription(Json::parse(text, "test.json"), "test.json"), libraries));
        runner = std::make_unique<Runner>(device, *graph, scene, RunnerOptions{.rays = chooseRayBody(device.facts(), ""), .checkBounds = true});
    }
    /// Runs a frame; the shown image must hold one value everywhere, which is returned.
    float frame() {
        runner->run();
        const ImageData image = runner->readImage(graph->show);
        EXPECT_EQ(image.width, 20);
        for (float value : image.values) EXPECT_EQ(value, image.values[0]);
        return image.values[0];
    }

    Path folder;
    std::string source;  ///< shaders are found beside it
    gpu::Device device;
    PluginLibraries libraries;
    Scene scene;
    std::unique_ptr<Graph> graph;
    std::unique_ptr<Runner> runner;
};

constexpr const char* loop = R"("f": {"type": "feedback", "in": {"last": "f.next@prev"}})";

}  // namespace

// A loop that reads the value of two frames ago, or this frame's, would not count 1, 2, 3.
TEST_F(RunnerTest, PrevIsLastFramesValue) {
    start(loop, "f.next");
    for (int i = 1; i <= 5; ++i) EXPECT_EQ(frame(), float(i));
}

TEST_F(RunnerTest, ResetResizeAndCutClearHistory) {
    scene.cuts = {6};
    start(loop, "f.next");
    frame();
    EXPECT_EQ(frame(), 2);
    runner->reset();
    EXPECT_EQ(frame(), 1);
    EXPECT_EQ(frame(), 2);
    EXPECT_EQ(frame(), 3);
    EXPECT_EQ(frame(), 4);
    EXPECT_EQ(frame(), 1) << "frame 6 is a cut";
    frame();
    runner->resize({20, 9});
    EXPECT_EQ(frame(), 1);
}

TEST_F(RunnerTest, BuffersOfUintAreCountedIn) {
    start(R"("t": {"type": "tally"})", "t.copy");
    EXPECT_EQ(frame(), 2 * 20 * 12);
    setParameter(*graph, "t.at", Json(2));
    try {
        runner->run();
        FAIL() << "counted outside of the buffer";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("240 accesses outside a port; the first: port \"counts\" at (2, 0)"), std::string::npos) << error.what();
    }
}

// A parameter changes what is added, never what was kept.
TEST_F(RunnerTest, ParametersTakeEffectAndLeaveHistoryAlone) {
    start(loop, "f.next");
    frame();
    EXPECT_TRUE(setParameter(*graph, "f.step", Json(10)));
    EXPECT_EQ(frame(), 11);
    EXPECT_FALSE(setParameter(*graph, "f.step", Json(10))) << "that is no change";
}

TEST_F(RunnerTest, StateLastsAndOnlyRestartsWhereThatIsDeclared) {
    start(R"("c": {"type": "count"}, "r": {"type": "restart"})", "r.copy");
    const Source count = findSource(*graph, "c.copy");
    runner = std::make_unique<Runner>(device, *graph, scene, RunnerOptions{.rays = chooseRayBody(device.facts(), ""), .pinned = {count}});
    frame();
    EXPECT_EQ(frame(), 2);
    setParameter(*graph, "c.flag", Json(true));
    EXPECT_EQ(frame(), 1) << "a parameter of another pass changed";
    EXPECT_EQ(runner->readImage(count).values[0], 3);
    EXPECT_EQ(frame(), 2);
}

TEST_F(RunnerTest, OnChangePassesRunWhenSomethingChanged) {
    start(R"("b": {"type": "bake"})", "b.copy");
    EXPECT_EQ(frame(), 1);
    EXPECT_EQ(frame(), 1);
    setParameter(*graph, "b.quality", Json(5));
    EXPECT_EQ(frame(), 2);
    const FrameReport idle = runner->run();
    ASSERT_EQ(idle.passes.size(), 1u);
    EXPECT_FALSE(idle.passes[0].ran);
    EXPECT_TRUE(idle.passes[0].setup);
}

TEST_F(RunnerTest, NoValidationMessages) {
    start(loop, "f.next");
    frame();
    EXPECT_TRUE(device.validationMessages().empty());
}

}  // namespace lodestir::test
