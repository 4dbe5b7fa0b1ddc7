// SPDX-License-Identifier: MIT
// The same seed on the same device gives the same image, bit for bit; another seed, another one.
#include "program.h"
#include "shared_device.h"

#include <framework/app/session.h>

namespace lodestir::test {
namespace {

class SameBits : public ProgramTest {
protected:
    /// All image files of a run of the path tracer, by name.
    std::map<std::string, std::string> images(const std::string& out, const std::string& scene, const Arguments& more) {
        Arguments arguments{
            "--scene", (sourceFolder / "scenes" / scene).string(), "--size", "96x54", "--frames", "3", "--show", "trace", "--dump",
            "display"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Path results = run(out, sourceFolder / "graphs/path_tracer.json", arguments);
        std::map<std::string, std::string> files;
        for (const std::string& name : filesOf(results))
            if (name != "run.json") files[name] = readText(results / name);
        return files;
    }

    void holdsFor(const std::string& scene) {
        const auto first = images("first", scene, {"--seed", "5"}), second = images("second", scene, {"--seed", "5"});
        ASSERT_EQ(first.size(), 9u);
        ASSERT_EQ(second.size(), first.size());
        for (const auto& [name, bytes] : first) {
            EXPECT_TRUE(second.at(name) == bytes) << name << " differs between two processes";
        }
        const ImageData five = readExr(folder / "first/trace.0.exr"), next = readExr(folder / "first/trace.1.exr");
        EXPECT_NE(five.values, next.values) << "frames must not repeat their random numbers";
        images("other", scene, {"--seed", "6"});
        const ImageData six = readExr(folder / "other/trace.0.exr");
        std::size_t lit = 0, same = 0;
        for (std::size_t i = 0; i < five.values.size(); ++i) {
            if (five.values[i] == 0 && six.values[i] == 0) continue;  // what is black is black with any seed
            ++lit;
            same += five.values[i] == six.values[i];
        }
        EXPECT_GT(lit, five.values.size() / 20);
        EXPECT_LT(same, lit / 2) << "another seed must give other noise";
        EXPECT_NEAR(meanOf(six) / meanOf(five), 1, 0.5) << "of the same picture";
    }
};

TEST_F(SameBits, Rock) { holdsFor("rock.json"); }
TEST_F(SameBits, GlossyCornellBox) { holdsFor("cornell_glossy.json"); }

// Whatever order the driver runs workgroups in, a pixel's sum has one order.
TEST_F(SameBits, WithABarrierBeforeEveryPass) {
    EXPECT_TRUE(images("few", "cornell_glossy.json", {}) == images("all", "cornell_glossy.json", {"--all-barriers"}))
        << "a barrier is missing";
}

// A port made in the memory of another, or not at all, must not show in what is made of it.
TEST_F(SameBits, WhateverSharesMemory) {
    for (const char* graph : {"restir_pt_enhanced.json", "restir_lod.json"}) {
        const auto last = [&](bool share, std::vector<std::string> dumps) {
            Session session({.graph = sourceFolder / "graphs" / graph,
                             .changes = {.scene = sourceFolder / "scenes/ensemble_moving.json", .size = glm::uvec2(48, 40)},
                             .dumps = std::move(dumps),
                             .shareMemory = share},
                            {.device = sharedDevice()});
            for (int frame = 0; frame < 4; ++frame) session.runner().run();
            return session.runner().readImage(session.graph().show).values;
        };
        const std::vector<float> bare = last(false, {});
        EXPECT_TRUE(bare == last(true, {})) << graph;
        EXPECT_TRUE(bare == last(false, {"hits.motion", "hits.depth", "initial.paths", "temporal.paths", "temporal.color", "shade.color"})) << graph;
    }
    EXPECT_EQ(sharedDevice()->validationMessages(), std::vector<std::string>{});
}

// With two rounds what is reserved for one of them comes and goes.
TEST_F(SameBits, ReservedMemoryFollowsParameters) {
    const auto paths = [](bool listed) {
        Session session({.graph = sourceFolder / "graphs/restir_pt_enhanced.json",
                         .changes = {.size = glm::uvec2(48, 40), .set = {{"spatial.rounds", Json(2)}, {"spatial.compaction", Json(listed)}}},
                         .dumps = {"spatial.paths"},
                         .checkBounds = listed},
                        {.device = sharedDevice()});
        for (int frame = 0; frame < 2; ++frame) session.runner().run();
        return session.runner().readBytes(findSource(session.graph(), "spatial.paths.reservoirs"));
    };
    EXPECT_TRUE(paths(false) == paths(true));
    EXPECT_EQ(sharedDevice()->validationMessages(), std::vector<std::string>{});
}

// What splatting keeps while it runs is small records beside the paths, and paths of those techniques alone that make any. If this fails, look at what
// `lodestir check` tells of the pass.
TEST_F(SameBits, SplattingHoldsWhatItsTechniquesMake) {
    const auto bytesAPixel = [](std::optional<std::string> variant, std::vector<Setting> set) {
        const auto bytes = [&](glm::uvec2 size) {
            Session session({.graph = sourceFolder / "graphs/restir_lod.json", .changes = {.size = size, .set = set, .variant = variant}},
                            {.device = sharedDevice()});
            session.runner().run();
            return session.runner().memoryBytes();
        };
        return double(bytes({64, 48}) - bytes({32, 32})) / (64 * 48 - 32 * 32);
    };
    const double both = bytesAPixel({}, {}), splatted = bytesAPixel({}, {{"temporal.backup", Json(0)}}), reprojected = bytesAPixel("frame jitter", {});
    std::printf("bytes a pixel of all ports: %.1f, %.1f without a backup, %.1f without splats\n", both, splatted, reprojected);
    EXPECT_LE(both, 656);
    EXPECT_EQ(both - splatted, 128 + 16) << "a path and its landing";
    EXPECT_EQ(both - reprojected, 128 + 16 + 4) << "the same, and an entry in a list";
    EXPECT_EQ(sharedDevice()->validationMessages(), std::vector<std::string>{});
}

}  // namespace
}  // namespace lodestir::test
