// SPDX-License-Identifier: MIT
// Models that other people made render, given directly on the command line.
#include "program.h"

#include <framework/app/session.h>

namespace lodestir::test {
namespace {

class Models : public ProgramTest {
protected:
    void SetUp() override {
        if (!std::filesystem::is_directory(assetFolder)) GTEST_SKIP() << "no models at " << assetFolder << ", so nothing was rendered";
    }
    ImageData render(const std::string& name, const Arguments& more = {}) {
        SCOPED_TRACE(name);
        Arguments arguments{
            "--scene",    (assetFolder / "models" / name).string(), "--size", "64x36", "--frames", "1", "--show", "trace",
            "--check-nan"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        std::filesystem::remove_all(folder / "out");
        const Path out = run("out", sourceFolder / "graphs/path_tracer.json", arguments);
        return std::filesystem::exists(out / "trace.0.exr") ? readExr(out / "trace.0.exr") : makeImage(64, 36, 3);
    }
    void eachRenders(std::size_t step);
};

TEST_F(Models, Render) {
    for (const char* name : {"DamagedHelmet/glTF/DamagedHelmet.gltf", "Avocado/glTF/Avocado.gltf", "CornellBox-bevy/CornellBox.glb",
                             "BoxTexturedNonPowerOfTwo/BoxTexturedNonPowerOfTwo.gltf", "BoxInterleaved/BoxInterleaved.gltf",
                             "BoxVertexColors/BoxVertexColors.gltf", "AlphaMask/01_alpha_mask.gltf", "AlphaBlend/01_alpha_blend.gltf",
                             "SphereLights/sphere_lights.gltf", "SimpleInstancing/simple-instancing.glb",
                             "TriangleWithoutIndices-embedded/TriangleWithoutIndices.gltf"}) {
        const ImageData image = render(name);
        EXPECT_TRUE(allFinite(image)) << name;
        EXPECT_GT(meanOf(image), 1e-4) << name << " is black";
        const auto [low, high] = std::ranges::minmax(image.values);
        EXPECT_GT(high - low, 1e-3f) << name << " shows nothing";
    }
}

/// Every so many-th of all models. Two frames, so that what is animated moves. Here models share a device and a process, because a hundred processes would
/// take minutes.
void Models::eachRenders(std::size_t step) {
    std::vector<Path> files;
    for (const char* part : {"models", "decoded", "generator"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(assetFolder / part)) {
            const std::string extension = entry.path().extension().string(), name = entry.path().stem().string();
            const bool isRefused = name == "Compatibility_04" || name == "Compatibility_05";  // they require what no program may have
            if ((extension == ".gltf" || extension == ".glb") && !isRefused) files.push_back(entry.path());
        }
    std::ranges::sort(files);
    const auto device = std::make_shared<const gpu::Device>();
    ASSERT_TRUE(device->validating());
    for (std::size_t i = 0; i < files.size(); i += step) {
        const Path& file = files[i];
        SCOPED_TRACE(file.string());
        SessionOptions options;
        options.graph = sourceFolder / "graphs/path_tracer.json";
        options.changes.scene = file;
        options.changes.size = glm::uvec2(32, 18);
        Session session(options, {.device = device});
        for (int frame = 0; frame < 2; ++frame) session.runner().run();
        EXPECT_TRUE(allFinite(session.runner().readImage(session.graph().show)));
        EXPECT_EQ(device->validationMessages(), std::vector<std::string>{});
    }
    EXPECT_GE(files.size(), 90u);
}

// If this fails, somebody's model does not render: a crash, a value that isn't finite or a validation message. gltf_assets_test reads all of them.
TEST_F(Models, EveryThirdRenders) { eachRenders(3); }

using LongModels = Models;
TEST_F(LongModels, EveryOneRenders) { eachRenders(1); }

// If this fails, containers are read differently: the same model as .gltf, with data URIs, and as .glb.
TEST_F(Models, ThreeContainersOfOneModelGiveOneImage) {
    const ImageData separate = render("CesiumMan/glTF/CesiumMan.gltf"), embedded = render("CesiumMan-embedded/CesiumMan.gltf"),
                    binary = render("CesiumMan-glb/CesiumMan.glb");
    EXPECT_EQ(separate.values, embedded.values);
    EXPECT_EQ(separate.values, binary.values);
}

// If this fails, animated nodes stand still.
TEST_F(Models, AnimatedNodesMove) {
    const Path out = run("moving", sourceFolder / "passes/basic/visibility/visibility.json",
                         {"--scene", (assetFolder / "models/BoxAnimated/BoxAnimated.gltf").string(), "--size", "64x36", "--frames", "6",
                          "--show", "hits.motion", "--dump", "hits.normal"});
    const auto moves = [](const ImageData& motion) {
        return std::ranges::any_of(motion.values, [](float v) { return std::abs(v) > 0.1f; });
    };
    EXPECT_FALSE(moves(readExr(out / "hits.motion.0.exr"))) << "the first frame has no frame before it";
    EXPECT_TRUE(moves(readExr(out / "hits.motion.5.exr")));
    EXPECT_NE(readExr(out / "hits.normal.0.exr").values, readExr(out / "hits.normal.5.exr").values);
}

}  // namespace
}  // namespace lodestir::test
