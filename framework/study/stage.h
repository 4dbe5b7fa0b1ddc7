// SPDX-License-Identifier: MIT
// Where a study's graphs are rendered: one device, one scene at a time, every run in a fresh runner, so that no run knows of another.
#pragma once
#include <framework/graph/renderer.h>
#include <framework/scene/scene.h>
#include <framework/study/error/halves.h>
#include <framework/study/error/seen.h>
#include <framework/study/run_list.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace lodestir {

/// Most samples of one frame of a reference: frames of a second or so, because long ones are taken for a hang on GPUs that also draw the
/// screen.
inline constexpr std::uint64_t samplesPerFrame = 1 << 23;

/// A graph for one scene, checked, and what is measured of it.
struct StagedGraph {
    Graph graph;
    Source port;  ///< an image in linear radiance
};

struct StagedFrame {
    FrameReport report;
    ImageData image;  ///< three channels
};

class Stage {
public:
    Stage(const Study& study, const RendererOptions& options);
    ~Stage();

    /// Builds every graph of the study for every scene, without a device. Error with all that is wrong.
    void check();
    StagedGraph build(const StudyGraph& choice, const std::vector<Setting>& knobs, std::size_t scene, std::uint32_t seed);

    const gpu::DeviceFacts& device() { return renderer_.device().facts(); }
    RayBody rays() { return renderer_.rays(); }
    const Scene& scene(std::size_t index);  ///< loaded unless it was the last one asked for
    const Hash& sceneContent(std::size_t index);
    /// Hash of all that the frames of a run depend on but the device.
    std::string nameOf(const StudyRun& run);

    /// The reference's graph, taking so many samples a pixel and frame.
    StagedGraph buildReference(std::size_t scene, int samples);
    /// A runner of a graph that was built for the scene; graph and stage must outlive it, and no other scene may be asked for meanwhile.
    std::unique_ptr<Runner> makeRunner(StagedGraph& staged, std::size_t scene);
    /// The measured port after the runner's last frame: three channels. Error when validation had something to say.
    ImageData imageOf(const Runner& runner, const StagedGraph& staged);

    /// The measured frames of a run.
    std::vector<StagedFrame> render(const StudyRun& run);
    /// The reference of a measured frame (an offset from the event), from `folder` where it holds one for the same content. `finest`: of the
    /// scene at its finest levels.
    Halves reference(std::size_t scene, int offset, const Path& folder, bool finest = false);
    /// What is seen in the measured frames besides radiance.
    Seen see(std::size_t scene);

private:
    int samplesAFrame(const Graph& graph) const;  ///< of a reference, at most
    ImageData renderHalf(StagedGraph& staged, Runner& runner, const std::string& samplesName, int frame, std::uint32_t half);

    const Study& study_;
    Renderer renderer_;
    std::optional<std::size_t> loaded_;
    Scene scene_;
    Hash content_;
};

}  // namespace lodestir
