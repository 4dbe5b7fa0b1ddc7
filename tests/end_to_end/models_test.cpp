// SPDX-License-Identifier: MIT
// Models that other people made render, given directly on the command line.
#include "program.h"

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

// If this fails, containers are read differently: the same model as .gltf, with data URIs, and as .glb.
TEST_F(Models, ThreeContainersOfOneModelGiveOneImage) {
    const ImageData separate = render("CesiumMan/glTF/CesiumMan.gltf"), embedded = render("CesiumMan-embedded/CesiumMan.gltf"),
                    binary = render("CesiumMan-glb/CesiumMan.glb");
    EXPECT_EQ(separate.values, embedded.values);
    EXPECT_EQ(separate.values, binary.values);
}

// If this fails, animated nodes stand still.
TEST_F(Models, AnimatedNodesMove) {
    const Path out = run("moving", sourceFolder / "passes/visibility/visibility.json",
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
