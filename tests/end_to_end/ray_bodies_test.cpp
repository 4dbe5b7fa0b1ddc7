// SPDX-License-Identifier: MIT
// Images do not depend on how rays are traced.
#include "program.h"
#include "statistics.h"

#include <framework/shaders/world/primary_hit.h>

#include <cstring>

namespace lodestir::test {
namespace {

class RayBodies : public ProgramTest {
protected:
    std::vector<PrimaryHit> hits(const std::string& body, const std::string& scene) {
        const Path out = run(body, sourceFolder / "passes/visibility/visibility.json",
                             {"--scene", (sourceFolder / "scenes" / scene).string(), "--size", "128x72", "--frames", "1", "--rays", body,
                              "--dump", "hits.hits"});
        const std::vector<std::byte> npy = readBytes(out / "hits.hits.0.npy");
        std::vector<PrimaryHit> result(128 * 72);
        const std::size_t bytes = result.size() * sizeof(PrimaryHit);
        EXPECT_GT(npy.size(), bytes);
        if (npy.size() > bytes) std::memcpy(result.data(), npy.data() + npy.size() - bytes, bytes);
        return result;
    }
    std::vector<ImageData> frames(const std::string& body, const std::string& scene) {
        return render(body + "_frames", sourceFolder / "graphs/path_tracer.json", "trace", 8,
                      {"--scene", (sourceFolder / "scenes" / scene).string(), "--size", "64x64", "--set", "trace.spp=16", "--rays", body});
    }
};

// The same rays meet the same triangles but where two are equally far, as on shared edges.
TEST_F(RayBodies, FirstHitsAgree) {
    for (const char* scene : {"rock.json", "cornell_glossy.json"}) {
        const auto packet = hits("packet", scene), lane = hits("lane", scene);
        std::size_t differ = 0;
        for (std::size_t i = 0; i < packet.size(); ++i) {
            EXPECT_EQ(packet[i].film, lane[i].film) << "pixel " << i;
            differ += packet[i].primitive != lane[i].primitive || packet[i].instance != lane[i].instance;
        }
        EXPECT_LE(differ, packet.size() / 1000) << scene;
    }
}

// Random numbers do not depend on the body either, so images differ only where a ray met another triangle or rounding tipped a choice.
TEST_F(RayBodies, ImagesAgree) {
    const auto packet = frames("packet", "cornell_glossy.json"), lane = frames("lane", "cornell_glossy.json");
    ASSERT_FALSE(HasFailure());
    std::size_t differ = 0;
    for (std::size_t i = 0; i < packet[0].values.size(); ++i)
        differ += std::abs(packet[0].values[i] - lane[0].values[i]) > 1e-3f * (1 + std::abs(packet[0].values[i]));
    EXPECT_LE(differ, packet[0].values.size() / 20);
    const Comparison comparison = compareFrames(packet, lane);
    EXPECT_TRUE(comparison.equal()) << comparison.text;
}

}  // namespace
}  // namespace lodestir::test
