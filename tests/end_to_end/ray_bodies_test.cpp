// SPDX-License-Identifier: MIT
// Images do not depend on how rays are traced.
#include "program.h"
#include "render.h"
#include "statistics.h"

#include <framework/graph/runner.h>
#include <framework/shaders/world/primary_hit.h>

#include <cstring>

namespace lodestir::test {
namespace {

class RayBodies : public ProgramTest {
protected:
    struct FirstHits {
        std::vector<PrimaryHit> hits;
        ImageData depth;
    };
    FirstHits hits(const std::string& body, const std::string& scene) {
        const std::string last = std::to_string(lastFrame);
        const Path out = run(body, folder / "levels.json",
                             {"--scene", (sourceFolder / "scenes" / scene).string(), "--size", "128x72", "--frames", std::to_string(lastFrame + 1), "--rays",
                              body, "--dump", "hits.hits", "--dump", "hits.depth"});
        const std::vector<std::byte> npy = readBytes(out / ("hits.hits." + last + ".npy"));
        FirstHits result{std::vector<PrimaryHit>(128 * 72), readExr(out / ("hits.depth." + last + ".exr"))};
        const std::size_t bytes = result.hits.size() * sizeof(PrimaryHit);
        EXPECT_GT(npy.size(), bytes);
        if (npy.size() > bytes) std::memcpy(result.hits.data(), npy.data() + npy.size() - bytes, bytes);
        return result;
    }
    /// Every body that the device has, its best one first.
    static std::vector<std::string> bodies() {
        const auto devices = gpu::listDevices();
        const gpu::DeviceFacts& device = devices[gpu::chooseDevice(devices, "")];
        std::vector<std::string> names{std::string(nameOf(chooseRayBody(device, "")))};
        for (const char* name : {"lane", "ray_query"})
            if (name != names[0] && (device.rayQuery || name == std::string("lane"))) names.push_back(name);
        return names;
    }
    void SetUp() override {
        write("levels.json",
              {{"format", 1},
               {"scene", (sourceFolder / "scenes/rock.json").string()},
               {"passes", {{"lod", {{"type", "lod_select"}, {"set", {{"mode", "distance"}, {"distance", 1}}}}}, {"hits", {{"type", "visibility"}}}}},
               {"show", "hits.normal"}});
    }
    static constexpr int lastFrame = 3;
    std::vector<ImageData> frames(const std::string& body, const std::string& scene) {
        return render(sourceFolder / "graphs/path_tracer.json", "trace", 8,
                      {.scene = sourceFolder / "scenes" / scene, .size = glm::uvec2(64, 64), .set = {{"trace.spp", Json(16)}}}, body);
    }
};

// The same rays meet the same triangles but where two are equally far, as on shared edges; also after levels were switched and things moved.
TEST_F(RayBodies, FirstHitsAgree) {
    for (const char* scene : {"rock.json", "cornell_glossy.json", "chessboard.json", "ensemble_moving.json"}) {
        const auto best = hits(bodies()[0], scene);
        for (const std::string& body : bodies()) {
            const auto other = hits(body, scene);
            std::size_t differ = 0;
            for (std::size_t i = 0; i < best.hits.size(); ++i) {
                const PrimaryHit &a = best.hits[i], &b = other.hits[i];
                EXPECT_EQ(a.film, b.film) << "pixel " << i;
                const float far = best.depth.values[i], farther = other.depth.values[i];
                differ += (a.primitive != b.primitive || a.instance != b.instance) && std::abs(far - farther) > 1e-5f * far;
            }
            EXPECT_LE(differ, best.hits.size() / 1000) << scene << ", " << body;
        }
    }
}

// Random numbers do not depend on the body either, so images differ only where a ray met another triangle or rounding tipped a choice.
TEST_F(RayBodies, ImagesAgree) {
    for (const char* scene : {"cornell_glossy.json", "ensemble_panes.json"}) {
        const auto best = frames(bodies()[0], scene);
        for (const std::string& body : bodies()) {
            if (body == bodies()[0]) continue;
            const auto other = frames(body, scene);
            ASSERT_FALSE(HasFailure());
            std::size_t differ = 0;
            for (std::size_t i = 0; i < best[0].values.size(); ++i)
                differ += std::abs(best[0].values[i] - other[0].values[i]) > 1e-3f * (1 + std::abs(best[0].values[i]));
            EXPECT_LE(differ, best[0].values.size() / 20) << scene << ", " << body;
            const Comparison comparison = compareFrames(best, other);
            EXPECT_TRUE(comparison.equal()) << scene << ", " << body << ": " << comparison.text;
        }
    }
}

}  // namespace
}  // namespace lodestir::test
