// SPDX-License-Identifier: MIT
// Variable rate tracing: what is traced, in which order, what becomes of pixels that aren't, and that their images have the right mean.
#include "shift_session.h"

#include <framework/shaders/world/primary_hit.h>
#include <framework/study/ensemble/ensemble.h>
#include <passes/rate/trace_rate.h>


namespace lodestir::test {
namespace {

/// Nodes of graphs/variable_rate.json with a merge patch.
OrderedJson nodes(const OrderedJson& patch = OrderedJson::object()) {
    OrderedJson passes = OrderedJson::parse(readText(sourceFolder / "graphs/variable_rate.json"))["passes"];
    passes.merge_patch(patch);
    passes.erase("display");
    return passes;
}
OrderedJson rateSet(const OrderedJson& set) { return {{"rate", {{"set", set}}}}; }

bool traced(const std::vector<TraceRate>& rates, std::size_t i) { return rates[i].source == i; }

bool isFinite(const Reservoir& r) {
    const float confidence = confidenceOf(r);
    return std::isfinite(r.W + confidence) && (r.W == 0 || std::isfinite(r.F.x + r.F.y + r.F.z + r.G + r.radiance.x + r.radiance.y + r.radiance.z));
}

// If this fails, a graph with rates is another technique even where every pixel is traced.
TEST(VariableRate, AtFullRateNothingChanges) {
    const glm::uvec2 size(45, 19);
    const auto frames = [&](const OrderedJson& patch) {
        Frames session(sceneFile("ensemble_moving"), size, nodes(patch), {"spatial.paths.reservoirs", "spatial.paths.samples", "shade.color"});
        session.restart(5);
        session.run(4);
        return std::tuple(session.records<std::array<std::uint32_t, 16>>("spatial.paths.reservoirs"),
                          session.records<std::array<std::uint32_t, 16>>("spatial.paths.samples"), session.image("shade.color").values);
    };
    const auto plain = frames({{"rate", nullptr}, {"initial", {{"in", {{"rates", nullptr}}}}}});
    for (const char* skipped : {"absent", "roulette", "copy"})
        EXPECT_TRUE(frames({{"rate", {{"set", {{"budget", 1}}}}}, {"initial", {{"set", {{"skipped", skipped}}}}}}) == plain) << skipped;
}

// If this fails, the order of pixels isn't one, or what is traced hangs on who walks it.
TEST(VariableRate, CompactionChangesNothing) {
    for (const glm::uvec2 size : {glm::uvec2(45, 19), glm::uvec2(70, 1)}) {
        Frames frames(sceneFile("ensemble_glossy"), size, nodes(rateSet({{"budget", 0.4}, {"coarsest", "4x4"}, {"tile", "8x8"}})),
                      {"initial.paths.reservoirs", "rate.rates.pixels", "rate.rates.order"});
        std::array<std::vector<std::array<std::uint32_t, 16>>, 2> paths;
        for (const bool compacted : {false, true}) {
            frames.set("initial.compaction", Json(compacted));
            frames.restart(0);
            frames.run(3);
            paths[compacted] = frames.records<std::array<std::uint32_t, 16>>("initial.paths.reservoirs");
        }
        EXPECT_TRUE(paths[0] == paths[1]);
        const auto rates = frames.records<TraceRate>("rate.rates.pixels");
        const auto order = frames.records<std::uint32_t>("rate.rates.order");
        std::vector<std::uint32_t> sorted = order;
        std::ranges::sort(sorted);
        int changes = 0;
        for (std::size_t i = 0; i < sorted.size(); ++i) {
            EXPECT_EQ(sorted[i], i);
            changes += i > 0 && traced(rates, order[i]) != traced(rates, order[i - 1]);
        }
        const auto tiles = int((size.x + 15) / 16 * ((size.y + 15) / 16));
        EXPECT_LE(changes, 2 * tiles - 1) << "traced pixels come first in each tile";
        EXPECT_GT(changes, 0);
    }
}

// What roulette makes of a pixel without reuse is the full rate's estimate over q, with chance q, else nothing: so its mean is the full rate's and its
// variance (sigma^2 + mu^2) / q - mu^2. Given the estimates x, the sums of x^2 over q with and without the coin have a difference of known variance.
TEST(VariableRate, RouletteHasTheMeanAndVarianceOfItsChance) {
    const glm::uvec2 size(64, 36);
    const auto session = [&](double share, bool random) {
        OrderedJson patch = OrderedJson::parse(R"({"temporal": {"off": true}, "spatial": {"off": true}, "shade": {"in": {"color": null}}})");
        patch["rate"]["set"] = {{"budget", share}, {"choice", random ? "random" : "cycle"}};
        patch["initial"]["set"]["skipped"] = "roulette";
        return std::make_unique<Frames>(sceneFile("ensemble_diffuse"), size, nodes(patch),
                                        std::vector<std::string>{"initial.paths.reservoirs", "rate.rates.pixels"});
    };
    const auto full = session(1, true);
    for (const bool random : {false, true}) {
        const auto some = session(0.25, random);
        full->restart(0);
        full->run();
        some->restart(0);
        some->run();
        double mean = 0, meanVariance = 0, square = 0, squareVariance = 0, chosen = 0, free = 0;
        for (int frame = 0; frame < 24; ++frame) {
            full->run();
            some->run();
            const auto all = full->records<Reservoir>("initial.paths.reservoirs"), few = some->records<Reservoir>("initial.paths.reservoirs");
            const auto rates = some->records<TraceRate>("rate.rates.pixels");
            for (std::size_t i = 0; i < all.size(); ++i) {
                const double q = rates[i].chance;
                EXPECT_TRUE(q == 1 || q == 0.25);
                EXPECT_EQ(confidenceOf(few[i]), 1);
                EXPECT_NEAR(few[i].W * q, traced(rates, i) ? all[i].W : 0, 1e-6 * all[i].W);
                if (q == 1) continue;
                const double x = all[i].W > 0 ? double(all[i].W) * (0.2126 * all[i].F.x + 0.7152 * all[i].F.y + 0.0722 * all[i].F.z) : 0;
                const double coin = traced(rates, i) ? 1 : 0;
                chosen += coin;
                ++free;
                mean += x * (coin / q - 1);
                meanVariance += x * x * (1 - q) / q;
                square += x * x * (coin / q - 1) / q;
                squareVariance += x * x * x * x * (1 - q) / (q * q * q);
            }
        }
        ASSERT_GT(free, 10000);
        EXPECT_NEAR(chosen / free, 0.25, 4 * std::sqrt(0.25 * 0.75 / free));
        EXPECT_LT(std::abs(mean), 4 * std::sqrt(meanVariance));
        EXPECT_LT(std::abs(square), 4 * std::sqrt(squareVariance));
    }
}

// If this fails, more or fewer paths are traced than the budget says, or some pixel waits for ever.
TEST(VariableRate, BudgetIsMetAndEachPixelHasItsTurn) {
    const glm::uvec2 size(150, 70);
    OrderedJson passes = nodes(rateSet({{"manner", "budget"}, {"choice", "random"}}));
    for (const char* pass : {"initial", "temporal", "spatial", "shade"}) passes.erase(pass);
    Frames frames(sceneFile("ensemble_glossy"), size, passes, {"rate.rates.pixels"});
    for (const auto& [budget, coarsest] : {std::pair(0.35, "2x2"), std::pair(0.6, "2x2"), std::pair(0.3, "4x4")})
        for (const char* tile : {"2x2", "8x8", "16x16"}) {
            frames.set("rate.budget", Json(budget));
            frames.set("rate.coarsest", Json(coarsest));
            frames.set("rate.tile", Json(tile));
            frames.restart(0);
            frames.run();
            const std::size_t pixels = frames.records<TraceRate>("rate.rates.pixels").size();
            std::vector<int> waited(pixels, 0);
            double sum = 0;
            int most = 0;
            constexpr int count = 100;
            for (int frame = 0; frame < count; ++frame) {
                frames.run();
                const auto rates = frames.records<TraceRate>("rate.rates.pixels");
                for (std::size_t i = 0; i < pixels; ++i) {
                    sum += traced(rates, i);
                    waited[i] = traced(rates, i) ? 0 : waited[i] + 1;
                    most = std::max(most, waited[i]);
                    ASSERT_LT(rates[i].source, pixels);
                    ASSERT_TRUE(traced(rates, rates[i].source)) << "what stands for a block is traced";
                }
            }
            EXPECT_NEAR(sum / (count * double(pixels)), budget, 0.02 * budget) << tile << " " << coarsest;
            EXPECT_LT(most, 16);
        }
}

// If this fails, a rate hangs on one frame alone, or a frame's rate isn't the next one's where rates are computed after tracing. Nothing moves and guides see
// surfaces alone, so that each frame decides the same.
TEST(VariableRate, TheFinestOfFourFramesCounts) {
    OrderedJson passes = nodes(rateSet({{"manner", "quality"}, {"tile", "8x8"}, {"forced", false}}));
    for (const char* pass : {"initial", "temporal", "spatial", "shade"}) passes.erase(pass);
    Frames frames(sceneFile("ensemble_diffuse"), {128, 72}, passes, {"rate.rates.pixels"});
    const auto chances = [&](const char* manner, int memory, int frame) {
        frames.set("rate.manner", Json(manner));
        frames.set("rate.memoryFrames", Json(memory));
        frames.restart(0);
        frames.run(frame + 1);
        std::vector<float> values;
        for (const TraceRate& rate : frames.records<TraceRate>("rate.rates.pixels")) values.push_back(rate.chance);
        return values;
    };
    const std::vector<float> decided = chances("quality", 1, 0), all(decided.size(), 1.0f);
    EXPECT_GT(std::ranges::count(decided, 1.0f), 100);
    EXPECT_GT(std::ranges::count(decided, 0.25f), 100);
    EXPECT_TRUE(chances("quality", 1, 3) == decided);
    EXPECT_TRUE(chances("quality", 4, 2) == all) << "of the frame before the first nothing is known";
    EXPECT_TRUE(chances("quality", 4, 3) == decided);
    EXPECT_TRUE(chances("after", 1, 0) == all);
    EXPECT_TRUE(chances("after", 1, 1) == decided);
    EXPECT_TRUE(chances("after", 4, 3) == all);
    EXPECT_TRUE(chances("after", 4, 4) == decided);
}

// If this fails, pixels wait for reuse that nothing can be reused for: what has come into sight, another level, a mirror.
TEST(VariableRate, WhatNothingElseCouldFillIsTraced) {
    OrderedJson passes = nodes(rateSet({{"manner", "uniform"}, {"budget", 0.25}, {"choice", "random"}}));
    for (const char* pass : {"initial", "temporal", "spatial", "shade"}) passes.erase(pass);
    const glm::uvec2 size(64, 36);
    const auto share = [&](Frames& frames, const auto& isAsked) {  // of the pixels that are asked for, those that had to be traced and were
        const auto rates = frames.records<TraceRate>("rate.rates.pixels");
        int asked = 0, good = 0;
        for (std::size_t i = 0; i < rates.size(); ++i) {
            if (!isAsked(i)) continue;
            ++asked;
            good += rates[i].chance == 1 && traced(rates, i);
        }
        EXPECT_GT(asked, 20);
        EXPECT_LT(good, int(rates.size())) << "not simply all";
        return good / double(asked);
    };
    const auto instanceOf = [](Frames& frames) { return frames.records<PrimaryHit>("hits.hits"); };
    passes["lod"] = {{"type", "lod_select"}};
    passes["hits"]["in"]["worldPrev"] = "lod@prev";
    Frames cube(sceneFile("cube"), size, passes, {"rate.rates.pixels", "hits.hits"});
    cube.restart(38);
    for (const int frame : {38, 39, 40}) {
        cube.run();
        const auto hits = instanceOf(cube);
        const std::uint32_t instance = hits[size.x * (size.y / 2) + size.x / 2].instance;
        const double found = share(cube, [&](std::size_t i) { return hits[i].primitive != NONE && hits[i].instance == instance; });
        if (frame == 39) EXPECT_LT(found, 0.8) << "no switch yet";
        else EXPECT_EQ(found, 1) << frame;
    }
    passes.erase("lod");
    passes["hits"]["in"]["worldPrev"] = "scene@prev";
    const glm::uvec2 wide(96, 54);
    Frames moving(sceneFile("colonnade"), wide, passes, {"rate.rates.pixels", "hits.motion"});
    moving.restart(38);
    moving.run(3);
    const ImageData motion = moving.image("hits.motion");
    const auto comesIn = [&](std::size_t i) {
        const int x = int(i % wide.x), y = int(i / wide.x);
        const double fromX = std::floor(x + 0.5 + motion.at(x, y, 0)), fromY = std::floor(y + 0.5 + motion.at(x, y, 1));
        return fromX < 0 || fromY < 0 || fromX >= double(wide.x) || fromY >= double(wide.y);
    };
    EXPECT_EQ(share(moving, comesIn), 1);
}

// Normals as colours: what is filled has its own pixel's where the surface is flat, so that nothing comes from other surfaces.
TEST(VariableRate, UpsamplingStaysOnTheSurface) {
    OrderedJson passes = nodes(rateSet({{"budget", 0.25}, {"choice", "fixed"}, {"forced", false}}));
    for (const char* pass : {"initial", "temporal", "spatial", "shade"}) passes.erase(pass);
    passes["whole"] = node("upsample", {{"color", "hits.normal"}, {"rates", "rate"}, {"depths", "hits.depth"}, {"normals", "hits.normal"}});
    Frames frames(sceneFile("cornell"), {75, 60}, passes, {"whole.color", "hits.normal", "rate.rates.pixels"});
    frames.run(2);
    const ImageData whole = frames.image("whole.color"), normal = frames.image("hits.normal");
    const auto rates = frames.records<TraceRate>("rate.rates.pixels");
    int filled = 0, own = 0;
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 75; ++x) {
            double difference = 0;
            for (int c = 0; c < 3; ++c) difference += std::abs(whole.at(x, y, c) - normal.at(x, y, c));
            if (traced(rates, std::size_t(y * 75 + x))) {
                EXPECT_EQ(x % 2 + y % 2, 0);
                EXPECT_EQ(difference, 0);
                continue;
            }
            ++filled;
            own += difference < 0.01;
        }
    EXPECT_GT(filled, 3000);
    EXPECT_GT(own, 0.98 * filled);
}

// Where reuse is off and nothing is traced for a while, reservoirs without confidence fill most of the image; each pass has to bear any mixture of them.
TEST(VariableRate, PassesBearPixelsThatHoldNothing) {
    const TemporaryFolder temporary;
    OrderedJson dark = OrderedJson::parse(readText(sceneFile("cube")));
    for (auto& [model, value] : dark["models"].items()) value["file"] = (sceneFolder() / value["file"].get<std::string>()).string();
    dark["environment"] = {{"type", "constant"}, {"color", {0, 0, 0}}, {"strength", 0}};
    writeFile(temporary.path / "dark.json", dark.dump());
    OrderedJson passes = nodes({{"rate", {{"set", {{"budget", 0.0625}, {"coarsest", "4x4"}, {"age", 255}, {"mirror", 0}, {"edges", 0}}}}},
                                {"initial", {{"set", {{"skipped", "absent"}}}}}});
    passes["pairing"] = node("pairing_textures", OrderedJson::object(), {{"radius", 4}});
    passes["splat"] = node("temporal_splat", pathsOf("initial", "paired"), {{"cap", 0}});
    passes["paired"] = node("spatial_paired_reuse", pathsOf("splat"));
    passes["calm"] = node("boiling_filter", {{"paths", "paired"}});
    passes["copies"] = node("duplication_map", {{"paths", "calm"}});
    passes["shadePaired"] = node("shade_reservoirs", {{"paths", "calm"}});
    const std::vector<std::string> ports{"temporal.paths.reservoirs", "spatial.paths.reservoirs", "splat.paths.reservoirs", "paired.paths.reservoirs",
                                         "calm.paths.reservoirs"},
        images{"spatial.color", "paired.color", "shade.color", "shadePaired.color", "copies.duplication"};
    std::vector<std::string> all{"initial.paths.reservoirs", "rate.rates.pixels"};
    all.insert(all.end(), ports.begin(), ports.end());
    all.insert(all.end(), images.begin(), images.end());
    for (const Path& scene : {temporary.path / "dark.json", sceneFile("ensemble_glossy")}) {
        const bool isDark = scene.stem() == "dark";
        Frames frames(scene, {48, 40}, passes, all);
        for (const int cap : {0, 20}) {
            frames.set("temporal.cap", Json(cap));
            frames.set("splat.cap", Json(cap));
            frames.restart(0);
            std::vector<Reservoir> before;
            for (int frame = 0; frame < 3; ++frame) {
                frames.run();
                const auto initial = frames.records<Reservoir>("initial.paths.reservoirs");
                const auto rates = frames.records<TraceRate>("rate.rates.pixels");
                int skipped = 0;
                for (std::size_t i = 0; i < rates.size(); ++i) {
                    EXPECT_EQ(confidenceOf(initial[i]), traced(rates, i) ? 1 : 0);
                    skipped += !traced(rates, i);
                }
                EXPECT_TRUE(frame == 0 ? skipped == 0 : skipped > int(rates.size()) * 4 / 5) << "all are traced where there is no history";
                for (const std::string& port : ports)
                    for (const Reservoir& r : frames.records<Reservoir>(port)) {
                        ASSERT_TRUE(isFinite(r)) << port;
                        ASSERT_TRUE(!isDark || r.W == 0) << port;
                    }
                for (const std::string& port : images) {
                    const double sum = sumOf(frames.image(port));  // finite
                    EXPECT_TRUE(!isDark || !port.ends_with("duplication") || sum == 0) << port;
                }
                // What is skipped keeps its history and its confidence, up to the cap; nothing grows of nothing.
                const auto after = frames.records<Reservoir>("temporal.paths.reservoirs");
                for (std::size_t i = 0; frame > 0 && i < rates.size(); ++i)
                    EXPECT_EQ(confidenceOf(after[i]), std::min(confidenceOf(before[i]), float(cap)) + (traced(rates, i) ? 1 : 0));
                before = frames.records<Reservoir>("spatial.paths.reservoirs");
            }
        }
    }
}

// The mean over fresh starts against path tracing: right where skipped pixels are absent and where they are weighed by their chance, though the guides
// look at what reuse left; wrong where they copy.
TEST(VariableRate, SkippedPixelsLeaveTheMeanButForCopies) {
    EnsembleJudge judge({.scene = sceneFile("ensemble_glossy"),
                         .size = {32, 18},
                         .warmup = 3,
                         .frame = 3,
                         .runs = 128,
                         .reference = {.graph = sourceFolder / "graphs/path_tracer.json", .variant = "no accumulation", .set = {}, .port = {}, .where = {}},
                         .referenceSamples = 2048,
                         .device = sharedDevice()});
    for (const char* variant : {"mode A", "mode B, guided", "copy"}) {
        const EnsembleResult result = judge.judge({.graph = sourceFolder / "graphs/variable_rate.json",
                                                   .variant = variant,
                                                   .set = {{"initial.candidates", Json(4)}, {"spatial.radius", Json(5)}},
                                                   .port = {},
                                                   .where = {}});
        EXPECT_EQ(result.verdict, variant == std::string("copy") ? Verdict::biased : Verdict::unbiased) << variant << ": " << result.reason;
        EXPECT_LE(result.halfWidth, 0.01);
        std::printf("%s: %+.2f %% +- %.2f %%\n", variant, 100 * (result.energy[0] / result.referenceEnergy[0] - 1), 100 * result.halfWidth);
    }
}

}  // namespace
}  // namespace lodestir::test
